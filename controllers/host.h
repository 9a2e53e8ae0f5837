// What a program supplies to controllers that need it: a planner, which needs a map and a heap, and a fuzzy controller, which is
// compiled from a knowledge base. Plain function pointers with a context pointer, so that the controllers stay freestanding.
#pragma once

#include "reckoning.h"
#include "senses.h"

namespace mts {

/// Parameters of the search for a path; see follow_plan.h.
struct PlanGains {
  float speed_m_s = 0.25f;
  float turn_rad_s = 115.0f * kRadPerDeg;
  float clearance_m = 0.22f;
  float cell_m = 0.1f;
  float population = 60.0f, generations = 300.0f, seed = 1.0f;
};

/// A path as straight pieces; the first begins where the robot is. `whole`: it ends at the gate. Otherwise the planner gives the rest
/// when the robot comes near the end of these pieces.
struct Way {
  Piece pieces[kLongestCourse] = {};
  std::uint8_t count = 0;
  bool whole = true;
};
enum class WayNews : std::uint8_t {
  kSame,     ///< the path stays as it was. While there is none, the robot stands, for 8 s at most, and the next question is `first` again
  kNew,      ///< `way` was written; without pieces it is no path, as with kSame while there is none
  kNoWay,    ///< no path exists
  kFailed,   ///< no path was found, though one may exist
};
struct WayQuestion {
  Place at, gate;                ///< the origin is where the strategy begins, the axes are the compass's
  Door in;                       ///< where the hall begins, in the same frame
  const Senses* senses = nullptr;
  const PlanGains* gains = nullptr;
  bool first = false;            ///< there is no path yet, or the robot has been held up on it for 4 s: plan from `at`
};

/// The inputs and outputs of std.go_to_goal's `GoToGoal`.
struct RulesInput { float bearing_deg = 0.0f; float free[kRangeFinders] = {}; };
struct RulesOutput { float turn_deg = 0.0f, speed = 0.0f; bool found = false; };   ///< `found`: some rule fired

struct Host {
  void* self = nullptr;
  /// Called once per control period. Takes in new senses and reports whether the path changes.
  WayNews (*look)(void* self, const WayQuestion& question, Way& way) = nullptr;
  RulesOutput (*decide)(void* self, const RulesInput& input) = nullptr;
};

}  // namespace mts
