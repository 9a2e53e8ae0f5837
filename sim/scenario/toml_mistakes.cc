#include "sim/scenario/toml_mistakes.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/source/encoding.h"

namespace kb::sim {
namespace {

using source::is_digit;
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// The line of a mistake, and the place in it.
struct Place {
  std::string_view line;
  std::size_t at = 0;

  [[nodiscard]] std::string_view rest() const { return line.substr(at); }
  [[nodiscard]] std::string_view before() const { return source::trimmed(line.substr(0, at)); }
  /// The number that ends at the place, or before blanks there; empty if none does.
  [[nodiscard]] std::string_view number_before() const {
    const std::string_view text = before();
    std::size_t begin = text.size();
    while (begin > 0 && (is_digit(text[begin - 1]) || text[begin - 1] == '.')) --begin;
    const bool word = begin > 0 && (is_letter(text[begin - 1]) || text[begin - 1] == '_');
    return word ? std::string_view() : text.substr(begin);
  }
};

Place place_of(std::string_view bytes, std::size_t at) {
  at = std::min(at, bytes.size());
  const std::size_t begin = at == 0 ? 0 : bytes.rfind('\n', at - 1) + 1;   // npos + 1 is 0
  const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
  return {bytes.substr(begin, end - begin), at - begin};
}

/// A value without quotation marks, up to what ends it.
std::string bare_text(const Place& place) {
  const bool value = place.before().ends_with('=') || place.before().ends_with('[') || place.before().ends_with(',');
  if (!value || place.rest().empty() || !is_letter(place.rest().front())) return {};
  const std::string_view word = source::trimmed(place.rest().substr(0, place.rest().find_first_of(",]}#\r")));
  const std::string small = source::lower(std::string(word));
  if (small == "true" || small == "false") return fmt::format("write `{}`, in small letters", small);
  return fmt::format("a text stands in quotation marks; write `\"{}\"`", word);
}

/// `0,3`, `3 s`, `0.3m`: what follows the digits of a number.
std::string behind_number(const Place& place) {
  const std::string_view number = place.number_before(), rest = place.rest();
  if (number.empty() || rest.empty()) return {};
  if (rest.front() == ',' && rest.size() > 1 && is_digit(rest[1]) && !is_blank(place.line[place.at - 1])) {
    const std::size_t digits = std::min(rest.find_first_not_of("0123456789", 1), rest.size());
    return fmt::format("a number has a point, no comma; write `{}.{}`", number, rest.substr(1, digits - 1));
  }
  if (is_letter(rest.front()) || rest.front() == '%') return fmt::format("no unit stands behind a number; write `{}`", number);
  return {};
}

/// A key or a table that is there twice.
std::string twice(const Place& place, std::string_view description, bool in_event) {
  if (description.find("redefine") == std::string_view::npos) return {};
  const std::string_view before = place.before(), line = source::trimmed(place.line);
  if (line.starts_with('[')) return fmt::format("`{}` is there twice; one table says all of it", line.substr(0, line.find('#')));
  const std::size_t key = before.find_last_of("{,") + 1, equals = before.rfind('=');   // npos + 1 is 0
  if (equals == std::string_view::npos || equals < key) return {};
  const std::string_view events = in_event ? "; an event does one thing, and each has an `[[event]]` of its own" : "";
  return fmt::format("`{}` stands twice in one table{}", source::trimmed(before.substr(key, equals - key)), events);
}

}  // namespace

std::string toml_mistake(std::string_view bytes, std::size_t at, std::string_view description) {
  const Place place = place_of(bytes, at);
  const std::string_view rest = place.rest();
  for (const std::string_view mark : source::kForeignQuotes) {
    if (rest.starts_with(mark)) return fmt::format("a text stands between `\"`, and `{}` is another mark", mark);
  }
  for (const std::string_view sign : {"//", "/*", "--", ";"}) {
    if (rest.starts_with(sign) && place.before().empty()) return fmt::format("a comment begins with `#`, not with `{}`", sign);
  }
  if (rest.starts_with("//")) return "a comment begins with `#`, not with `//`";
  if (rest.starts_with(';')) return "no `;` ends a line";
  if (rest.starts_with(':')) return "`=` stands between a key and its value, not `:`";
  const std::string_view above = bytes.substr(0, std::min(at, bytes.size()));
  const std::size_t header = above.rfind("\n[");
  const bool in_event = above.substr(header == std::string_view::npos ? 0 : header + 1).starts_with("[[event]]");
  if (std::string known = twice(place, description, in_event); !known.empty()) return known;
  if (std::string known = behind_number(place); !known.empty()) return known;
  if (std::string known = bare_text(place); !known.empty()) return known;
  if (place.before().ends_with('=') && source::trimmed(rest).empty()) return "a value is missing behind `=`";
  return {};
}

std::string number_at(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  std::size_t end = 0;
  bool point = false;
  for (; end < text.size(); ++end) {
    const bool separates = (text[end] == '.' || text[end] == ',') && !point && end > 0 && end + 1 < text.size() && is_digit(text[end + 1]);
    if (!separates && !is_digit(text[end])) break;
    point = point || separates;
  }
  std::string number(text.substr(0, end));
  std::replace(number.begin(), number.end(), ',', '.');
  return number.empty() || !negative ? number : "-" + number;
}

}  // namespace kb::sim
