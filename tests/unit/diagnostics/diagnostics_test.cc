#include <gtest/gtest.h>

#include "compiler/diagnostics/consumers.h"
#include "compiler/diagnostics/display.h"

namespace kb::diagnostics {
namespace {

class Reporting : public ::testing::Test {
 protected:
  source::Span at(std::uint32_t begin, std::uint32_t end) const { return {file_, begin, end}; }
  Diagnostics with(std::initializer_list<std::string_view> options) {
    WarningOptions warnings;
    for (const auto option : options) EXPECT_TRUE(warnings.apply(option)) << option;
    return {sources_, heard_, std::move(warnings)};
  }
  source::Sources sources_;
  source::FileId file_ = sources_.add("a.kb", std::string(5000, 'x'));
  source::FileId library_ = sources_.add("std/a.kb", "xxxx", true);
  CollectingConsumer heard_;
};

TEST_F(Reporting, fills_in_the_arguments_and_keeps_notes_and_suggestion) {
  auto diagnostics = with({});
  diagnostics.report(Kind::kCannotRead, at(1, 2), {"b.kb", "no such file"})
      .note(Kind::kImportedHere, at(3, 4))
      .suggest("c.kb");
  ASSERT_EQ(heard_.all.size(), 1u);
  EXPECT_EQ(heard_.all[0].message, "cannot read `b.kb`: no such file");
  EXPECT_EQ(heard_.all[0].suggestion, "c.kb");
  ASSERT_EQ(heard_.all[0].notes.size(), 1u);
  EXPECT_EQ(heard_.all[0].notes[0].text, "imported here");
  EXPECT_TRUE(diagnostics.failed());
}

TEST_F(Reporting, shows_what_is_empty_or_holds_a_backtick) {
  auto diagnostics = with({});
  const auto says = [&](std::string_view argument) {
    diagnostics.report(Kind::kCannotRead, {}, {argument, ""});
    return heard_.all.back().message;
  };
  EXPECT_EQ(says(""), "cannot read `\"\"`: ") << "only what stands in backticks is shown";
  EXPECT_EQ(says("`"), "cannot read `` ` ``: ");
  EXPECT_EQ(says("`a`"), "cannot read `` `a` ``: ");
  EXPECT_EQ(says("a` or `b"), "cannot read `a` or `b`: ");
}

TEST(QuotedCode, shows_the_beginning_in_whole_characters) {
  EXPECT_EQ(quoted_code("a"), "`a`");
  EXPECT_EQ(quoted_code(std::string(60, 'a')), "`" + std::string(60, 'a') + "`");
  EXPECT_EQ(quoted_code(std::string(59, 'a') + "\u0436\u0436"), "`" + std::string(59, 'a') + "\u0436...`");
}

TEST_F(Reporting, says_one_thing_of_one_place_once) {
  auto diagnostics = with({});
  for (int i = 0; i < 3; ++i) diagnostics.report(Kind::kImportCycle, at(1, 2), {"b.kb"});
  diagnostics.report(Kind::kImportCycle, at(1, 3), {"b.kb"});
  diagnostics.report(Kind::kCannotRead, at(1, 2), {"b.kb", "why"});
  EXPECT_EQ(heard_.all.size(), 3u);
  EXPECT_EQ(diagnostics.errors(), 3u);
}

TEST_F(Reporting, tells_messages_without_a_place_apart_by_their_words) {
  auto diagnostics = with({});
  diagnostics.report(Kind::kCannotRead, {}, {"b.kb", "why"});
  diagnostics.report(Kind::kCannotRead, {}, {"c.kb", "why"});
  diagnostics.report(Kind::kCannotRead, {}, {"c.kb", "why"});
  EXPECT_EQ(heard_.all.size(), 2u);
}

TEST_F(Reporting, stops_an_avalanche_and_says_so_once) {
  auto diagnostics = with({});
  for (std::uint32_t i = 0; i < 1000; ++i) diagnostics.report(Kind::kImportCycle, at(i, i + 1), {"b.kb"});
  EXPECT_EQ(diagnostics.errors(), 1000u);
  ASSERT_EQ(heard_.all.size(), Diagnostics::kMaxErrors + 1);
  EXPECT_EQ(heard_.all.back().kind, Kind::kTooManyMessages);
  EXPECT_EQ(heard_.all.back().severity, Severity::kNote);
  EXPECT_EQ(heard_.all.back().message, "there are more than 200 errors; the others are not shown");
}

TEST_F(Reporting, looks_for_no_nearer_name_once_nothing_more_is_shown) {
  auto diagnostics = with({});
  const std::vector<std::string_view> names{"Gate"};
  for (std::uint32_t i = 0; i < Diagnostics::kMaxErrors; ++i) {
    EXPECT_FALSE(diagnostics.full());
    diagnostics.report(Kind::kUnknownName, at(i, i + 1), {"Gat"}).suggest(diagnostics.nearest("Gat", names));
    EXPECT_EQ(heard_.all.back().suggestion, "Gate");
  }
  EXPECT_TRUE(diagnostics.full());
  EXPECT_FALSE(diagnostics.nearest("Gat", names));
}

TEST_F(Reporting, knows_names_by_what_has_them_and_passes_over_empty_ones) {
  struct Named { std::string name; bool meant; };
  const std::vector<Named> all{{"Gate", false}, {"Gates", true}};
  EXPECT_EQ(with({}).nearest("Gat", all, &Named::name), "Gate");
  EXPECT_EQ(with({}).nearest("Gat", all, [](const Named& one) { return one.meant ? std::string_view(one.name) : std::string_view(); }), "Gates");
}

TEST_F(Reporting, is_full_for_warnings_that_are_off_and_after_the_last_that_is_shown) {
  EXPECT_FALSE(with({}).full(Kind::kConfusable));
  EXPECT_TRUE(with({"no-confusable"}).full(Kind::kConfusable));
  for (const bool raised : {false, true}) {
    auto diagnostics = raised ? with({"error=confusable"}) : with({});
    for (std::uint32_t i = 0; i <= Diagnostics::kMaxErrors; ++i) {
      EXPECT_FALSE(diagnostics.full(Kind::kConfusable));
      diagnostics.report(Kind::kConfusable, at(i, i + 1), {"A", "B", "1", ""});
    }
    EXPECT_TRUE(diagnostics.full(Kind::kConfusable));
    EXPECT_EQ(heard_.all.back().kind, Kind::kTooManyMessages);
  }
}

TEST_F(Reporting, shows_warnings_by_their_options) {
  const auto severity = [this](std::initializer_list<std::string_view> options) {
    heard_.all.clear();
    with(options).report(Kind::kNeverRead, at(1, 2), {"Gate", ""});
    return heard_.all.empty() ? Severity::kNote : heard_.all[0].severity;
  };
  constexpr Severity kSilent = Severity::kNote;
  EXPECT_EQ(severity({}), Severity::kWarning);
  EXPECT_EQ(severity({"no-never-read"}), kSilent);
  EXPECT_EQ(severity({"no-never-read", "never-read"}), Severity::kWarning);
  EXPECT_EQ(severity({"no-never-set"}), Severity::kWarning);
  EXPECT_EQ(severity({"error"}), Severity::kError);
  EXPECT_EQ(severity({"error", "no-never-read"}), kSilent);
  EXPECT_EQ(severity({"error=never-read"}), Severity::kError);
  EXPECT_EQ(severity({"error", "no-error=never-read"}), Severity::kWarning);
  EXPECT_EQ(severity({"no-error=never-read", "error"}), Severity::kWarning);
  EXPECT_EQ(severity({"error", "no-error"}), Severity::kWarning);
}

TEST_F(Reporting, is_silent_about_warnings_in_the_library_unless_asked) {
  const source::Span inside{library_, 0, 1};
  with({}).report(Kind::kNeverRead, inside, {"Gate", ""});
  with({"error"}).report(Kind::kNeverRead, inside, {"Gate", ""});
  EXPECT_TRUE(heard_.all.empty());
  with({"standard-library"}).report(Kind::kNeverRead, inside, {"Gate", ""});
  EXPECT_EQ(heard_.all.size(), 1u);
  with({}).report(Kind::kImportCycle, inside, {"b.kb"});
  EXPECT_EQ(heard_.all.size(), 2u) << "errors are always told";
}

TEST_F(Reporting, knows_an_error_from_a_warning_that_was_made_one) {
  auto diagnostics = with({"error"});
  diagnostics.report(Kind::kNeverRead, at(1, 2), {"Gate", ""});
  EXPECT_TRUE(diagnostics.failed());
  EXPECT_FALSE(diagnostics.broken());
  diagnostics.report(Kind::kImportCycle, at(1, 2), {"b.kb"});
  EXPECT_TRUE(diagnostics.broken());
}

TEST(WarningOptions, refuse_what_names_no_warning) {
  WarningOptions options;
  EXPECT_FALSE(options.apply("no-such-warning"));
  EXPECT_FALSE(options.apply(""));
  EXPECT_FALSE(options.apply("error="));
}

TEST(Closest, finds_the_name_that_was_meant) {
  const auto find = [](std::string_view word, std::vector<std::string_view> candidates) {
    return closest(word, candidates).value_or("-");
  };
  EXPECT_EQ(find("LM33", {"LM1", "LM13", "LM3"}), "LM13") << "the first of two at the same distance";
  EXPECT_EQ(find("Lnie", {"Gate", "Line"}), "Line") << "letters swapped count once";
  EXPECT_EQ(find("line", {"Lime", "Line"}), "Line") << "case costs nothing";
  EXPECT_EQ(find("approach_crossing", {"aproach_crosing"}), "aproach_crosing");
  EXPECT_EQ(find("Gate", {"Obst", "Safe"}), "-") << "nothing is near";
  EXPECT_EQ(find("X", {"Y"}), "-") << "another letter is another name";
  EXPECT_EQ(find("strat", {"strategies", "strategy", "start_at"}), "strategy") << "the shortest of which it is the beginning";
  EXPECT_EQ(find("ahead", {"Lahead_x", "Drive.ahead"}), "Drive.ahead") << "a member without its group";
  EXPECT_EQ(find("St", {"Stop"}), "-") << "two letters say too little";
  EXPECT_EQ(find("Gate", {"Gate", ""}), "-") << "itself is no correction";
  EXPECT_EQ(find(std::string(500, 'a'), {std::string_view("a")}), "-");
}

}  // namespace
}  // namespace kb::diagnostics
