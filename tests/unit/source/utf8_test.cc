#include "compiler/source/utf8.h"

#include <gtest/gtest.h>

namespace kb::source {
namespace {

TEST(Utf8, is_checked_to_the_letter) {
  EXPECT_EQ(find_ill_formed("Старт1 ✓ 𝄞"), std::string_view::npos);
  for (const std::string_view wrong : {"a\x80", "a\xC0\xAF", "a\xED\xA0\x80", "a\xF4\x90\x80\x80", "a\xE2\x82", "a\xFF"}) {
    EXPECT_EQ(find_ill_formed(wrong), 1u) << wrong;
  }
}

TEST(ValidUtf8, has_a_sign_for_each_byte_that_is_ill_formed) {
  EXPECT_EQ(valid_utf8("a\xFFz"), "a\xEF\xBF\xBDz");
  EXPECT_EQ(valid_utf8("\xC0\xAF"), "\xEF\xBF\xBD\xEF\xBF\xBD");                      // overlong
  EXPECT_EQ(valid_utf8("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");      // a surrogate
  EXPECT_EQ(valid_utf8("Старт ✓ 𝛼"), "Старт ✓ 𝛼");
}

TEST(Printable, shows_what_cannot_be_shown_as_numbers_and_cuts_between_characters) {
  EXPECT_EQ(printable("a\x01\xFFz"), "a\\x01\\xffz");
  const std::string long_text = std::string(39, 'x') + "ééé";
  EXPECT_EQ(printable(long_text), std::string(39, 'x') + "é...");
}

TEST(EscapeMarkup, leaves_nothing_that_ends_a_text_or_an_attribute) {
  EXPECT_EQ(escape_markup("a<b> & \"c\"\n"), "a&lt;b&gt; &amp; &quot;c&quot;\n");
  EXPECT_EQ(escape_markup("\x01\xFFé"), "?\xEF\xBF\xBDé");
}

}  // namespace
}  // namespace kb::source
