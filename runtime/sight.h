// What can be said of a look at the readings. Part of runtime/perception.h.
#pragma once

#include <cstdint>

#include "cpp20.h"

namespace mts {

/// The worst that can be said of the readings of one look, in order of severity.
enum class Sight : std::uint8_t {
  kClear,          ///< every number sensor has a reading in its range
  kSilent,         ///< some number sensor has none: what rests on it is unknown
  kStale,          ///< some reading is older than its sensor's `stale`: it says little, or (a text) nothing
  kBeyondRange,    ///< some reading was outside of its sensor's range: taken as the nearest end
  kNotANumber,     ///< some reading was NaN or infinite: taken as no reading
  kFromTheFuture,  ///< some reading was measured after `now`: taken as measured now, or, if it is further ahead than clocks differ, as none
  kTimeBackwards,  ///< `now` is before that of the look before: readings keep the age that they had, and new ones go by the new clock
};

// As in runtime/status.h.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wswitch-default"
/// A word for logs. Static text.
[[nodiscard]] constexpr const char* text(Sight sight) {
  switch (sight) {
    case Sight::kClear: return "clear";
    case Sight::kSilent: return "silent";
    case Sight::kStale: return "stale";
    case Sight::kBeyondRange: return "out_of_range";
    case Sight::kNotANumber: return "not_a_number";
    case Sight::kFromTheFuture: return "from_the_future";
    case Sight::kTimeBackwards: return "time_backwards";
  }
  return "unknown";
}
#pragma GCC diagnostic pop

/// What one look found, and what it did.
struct SightReport {
  Sight sight = Sight::kClear;
  std::uint32_t silent = 0, stale = 0, out_of_range = 0, not_a_number = 0, from_the_future = 0;  ///< readings
  std::uint32_t fits = 0;    ///< readings held against a prototype: the work
  std::uint32_t facts = 0;   ///< perceived facts that were put together
  std::uint32_t asleep = 0;  ///< lazy facts that nobody waited for
};

}  // namespace mts
