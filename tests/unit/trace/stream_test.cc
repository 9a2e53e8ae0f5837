#include "tools/kbc/trace/stream.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace kb::trace {
namespace {

TEST(OpenStream, says_why_it_cannot) {
  std::string error;
  EXPECT_EQ(open_stream("/", error), nullptr);
  EXPECT_EQ(error, "is a directory");
  EXPECT_EQ(open_stream("/nowhere/at/all", error), nullptr);
  EXPECT_EQ(error, "no such file");
}

TEST(LineReader, cuts_lines_however_the_bytes_arrive) {
  const std::string bytes =
      "\xEF\xBB\xBF"
      "a\r\n\nbc\r\rd\n\r\nlast";
  for (const std::size_t chunk : {1u, 2u, 5u, 100u}) {
    MemoryStream stream(bytes, chunk);
    LineReader lines(stream);
    std::vector<std::string> got;
    while (const auto line = lines.next()) got.emplace_back(line->text);
    EXPECT_EQ(got, (std::vector<std::string>{"a", "", "bc\r\rd", "", "last"}));
  }
}

TEST(LineReader, ends_at_a_line_that_is_too_long) {
  const std::string bytes = "a\n" + std::string(3 * LineReader::kMaxLineBytes, 'x') + "\nb\n";
  MemoryStream stream(bytes, 10000);
  LineReader lines(stream);
  EXPECT_EQ(lines.next()->text, "a");
  const auto line = lines.next();
  ASSERT_TRUE(line);
  EXPECT_TRUE(line->too_long);
  EXPECT_EQ(line->number, 2u);
  EXPECT_FALSE(lines.next());
}

}  // namespace
}  // namespace kb::trace
