// Two knowledge bases of one namespace in one program: see note [two minds of one name] in compiler/emit/names.cc.
#include <gtest/gtest.h>

const char* ahead();
const char* back();

TEST(Twins, EachDecideByTheirOwnRules) {
  EXPECT_STREQ(ahead(), "Drive.ahead");
  EXPECT_STREQ(back(), "Drive.back");
}
