#include <gtest/gtest.h>

#include "tests/unit/syntax/reading.h"

namespace kb::syntax::testing {
namespace {

using diagnostics::Kind;

// The condition of a rule as the tree printer shows it, without its indentation.
std::string condition(const std::string& text) {
  const Reading reading = read("rule r at l when " + text + " then +X");
  EXPECT_TRUE(reading.messages.empty()) << said(reading);
  std::string out;
  const std::size_t begin = reading.tree.find("  when\n") + 7;
  const std::size_t end = reading.tree.find("  then\n");
  for (std::size_t i = begin; i < end;) {
    const std::size_t line_end = reading.tree.find('\n', i);
    out += reading.tree.substr(i + 4, line_end - i - 4) + "\n";
    i = line_end + 1;
  }
  return out;
}

TEST(Conditions, bind_from_or_over_and_and_for_to_not) {
  EXPECT_EQ(condition("A or B and not C for 1 s"), "or\n  A\n  and\n    B\n    for 1 s\n      not\n        C\n");
}

TEST(Conditions, keep_chains_flat_and_parentheses_apart) {
  EXPECT_EQ(condition("A and B and C"), "and\n  A\n  B\n  C\n");
  EXPECT_EQ(condition("A or (B or C) or D"), "or\n  A\n  or\n    B\n    C\n  D\n");
  EXPECT_EQ(condition("((A))"), "A\n");
}

TEST(Conditions, time_what_stands_before_for) {
  EXPECT_EQ(condition("(A and B) for 300 ms for 2 s"), "for 2 s\n  for 300 ms\n    and\n      A\n      B\n");
}

TEST(Conditions, have_all_primaries) {
  EXPECT_EQ(condition("event A and lost B and seen l.to"), "and\n  event A\n  lost B\n  seen l.to\n");
  EXPECT_EQ(condition("any G and no sat H and sat X"), "and\n  any G\n  no sat H\n  sat X\n");
  EXPECT_EQ(condition("any event G and no lost H and any seen X"), "and\n  any event G\n  no lost H\n  any seen X\n");
  EXPECT_EQ(condition("A is low and sat B is not high"), "and\n  A is low\n  sat B is not high\n");
  EXPECT_EQ(condition("In[turn_of(i, o)].when"), "In[turn_of(i, o)].when\n");
}

std::string nested(std::size_t depth, const std::string& open, const std::string& close) {
  std::string text = "rule r at l when ";
  for (std::size_t i = 0; i < depth; ++i) text += open;
  text += "A";
  for (std::size_t i = 0; i < depth; ++i) text += close;
  return text + " then +X\nfact B\n";
}

TEST(Nesting, is_taken_to_its_limit_and_not_beyond) {
  const std::pair<const char*, const char*> forms[] = {{"(", ")"}, {"not ", ""}, {"", " for 1 s"}, {"G[", "]"}};
  for (const auto& [open, close] : forms) {
    EXPECT_TRUE(read(nested(kMaxNesting, open, close)).messages.empty()) << open << close;
    const Reading reading = read(nested(kMaxNesting + 1, open, close));
    ASSERT_EQ(reading.messages.size(), 1u) << open << close;
    EXPECT_EQ(reading.messages[0].kind, Kind::kNestingTooDeep);
    EXPECT_TRUE(reading.tree.ends_with("fact\n  B\n"));
  }
}

TEST(Nesting, costs_no_stack_however_deep) {
  constexpr std::size_t kDeep = 200'000;
  for (const char* open : {"(", "not ", "G[", "f("}) {
    std::string text = "rule r at l when ";
    for (std::size_t i = 0; i < kDeep; ++i) text += open;
    EXPECT_EQ(read(text).messages.size(), 1u) << open;
  }
}

TEST(Terms, that_are_none_are_left_to_the_model_which_knows_the_groups) {
  const Reading reading = read("rule r at l when Step is one then +X");
  EXPECT_EQ(said(reading), "");
  EXPECT_NE(reading.tree.find("Step is one\n"), std::string::npos) << reading.tree;
}

}  // namespace
}  // namespace kb::syntax::testing
