// A comment allows the warnings of its line and of the statement below it.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "compiler/diagnostics/allowed.h"

namespace kb::diagnostics {
namespace {

/// A file, and the place in it where its text had a `!`.
struct Marked {
  explicit Marked(std::string text) {
    const std::size_t at = text.find('!');
    text.erase(at, 1);
    const auto begin = static_cast<std::uint32_t>(at);
    place = {sources.add("a.kb", std::move(text)), begin, begin + 1};
  }
  source::Sources sources;
  source::Span place;
};

/// Whether `never-read` (KB1013) is allowed where the text has a `!`.
bool allowed(const std::string& text) {
  const Marked marked(text);
  return AllowancesOfFiles().allow(marked.sources, marked.place, "never-read", "KB1013");
}

TEST(Allowed, in_its_line_and_above_it) {
  EXPECT_TRUE(allowed("fact !Gate   # allow: never-read\n"));
  EXPECT_TRUE(allowed("# allow: never-read\nfact !Gate\n"));
  EXPECT_TRUE(allowed("\n# allow: never-read\n# for the display\nfact !Gate"));
  EXPECT_TRUE(allowed("# allow: never-read\r\nfact !Gate\r\n"));
  EXPECT_FALSE(allowed("fact !Gate\n# allow: never-read\n"));
  EXPECT_FALSE(allowed("# allow: never-read\n\nfact !Gate\n")) << "it belongs to nothing";
  EXPECT_FALSE(allowed("fact Door   # allow: never-read\nfact !Gate\n"));
}

TEST(Allowed, above_the_statement_of_its_line) {
  EXPECT_TRUE(allowed("# allow: never-read\nrule a at b\n    when C\n    then +!D\n"));
  EXPECT_TRUE(allowed("rule a at b   # allow: never-read\n    when C\n    then +!D\n"));
  EXPECT_TRUE(allowed("# allow: never-read\nmap M {\n    road A\n\n    road !B\n}\n"));
  EXPECT_TRUE(allowed("rule a at b\n    when C\n    # allow: never-read\n    then +!D\n"));
  EXPECT_FALSE(allowed("rule a at b\n    # allow: never-read\n    when C\n    then +!D\n")) << "it is for the line below it";
  EXPECT_TRUE(allowed("# allow: never-read\nfact A,\n" + [] {
    std::string names;
    for (int i = 0; i < 5000; ++i) names += "    B,\n";
    return names;
  }() + "    !C\n")) << "however long the statement is";
  EXPECT_FALSE(allowed("map M {\n    road A   # allow: never-read\n    road !B\n}\n"));
  EXPECT_FALSE(allowed("# allow: never-read\nfact C\nrule a at b\n    then +!D\n"));
}

TEST(Allowed, in_the_statement_that_is_known_to_begin_there) {
  const std::string text = "  # allow: never-read\n  fact A,\nB\n  fact C\n";
  const std::uint32_t begins[] = {24, 36};
  const auto allows = [&, known = Allowances(text, begins)](const char* name) {
    return known.allow(static_cast<std::uint32_t>(text.rfind(name)), "never-read", "KB1013");
  };
  EXPECT_TRUE(allows("A,"));
  EXPECT_TRUE(allows("B\n")) << "it goes on without indentation";
  EXPECT_FALSE(allows("C\n")) << "another begins, indented as well";
}

TEST(Allowed, by_name_or_code_with_a_reason) {
  EXPECT_TRUE(allowed("# allow: KB1013\nfact !Gate\n"));
  EXPECT_TRUE(allowed("# allow: never-set, never-read\nfact !Gate\n"));
  EXPECT_TRUE(allowed("# allow: never-set: by the program, never-read - on the display\nfact !Gate\n"));
  EXPECT_TRUE(allowed("import \"a#b.kb\" fact !Gate # allow: never-read\n"));
  EXPECT_FALSE(allowed("# allow: never-set\nfact !Gate\n"));
  EXPECT_FALSE(allowed("# allow: never\nfact !Gate\n"));
  EXPECT_FALSE(allowed("# allow never-read\nfact !Gate\n"));
  EXPECT_FALSE(allowed("# we allow: never-read\nfact !Gate\n"));
}

/// The number of the line, from 1, above which a comment would allow a warning where the text has a `!`, if its statement begins with the last `word`.
std::uint32_t line_of_comment(const std::string& text, const char* word) {
  const Marked marked(text);
  const auto statement = static_cast<std::uint32_t>(text.rfind(word));
  return marked.sources.locate(marked.place.file, line_to_allow(marked.sources, marked.place, statement).begin).line;
}

TEST(Allowed, has_its_comment_above_the_statement_or_in_a_block_above_the_line) {
  EXPECT_EQ(line_of_comment("fact A\nfact !B\n", "fact"), 2u);
  EXPECT_EQ(line_of_comment("fact A\n\n  rule a at b   # why\nwhen A\nthen +!C\n", "rule"), 3u);
  EXPECT_EQ(line_of_comment("map M {   # {\n    road A\n    road !B\n}\n", "map"), 3u);
}

TEST(Allowed, nothing_where_there_is_no_place) { EXPECT_FALSE(AllowancesOfFiles().allow(source::Sources(), {}, "never-read", "KB1013")); }

}  // namespace
}  // namespace kb::diagnostics
