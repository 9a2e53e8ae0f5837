#include <gtest/gtest.h>

#include "tests/unit/program/program_builder.h"
#include "tests/unit/program/random_program.h"

namespace kb::program::testing {
namespace {

Program sound() {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").satellite("A").satellite("B").exclusive({"A", "B"}).strategy("Go");
  b.when("r", "goal", held(seen("F"), 1), {raise("A")});
  b.when("s", "goal", high("A"), {raise("B"), raise("sat Go")});
  return b.build();
}

/// The first fault of a program after `damage`.
template <class Damage>
std::string fault(Damage damage) {
  Program program = sound();
  damage(program);
  const std::vector<std::string> faults = verify(program);
  return faults.empty() ? "" : faults.front();
}

TEST(Verify, FindsNothingInSoundPrograms) {
  EXPECT_TRUE(verify(sound()).empty());
  for (std::uint64_t seed = 0; seed < 200; ++seed) EXPECT_TRUE(verify(random_program(seed)).empty()) << "seed " << seed;
}

TEST(Verify, FindsWhatWouldLeadTheEngineAstray) {
  EXPECT_EQ(fault([](Program& p) { ++p.facts; }), "6 cells, 7 counted");
  EXPECT_EQ(fault([](Program& p) { std::swap(p.cells[0], p.cells[2]); }),
            "cell `A` stands among cells of another kind");
  EXPECT_EQ(fault([](Program& p) { p.cells[1].initial = 2.0f; }), "cell `sat F` starts outside [-1, 1]");
  EXPECT_EQ(fault([](Program& p) { p.cells[0].event = 1.5; }), "fact `F`: thresholds 1.5 and 0.25 leave [0, 1]");
  EXPECT_EQ(fault([](Program& p) { p.settings.firing = 0.0; }), "firing = 0 is outside (0, 1]");
  EXPECT_EQ(fault([](Program& p) { p.exclusive.push_back(p.exclusive[0]); }), "cell `A` is in two exclusive groups");
  EXPECT_EQ(fault([](Program& p) { p.priority.clear(); }), "the priority does not hold every strategy once");
  EXPECT_EQ(fault([](Program& p) { p.conds[1].children[0] = CondId{7}; }),
            "condition 1 has part 7, which is not before it");
  EXPECT_EQ(fault([](Program& p) { p.conds[0].cell = CellId{1}; }),
            "condition 0: `sat F` is no fact and cannot be seen");
  EXPECT_EQ(fault([](Program& p) { p.rules[0].level = 1; }), "rule `s` stands below a lower level");
  EXPECT_EQ(fault([](Program& p) { p.rules[0].writes[0].cell = CellId{0}; }),
            "rule `r` writes a cell that is no satellite");
  EXPECT_EQ(fault([](Program& p) {
              p.rules[1].writes = {{CellId{3}, 1.0f}, {CellId{2}, 1.0f}};
            }),
            "rule `s`: its writes are not ascending");
  EXPECT_EQ(fault([](Program& p) { p.rules[0].clears = {4}; }), "rule `r` clears no exclusive group");
}

}  // namespace
}  // namespace kb::program::testing
