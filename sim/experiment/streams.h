// The stream of random numbers for each part of an experiment: see note [what a run depends on].
#pragma once

#include <cstdint>

namespace kb::sim::experiment {

// note [streams apart]
// The first 2^20 labyrinths, routes and cases have one block of 2^20 streams each, side by side. Larger numbers have further blocks of
// 2^20 streams above these, so that experiments made before them keep their numbers.
enum class Drawn : std::uint64_t { kSketch = 1u << 20, kRoute = 2u << 20, kCase = 3u << 20 };

/// All different, for numbers below 2^52.
[[nodiscard]] constexpr std::uint64_t stream_of(Drawn what, std::uint64_t number) {
  return static_cast<std::uint64_t>(what) + (number & 0xFFFFF) + (number >> 20 << 32);
}

/// All different, for labyrinths below 2^28 and routes below 2^24.
[[nodiscard]] constexpr std::uint64_t route_number(std::uint64_t labyrinth, std::uint64_t route) { return (route & 0xFFF) + (labyrinth << 12) + (route >> 12 << 40); }

}  // namespace kb::sim::experiment
