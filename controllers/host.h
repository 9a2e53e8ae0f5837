// What a program lends to controllers that cannot do without it: a planner, which needs a map and a heap, and a fuzzy controller,
// which is compiled from a knowledge base. Plain functions with a pointer, so that the controllers stay freestanding.
#pragma once

#include "reckoning.h"
#include "senses.h"

namespace mts {

/// What a way is looked for with; see follow_plan.h.
struct PlanGains {
  float speed_m_s = 0.25f;
  float turn_rad_s = 115.0f * kRadPerDeg;
  float clearance_m = 0.22f;
  float cell_m = 0.1f;
  float population = 60.0f, generations = 300.0f, seed = 1.0f;
};

/// A way as straight pieces, the first of them from where the robot is. `whole`: it ends at the gate; else the planner gives the
/// rest when the robot has come near to the end of these.
struct Way {
  Piece pieces[kLongestCourse] = {};
  std::uint8_t count = 0;
  bool whole = true;
};
enum class WayNews : std::uint8_t {
  kSame,     ///< go on
  kNew,      ///< `way` was written
  kNoWay,    ///< there is none
  kFailed,   ///< none was found; there may be one
};
struct WayQuestion {
  Place at, gate;                ///< counted from where the strategy begins, axes of the compass
  Door in;                       ///< where the hall begins, the same
  const Senses* senses = nullptr;
  const PlanGains* gains = nullptr;
  bool first = false;            ///< the strategy has just begun: there is no way yet
};

/// The inputs and outputs of std.go_to_goal's `GoToGoal`.
struct RulesInput { float bearing_deg = 0.0f; float free[kRangeFinders] = {}; };
struct RulesOutput { float turn_deg = 0.0f, speed = 0.0f; bool found = false; };   ///< `found`: some rule fired

struct Host {
  void* self = nullptr;
  /// Asked at each period. Sees what is new, and says whether the way changes.
  WayNews (*look)(void* self, const WayQuestion& question, Way& way) = nullptr;
  RulesOutput (*decide)(void* self, const RulesInput& input) = nullptr;
};

}  // namespace mts
