#include <gtest/gtest.h>

#include "tests/unit/syntax/reading.h"

namespace kb::syntax::testing {
namespace {

using diagnostics::Kind;

struct Mistake {
  const char* text;
  Kind kind;
};

// Each is followed by a sound statement, which must be read.
const Mistake kMistakes[] = {
    {"rule r at l when A +B", Kind::kMissingThen},
    {"rule r at l when A\n", Kind::kMissingThen},
    {"rule r at l A then +B", Kind::kMissingWhen},
    {"rule r when A then +B", Kind::kMissingLevel},
    {"rule r at l if A then +B", Kind::kIfForWhen},
    {"rule r at l when A then B", Kind::kUnsignedEffect},
    {"rule r at l when A then not B", Kind::kNegatedEffect},
    {"rule r at l when A then +B\nelse -B", Kind::kElseBranch},
    {"rule r at l when A then +B and -C", Kind::kJoinedEffects},
    {"rule r at l when A is on then +B", Kind::kUnknownTerm},
    {"fact A event 0,5", Kind::kMalformedNumber},
    {"set event = 0,5", Kind::kMalformedNumber},
    {"fact Arr\xEAt", Kind::kBytesNotUtf8},
    {"fact l'arret", Kind::kForeignQuote},
    {"rule r at l when A > 2 then +B", Kind::kComparison},
    {"rule r at l when A == 2 then +B", Kind::kComparison},
    {"rule r at l when A == high then +B", Kind::kEqualitySign},
    {"rule r at l when A == B then +B", Kind::kComparison},
    {"rule r at l when A is A.b then +B", Kind::kUnknownTerm},
    {"rule r at l when A then toggle B", Kind::kEffectValue},
    {"row r in R(a: 3)", Kind::kNumberAsCondition},
    {"rule r at l when A => +B", Kind::kOtherWord},
    {"rule r at l when A && B then +B", Kind::kForeignOperator},
    {"rule r at l when 1 then +B", Kind::kNumberAsCondition},
    {"rule r at l when (A then +B", Kind::kNotClosed},
    {"rule r at l when A) then +B", Kind::kNotOpened},
    {"rule r at when A then +B", Kind::kUnexpected},
    {"rule route at l when A then +B", Kind::kWordAsName},
    {"rule \"r\" at l when A then +B", Kind::kQuotedName},
    {"fact Wall-Left", Kind::kHyphen},
    {"rule r at l when Wall-Left then +B", Kind::kHyphen},
    {"rule r at l when (A)-B", Kind::kMissingThen},
    {"rule r at l when A+B", Kind::kMissingThen},
    {"rul r at l when A then +B", Kind::kUnknownStatement},
    {"names X { a b }", Kind::kMissingComma},
    {"names X { a, }", Kind::kTrailingComma},
    {"names X { }", Kind::kEmptyList},
    {"names X { a, b", Kind::kNotClosed},
    {"fact A exclusiv", Kind::kUnknownAttribute},
    {"fact A event 0.5 event 0.6", Kind::kClauseTwice},
    {"fact A;", Kind::kSemicolon},
    {"levels a, b", Kind::kDescendingOrder},
    {"map M {\n  landmrk A\n}", Kind::kMapLine},
    {"map M {\n  road A -- B.N\n}", Kind::kRoadWithoutExit},
    {"map M {\n  road A.N B.N\n}", Kind::kRoadWithoutWay},
    {"map M {\n  landmark A at (1 cm, 2)\n}", Kind::kCoordinateUnit},
    {"map M {\n  landmark A", Kind::kNotClosed},
    {"route R by C: A -> B", Kind::kRouteWithoutMap},
    {"route R on M: A -> B", Kind::kRouteWithoutCommand},
    {"control U = f(a 3)", Kind::kUnexpected},
};

TEST(Recovery, says_one_thing_about_one_mistake_and_reads_on) {
  for (const Mistake& mistake : kMistakes) {
    const Reading reading = read(std::string("fact Before\n") + mistake.text + "\nfact After\n");
    ASSERT_EQ(reading.messages.size(), 1u) << mistake.text << "\n" << said(reading);
    EXPECT_EQ(reading.messages[0].kind, mistake.kind) << mistake.text << "\n" << said(reading);
    EXPECT_TRUE(reading.tree.starts_with("fact\n  Before\n")) << mistake.text;
    EXPECT_TRUE(reading.tree.ends_with("fact\n  After\n")) << mistake.text << "\n" << reading.tree;
  }
}

TEST(Recovery, finds_the_mistakes_of_all_statements_in_one_run) {
  std::string text;
  std::size_t expected = 0;
  for (const Mistake& mistake : kMistakes) {
    text += std::string(mistake.text) + "\nfact Between\n";
    ++expected;
  }
  EXPECT_EQ(read(text).messages.size(), expected);
}

TEST(Recovery, goes_on_inside_a_map) {
  const Reading reading = read("map M {\n  landmrk A\n  landmark B\n  road B.N\n  road B.N -- B.S\n}\nfact X\n");
  EXPECT_EQ(reading.messages.size(), 2u);
  EXPECT_EQ(reading.tree, "map M\n  landmark B\n  road B.N -- B.S\nfact\n  X\n");
}

TEST(Recovery, keeps_what_was_read_of_a_map_that_the_file_ends_in) {
  for (const char* end : {"  road", "  road B.", "  road B.N -- C.S\n  landmark"}) {
    const Reading reading = read(std::string("map M {\n  landmark B\n") + end);
    EXPECT_EQ(reading.messages.size(), 1u) << end << said(reading);
    EXPECT_TRUE(reading.tree.starts_with("map M\n  landmark B\n")) << end << reading.tree;
  }
}

TEST(Recovery, says_nothing_about_what_follows_from_a_bad_character) {
  EXPECT_EQ(read("fact A $ B\nfact C\n").messages.size(), 1u);
}

TEST(Messages, come_in_the_order_of_the_text) {
  const Reading reading = read("fact 1\nfact A ☃\nrule r at l when A == high then +B\nfact 2\n");
  EXPECT_EQ(reading.places, (std::vector<std::string>{"1:6", "2:8", "3:20", "4:6"}));
}

TEST(Messages, speak_the_words_of_the_user) {
  EXPECT_EQ(said(read("rule r at when A then +B")), "1:11 expected a level after `at`, found `when`\n");
  EXPECT_EQ(said(read("rule r at l when A and then +B")), "1:24 expected a condition after `and`, found `then`\n");
  EXPECT_EQ(said(read("rule r at l when A wen B then +C")),
            "1:20 expected `then`, `and`, `or`, `for` or `is` after `A`, found `wen`\n");
  EXPECT_EQ(said(read("fact")), "1:5 expected the name of the fact after `fact`, found the end of the file\n");
}

TEST(Messages, show_where_a_bracket_was_opened) {
  const Reading reading = read("names X {\n  a, b\nfact A\n");
  ASSERT_EQ(reading.messages.size(), 1u);
  ASSERT_EQ(reading.messages[0].notes.size(), 1u);
  EXPECT_EQ(reading.messages[0].notes[0].span.begin, 8u);
}

TEST(Recovery, keeps_the_statement_before_a_misspelt_one) {
  EXPECT_EQ(read("names X { a }\nrul x\nfact A of\nrule r at l when A then +B\n)\nfact C\n").tree,
            "names X { a }\nrule r\n  at l\n  when\n    A\n  then\n    +B\nfact\n  C\n");
}

TEST(Messages, guess_the_statement_that_was_meant) {
  EXPECT_EQ(said(read("fact A\nsatelite B\n")), "2:1 `satelite` begins no statement [satellite]\n");
}

TEST(Slips, that_make_two_tokens_of_one_leave_all_others_as_they_are) {
  std::string slips = "rule r at l when A", right = slips;
  for (int i = 0; i < 1000; ++i) {
    slips += " and A" + std::to_string(i) + " != low";
    right += " and A" + std::to_string(i) + " is not low";
  }
  EXPECT_EQ(read(slips + " +B\nfact C").tree, read(right + " then +B\nfact C").tree);
}

TEST(Recovery, goes_on_within_a_fuzzy_block) {
  const Reading reading = read(R"(fuzzy F {
  and product
  input  far 0..4 { near ramp(1, 0) }
  input  aside -1..1 { left = ramp(0, -1) }
  output speed 0..1 { slow = 0.1 } by average default slow
  given far near {
    aside is left -> speed = slow
  }
  given aside is left {
    far is -> speed = slow
    far is near -> speed = slow weight 0.5,
    far is near -> speed = slow,
        horn = on on
    given far is near { aside is left -> speed 3 }
    far is near -> speed = slow weight 0.25
  }
  far is near -> speed = slow weight 0.75
}
fact After
)");
  EXPECT_EQ(reading.messages.size(), 7u) << said(reading);
  for (const char* read_on : {"input aside", "default slow", "given aside is left", "weight 0.25", "weight 0.75"}) {
    EXPECT_NE(reading.tree.find(read_on), std::string::npos) << read_on << "\n" << reading.tree;
  }
  EXPECT_TRUE(reading.tree.ends_with("fact\n  After\n")) << reading.tree;
}

TEST(Recovery, closes_a_fuzzy_block_and_its_nests) {
  for (const char* head : {"fuzzy F {\n", "fuzzy F {\n  given a is b {\n", "fuzzy F {\n  given a is b {\n    given c is d {\n", "fuzzy F {\n  input a 0..1 {\n"}) {
    const Reading reading = read(std::string(head) + "fact After\nfact Last\n");
    EXPECT_EQ(reading.messages.size(), 1u) << head << said(reading);
    EXPECT_TRUE(reading.tree.ends_with("fact\n  After\nfact\n  Last\n")) << head << reading.tree;
    EXPECT_NE(reading.tree.find("fuzzy F"), std::string::npos) << head << reading.tree;
  }
}

}  // namespace
}  // namespace kb::syntax::testing
