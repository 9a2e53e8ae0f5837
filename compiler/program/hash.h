// For hash tables that are looked up and never iterated.
#pragma once

#include <cstdint>

namespace kb::program {

/// The hash of a sequence that goes on with `value`.
[[nodiscard]] inline std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
  hash ^= value + 0x9E3779B97F4A7C15ull + (hash << 6) + (hash >> 2);
  return hash * 0xFF51AFD7ED558CCDull;
}

}  // namespace kb::program
