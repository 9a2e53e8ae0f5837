#include "sim/scenario/toml_keys.h"

#include <gtest/gtest.h>

#include <string>

namespace kb::sim {
namespace {

constexpr std::size_t kMostPoints = kMostKeyParts - 1;

std::string repeated(std::size_t times, const std::string& text) {
  std::string all;
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

TEST(TomlKeys, of_too_many_parts_are_found_however_they_are_written) {
  EXPECT_EQ(find_deep_key("a" + repeated(kMostPoints + 1, ".a") + " = 1\n"), 1 + 2 * kMostPoints);
  for (const std::string part : {".a", " . a", R"(."a")", ".'a'", R"(."")", R"(."\"")", R"(.'"')", R"(.'\')"}) {
    for (const std::string before : {"", "[", "[[", "x = {", "x = {y = '''''a''''', ", "x = \"\"\"#\\\"\"\"\"\"\n", "x = 'a\n", "# it's\n", "x = [1,\n{"}) {
      EXPECT_NE(find_deep_key(before + "a" + repeated(kMostPoints + 1, part)), std::string::npos) << before << part;
      EXPECT_EQ(find_deep_key(before + "a" + repeated(kMostPoints, part)), std::string::npos) << before << part;
    }
  }
}

TEST(TomlKeys, are_not_what_stands_in_strings_comments_and_numbers) {
  const std::string points(100, '.');
  for (const std::string& text : {"a = \"" + points + "\"", "a = '" + points + "'", "a = \"\"\"\n" + points + "\"\"\"\"\"", "a = '''" + points + "'" + points + "'''",
                                 "# " + points, "a = 1 # \"" + points, "a = \"\\\"" + points + "\"", "a = [" + repeated(100, "1.5, ") + "]", "a = '''\n''" + points}) {
    EXPECT_EQ(find_deep_key(text), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace kb::sim
