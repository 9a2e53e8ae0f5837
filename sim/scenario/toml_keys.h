// Keys of TOML that are too deep for the TOML library.
#pragma once

#include <cstddef>
#include <string_view>

namespace kb::sim {

/// The most parts of one key. The library recurses into each table, and only 256 tables within values are its own limit; both limits together
/// need two megabytes of stack.
inline constexpr std::size_t kMostKeyParts = 32;

/// Where the first key goes on after `kMostKeyParts` parts; npos if none does. `bytes` need not be TOML. What stands in strings and comments is
/// no key, and neither is a number: it has one point.
[[nodiscard]] std::size_t find_deep_key(std::string_view bytes);

}  // namespace kb::sim
