// Numbers in texts, read the same in every locale.
#pragma once

#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace kb::source {

/// False unless all of `text` is one number that `Number` can hold, of floating types a finite one. Neither blanks nor a `+` before it.
template <class Number>
[[nodiscard]] bool read_number(std::string_view text, Number& number) {
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return false;
  if constexpr (std::is_floating_point_v<Number>) return std::isfinite(number);
  return true;
}

/// The text without a `+` before a number. Where another sign follows it stays, so that `+-5` is no number.
[[nodiscard]] constexpr std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

}  // namespace kb::source
