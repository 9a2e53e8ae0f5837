// A line of a stream is a place for messages, and costs no more than itself.
#include <gtest/gtest.h>

#include "tools/kbc/trace/excerpt.h"

namespace kb::trace {
namespace {

TEST(Excerpt, knows_its_number_without_the_lines_before_it) {
  source::Sources sources;
  const source::Span place = excerpt(sources, "drive.jsonl", {"{\"t\":1,\"lime\":0}", 30'000'000}, 7, 13);
  EXPECT_EQ(sources.describe(place), "drive.jsonl:30000000:8");
  EXPECT_EQ(sources.text(place), "\"lime\"");
  EXPECT_EQ(sources.bytes(place.file), "{\"t\":1,\"lime\":0}");
}

TEST(Excerpt, is_added_once_while_the_line_is_the_same) {
  source::Sources sources;
  const source::Span first = excerpt(sources, "drive.jsonl", {"same", 7}, 0, 1), again = excerpt(sources, "drive.jsonl", {"same", 7}, 2, 3);
  const source::Span later = excerpt(sources, "drive.jsonl", {"same", 8}, 0, 1);
  EXPECT_EQ(first.file, again.file);
  EXPECT_NE(first.file, later.file);
  EXPECT_EQ(sources.locate(later.file, 0).line, 8u);
}

}  // namespace
}  // namespace kb::trace
