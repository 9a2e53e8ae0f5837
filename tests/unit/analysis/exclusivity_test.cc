#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "compiler/analysis/satisfier.h"
#include "tests/unit/program/program_builder.h"
#include "tests/unit/stride.h"

namespace kb::analysis {
namespace {

using namespace program::testing;
using program::Program;

struct Member { float initial = -1.0f; bool keep = false; };

/// Facts F to J; satellites A, B, C, one variable.
ProgramBuilder group(Member a, Member b = {}, Member c = {}) {
  ProgramBuilder builder({"goal", "act", "control"});
  for (const char* fact : {"F", "G", "H", "I", "J"}) builder.fact(fact);
  builder.satellite("A", a.initial, a.keep).satellite("B", b.initial, b.keep).satellite("C", c.initial, c.keep);
  builder.exclusive({"A", "B", "C"});
  return builder;
}

bool exclusive(const ProgramBuilder& builder) { return exclusive_at_all_times(builder.build()).front(); }

TEST(ExclusiveAtAllTimes, EveryGroupWhoseMembersAreRaisedOneByOne) {
  ProgramBuilder b = group({1.0f});
  b.when("a", "goal", high("F"), {raise("A")}).when("b", "goal", high("G"), {raise("B")}).when("reset", "goal", low("F"), {reset_all()});
  EXPECT_TRUE(exclusive(b));
}

TEST(ExclusiveAtAllTimes, AGroupThatIsKeptAsAWhole) {
  ProgramBuilder b = group({1.0f, true}, {-1.0f, true}, {-1.0f, true});
  b.when("b", "goal", high("G"), {raise("B")});
  EXPECT_TRUE(exclusive(b));
  b.when("reset", "goal", low("F"), {reset_all()}).when("c", "goal", low("G"), {reset_all(), raise("C")});
  EXPECT_TRUE(exclusive(b));
}

TEST(ExclusiveAtAllTimes, NotIfAResetRaisesOneBesideOneThatIsKept) {
  ProgramBuilder b = group({1.0f}, {-1.0f, true});
  b.when("reset", "goal", low("F"), {reset_all()});
  EXPECT_TRUE(exclusive(b)) << "nothing raises B";
  b.when("b", "act", high("G"), {raise("B")});
  EXPECT_FALSE(exclusive(b));
}

TEST(ExclusiveAtAllTimes, IfOneThatIsKeptBeginsHighAndAResetRaisesNone) {
  ProgramBuilder b = group({1.0f, true});
  b.when("b", "goal", high("G"), {raise("B")}).when("reset", "goal", low("F"), {reset_all()});
  EXPECT_TRUE(exclusive(b));
}

TEST(ExclusiveAtAllTimes, NotIfOneRuleRaisesTwo) {
  ProgramBuilder b = group({1.0f}, {-1.0f, true});
  b.when("both", "goal", low("F"), {raise("B"), reset_all()});
  EXPECT_FALSE(exclusive(b));
  ProgramBuilder other = group({1.0f}, {-1.0f, true});
  other.when("one", "goal", low("F"), {raise("A"), reset_all()});
  EXPECT_TRUE(exclusive(other));
}

TEST(ExclusiveAtAllTimes, ALaterEffectMattersWhereAnotherRuleOfTheLevelRaisesThatMember) {
  ProgramBuilder b = group({});
  b.when("a", "goal", high("F"), {raise("A"), assign("B", -0.5f)});
  EXPECT_TRUE(exclusive(b));
  b.when("below", "act", high("G"), {raise("B")});
  EXPECT_TRUE(exclusive(b));
  b.when("beside", "goal", high("G"), {raise("B")});
  EXPECT_FALSE(exclusive(b));
  ProgramBuilder weak = group({});
  weak.when("a", "goal", high("F"), {assign("A", 0.5f), assign("B", -0.5f)}).when("b", "goal", high("G"), {raise("B")});
  EXPECT_TRUE(exclusive(weak));
}

TEST(ExclusiveAtAllTimes, AResetSilencesTheRulesBesideIt) {
  ProgramBuilder b = group({});
  b.when("a", "goal", high("F"), {reset_all(), raise("A"), assign("B", 0.0f)}).when("b", "goal", high("G"), {raise("B")});
  EXPECT_TRUE(exclusive(b));
  b.when("c", "goal", high("G"), {reset_all(), raise("B")});
  EXPECT_FALSE(exclusive(b));
}

class RandomGroups {
 public:
  explicit RandomGroups(std::uint64_t seed) : random_(seed) {}

  Program program() {
    Member members[3];
    for (Member& member : members) member = {one_of({-1.0f, -1.0f, -0.5f, 0.0f}), chance(40)};
    if (chance(60)) members[pick(3)].initial = one_of({1.0f, 0.5f});
    ProgramBuilder builder = group(members[0], members[1], members[2]);
    for (std::size_t i = 0, rules = 2 + pick(4); i < rules; ++i) {
      std::vector<NamedEffect> effects;
      for (std::size_t k = 0, count = 1 + pick(3); k < count; ++k) {
        if (chance(20)) effects.push_back(reset_all());
        else effects.push_back(assign(std::string(1, "ABC"[pick(3)]), one_of({1.0f, 1.0f, 0.5f, 0.0f, -0.5f, -1.0f})));
      }
      builder.while_true("rule" + std::to_string(i), chance(70) ? "goal" : "act", high(std::string(1, "FGHIJ"[i])), effects);
    }
    return builder.build();
  }
  float fact() { return std::uniform_real_distribution<float>(-1.0f, 1.0f)(random_); }

 private:
  std::size_t pick(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  bool chance(int percent) { return pick(100) < static_cast<std::size_t>(percent); }
  float one_of(std::vector<float> values) { return values[pick(values.size())]; }

  std::mt19937_64 random_;
};

TEST(ExclusiveAtAllTimes, AgreesWithWhatHappens) {
  std::size_t doubted = 0, seen = 0, held = 0;
  for (std::uint64_t seed = 0; seed < 3'000; seed += kb::testing::stride()) {
    RandomGroups random(seed);
    const Program program = random.program();
    const bool promised = exclusive_at_all_times(program).front();
    program::Interpreter interpreter(program);
    bool both = false;
    for (int tick = 0; tick < 200 && !both; ++tick) {
      const float facts[] = {random.fact(), random.fact(), random.fact(), random.fact(), random.fact()};
      static_cast<void>(interpreter.tick(facts, 100'000));
      const auto up = [&](program::CellId member) { return interpreter.value(member) > 0.0f; };
      both = std::ranges::count_if(program.exclusive.front(), up) > 1;
    }
    ASSERT_FALSE(promised && both) << "seed " << seed << "\n" << print(program);
    ++(promised ? held : doubted);
    seen += both ? 1 : 0;
  }
  EXPECT_GT(held * kb::testing::stride(), 1'000u);
  EXPECT_GT(seen * 10, doubted * 7) << seen << " of " << doubted;   // the others take more than it looks at
}

}  // namespace
}  // namespace kb::analysis
