#include <gtest/gtest.h>

#include "tests/unit/syntax/reading.h"

namespace kb::syntax::testing {
namespace {

using diagnostics::Kind;
using std::string_literals::operator""s;

std::vector<Kind> kinds(const std::string& text) {
  std::vector<Kind> out;
  for (const auto& message : read_tokens(text).messages) out.push_back(message.kind);
  return out;
}

TEST(Lexer, gives_a_kind_and_a_place_to_every_token) {
  EXPECT_EQ(read_tokens("fact Старт1 # c\n  = -0.5 m").tree,
            "1:1 Word fact\n1:6 Identifier Старт1\n1:13 Comment # c\n2:3 Equal =\n2:5 Minus -\n2:6 Number 0.5\n"
            "2:10 Identifier m\n2:11 End\n");
}

TEST(Lexer, steps_over_a_byte_order_mark_and_takes_both_line_breaks) {
  EXPECT_EQ(read_tokens("\xEF\xBB\xBF" "fact A\r\nfact B\n").tree.substr(0, 10), "1:1 Word f");
  EXPECT_TRUE(read("\xEF\xBB\xBF" "fact A # c\r\nfact B\r\n").messages.empty());
}

TEST(Lexer, separates_a_number_from_its_unit) {
  EXPECT_EQ(read_tokens("300ms 0.4 m/s 50%").tree,
            "1:1 Number 300\n1:4 Identifier ms\n1:7 Number 0.4\n1:11 Identifier m\n1:12 Slash /\n1:13 Identifier s\n"
            "1:15 Number 50\n1:17 Percent %\n1:18 End\n");
}

TEST(Lexer, says_one_thing_about_a_run_of_bad_bytes) {
  EXPECT_EQ(kinds("a \xFF\xFE\xFD b"), std::vector{Kind::kBytesNotUtf8});
  EXPECT_EQ(kinds("a \0\0\0 b"s), std::vector{Kind::kNulByte});
  EXPECT_EQ(kinds("a \x01\x02 b"), std::vector{Kind::kControlCharacter});
  EXPECT_EQ(kinds("a $$$ b"), std::vector{Kind::kUnknownCharacter});
}

TEST(Lexer, refuses_every_way_of_writing_what_is_not_utf8) {
  for (const char* bytes : {"\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF8", "\x80", "\xE2\x82"}) {
    EXPECT_EQ(kinds("fact A "s + bytes), std::vector{Kind::kBytesNotUtf8}) << bytes;
    EXPECT_EQ(kinds("# comment "s + bytes + "\n"), std::vector{Kind::kBytesNotUtf8}) << bytes;
    EXPECT_EQ(kinds("import \"a"s + bytes + "\""), std::vector{Kind::kBytesNotUtf8}) << bytes;
  }
}

TEST(Lexer, takes_letters_of_all_scripts_but_no_other_character) {
  EXPECT_TRUE(kinds("fact Старт1, ligne_d_arrêt, 停止線, _x, कक्षा").empty());
  EXPECT_EQ(kinds("fact ☃"), std::vector{Kind::kUnknownCharacter});
}

TEST(Lexer, names_what_is_wrong_with_a_number) {
  for (const char* text : {"1.2.3", "1.", ".5", "1_000", "0x1F"}) {
    EXPECT_EQ(kinds("set a = "s + text + " "), std::vector{Kind::kMalformedNumber}) << text;
  }
  EXPECT_EQ(kinds("1e "), std::vector{Kind::kExponentWithoutDigits});
  EXPECT_EQ(kinds("1e999 "), std::vector{Kind::kNumberTooLarge});
  EXPECT_TRUE(kinds("1e-999 1e3 0.5 007 ").empty());
}

TEST(Lexer, ends_an_open_string_with_its_line) {
  const Reading reading = read("import \"a.kb\nfact A\n");
  ASSERT_EQ(reading.messages.size(), 1u);
  EXPECT_EQ(reading.messages[0].kind, Kind::kUnterminatedString);
  EXPECT_EQ(reading.tree, "import \"a.kb\"\nfact\n  A\n");
}

TEST(Lexer, takes_names_of_255_bytes_and_no_longer_ones) {
  EXPECT_TRUE(kinds(std::string(255, 'x')).empty());
  EXPECT_EQ(kinds(std::string(256, 'x')), std::vector{Kind::kIdentifierTooLong});
}

TEST(Lexer, tells_two_slips_side_by_side_apart) {
  EXPECT_EQ(kinds("A ||! B"), (std::vector{Kind::kForeignOperator, Kind::kForeignOperator}));
}

}  // namespace
}  // namespace kb::syntax::testing
