// Reads rows of results back: a fixed number of fields without quotes, whole numbers and names.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <type_traits>

namespace kb::sim::batch {

/// Cuts a line at its commas. False if there are not exactly N fields.
template <std::size_t N>
[[nodiscard]] bool split(std::string_view line, std::array<std::string_view, N>& fields) {
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t comma = line.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == N)) return false;
    fields[i] = line.substr(0, comma);
    line.remove_prefix(std::min(line.size(), comma + (comma == std::string_view::npos ? 0 : 1)));
  }
  return true;
}

/// False unless all of `text` is one finite number.
template <class Number>
[[nodiscard]] bool read_number(std::string_view text, Number& number) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || result.ec != std::errc() || result.ptr != text.data() + text.size()) return false;
  if constexpr (std::is_floating_point_v<Number>) return std::isfinite(number);
  return true;
}

/// The index of a name in the list of known names; false if it is not there.
template <class Id, std::size_t N>
[[nodiscard]] bool read_name(std::string_view text, const std::array<std::string_view, N>& names, Id& id) {
  const auto found = std::find(names.begin(), names.end(), text);
  id = static_cast<Id>(found - names.begin());
  return found != names.end();
}

}  // namespace kb::sim::batch
