// Names in results are read by other programs as they were written.
#include "tools/kbc/row_names.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <utility>

#include "tests/unit/scratch_folder.h"

namespace kb::cli {
namespace {

using Pair = std::pair<std::string, std::string>;

TEST(RowNames, AreGivenBehindTheLastEqualsSignUnlessAFileHasIt) {
  EXPECT_EQ(file_and_name("a.toml"), Pair("a.toml", ""));
  EXPECT_EQ(file_and_name("a.toml=night"), Pair("a.toml", "night"));
  EXPECT_EQ(file_and_name("speed=2.toml=night"), Pair("speed=2.toml", "night"));
  const ScratchFolder folder;
  const std::string there = folder.path() + "/speed=2.toml";
  std::ofstream(there) << "seed = 1\n";
  EXPECT_EQ(file_and_name(there), Pair(there, ""));
  EXPECT_EQ(file_and_name(there + "=night"), Pair(there, "night"));
}

TEST(RowNames, CannotBeTakenForAMissingValueOrForTwoFields) {
  for (const char* good : {"a", "night-2", "v1.2_b", "NAN", "Na", "none", "7", "\xc3\xa4", "\xe5\xa3\x81-2"}) EXPECT_EQ(refused_name(good), "") << good;
  for (const char* bad : {"", "a,b", "a b", "\"a", "a|b", "NA", "nan", "NaN", "-nan", "None", "NULL", "null", "\xc3", "a\xe2\x80\x8b"}) EXPECT_NE(refused_name(bad), "") << bad;
  EXPECT_EQ(plain_name("two words|\xc3\xa4\xe2\x80\x8b.b\xff"), "two_words_\xc3\xa4_.b_");
}

}  // namespace
}  // namespace kb::cli
