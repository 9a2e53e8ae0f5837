// Which stream of random numbers belongs to which part of an experiment: see note [what a run depends on].
#pragma once

#include <cstdint>

namespace kb::sim::experiment {

// note [streams apart]
// Labyrinths, routes and cases have 2^20 streams each, side by side, as they had before any experiment was larger; what goes beyond
// that has blocks of 2^20 streams above all of those.
enum class Drawn : std::uint64_t { kSketch = 1u << 20, kRoute = 2u << 20, kCase = 3u << 20 };

/// All different, for numbers below 2^52.
[[nodiscard]] constexpr std::uint64_t stream_of(Drawn what, std::uint64_t number) {
  return static_cast<std::uint64_t>(what) + (number & 0xFFFFF) + (number >> 20 << 32);
}

/// All different, for labyrinths below 2^28 and routes below 2^24.
[[nodiscard]] constexpr std::uint64_t route_number(std::uint64_t labyrinth, std::uint64_t route) { return (route & 0xFFF) + (labyrinth << 12) + (route >> 12 << 40); }

}  // namespace kb::sim::experiment
