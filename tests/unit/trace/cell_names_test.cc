#include "tools/kbc/trace/cell_names.h"

#include <gtest/gtest.h>

#include "tests/unit/trace/sample.h"

namespace kb::trace {
namespace {

using program::testing::cell;

TEST(CellNames, are_found_in_either_spelling) {
  const auto program = testing::sample_program();
  const CellNames names(program);
  EXPECT_EQ(names.find("Near[left,far]"), cell(program, "Near[left,far]"));
  EXPECT_EQ(names.find("Near.left.far"), cell(program, "Near[left,far]"));
  EXPECT_EQ(names.find("Near[left, far]"), cell(program, "Near[left,far]"));
  EXPECT_EQ(names.find("In[N]"), cell(program, "In.N"));
  EXPECT_EQ(names.find("sat Line"), cell(program, "sat Line"));
  EXPECT_EQ(names.find("line"), program::CellId::kNone);
}

TEST(CellNames, suggest_only_cells_of_the_kind_that_is_asked_for) {
  const auto program = testing::sample_program();
  const CellNames names(program);
  EXPECT_EQ(names.closest("Mvoe", program::CellKind::kStrategy), "Move");
  EXPECT_EQ(names.closest("Mvoe", program::CellKind::kFact), std::nullopt);
}

TEST(RuleNames, mean_all_instances_or_one) {
  const auto program = testing::sample_program();
  EXPECT_EQ(find_rules(program, "pass").size(), 2u);
  EXPECT_EQ(program[find_rules(program, "pass.S").at(0)].name, "pass[S]");
  EXPECT_TRUE(find_rules(program, "pas").empty());
  EXPECT_EQ(closest_rule(program, "pas"), "pass");
  EXPECT_EQ(closest_rule(program, "pass[X]"), "pass[N]");
}

TEST(Patterns, match_with_stars_and_question_marks_in_either_spelling) {
  EXPECT_TRUE(matches("Move*", "Move.mark"));
  EXPECT_TRUE(matches("*[right,*]", "Cross[right,mark]"));
  EXPECT_TRUE(matches("Cross.right.*", "Cross[right,mark]"));
  EXPECT_TRUE(matches("LM?", "LM5"));
  EXPECT_FALSE(matches("LM?", "LM15"));
  EXPECT_FALSE(matches("Move", "Move.mark"));
  EXPECT_TRUE(matches("*a*b*c*", "xxaxxbxxcxx"));
  EXPECT_TRUE(matches("Line sat Line", "sat Line"));
  EXPECT_TRUE(matches("Gate Line", "Line"));
  EXPECT_FALSE(matches("", "Line"));
}

TEST(Patterns, that_match_no_cell_are_told_one_by_one) {
  const auto program = testing::sample_program();
  EXPECT_EQ(vain_patterns(program, "Line Nothing* sat Line sat Nothing"), (std::vector<std::string>{"Nothing*", "sat Nothing"}));
  EXPECT_EQ(vain_patterns(program, " "), std::vector<std::string>{" "});
  EXPECT_TRUE(vain_patterns(program, "").empty());
  EXPECT_EQ(meant_by(program, "In"), "In.*");
  EXPECT_EQ(meant_by(program, "Line,Move"), "Line Move");
  EXPECT_EQ(meant_by(program, "Mvoe"), "Move");
}

TEST(Patterns, do_not_take_exponential_time) {
  EXPECT_FALSE(matches(std::string(30, '*') + "b", std::string(5000, 'a')));
}

}  // namespace
}  // namespace kb::trace
