// How long ticks take, and the two comparisons.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/clock.h"

namespace peers {

using bench::Clock;
using bench::clock_ns;
using bench::ns_since;

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
