// Which planes of a fleet are at rest most of the time.
//
// note [planes at rest]
// Of the rules of a knowledge base a mission uses some: no obstacle comes, nothing is asked by distance, the detour is not taken. Then half of
// the planes are the same bit for all robots, tick after tick, and half of the kernel computes them. Recorded missions tell which planes
// these are. For them there is a second kernel, made of the same rules with the bits at rest in place of the planes, so that most of what
// belongs to them falls away. What is left of them says where one would change: then the word is ticked again by the whole kernel. So a
// recording decides how fast a tick is, never what it decides.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/tables/fleet.h"

namespace kb::tables {

/// What a robot was told, tick by tick.
struct FleetMission {
  std::vector<std::uint32_t> dt_us;   ///< by tick: the time since the tick before
  std::vector<float> facts;           ///< by tick, then by fact; as recorded, so NaN and values out of range are allowed
};

/// The planes that stay as they are in each robot that drives one of the missions over and over, once the first round is over; none if no
/// mission has a tick. `form` must be of these tables. Where rules disagree its robot goes on with whatever the bits say, without computing
/// strengths. Pure. Cost: all steps of the form, twice for each tick.
[[nodiscard]] FleetRest planes_at_rest(const FleetForm& form, const Tables& tables, std::span<const FleetMission> missions);

}  // namespace kb::tables
