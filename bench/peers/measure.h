// How long ticks take, and the two comparisons.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace peers {

using Clock = std::chrono::steady_clock;

[[nodiscard]] inline double ns_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
}

/// What it takes to look at the clock, which is in every tick that is timed by itself: the least of many looks.
[[nodiscard]] inline double clock_ns() {
  double least = std::numeric_limits<double>::max();
  for (int i = 0; i < 10'000; ++i) least = std::min(least, ns_since(Clock::now()));
  return least;
}

/// Keeps a value from being optimised away.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "r,m"(value) : "memory");
}

/// Route1 in every form over the same facts: first held against each other tick by tick, then timed in turns. Throws
/// std::runtime_error on the first tick at which a peer decides differently.
[[nodiscard]] nlohmann::json compare_route1(const std::string& program_json, const std::string& image, const std::string& sources, int rounds);

/// A chain of landmarks with two rules a leg, in sizes of 10 to 10^6 rules: `folder` holds chain_RULES.kbt. Peers that take
/// longer than `patience_s` to be made at a size are not made at larger ones.
[[nodiscard]] nlohmann::json compare_sizes(const std::string& folder, double patience_s);

/// What the machine's memory can do at best, with 256 MiB: one read that must wait for the one before, and reading all in order.
[[nodiscard]] nlohmann::json measure_memory();

}  // namespace peers
