#include "compiler/analysis/confusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include <fmt/format.h>

#include "compiler/diagnostics/consumers.h"
#include "compiler/driver/compile.h"
#include "compiler/fuzzy/certainty.h"
#include "compiler/source/source.h"

namespace kb::analysis {
namespace {

using program::CellId;
using program::Percept;
using program::PerceptId;
using program::Program;

Program program_of(const std::string& text) {
  source::MemoryFileSystem files;
  files.add("main.kb", text);
  driver::Options options;
  options.until = driver::Stage::kProgram;
  std::vector<diagnostics::Diagnostic> said;
  return driver::compile("main.kb", files, options, diagnostics::Keeping::make, &said)->program;
}

/// The certainty of a definition when the sensor reads `x`, spread by its noise and its age.
double certainty(const Program& program, PerceptId id, double x, double spread) {
  const Percept& percept = program.perception[id];
  std::vector<double> parts;
  for (const PerceptId child : percept.children) parts.push_back(certainty(program, child, x, spread));
  switch (percept.op) {
    case Percept::Op::kFits: return fuzzy::certainty(program.perception.prototypes[percept.prototype].shape, x, spread);
    case Percept::Op::kNot: return -parts.front();
    case Percept::Op::kAnd: return *std::min_element(parts.begin(), parts.end());
    case Percept::Op::kOr: return *std::max_element(parts.begin(), parts.end());
    default: return 0.0;
  }
}

/// The most that both can have at once, at any of many readings and ages.
double most_at_any_age(const Program& program, std::size_t first, std::size_t second) {
  double most = -1.0;
  for (const double spread : {1.0, 1.5, 3.0, 8.0, 20.0, 60.0}) {
    for (double x = 0.0; x <= 100.0; x += 0.5) {
      const auto at = [&](std::size_t i) { return certainty(program, program.perception.perceived[i].percept, x, spread); };
      most = std::max(most, std::min(at(first), at(second)));
    }
  }
  return most;
}

TEST(Confusions, FactsAreExclusiveOnlyIfNoReadingOfAnyAgeGivesBoth) {
  std::mt19937 random(7);
  const auto number = [&](int least, int most) { return std::uniform_int_distribution<int>(least, most)(random); };
  const auto part = [&] {
    const int from = number(0, 90), to = number(from + 1, 100);
    const std::string ramp = number(0, 1) == 1 ? fmt::format("ramp({}, {})", from, to) : fmt::format("ramp({}, {})", to, from);
    return (number(0, 3) == 0 ? "not s ~ " : "s ~ ") + ramp;
  };
  int exclusive = 0, not_so = 0;
  for (int round = 0; round < 60; ++round) {
    const auto definition = [&] { return number(0, 1) == 1 ? part() : part() + (number(0, 1) == 1 ? " and " : " or ") + part(); };
    const Program program = program_of(fmt::format("levels a > b\nsensor s 0..100 noise 1 stale 5 s\nfact A = {}\nfact B = {}\n", definition(), definition()));
    ASSERT_EQ(program.perception.perceived.size(), 2u);
    Confusions confusions(program);
    const double most = most_at_any_age(program, 0, 1);
    for (const double limit : {0.2, 0.5, 0.8}) {
      const bool never = confusions.exclusive(CellId{0}, CellId{1}, limit);
      (never ? exclusive : not_so) += 1;
      if (never) {
        EXPECT_LT(most, limit);
      }
    }
  }
  EXPECT_GT(exclusive, 20);
  EXPECT_GT(not_so, 20);
}

TEST(Confusions, AFactAndItsOppositeAreExclusiveAlthoughBothMayBeUnknown) {
  const Program program = program_of("levels a > b\nsensor s 0..100 noise 1\nfact Given\nfact A = s ~ ramp(40, 60)\nfact B = not A\nfact C = not A and Given\n");
  Confusions confusions(program);
  const CellId a{1}, b{2}, c{3};
  EXPECT_GT(confusions.between(a, b).degree, -0.01);
  EXPECT_TRUE(confusions.exclusive(a, b, 0.1));
  EXPECT_TRUE(confusions.exclusive(a, c, 0.5));
  EXPECT_FALSE(confusions.exclusive(b, c, 0.5));
  EXPECT_FALSE(confusions.exclusive(CellId{0}, a, 0.5));
}

}  // namespace
}  // namespace kb::analysis
