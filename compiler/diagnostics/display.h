// Text of unknown origin on a terminal: how wide it is, what must not get there, and how several are named.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kb::diagnostics {

/// The code point that `text` begins with (`text` is not empty), and how many bytes it takes: 0 if that is no well-formed UTF-8.
struct CodePoint { char32_t value = 0; std::size_t bytes = 0; };
[[nodiscard]] CodePoint code_point(std::string_view text);

/// One code point at the front of a text, as a terminal shows it.
struct Glyph {
  std::size_t bytes = 0;    ///< how many bytes of the text it takes; 0 at the end
  std::string shown;        ///< itself, blanks for a tab, `<1B>` for a byte or `<U+200E>` for a character that is not shown
  std::size_t columns = 0;  ///< width: 0 for combining marks, 2 for wide characters
};

/// The glyph at `text[at]`, where `column` columns stand before it (for tabs, which end at multiples of 4).
[[nodiscard]] Glyph glyph(std::string_view text, std::size_t at, std::size_t column);

/// `text` with everything shown that a terminal would obey: control characters, marks of direction, broken UTF-8.
[[nodiscard]] std::string visible(std::string_view text);

/// `text` for the place of `{}` between backticks: what is empty, or holds a backtick itself, would not be seen for what it is there.
/// Several codes, as in `when` or `while`, come without the outermost backticks and stay as they are.
[[nodiscard]] std::string between_backticks(std::string_view text);
/// Of a long text the beginning, and `...`: whole characters, some 60 bytes of them.
[[nodiscard]] std::string beginning(std::string_view text);
/// The beginning of `text` in backticks.
[[nodiscard]] std::string quoted_code(std::string_view text);

/// "`a`, `b` and 3 more", of which `what` may be said behind: "and 3 more strategies".
[[nodiscard]] std::string listed(const std::vector<std::string_view>& names, std::size_t shown, std::string_view what = "");

/// "1 tick", "2 ticks"; of other plurals `many` says the word: "3 indexes".
[[nodiscard]] std::string counted(std::uint64_t count, std::string_view one, std::string_view many = "");

/// "`a`, `b`".
[[nodiscard]] std::string in_a_row(std::span<const std::string_view> names);

/// A source line cut to what fits, and where [begin, end) of it stands in what is shown.
struct Excerpt {
  std::string text;
  std::size_t column = 0;   ///< columns before the place
  std::size_t columns = 1;  ///< width of the place, at least 1
};
/// At most about 120 columns; of a longer line the part round `begin`, with `...` where something is left out. O(the part).
[[nodiscard]] Excerpt excerpt(std::string_view line, std::size_t begin, std::size_t end);

}  // namespace kb::diagnostics
