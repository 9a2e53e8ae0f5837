#include "compiler/diagnostics/display.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "compiler/source/encoding.h"
#include "compiler/source/utf8.h"

namespace kb::diagnostics {
namespace {

constexpr std::size_t kTab = 4;
constexpr std::size_t kBefore = 60, kWidest = 120;

struct Range { char32_t first, last; };

// The blocks of combining marks and of wide characters that occur in names; not all of Unicode.
constexpr std::array kZeroWide = {
    Range{0x0300, 0x036F}, Range{0x0483, 0x0489}, Range{0x0591, 0x05BD}, Range{0x05BF, 0x05BF}, Range{0x05C1, 0x05C2}, Range{0x05C4, 0x05C5},
    Range{0x05C7, 0x05C7}, Range{0x0610, 0x061A}, Range{0x064B, 0x065F}, Range{0x0670, 0x0670}, Range{0x06D6, 0x06DC}, Range{0x06DF, 0x06E4},
    Range{0x06E7, 0x06E8}, Range{0x06EA, 0x06ED}, Range{0x0900, 0x0902}, Range{0x093A, 0x093A}, Range{0x093C, 0x093C}, Range{0x0941, 0x0948},
    Range{0x094D, 0x094D}, Range{0x0951, 0x0957}, Range{0x0962, 0x0963}, Range{0x0981, 0x0981}, Range{0x09BC, 0x09BC}, Range{0x09C1, 0x09C4},
    Range{0x09CD, 0x09CD}, Range{0x0BCD, 0x0BCD}, Range{0x0E31, 0x0E31}, Range{0x0E34, 0x0E3A}, Range{0x0E47, 0x0E4E}, Range{0x1AB0, 0x1AFF},
    Range{0x1DC0, 0x1DFF}, Range{0x20D0, 0x20FF}, Range{0xFE00, 0xFE0F}, Range{0xFE20, 0xFE2F}};
constexpr std::array kWide = {
    Range{0x1100, 0x115F}, Range{0x231A, 0x231B}, Range{0x23E9, 0x23EC}, Range{0x2614, 0x2615}, Range{0x2648, 0x2653}, Range{0x26A1, 0x26A1},
    Range{0x26AA, 0x26AB}, Range{0x26D4, 0x26D4}, Range{0x2705, 0x2705}, Range{0x270A, 0x270B}, Range{0x2728, 0x2728}, Range{0x274C, 0x274E},
    Range{0x2753, 0x2757}, Range{0x2795, 0x2797}, Range{0x2B1B, 0x2B1C}, Range{0x2B50, 0x2B55}, Range{0x2E80, 0x303E}, Range{0x3041, 0x33FF}, Range{0x3400, 0x4DBF}, Range{0x4E00, 0x9FFF},
    Range{0xA000, 0xA4CF}, Range{0xAC00, 0xD7A3}, Range{0xF900, 0xFAFF}, Range{0xFE30, 0xFE4F}, Range{0xFF00, 0xFF60},
    Range{0xFFE0, 0xFFE6}, Range{0x1F300, 0x1F64F}, Range{0x1F680, 0x1F6FF}, Range{0x1F7E0, 0x1F7EB}, Range{0x1F900, 0x1F9FF},
    Range{0x1FA70, 0x1FAFF},
    Range{0x20000, 0x3FFFD}};
// Control characters that change how text is displayed, such as marks that reverse its direction: source could look different from what
// it says (CVE-2021-42574); and what is not shown at all, or as an ordinary blank.
constexpr std::array kObeyed = {Range{0x80, 0xA0}, Range{0xAD, 0xAD}, Range{0x034F, 0x034F}, Range{0x061C, 0x061C}, Range{0x115F, 0x1160}, Range{0x17B4, 0x17B5},
                                Range{0x180B, 0x180F}, Range{0x200B, 0x200F}, Range{0x2028, 0x202F}, Range{0x2060, 0x2069}, Range{0x3164, 0x3164},
                                Range{0xFEFF, 0xFEFF}, Range{0xFFA0, 0xFFA0}, Range{0xE0000, 0xE01EF}};

template <std::size_t N>
bool in(const std::array<Range, N>& ranges, char32_t c) {
  return std::any_of(ranges.begin(), ranges.end(), [c](Range r) { return c >= r.first && c <= r.last; });
}

std::size_t columns_of(char32_t c) { return c < 0x80 ? 1 : in(kZeroWide, c) ? 0 : in(kWide, c) ? 2 : 1; }

// A place about `kBefore` columns before `begin`, not within a character.
std::size_t start_of(std::string_view line, std::size_t begin) {
  if (line.size() <= kWidest || begin <= kBefore) return 0;
  std::size_t start = begin - kBefore;
  while (start < begin && !source::begins_code_point(line[start])) ++start;
  return start;
}

/// One code point at the front of a text, as a terminal shows it.
struct Glyph {
  std::size_t bytes = 0;    ///< how many bytes of the text it takes; 0 at the end
  std::string shown;        ///< itself, blanks for a tab, `<1B>` for a byte or `<U+200E>` for a character that is not shown
  std::size_t columns = 0;  ///< width: 0 for combining marks, 2 for wide characters
};

/// The glyph at `text[at]`, where `column` columns stand before it (for tabs, which end at multiples of 4).
Glyph glyph(std::string_view text, std::size_t at, std::size_t column) {
  if (at >= text.size()) return {};
  const source::CodePoint c = source::code_point(text.substr(at));
  if (c.bytes == 0 || (c.value < 0x20 && c.value != '\t') || c.value == 0x7F) {
    return {1, fmt::format("<{:02X}>", static_cast<unsigned char>(text[at])), 4};
  }
  if (c.value == '\t') {
    const std::size_t width = kTab - column % kTab;
    return {1, std::string(width, ' '), width};
  }
  if (in(kObeyed, c.value)) {
    std::string shown = fmt::format("<U+{:04X}>", static_cast<std::uint32_t>(c.value));
    const std::size_t width = shown.size();
    return {c.bytes, std::move(shown), width};
  }
  return {c.bytes, std::string(text.substr(at, c.bytes)), columns_of(c.value)};
}

}  // namespace

std::size_t columns(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size();) {
    const source::CodePoint c = source::code_point(text.substr(at));
    count += columns_of(c.value);
    at += std::max<std::size_t>(1, c.bytes);
  }
  return count;
}

