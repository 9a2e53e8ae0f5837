// Reads rows of results back: a fixed number of fields without quotes, whole numbers and names.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

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

/// The index of a name in the list of known names; false if it is not there.
template <class Id, std::size_t N>
[[nodiscard]] bool read_name(std::string_view text, const std::array<std::string_view, N>& names, Id& id) {
  const auto found = std::find(names.begin(), names.end(), text);
  id = static_cast<Id>(found - names.begin());
  return found != names.end();
}

}  // namespace kb::sim::batch
