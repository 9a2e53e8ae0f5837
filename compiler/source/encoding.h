// Bytes and characters: recognises files that are not UTF-8 with line ends LF or CRLF, counts code points, trims, splits, converts to lower case.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace kb::source {

/// What may stand at the beginning of UTF-8, and is no text.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// The quotation marks of word processors, single ones and pairs.
inline constexpr std::string_view kForeignQuotes[] = {"\u2018", "\u2019", "\u201a", "\u201b", "\u201c", "\u201d", "\u201e", "\u201f", "\u00ab", "\u00bb"};

/// Known by a byte order mark of its own, or by one NUL among the first two bytes: text has no NUL, and begins with ASCII even in UTF-16.
[[nodiscard]] inline bool is_utf16(std::string_view bytes) {
  if (bytes.size() < 2) return false;
  return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF") || (bytes[0] == 0) != (bytes[1] == 0);
}

/// The first carriage return without a line feed after it; npos if there is none.
[[nodiscard]] inline std::size_t find_lone_return(std::string_view bytes) {
  std::size_t at = bytes.find('\r');
  while (at != std::string_view::npos && at + 1 < bytes.size() && bytes[at + 1] == '\n') at = bytes.find('\r', at + 2);
  return at;
}

/// What a file is that is no plain text, by how it begins, for messages; empty if it is none of these.
[[nodiscard]] inline std::string_view other_format(std::string_view bytes) {
  if (bytes.starts_with("PK\x03\x04")) return "a document of a word processor, or an archive";
  if (bytes.starts_with("\xD0\xCF\x11\xE0")) return "a document of a word processor";
  if (bytes.starts_with("{\\rtf")) return "a text with formats (RTF)";
  if (bytes.starts_with("%PDF-")) return "a PDF file";
  return {};
}

/// Whether a UTF-8 code point begins with this byte; if not, the byte continues one.
[[nodiscard]] constexpr bool begins_code_point(char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }

/// An ASCII letter in lower case; anything else unchanged.
[[nodiscard]] constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// The same for a whole text.
[[nodiscard]] inline std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) { return lower(c); });
  return text;
}

/// Of ASCII only, under every locale.
[[nodiscard]] constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
[[nodiscard]] constexpr bool is_letter_or_digit(char c) { return (lower(c) >= 'a' && lower(c) <= 'z') || is_digit(c); }

/// The part of `text` without blanks, tabs and line ends at its ends.
[[nodiscard]] constexpr std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// The parts of `text` between the separators, in order: at least one, which may be empty.
[[nodiscard]] inline std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

/// How many code points the text has. O(bytes).
[[nodiscard]] inline std::size_t code_points(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_code_point));
}

}  // namespace kb::source
