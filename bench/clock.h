// The clock of benchmarks that time single ticks.
#pragma once

#include <algorithm>
#include <chrono>
#include <limits>

namespace bench {

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

}  // namespace bench
