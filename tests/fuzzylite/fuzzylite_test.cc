#include <fl/Headers.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "compiler/diagnostics/consumers.h"
#include "compiler/fuzzy/interpret.h"
#include "compiler/model/model.h"
#include "compiler/tables/fuzzy.h"
#include "tests/unit/fuzzy/random_controller.h"
#include "tools/kbc/fll/fll.h"

namespace kb::fll {
namespace {

std::size_t points() {
  const char* const asked = std::getenv("KB_FUZZYLITE_POINTS");
  return asked != nullptr ? std::strtoul(asked, nullptr, 10) : 1'500;
}

std::unique_ptr<fl::Engine> engine_of(const std::string& text) {
  fl::fuzzylite::setMachEps(1e-13);   // else a degree below 1e-6 is nothing to it
  return std::unique_ptr<fl::Engine>(fl::FllImporter().fromString(text));
}

/// Both at many points. Where the strengths add up to next to nothing a mean hangs on their last bits: such points are
/// counted, and must be few.
void compare(const fuzzy::Controller& controller, fl::Engine& engine, std::uint64_t seed, const std::string& name) {
  const tables::FuzzyForm form = tables::pack(controller);
  std::size_t compared = 0;
  for (std::size_t n = 0; n < points(); ++n) {
    const std::vector<double> x = fuzzy::testing::random_inputs(controller, seed + n);
    for (std::size_t slot = 0; slot < x.size(); ++slot) engine.inputVariables()[slot]->setValue(x[slot]);
    engine.process();
    const auto exact = fuzzy::interpret(controller, x);
    const auto robot = tables::evaluate(form, std::vector<float>(x.begin(), x.end()));
    for (std::uint32_t o = 0; o < controller.outputs.size(); ++o) {
      double weight = 0.0;
      for (std::size_t r = 0; r < controller.rules.size(); ++r) {
        for (const auto& one : controller.rules[r].consequents) weight += one.output == o ? exact.strengths[r] : 0.0;
      }
      const double theirs = engine.outputVariables()[o]->getValue();
      if (weight > 0.0 && weight < 1e-2) continue;
      if (weight == 0.0 && std::isnan(theirs)) continue;
      const double size = std::max({1.0, std::fabs(controller.outputs[o].low), std::fabs(controller.outputs[o].high)});
      ASSERT_NEAR(exact.outputs[o], theirs, 1e-5) << name << ", output " << o << ", point " << n;
      ASSERT_NEAR(static_cast<double>(robot.outputs[o]), theirs, 1e-5 * size / std::min(1.0, std::max(weight, 0.1))) << name << ", output " << o << ", point " << n;
      ++compared;
    }
  }
  EXPECT_GT(compared, points() / 4) << name;
}

TEST(Export, RandomControllersAnswerAsInFuzzylite) {
  const source::Sources sources;
  diagnostics::CountingConsumer consumer;
  diagnostics::Diagnostics diagnostics(sources, consumer);
  std::size_t exported = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const auto controller = fuzzy::testing::random_controller(seed, {.circles = false, .nests = true, .reach = false, .negations = false});
    const auto text = export_engine(controller, diagnostics);
    ASSERT_TRUE(text) << seed;
    const auto engine = engine_of(*text);
    compare(controller, *engine, seed * 1'000'000, "seed " + std::to_string(seed) + "\n" + *text);
    ++exported;
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(exported, 30u);
}

/// The text of a knowledge base as its first controller.
std::optional<fuzzy::Controller> compile(const std::string& text, source::Sources& sources, diagnostics::Diagnostics& diagnostics) {
  source::MemoryFileSystem files;
  files.add("main.kb", text);
  const model::Forest forest = model::load("main.kb", "", files, sources, diagnostics);
  const model::Model model = model::resolve(forest, diagnostics);
  if (model.fuzzy.empty()) return std::nullopt;
  return model.fuzzy.front();
}

// Hedges and functions of fuzzylite, letters that it leaves out, and names that the export makes itself.
TEST(Export, NamesThatFuzzyliteReadsAsSomethingElse) {
  source::Sources sources;
  diagnostics::CountingConsumer consumer;
  diagnostics::Diagnostics diagnostics(sources, consumer);
  const auto controller = compile(R"(fuzzy Names {
    input  free[2] 0..1 { any = ramp(0.9, 0.1)  sin = ramp(0.1, 0.9) }
    input  free_0 0..1 { lt = ramp(0.9, 0.1)  round = ramp(0.1, 0.9) }
    output max 0..1 { rule0_max = 0.1  größe = 1  seldom = 0.7 }
    free[0] is any -> max = 0.3
    free[1] is sin and free_0 is lt -> max = rule0_max
    free[1] is not any and free_0 is round -> max = größe
    free[0] is sin or free_0 is very round -> max = seldom
  }
)", sources, diagnostics);
  ASSERT_TRUE(controller);
  const auto text = export_engine(*controller, diagnostics);
  ASSERT_TRUE(text);
  compare(*controller, *engine_of(*text), 11, *text);
}

TEST(Import, EnginesAnswerAsInFuzzylite) {
  std::size_t imported = 0;
  for (const char* const name : {"obstacle", "linear"}) {
    std::ifstream file(fmt::format("{}/{}.fll", KB_ENGINES, name));
    std::stringstream bytes;
    bytes << file.rdbuf();
    source::Sources sources;
    diagnostics::CountingConsumer consumer;
    diagnostics::Diagnostics diagnostics(sources, consumer);
    const source::FileId id = sources.add(name, bytes.str());
    const auto text = import_engine(sources, id, diagnostics);
    ASSERT_TRUE(text) << name;
    const auto controller = compile(*text, sources, diagnostics);
    ASSERT_TRUE(controller) << *text;
    EXPECT_EQ(diagnostics.errors(), 0u) << *text;
    const auto engine = engine_of(bytes.str());
    compare(*controller, *engine, 7, *text);
    ++imported;
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(imported, 2u);
}

// Out and in again: the same controller, as far as it answers.
TEST(Import, TakesWhatExportWrites) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    source::Sources sources;
    diagnostics::CountingConsumer consumer;
    diagnostics::Diagnostics diagnostics(sources, consumer);
    const auto controller = fuzzy::testing::random_controller(seed, {.circles = false, .nests = true, .reach = false, .negations = false});
    const auto text = export_engine(controller, diagnostics);
    ASSERT_TRUE(text);
    const auto back = import_engine(sources, sources.add("engine.fll", *text), diagnostics);
    ASSERT_TRUE(back) << *text;
    const auto again = compile(*back, sources, diagnostics);
    ASSERT_TRUE(again) << *back;
    for (std::uint64_t n = 0; n < 200; ++n) {
      const auto x = fuzzy::testing::random_inputs(controller, seed * 1'000 + n);
      const auto first = fuzzy::interpret(controller, x), second = fuzzy::interpret(*again, x);
      for (std::size_t o = 0; o < first.outputs.size(); ++o) ASSERT_NEAR(first.outputs[o], second.outputs[o], 1e-9) << *back;
    }
  }
}

}  // namespace
}  // namespace kb::fll
