// Text of unknown origin: where it is UTF-8, and how it is made so.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace kb::source {

/// The code point that `text` begins with (`text` is not empty), and how many bytes it takes: 0 if that is no well-formed UTF-8, such as
/// an overlong form or a surrogate (Unicode 15, table 3-7).
struct CodePoint { char32_t value = 0; std::size_t bytes = 0; };
[[nodiscard]] CodePoint code_point(std::string_view text);

/// The first byte that belongs to no well-formed code point; npos if all do.
[[nodiscard]] std::size_t find_ill_formed(std::string_view text);

/// `text` with U+FFFD for each byte that belongs to no well-formed code point.
[[nodiscard]] std::string valid_utf8(std::string_view text);

/// `text` for a message: at most 40 bytes and then `...`, cut between characters; control characters and ill-formed bytes as \xNN.
[[nodiscard]] std::string printable(std::string_view text);

/// Valid UTF-8 with `& < > "` as entities, for text and for attributes in double quotes of XML and HTML; control characters that XML
/// does not allow become `?`.
[[nodiscard]] std::string escape_markup(std::string_view text);

}  // namespace kb::source
