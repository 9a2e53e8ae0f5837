#include <gtest/gtest.h>

#include <filesystem>

#include "tests/unit/syntax/reading.h"
#include "tests/unit/whole_file.h"

namespace kb::syntax::testing {
namespace {

std::vector<std::filesystem::path> all_knowledge_bases() {
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"stdlib_rules", "examples", "tests/golden"}) {
    const auto root = std::filesystem::path(KB_PROJECT_ROOT) / folder;
    if (!std::filesystem::exists(root)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      if (entry.path().extension() == ".kb") files.push_back(entry.path());
    }
  }
  return files;
}

TEST(Format, of_every_file_of_the_project_is_idempotent_and_keeps_the_tree) {
  ASSERT_FALSE(all_knowledge_bases().empty());
  for (const auto& path : all_knowledge_bases()) {
    const std::string text = whole_file(path);
    const std::string once = formatted(text);
    EXPECT_EQ(formatted(once), once) << path;
    EXPECT_EQ(read(once).tree, read(text).tree) << path;
  }
}

TEST(Format, leaves_a_file_with_errors_alone) { EXPECT_EQ(formatted("fact   A\nfact  (\n"), "fact   A\nfact  (\n"); }

TEST(Format, gives_every_statement_and_every_clause_its_line) {
  EXPECT_EQ(formatted("fact A set event=0.75 rule r[l in L]at map when A and not(B)for 300ms\nthen+X,-  sat Y"),
            "fact A\nset event = 0.75\nrule r[l in L] at map\n    when A and not (B) for 300 ms\n    then +X, -sat Y\n");
}

TEST(Format, leaves_a_rule_on_one_line_that_was_written_so_and_fits) {
  const std::string rules = "rule go   at act when A            then +B\nrule halt at act when A and seen C then -B\n";
  EXPECT_EQ(formatted("rule go at act when A then+B\nrule halt at act when A and seen C then -B"), rules);
  EXPECT_EQ(formatted(rules), rules);
  const std::string name(95, 'a');   // with the rest 120 characters
  EXPECT_EQ(formatted("rule " + name + " at b when C then +D\n"), "rule " + name + " at b when C then +D\n");
  EXPECT_EQ(formatted("rule " + name + " at b when CC then +D\n"), "rule " + name + " at b\n    when CC\n    then +D\n");
}

TEST(Format, puts_neighbouring_lines_in_columns) {
  EXPECT_EQ(formatted("fact A exclusive\nsatellites Bcd, E exclusive\n\nfact F\n"),
            "fact       A      exclusive\nsatellites Bcd, E exclusive\n\nfact F\n");
  EXPECT_EQ(formatted("map M { road A.N--B.S by m through(1,2)\nroad A.NNE->B.S through (1, 2) }"),
            "map M {\n    road A.N   -- B.S  by m  through (1, 2)\n    road A.NNE -> B.S        through (1, 2)\n}\n");
  EXPECT_EQ(formatted("table f(A,B)->C { x yy\n a:c d\n bbb:d c }"),
            "table f(A, B) -> C {\n          x  yy\n    a:    c  d\n    bbb:  d  c\n}\n");
}

TEST(Format, keeps_columns_that_were_made_with_care) {
  const std::string table = "table f(A, B) -> C {\n         x   yy\n    a:   c   d\n}\n";
  EXPECT_EQ(formatted(table), table);
  const std::string comments = "fact A                # one\nfact Abcdef           # two\n";
  EXPECT_EQ(formatted(comments), comments);
}

TEST(Format, aligns_comments_of_a_block_and_those_that_hang_below) {
  EXPECT_EQ(formatted("fact A # one\n       # more\nfact Bcd # two\n"),
            "fact A    # one\n          # more\nfact Bcd  # two\n");
}

TEST(Format, keeps_comments_byte_for_byte_and_at_most_one_blank_line) {
  EXPECT_EQ(formatted("\n\n#   /\\    \xE2\x94\x80\n#  /  \\\n\n\n\nfact A\n\n# end\n\n"),
            "#   /\\    \xE2\x94\x80\n#  /  \\\n\nfact A\n\n# end\n");
}

TEST(Format, indents_comments_as_what_follows_them) {
  EXPECT_EQ(formatted("rule r at l\n# why\nwhen A\n# what\nthen +B\n# next\nfact C\nmap M {\n# in\nlandmark A\n# last\n}\n"),
            "rule r at l\n    # why\n    when A\n    # what\n    then +B\n# next\nfact C\nmap M {\n    # in\n    landmark A\n"
            "    # last\n}\n");
}

TEST(Format, lays_out_more_columns_than_16_bits_can_number) {
  std::string head = "      ", line = " a:";
  for (int i = 0; i < 65'600; ++i) head += " a", line += " bcd";
  const std::string once = formatted("table f(A, A) -> A {\n" + head + "\n" + line + "\n}\n");
  EXPECT_EQ(formatted(once), once);
  EXPECT_TRUE(once.ends_with("  bcd  bcd  bcd\n}\n")) << once.substr(once.size() - 40);
}

TEST(Format, counts_columns_in_characters_on_a_line_with_a_comment_before) {
  EXPECT_EQ(formatted("# \xC3\xA4\nfact A    exclusive  # \xC3\xA4\nfact Bcd  exclusive  # \xC3\xB6\n"),
            "# \xC3\xA4\nfact A    exclusive  # \xC3\xA4\nfact Bcd  exclusive  # \xC3\xB6\n");
}

TEST(Format, keeps_line_breaks_within_a_statement) {
  EXPECT_EQ(formatted("route R on M by C:\nA -> B\n-> C\nrule r at l\nwhen A and\nB\nthen +C,\n-D\n"),
            "route R on M by C:\n    A -> B\n    -> C\nrule r at l\n    when A and\n        B\n    then +C,\n        -D\n");
}

TEST(Format, begins_the_columns_of_the_first_line_behind_a_byte_order_mark) {
  EXPECT_EQ(formatted("\xEF\xBB\xBF" "fact A    exclusive\nfact B    exclusive\n"), "fact A    exclusive\nfact B    exclusive\n");
}

TEST(Format, ends_all_lines_as_the_first_one_ends_and_the_last_line_as_well) {
  EXPECT_EQ(formatted("fact A\r\n\nfact B"), "fact A\r\n\r\nfact B\r\n");
  EXPECT_EQ(formatted("fact A\n\r\nfact B"), "fact A\n\nfact B\n");
  EXPECT_EQ(formatted(""), "");
}

}  // namespace
}  // namespace kb::syntax::testing
