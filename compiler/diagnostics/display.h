// Text of unknown origin on a terminal: how wide it is, what must not be printed raw, and how to list several names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kb::diagnostics {

/// How many columns of a terminal `text` takes: wide characters have two, combining marks none, and a tab counts for one. O(bytes).
[[nodiscard]] std::size_t columns(std::string_view text);

/// `text` with everything spelled out that a terminal would obey: control characters, marks of direction, broken UTF-8.
[[nodiscard]] std::string visible(std::string_view text);

/// `text` prepared for a `{}` that stands between backticks, where an empty text or one with a backtick in it would be misread.
/// Several pieces of code, as in `when` or `while`, come without the outermost backticks and stay as they are.
[[nodiscard]] std::string between_backticks(std::string_view text);
/// The beginning of a long text, cut at a whole character after some 60 bytes, and `...`.
[[nodiscard]] std::string beginning(std::string_view text);
/// The beginning of `text` in backticks.
[[nodiscard]] std::string quoted_code(std::string_view text);

/// "`a`, `b` and 3 more", with `what` after the count if given: "and 3 more strategies".
[[nodiscard]] std::string listed(const std::vector<std::string_view>& names, std::size_t shown, std::string_view what = "");

/// "1 tick", "2 ticks"; `many` is the plural if it is not `one` with an s: "3 indexes".
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
