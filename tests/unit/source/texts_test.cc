#include "compiler/source/texts.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace kb::source {
namespace {

TEST(Texts, StandWhereTheyAreHoweverManyComeAfterThem) {
  Texts texts;
  std::vector<std::string_view> kept;
  for (int i = 0; i < 10'000; ++i) kept.push_back(texts.keep({"rule[", std::to_string(i), "]"}));
  for (int i = 0; i < 10'000; ++i) ASSERT_EQ(kept[static_cast<std::size_t>(i)], "rule[" + std::to_string(i) + "]");
}

TEST(Texts, AreCopies) {
  Texts texts;
  std::string from = "Line";
  const std::string_view kept = texts.keep(from);
  from = "Safe";
  EXPECT_EQ(kept, "Line");
  EXPECT_EQ(texts.keep(""), "");
}

}  // namespace
}  // namespace kb::source
