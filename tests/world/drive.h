// The body of the robot: it does what the dispatched strategy says, for the length of one tick.
#pragma once

#include <cstdint>
#include <string_view>

#include "tests/world/world.h"

namespace kb::world {

/// A strategy of the standard library as the body understands it.
struct Action {
  enum class Kind : std::uint8_t { kStand, kMove, kCross, kAvoid, kRound };
  Kind kind = Kind::kStand;
  Turn turn = Turn::kForward;        ///< kCross
  Method method = Method::kMark;     ///< kCross, kMove
};

/// `Move.mark`, `Cross[right,mark]`, `Avoid`, `Round`; everything else (`Stop`, `Search`, no strategy) stands still.
[[nodiscard]] Action action_of(std::string_view strategy);

/// Drives for `dt_ms`. Accidents are noted in `world.faults`.
void drive(World& world, Action action, std::int64_t dt_ms);

}  // namespace kb::world
