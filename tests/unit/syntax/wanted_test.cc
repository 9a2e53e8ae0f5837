// What can be written at a place: the end of a text, or any place in it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "compiler/syntax/syntax.h"
#include "tests/unit/whole_file.h"

namespace kb::syntax {
namespace {

std::optional<Wanted> at(std::string text, std::size_t offset) {
  source::Sources sources;
  const source::FileId file = sources.add("test.kb", std::move(text));
  return wanted_at(sources, file, static_cast<std::uint32_t>(offset));
}
std::optional<Wanted> behind(const std::string& text) { return at(text, text.size()); }

bool offers(const std::optional<Wanted>& wanted, std::string_view word) {
  return wanted && std::ranges::find(wanted->words, word) != wanted->words.end();
}
NameKind names(const std::string& text) { return behind(text).value().names; }

TEST(Wanted, WordsAreThoseOfTheGrammar) {
  EXPECT_TRUE(offers(behind(""), "rule"));
  EXPECT_FALSE(offers(behind(""), "when"));
  EXPECT_EQ(behind("rule a at b\n  ")->words, (std::vector<std::string_view>{"when", "while"}));
  EXPECT_TRUE(offers(behind("rule a at b when C "), "then"));
}

TEST(Wanted, StatementsBeginWhereLinesDo) {
  const std::string rule = "rule a at b when C then +D";
  EXPECT_TRUE(offers(behind(rule + "\n"), "rule"));
  EXPECT_FALSE(offers(behind(rule + " "), "rule"));
  EXPECT_TRUE(offers(behind(rule + " # done\n"), "fact"));
}

TEST(Wanted, NamesAreOfTheKindThatThePlaceAsksFor) {
  EXPECT_EQ(names("rule a at "), NameKind::kLevel);
  EXPECT_EQ(names("rule a at b when "), NameKind::kCell);
  EXPECT_EQ(names("rule a at b when (C or seen "), NameKind::kFact);
  EXPECT_EQ(names("rule a at b when C then +D, -"), NameKind::kSatellite);
  EXPECT_EQ(names("rule a at b when C then +sat "), NameKind::kFactOrStrategy);
  EXPECT_EQ(names("rule a at b when any event "), NameKind::kGroup);
  EXPECT_EQ(names("rule a[x in "), NameKind::kRelationOrSet);
  EXPECT_EQ(names("table T(A) -> B {\n  a "), NameKind::kMember);
  EXPECT_EQ(names("fuzzy F {\n  input gap 0..1 m { near = "), NameKind::kShape);
  EXPECT_EQ(names("rule a at b when C for 2 "), NameKind::kUnit);
}

TEST(Wanted, NewNamesAndSignsAreForNobodyToOffer) {
  EXPECT_EQ(names("fact "), NameKind::kNone);
  EXPECT_EQ(names("rule a["), NameKind::kNone);
  EXPECT_EQ(names("control A = b(c: 1) "), NameKind::kNone);
}

TEST(Wanted, WhatStandsBehindThePlaceDoesNotMatter) {
  const std::string before = "rule a at ";
  for (const std::string behind : {"b when C then +D\n", "when C", "{{{ \"\n", "= ~ 3"}) {
    const auto wanted = at(before + behind, before.size());
    ASSERT_TRUE(wanted);
    EXPECT_EQ(wanted->names, NameKind::kLevel) << behind;
  }
}

TEST(Wanted, AStatementIsReadWithoutThoseBeforeIt) {
  EXPECT_EQ(names("fact fact = 3 }\nrule a at "), NameKind::kLevel);
  EXPECT_FALSE(behind("rule a b c when "));
  EXPECT_EQ(behind("fact A\nrule a at ")->statement, 7u);
}

TEST(Wanted, AMapGoesOnBehindALineThatCannotBeRead) {
  const auto wanted = behind("map M {\n  road A. --\n  ");
  EXPECT_TRUE(offers(behind("map M {\n  landmark 3\n  road A.N -- B.S "), "by"));
  EXPECT_FALSE(wanted && offers(wanted, "when"));
}

TEST(Wanted, AtTheWordsOfTheStandardLibraryTheyAreOffered) {
  std::size_t asked = 0;
  for (const auto& entry : std::filesystem::directory_iterator(KB_PROJECT_ROOT "/stdlib_rules/std")) {
    source::Sources sources;
    const source::FileId file = sources.add("std.kb", whole_file(entry.path()));
    const std::vector<Lexeme> all = lexemes(sources, file);
    for (std::size_t i = 0; i < all.size(); i += 3) {   // each place costs as much as to read the file
      if (all[i].what != Lexeme::Class::kWord) continue;
      const std::string_view word = sources.text(all[i].span);
      EXPECT_TRUE(offers(wanted_at(sources, file, all[i].span.begin), word)) << entry.path() << ":" << sources.locate(file, all[i].span.begin).line << " " << word;
      ++asked;
    }
  }
  EXPECT_GT(asked, 300u);
}

}  // namespace
}  // namespace kb::syntax
