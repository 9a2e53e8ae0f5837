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
struct RulesInput {
  float bearing_deg = 0.0f;           ///< from ahead to the goal, counter-clockwise, in (-180, 180]
  float free[kRangeFinders] = {};     ///< 0 blocked to 1 free: see follow_rules.h
};
/// Numbers that are NaN or infinite count as if no rule had fired.
struct RulesOutput {
  float turn_deg = 0.0f;   ///< by which the robot turns, counter-clockwise; reduced to (-180, 180]
  float speed = 0.0f;      ///< share of 0.25 m/s, 0 to 1, at which it steers while it turns by less than 20 degrees; below 0.5 it turns on the spot
  bool found = false;      ///< some rule fired
};

/// Controllers keep a copy. `self`, handed to both functions, must live as long as they are stepped. Both are called within `step`, and
/// must not throw: while they run, the wheels do what they were last told. So a planner that needs more than a part of the control period should
/// plan elsewhere, and answer kSame until it has a path.
struct Host {
  void* self = nullptr;
  /// Called once per control period while the robot is between the doors. Takes in new senses and reports whether the path changes.
  WayNews (*look)(void* self, const WayQuestion& question, Way& way) = nullptr;
  /// Called where the robot has to decide: after each turn and each 10 cm, or in each period while it steers.
  RulesOutput (*decide)(void* self, const RulesInput& input) = nullptr;
};

}  // namespace mts
