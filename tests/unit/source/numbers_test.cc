#include "compiler/source/numbers.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace kb::source {
namespace {

TEST(Numbers, AreAllOfTheText) {
  double number = 0.0;
  EXPECT_TRUE(read_number("-2.5e3", number));
  EXPECT_EQ(number, -2500.0);
  for (const char* const text : {"", " 1", "1 ", "1m", "0x10", "+1", "1e999", "inf", "nan"}) EXPECT_FALSE(read_number(text, number)) << text;
}

TEST(Numbers, FitTheirType) {
  std::uint8_t number = 0;
  EXPECT_TRUE(read_number("010", number));
  EXPECT_EQ(number, 10);
  for (const char* const text : {"256", "-1", "1.0"}) EXPECT_FALSE(read_number(text, number)) << text;
}

TEST(Numbers, HaveOneSign) {
  EXPECT_EQ(without_plus("+5"), "5");
  EXPECT_EQ(without_plus("-5"), "-5");
  for (const char* const text : {"+-5", "+", ""}) EXPECT_EQ(without_plus(text), text);
}

}  // namespace
}  // namespace kb::source
