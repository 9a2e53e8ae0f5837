// From the model to the program: a model by hand, as the earlier phase would make it.
#include <gtest/gtest.h>

#include "compiler/model/model.h"
#include "compiler/program/program.h"

namespace kb::program {
namespace {

model::CellId add_cell(model::Model& model, const std::string& name, model::CellKind kind, float initial) {
  model::Cell cell;
  cell.name = model.texts->keep(name);
  cell.kind = kind;
  cell.initial = initial;
  model.cells.push_back(cell);
  return model::CellId{static_cast<std::uint32_t>(model.cells.size() - 1)};
}

/// Cells in an order of declaration that is not the program's; two levels; a rule at the lower one declared first.
model::Model small_model() {
  model::Model model;
  model.levels = {"goal", "route", "control"};
  const auto go = add_cell(model, "Go", model::CellKind::kStrategy, -1.0f);
  const auto sat_go = add_cell(model, "sat Go", model::CellKind::kSatellite, -1.0f);
  const auto line = add_cell(model, "Line", model::CellKind::kFact, 0.0f);
  const auto sat_line = add_cell(model, "sat Line", model::CellKind::kSatellite, 1.0f);
  model.cells[model::index(go)].satellites = {sat_go};
  model.cells[model::index(line)].satellites = {sat_line};
  model.exclusive = {{sat_line, sat_go}};
  model.priority = {go};
  model.settings.idle = model::Idle::kStrategy;
  model.settings.idle_strategy = go;
  model.conds.resize(4);
  model.conds[0].op = model::Cond::Op::kSeen;
  model.conds[0].cell = line;
  model.conds[1].op = model::Cond::Op::kIs;
  model.conds[1].term = syntax::Term::kLow;
  model.conds[1].cell = sat_go;
  model.conds[2].op = model::Cond::Op::kAnd;
  model.conds[2].children = {model::CondId{0}, model::CondId{1}};
  model.conds[3].op = model::Cond::Op::kAnd;  // (seen Line and sat Go is low) and seen Line
  model.conds[3].children = {model::CondId{2}, model::CondId{0}};
  model.templates = {{"lower", {}, true, 1}, {"upper", {}, false, 0, syntax::Rule::Mode::kWhile}};
  model::Rule lower;
  lower.tmpl = model::TemplateId{0};
  lower.name = "lower[x]";
  lower.condition = model::CondId{3};
  lower.effects = {{sat_go, 1.0f, {}, false}};
  model::Rule upper = lower;
  upper.tmpl = model::TemplateId{1};
  upper.name = "upper";
  upper.effects = {{model::CellId::kNone, 0.0f, {}, true}};
  model.rules = {lower, upper};
  model.controls = {{go, "drive", fuzzy::kNone, {{"speed", 0.4, "m/s", "", true, {}}}, {}, {}}};
  return model;
}

Program lowered(const model::Model& model) {
  const source::Sources sources;
  return lower(model, sources);
}

TEST(Lower, OrdersCellsByKindAndKeepsWhatBelongsTogether) {
  const Program program = lowered(small_model());
  ASSERT_TRUE(verify(program).empty()) << verify(program).front();
  std::vector<std::string> names;
  for (const Cell& cell : program.cells) names.emplace_back(cell.name);
  EXPECT_EQ(names, (std::vector<std::string>{"Line", "sat Go", "sat Line", "Go"}));
  EXPECT_EQ(program.cells[0].satellites, decltype(Cell::satellites){CellId{2}});
  EXPECT_EQ(program.cells[3].satellites, decltype(Cell::satellites){CellId{1}});
  EXPECT_EQ(program.exclusive, (std::vector<std::vector<CellId>>{{CellId{1}, CellId{2}}}));
  EXPECT_EQ(program.settings.idle_strategy, CellId{3});
  EXPECT_EQ(program.controls.at(0).strategy, CellId{3});
}

TEST(Lower, OrdersRulesByLevelWithTheControlLevelsOwnLast) {
  const Program program = lowered(small_model());
  ASSERT_EQ(program.rules.size(), 3u);
  EXPECT_EQ(program.rules[0].name, "upper");
  EXPECT_TRUE(program.rules[0].reset);
  EXPECT_EQ(program.rules[0].mode, Mode::kWhile);
  EXPECT_EQ(program.rules[1].name, "lower[x]");
  EXPECT_EQ(program.rules[1].tmpl(), "lower");
  EXPECT_TRUE(program.rules[1].standard);
  EXPECT_EQ(program.rules[1].clears, decltype(Rule::clears){0});
  EXPECT_EQ(program.rules[2].name, "run[Go]");
  EXPECT_EQ(program.at(program.rules[2]), "priority");
}

TEST(Lower, MakesEqualConditionsOneAndFlattensThem) {
  const Program program = lowered(small_model());
  EXPECT_EQ(program.rules[0].condition, program.rules[1].condition);
  EXPECT_EQ(print_condition(program, program.rules[0].condition), "seen Line and sat Go is low");
}

}  // namespace
}  // namespace kb::program