std::string between_backticks(std::string_view text) {
  if (text.empty()) return "\"\"";
  const bool at_edge = text.starts_with('`') || text.ends_with('`');
  const bool alone = std::count(text.begin(), text.end(), '`') % 2 != 0;
  return at_edge || alone ? "` " + std::string(text) + " `" : std::string(text);
}

std::string beginning(std::string_view text) {
  constexpr std::size_t kMost = 60;
  std::size_t end = 0;
  while (end < text.size() && end < kMost) end += std::max<std::size_t>(1, source::code_point(text.substr(end)).bytes);
  return std::string(text.substr(0, end)) + (end < text.size() ? "..." : "");
}

std::string quoted_code(std::string_view text) { return "`" + between_backticks(beginning(text)) + "`"; }

std::string visible(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    Glyph g = glyph(text, at, 0);
    out += text[at] == '\t' ? " " : g.shown;
    at += g.bytes;
  }
  return out;
}

Excerpt excerpt(std::string_view line, std::size_t begin, std::size_t end) {
  begin = std::min(begin, line.size());
  end = std::clamp(end, begin, line.size());
  const std::size_t start = start_of(line, begin);
  Excerpt result;
  if (start > 0) result.text = "...";
  std::size_t column = result.text.size();
  std::size_t place_end = column;
  bool found = false;
  std::size_t at = start;
  while (at < line.size()) {
    if (column >= kWidest && found) break;
    if (!found && at >= begin) {
      found = true;
      result.column = column;
    }
    const Glyph g = glyph(line, at, column);
    result.text += g.shown;
    column += g.columns;
    if (at < end) place_end = column;
    at += g.bytes;
  }
  if (!found) result.column = column;
  if (at < line.size()) result.text += "...";
  result.columns = place_end > result.column ? place_end - result.column : 1;
  return result;
}

std::string listed(const std::vector<std::string_view>& names, std::size_t shown, std::string_view what) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), shown); ++i) {
    text += fmt::format("{}`{}`", i == 0 ? "" : i + 1 == names.size() ? " and " : ", ", names[i]);
  }
  if (names.size() > shown) text += fmt::format(" and {} more{}{}", names.size() - shown, what.empty() ? "" : " ", what);
  return text;
}

std::string counted(std::uint64_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}{}", count, count == 1 || many.empty() ? one : many, count == 1 || !many.empty() ? "" : "s");
}

std::string in_a_row(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text += fmt::format("{}`{}`", text.empty() ? "" : ", ", name);
  return text;
}

}  // namespace kb::diagnostics
