#include "compiler/diagnostics/look_alike.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include "compiler/source/utf8.h"

namespace kb::diagnostics {
namespace {

struct Decomposition { char32_t whole, letter, mark; };
constexpr Decomposition kDecompositions[] = {
#include "compiler/diagnostics/decompositions.def"
};

struct Twin { char32_t letter; char plain; };
/// Cyrillic and Greek letters that most fonts draw like an ASCII letter. Ascending.
constexpr Twin kTwins[] = {
    {0x0391, 'A'}, {0x0392, 'B'}, {0x0395, 'E'}, {0x0396, 'Z'}, {0x0397, 'H'}, {0x0399, 'I'}, {0x039A, 'K'}, {0x039C, 'M'}, {0x039D, 'N'}, {0x039F, 'O'},
    {0x03A1, 'P'}, {0x03A4, 'T'}, {0x03A5, 'Y'}, {0x03A7, 'X'}, {0x03BD, 'v'}, {0x03BF, 'o'}, {0x0405, 'S'}, {0x0406, 'I'}, {0x0408, 'J'}, {0x0410, 'A'},
    {0x0412, 'B'}, {0x0415, 'E'}, {0x041A, 'K'}, {0x041C, 'M'}, {0x041D, 'H'}, {0x041E, 'O'}, {0x0420, 'P'}, {0x0421, 'C'}, {0x0422, 'T'}, {0x0423, 'Y'},
    {0x0425, 'X'}, {0x0430, 'a'}, {0x0435, 'e'}, {0x043E, 'o'}, {0x0440, 'p'}, {0x0441, 'c'}, {0x0443, 'y'}, {0x0445, 'x'}, {0x0455, 's'}, {0x0456, 'i'},
    {0x0458, 'j'}, {0x04BB, 'h'}, {0x04C0, 'I'}, {0x04CF, 'l'}, {0x0501, 'd'}, {0x051A, 'Q'}, {0x051B, 'q'}, {0x051C, 'W'}, {0x051D, 'w'}};

/// A character of a name as it is written, and what it looks like.
struct Character {
  std::string_view written;
  char32_t point = 0;
  std::u32string looks;
};

char32_t plain(char32_t letter) {
  if (letter >= 0xFF01 && letter <= 0xFF5E) return letter - 0xFF01 + 0x21;   // full-width
  const auto* const twin = std::lower_bound(std::begin(kTwins), std::end(kTwins), letter, [](const Twin& t, char32_t l) { return t.letter < l; });
  return twin != std::end(kTwins) && twin->letter == letter ? static_cast<char32_t>(twin->plain) : letter;
}

std::u32string looks(char32_t letter) {
  std::u32string marks;
  for (;;) {   // in some letters with two marks, the first part still has a mark
    const auto* const at = std::lower_bound(std::begin(kDecompositions), std::end(kDecompositions), letter,
                                            [](const Decomposition& d, char32_t l) { return d.whole < l; });
    if (at == std::end(kDecompositions) || at->whole != letter) break;
    marks.insert(marks.begin(), at->mark);
    letter = at->letter;
  }
  return plain(letter) + marks;
}

std::vector<Character> characters(std::string_view name) {
  std::vector<Character> out;
  for (std::size_t at = 0; at < name.size();) {
    source::CodePoint next = source::code_point(name.substr(at));
    if (next.bytes == 0) next = {static_cast<unsigned char>(name[at]), 1};
    out.push_back({name.substr(at, next.bytes), next.value, looks(next.value)});
    at += next.bytes;
  }
  return out;
}

std::string_view script(char32_t point) {
  const auto in = [point](char32_t first, char32_t last) { return point >= first && point <= last; };
  if (in(0x0300, 0x036F)) return "a mark of its own";
  if (in(0x0370, 0x03FF) || in(0x1F00, 0x1FFF)) return "Greek";
  if (in(0x0400, 0x052F)) return "Cyrillic";
  if (in(0x3040, 0x30FF)) return "kana";
  if (in(0xFF00, 0xFFEF)) return "full-width";
  return in(0, 0x024F) || in(0x1E00, 0x1EFF) ? "Latin" : "another script";
}

/// The characters [from, to) of a name: "U+0065, U+0301 (a mark of its own)".
std::string code_points(const std::vector<Character>& name, std::size_t from, std::size_t to) {
  std::string text;
  for (std::size_t i = from; i < to; ++i) {
    text += fmt::format("{}U+{:04X} ({})", i == from ? "" : " and ", static_cast<std::uint32_t>(name[i].point), script(name[i].point));
  }
  return text;
}

}  // namespace

std::string appearance(std::string_view name) {
  const auto ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
  if (std::all_of(name.begin(), name.end(), ascii)) return std::string(name);
  std::string text;
  for (const Character& character : characters(name)) {
    for (const char32_t point : character.looks) {
      if (point < 0x80) text += static_cast<char>(point);
      else text += fmt::format("\\{:X};", static_cast<std::uint32_t>(point));
    }
  }
  return text;
}

bool look_alike(std::string_view a, std::string_view b) { return a != b && appearance(a) == appearance(b); }

std::string difference(std::string_view a, std::string_view b) {
  constexpr int kMost = 3;
  const std::vector<Character> first = characters(a), second = characters(b);
  std::string text;
  std::size_t i = 0, j = 0;
  for (int told = 0; told < kMost && i < first.size() && j < second.size();) {
    const std::size_t from_i = i, from_j = j;
    std::u32string seen_i = first[i++].looks, seen_j = second[j++].looks;
    while (seen_i != seen_j && (i < first.size() || j < second.size())) {   // one code point may equal two
      if (seen_i.size() < seen_j.size() && i < first.size()) seen_i += first[i++].looks;
      else if (j < second.size()) seen_j += second[j++].looks;
      else break;
    }
    const std::size_t last_i = i - 1;
    const std::string_view letter(first[from_i].written.data(),
                                  static_cast<std::size_t>(first[last_i].written.data() + first[last_i].written.size() - first[from_i].written.data()));
    if (i - from_i == j - from_j && first[from_i].point == second[from_j].point) continue;
    text += fmt::format("{}`{}` is {} in the one, {} in the other", told++ == 0 ? "" : "; ", letter, code_points(first, from_i, i), code_points(second, from_j, j));
  }
  return text;
}

}  // namespace kb::diagnostics
