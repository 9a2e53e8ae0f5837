#include "sim/scenario/toml_keys.h"

#include <algorithm>
#include <string>

namespace kb::sim {
namespace {

/// Behind the string that begins with the quotation mark at `at`. One that is not closed ends with its line, or with the text if it has several lines:
/// there the library gives up.
std::size_t behind_string(std::string_view bytes, std::size_t at) {
  const char quote = bytes[at];
  const bool lines = bytes.substr(at).starts_with(std::string(3, quote));
  const std::size_t marks = lines ? 3 : 1;
  for (at += marks; at < bytes.size(); ++at) {
    if (bytes[at] == '\n' && !lines) return at;
    if (bytes[at] == '\\' && quote == '"') {
      ++at;
    } else if (bytes[at] == quote) {
      std::size_t row = 1;
      while (row < 5 && at + row < bytes.size() && bytes[at + row] == quote) ++row;   // a string of several lines may end in two marks of its own
      if (row >= marks) return at + (lines ? row : 1);
      at += row - 1;
    }
  }
  return bytes.size();
}

}  // namespace

std::size_t find_deep_key(std::string_view bytes) {
  constexpr std::string_view kBetweenKeys = "\n=,[]{}";
  std::size_t points = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    const char c = bytes[at];
    if (c == '"' || c == '\'') at = behind_string(bytes, at) - 1;
    else if (c == '#') at = std::min(bytes.find('\n', at), bytes.size()) - 1;
    else if (kBetweenKeys.find(c) != std::string_view::npos) points = 0;
    else if (c == '.' && ++points >= kMostKeyParts) return at;
  }
  return std::string_view::npos;
}

}  // namespace kb::sim
