#include <gtest/gtest.h>

#include "compiler/source/source.h"

namespace kb::source {
namespace {

Span at(FileId file, std::uint32_t begin, std::uint32_t end) { return {file, begin, end}; }

TEST(Sources, count_lines_from_one_and_columns_in_code_points) {
  Sources sources;
  const FileId file = sources.add("a.kb", "fact Старт\nfact B\r\n\nlast");
  EXPECT_EQ(sources.describe(at(file, 0, 4)), "a.kb:1:1");
  EXPECT_EQ(sources.describe(at(file, 5, 15)), "a.kb:1:6");
  EXPECT_EQ(sources.locate(file, 15).column, 11u) << "five letters of two bytes each";
  EXPECT_EQ(sources.describe(at(file, 16, 20)), "a.kb:2:1");
  EXPECT_EQ(sources.describe(at(file, 25, 29)), "a.kb:4:1");
}

TEST(Sources, hand_out_a_line_without_its_line_break) {
  Sources sources;
  const FileId file = sources.add("a.kb", "one\r\ntwo\n\nfour");
  EXPECT_EQ(sources.line_of(file, 1).text, "one");
  EXPECT_EQ(sources.line_of(file, 3).text, "one") << "the line break belongs to its line";
  EXPECT_EQ(sources.line_of(file, 6).text, "two");
  EXPECT_EQ(sources.line_of(file, 9).text, "");
  EXPECT_EQ(sources.line_of(file, 14).text, "four") << "the end of the file is on its last line";
  EXPECT_EQ(sources.line_of(file, 14).begin, 10u);
}

TEST(Sources, count_the_columns_of_a_line_of_any_length) {
  std::string line = "\xEF\xBB\xBF";
  for (int i = 0; i < 10000; ++i) line += i % 3 == 0 ? "\xC3\xA4" : "a";
  for (const std::string before : {"", "one\n"}) {
    const std::string bytes = before.empty() ? line : before + line.substr(3);
    Sources sources;
    const FileId file = sources.add("a.kb", bytes);
    std::uint32_t column = 0, wrong = 0;
    for (std::size_t i = before.empty() ? 3 : before.size(); i < bytes.size(); ++i) {
      if ((static_cast<unsigned char>(bytes[i]) & 0xC0u) != 0x80u) wrong += sources.locate(file, static_cast<std::uint32_t>(i)).column == ++column ? 0 : 1;
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_EQ(sources.locate(file, static_cast<std::uint32_t>(bytes.size())).column, 10001u);
  }
}

TEST(Sources, find_the_byte_of_a_line_and_column_again) {
  std::string bytes = "\xEF\xBB\xBF" "fact \xD0\xA1\n\n";
  for (int i = 0; i < 10000; ++i) bytes += i % 3 == 0 ? "\xC3\xA4" : "a";   // a line of many pieces
  bytes += "\nlast";
  Sources sources;
  const FileId file = sources.add("a.kb", bytes);
  std::uint32_t wrong = 0;
  for (std::uint32_t i = 3; i <= bytes.size(); ++i) {
    const bool begins = i == bytes.size() || (static_cast<unsigned char>(bytes[i]) & 0xC0u) != 0x80u;
    if (begins && sources.offset_of(file, sources.locate(file, i)) != i) ++wrong;
  }
  EXPECT_EQ(wrong, 0u);
}

TEST(Sources, take_the_end_for_a_place_that_a_file_does_not_have) {
  Sources sources;
  const FileId file = sources.add("a.kb", "one\ntwo");
  EXPECT_EQ(sources.offset_of(file, {1, 9}), 3u) << "the line is shorter";
  EXPECT_EQ(sources.offset_of(file, {2, 9000}), 7u);
  EXPECT_EQ(sources.offset_of(file, {3, 1}), 7u) << "there is no such line";
  EXPECT_EQ(sources.offset_of(sources.add("empty.kb", ""), {1, 1}), 0u);
}

TEST(Sources, do_not_count_a_byte_order_mark_as_a_column) {
  Sources sources;
  const FileId file = sources.add("a.kb", "\xEF\xBB\xBF" "fact A");
  EXPECT_EQ(sources.locate(file, 3).column, 1u);
  EXPECT_EQ(sources.locate(file, 8).column, 6u);
}

TEST(Sources, are_at_ease_with_an_empty_file) {
  Sources sources;
  const FileId file = sources.add("a.kb", "");
  EXPECT_EQ(sources.describe(at(file, 0, 0)), "a.kb:1:1");
  EXPECT_EQ(sources.line_of(file, 0).text, "");
  EXPECT_EQ(sources.text(at(file, 0, 0)), "");
}

TEST(Sources, never_move_the_bytes_of_a_file) {
  Sources sources;
  const FileId first = sources.add("a.kb", "short");
  const std::string_view before = sources.bytes(first);
  for (int i = 0; i < 100; ++i) sources.add("b.kb", "x");
  EXPECT_EQ(sources.bytes(first).data(), before.data());
}

TEST(Span, of_no_file_has_no_place) {
  const Sources sources;
  EXPECT_EQ(sources.describe({}), "-");
  EXPECT_EQ(sources.text({}), "");
  EXPECT_FALSE(Span{}.known());
}

TEST(Span, joins_with_its_neighbour_in_the_same_file_only) {
  const FileId a{0}, b{1};
  EXPECT_EQ(join(at(a, 4, 6), at(a, 1, 2)), at(a, 1, 6));
  EXPECT_EQ(join(at(a, 4, 6), at(b, 1, 2)), at(a, 4, 6));
  EXPECT_EQ(join({}, at(b, 1, 2)), at(b, 1, 2));
}

}  // namespace
}  // namespace kb::source
