#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "compiler/diagnostics/consumers.h"
#include "compiler/diagnostics/display.h"

namespace kb::diagnostics {
namespace {

using Json = nlohmann::json;

// A message of one kind about the first place where `what` stands in `text`.
struct Case {
  explicit Case(std::string text, std::string path = "a.kb") : file(sources.add(std::move(path), std::move(text))) {}
  source::Span at(std::string_view what) const {
    const auto begin = static_cast<std::uint32_t>(sources.bytes(file).find(what));
    return {file, begin, begin + static_cast<std::uint32_t>(what.size())};
  }
  Diagnostic message(source::Span span) const { return {Kind::kImportCycle, Severity::kError, span, "the message", {}, {}}; }
  std::string text(const Diagnostic& d, bool color = false) const {
    std::string out;
    TextConsumer(sources, [&](std::string_view part) { out += part; }, color).consume(d);
    return out;
  }
  source::Sources sources;
  source::FileId file;
};

TEST(TextConsumer, underlines_the_place_in_its_line) {
  const Case c("fact A\n  fact Gate   # a gate\n");
  EXPECT_EQ(c.text(c.message(c.at("Gate"))),
            "a.kb:2:8: error: the message [KB0903]\n"
            "    2 |   fact Gate   # a gate\n"
            "      |        ^~~~\n");
}

TEST(TextConsumer, shows_notes_at_their_own_lines_and_the_suggestion_below) {
  const Case c("fact A\nfact B\n");
  Diagnostic d = c.message(c.at("B"));
  d.notes.push_back({Kind::kImportedHere, c.at("A"), "first here"});
  d.notes.push_back({Kind::kLookedIn, {}, "looked for `C`"});
  d.suggestion = "A";
  EXPECT_EQ(c.text(d),
            "a.kb:2:6: error: the message [KB0903]\n"
            "    2 | fact B\n"
            "      |      ^\n"
            "      = did you mean `A`?\n"
            "      = looked for `C`\n"
            "a.kb:1:6: note: first here\n"
            "    1 | fact A\n"
            "      |      ^\n");
}

TEST(TextConsumer, names_the_flag_of_a_warning) {
  const Case c("x");
  EXPECT_EQ(c.text({Kind::kNeverRead, Severity::kWarning, {}, "m", {}, {}}), "kbc: warning: m [-Wnever-read KB1021]\n");
  EXPECT_EQ(c.text({Kind::kNeverRead, Severity::kError, {}, "m", {}, {}}), "kbc: error: m [-Werror=never-read KB1021]\n");
}

TEST(TextConsumer, counts_code_points_and_lays_out_tabs) {
  const Case c("\tСтарт1 Финиш");
  EXPECT_EQ(c.text(c.message(c.at("Финиш"))),
            "a.kb:1:9: error: the message [KB0903]\n"
            "    1 |     Старт1 Финиш\n"
            "      |            ^~~~~\n");
}

TEST(TextConsumer, gives_wide_characters_two_columns_and_marks_none) {
  const Case c("起点 e\xCC\x81 X");
  EXPECT_EQ(c.text(c.message(c.at("X"))),
            "a.kb:1:7: error: the message [KB0903]\n"
            "    1 | 起点 e\xCC\x81 X\n"
            "      |        ^\n");
}

TEST(TextConsumer, lets_nothing_through_that_a_terminal_obeys) {
  const Case c("a \x1b[31m \xFF b \xE2\x80\xAE c", "evil\n\x1b.kb");
  Diagnostic d = c.message(c.at("c"));
  d.message = "`\x1b[2J`";
  const std::string text = c.text(d);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(text,
            "evil<0A><1B>.kb:1:15: error: `<1B>[2J` [KB0903]\n"
            "    1 | a <1B>[31m <FF> b <U+202E> c\n"
            "      |                            ^\n");
}

TEST(TextConsumer, shows_the_end_of_a_file_and_the_first_line_of_a_long_place) {
  const Case c("rule r\nwhen A");
  EXPECT_EQ(c.text(c.message({c.file, 13, 13})),
            "a.kb:2:7: error: the message [KB0903]\n"
            "    2 | when A\n"
            "      |       ^\n");
  EXPECT_EQ(c.text(c.message({c.file, 5, 13})),
            "a.kb:1:6: error: the message [KB0903]\n"
            "    1 | rule r\n"
            "      |      ^\n");
}

TEST(TextConsumer, shows_the_part_of_an_endless_line_that_matters) {
  const Case c(std::string(1 << 20, 'x') + "HERE" + std::string(1 << 20, 'y'));
  const std::string text = c.text(c.message(c.at("HERE")));
  EXPECT_LT(text.size(), 600u);
  EXPECT_NE(text.find("xxxHEREyyy"), std::string::npos);
  const auto caret = text.rfind('^'), line = text.rfind('\n', caret);
  const auto here = text.find("HERE"), source_line = text.rfind('\n', here);
  EXPECT_EQ(caret - line, here - source_line);
}

TEST(TextConsumer, colours_only_when_asked) {
  const Case c("fact A");
  EXPECT_NE(c.text(c.message(c.at("A")), true).find("\x1b[1;31merror"), std::string::npos);
  EXPECT_EQ(c.text(c.message(c.at("A")), false).find('\x1b'), std::string::npos);
}

TEST(JsonConsumer, writes_an_object_a_line) {
  const Case c("fact Ж B");
  Diagnostic d = c.message(c.at("B"));
  d.notes.push_back({Kind::kLookedIn, {}, "a note"});
  std::string out;
  JsonConsumer consumer(c.sources, [&](std::string_view part) { out += part; });
  consumer.consume(d);
  EXPECT_EQ(std::count(out.begin(), out.end(), '\n'), 1);
  const Json json = Json::parse(out);
  EXPECT_EQ(json["severity"], "error");
  EXPECT_EQ(json["code"], "KB0903");
  EXPECT_EQ(json["place"], Json::parse(R"({"file":"a.kb","line":1,"column":8,"end_line":1,"end_column":9,"begin":8,"end":9})"));
  EXPECT_TRUE(json["notes"][0]["place"].is_null());
}

TEST(JsonConsumer, writes_no_broken_text) {
  const Case c("x", "\xFF.kb");
  std::string out;
  JsonConsumer consumer(c.sources, [&](std::string_view part) { out += part; });
  consumer.consume(c.message(c.at("x")));
  EXPECT_TRUE(Json::accept(out));
}

TEST(SarifLog, gathers_messages_and_describes_their_rules) {
  const Case c("fact A\nfact B", "maps/a b.kb");
  SarifLog log("0.1.0");
  Diagnostic warning{Kind::kNeverRead, Severity::kWarning, c.at("A"), "a warning", {}, {}};
  warning.notes.push_back({Kind::kImportedHere, c.at("B"), "here"});
  log.add(c.sources, warning);
  log.add(c.sources, c.message(c.at("B")));
  log.add(c.sources, {Kind::kTooManyMessages, Severity::kNote, {}, "more", {}, {}});
  const Json document = Json::parse(log.print());
  EXPECT_EQ(document["version"], "2.1.0");
  const Json& run = document["runs"][0];
  const Json& rules = run["tool"]["driver"]["rules"];
  ASSERT_EQ(rules.size(), 2u);
  EXPECT_EQ(rules[0]["id"], "KB0903");
  EXPECT_FALSE(rules[0]["help"]["markdown"].empty());
  const Json& results = run["results"];
  ASSERT_EQ(results.size(), 2u);
  for (const Json& result : results) EXPECT_EQ(rules[result["ruleIndex"].get<std::size_t>()]["id"], result["ruleId"]);
  EXPECT_EQ(results[0]["level"], "warning");
  const Json& place = results[0]["locations"][0]["physicalLocation"];
  EXPECT_EQ(place["artifactLocation"]["uri"], "maps/a%20b.kb");
  EXPECT_EQ(place["region"], Json::parse(R"({"startLine":1,"startColumn":6,"endLine":1,"endColumn":7})"));
  EXPECT_EQ(results[0]["relatedLocations"][0]["message"]["text"], "here");
  EXPECT_EQ(run["invocations"][0]["executionSuccessful"], false);
  EXPECT_EQ(run["invocations"][0]["toolExecutionNotifications"].size(), 1u);
}

TEST(SarifLog, of_a_clean_run_is_a_document_too) {
  const Json document = Json::parse(SarifLog("0.1.0").print());
  EXPECT_TRUE(document["runs"][0]["results"].empty());
  EXPECT_TRUE(document["runs"][0]["results"].is_array());
  EXPECT_EQ(document["runs"][0]["invocations"][0]["executionSuccessful"], true);
}

TEST(Summary, counts_in_words) {
  EXPECT_EQ(summary(0, 0), "");
  EXPECT_EQ(summary(1, 0), "1 error");
  EXPECT_EQ(summary(0, 2), "2 warnings");
  EXPECT_EQ(summary(2, 1), "2 errors and 1 warning");
}

}  // namespace
}  // namespace kb::diagnostics
