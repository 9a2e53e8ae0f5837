#include "tools/kbc/trace/glob.h"

#include "compiler/source/encoding.h"

namespace kb::trace {
namespace {

std::size_t after_character(std::string_view text, std::size_t at) {
  do ++at;
  while (at < text.size() && !source::begins_code_point(text[at]));
  return at;
}

}  // namespace

bool matches_glob(std::string_view pattern, std::string_view text) {
  constexpr std::size_t nowhere = std::string_view::npos;
  std::size_t p = 0, t = 0, star = nowhere, retry = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      retry = t;
    } else if (p < pattern.size() && pattern[p] == '?') {
      ++p;
      t = after_character(text, t);
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p;
      ++t;
    } else if (star != nowhere) {
      p = star + 1;
      t = retry = after_character(text, retry);
    } else
      return false;
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace kb::trace
