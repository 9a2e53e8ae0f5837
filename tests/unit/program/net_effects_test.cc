#include "compiler/program/net_effects.h"

#include <gtest/gtest.h>

#include "tests/unit/program/program_builder.h"

namespace kb::program::testing {
namespace {

using Net = std::map<std::string, float>;

/// Group G { A, B, C }, group M { K (kept), L }, free X (initially 0.5), Y.
Rule folded(const std::vector<NamedEffect>& effects, Program* out = nullptr) {
  ProgramBuilder b({"goal", "control"});
  b.satellite("A")
      .satellite("B")
      .satellite("C")
      .satellite("K", -1.0f, true)
      .satellite("L")
      .satellite("X", 0.5f)
      .satellite("Y");
  b.exclusive({"A", "B", "C"}).exclusive({"K", "L"});
  b.when("r", "goal", high("Y"), effects);
  const Program program = b.build();
  if (out != nullptr) *out = program;
  return program.rules.front();
}

Net net(const std::vector<NamedEffect>& effects) {
  Program program;
  const Rule rule = folded(effects, &program);
  Net found;
  CellId last = CellId::kNone;
  for_each_net_write(program, rule, [&](CellId cell, float value) {
    EXPECT_TRUE(last == CellId::kNone || last < cell) << "each once, ascending";
    last = cell;
    found.emplace(program[cell].name, value);
  });
  for (std::uint32_t i = 0; i < program.cells.size(); ++i) {   // net_value says the same of one cell
    const auto at = found.find(std::string(program.cells[i].name));
    EXPECT_EQ(net_value(program, group_of_cells(program), rule, CellId{i}), at == found.end() ? std::nullopt : std::optional(at->second));
  }
  return found;
}

TEST(NetEffects, PositiveWriteClearsTheRestOfItsGroup) {
  EXPECT_EQ(net({raise("A")}), (Net{{"A", 1}, {"B", -1}, {"C", -1}}));
  EXPECT_EQ(net({assign("A", 0.3f)}), (Net{{"A", 0.3f}, {"B", -1}, {"C", -1}}));
}
TEST(NetEffects, WriteThatIsNotPositiveClearsNothing) {
  EXPECT_EQ(net({lower("A")}), (Net{{"A", -1}}));
  EXPECT_EQ(net({assign("A", 0.0f)}), (Net{{"A", 0}}));
}
TEST(NetEffects, LaterEffectsOverrideEarlierOnes) {
  EXPECT_EQ(net({raise("A"), lower("B"), raise("C")}), (Net{{"A", -1}, {"B", -1}, {"C", 1}}));
  EXPECT_EQ(net({raise("A"), assign("B", 0.0f)}), (Net{{"A", 1}, {"B", 0}, {"C", -1}}));
  EXPECT_EQ(net({assign("B", 0.0f), raise("A")}), (Net{{"A", 1}, {"B", -1}, {"C", -1}}));
  EXPECT_EQ(net({raise("A"), lower("A")}), (Net{{"A", -1}, {"B", -1}, {"C", -1}}));
  EXPECT_EQ(net({raise("X"), lower("X")}), (Net{{"X", -1}}));
}
TEST(NetEffects, LoweringAllThenRaisingOneIsTheSameAsRaisingIt) {
  const Rule rule = folded({lower("A"), lower("B"), lower("C"), raise("B")});
  EXPECT_EQ(rule.writes.size(), 1u);
  EXPECT_EQ(rule.clears.size(), 1u);
  EXPECT_EQ(net({lower("A"), lower("B"), lower("C"), raise("B")}), (Net{{"A", -1}, {"B", 1}, {"C", -1}}));
}
TEST(NetEffects, LoweringAllIsOneClear) {
  const Rule rule = folded({lower("A"), lower("B"), lower("C")});
  EXPECT_TRUE(rule.writes.empty());
  EXPECT_EQ(rule.clears.size(), 1u);
}
TEST(NetEffects, ResetOverridesWhatCameBeforeButForKeptSatellites) {
  EXPECT_EQ(net({reset_all()}), (Net{{"A", -1}, {"B", -1}, {"C", -1}, {"L", -1}, {"X", 0.5f}, {"Y", -1}}));
  EXPECT_EQ(net({raise("Y"), raise("A"), reset_all()}),
            (Net{{"A", -1}, {"B", -1}, {"C", -1}, {"L", -1}, {"X", 0.5f}, {"Y", -1}}));
  EXPECT_EQ(net({raise("K"), reset_all()}),
            (Net{{"A", -1}, {"B", -1}, {"C", -1}, {"K", 1}, {"L", -1}, {"X", 0.5f}, {"Y", -1}}));
  EXPECT_EQ(net({raise("L"), reset_all()}),
            (Net{{"A", -1}, {"B", -1}, {"C", -1}, {"K", -1}, {"L", -1}, {"X", 0.5f}, {"Y", -1}}));
}
TEST(NetEffects, EffectsAfterAResetOverrideIt) {
  EXPECT_EQ(net({reset_all(), raise("B"), lower("X")}),
            (Net{{"A", -1}, {"B", 1}, {"C", -1}, {"L", -1}, {"X", -1}, {"Y", -1}}));
}
TEST(NetEffects, StayLinearInLargeGroups) {
  ProgramBuilder b({"goal", "control"});
  std::vector<std::string> legs;
  for (int i = 0; i < 2000; ++i) {
    legs.push_back("leg" + std::to_string(i));
    b.satellite(legs.back());
  }
  for (int i = 0; i + 1 < 2000; ++i)
    b.when("r" + std::to_string(i), "goal", high(legs[static_cast<std::size_t>(i)]),
           {raise(legs[static_cast<std::size_t>(i) + 1])});
  b.exclusive(legs);
  const Program program = b.build();
  std::size_t size = 0;
  for (const Rule& rule : program.rules) size += rule.writes.size() + rule.clears.size();
  EXPECT_LE(size, 2 * program.rules.size());
}

}  // namespace
}  // namespace kb::program::testing
