// Says early that a robot cannot get away, because it is in a well of the potential that its energy cannot lead out of.
//
// With friction, or driven by q' = F, the energy E = U + v^2 / 2 (for a unit of mass; U alone if kinematic) never grows. So a robot stays
// for ever in the connected part of { U <= E } around it. If that part lies within a few cells and does not come near the goal, the robot
// is caught, however slowly it still creeps towards the lowest point. (A mass with critical friction takes long to come to rest in a flat
// minimum.) On a saddle, in a corridor or on a slope the part reaches out of the neighbourhood, and there is no alarm.
//
// The search for the part runs on a lattice round the robot, lowest places first. E is raised by what may be missed between lattice points:
// a line that passes a point at half a step's distance h/2 is higher there by U'' (h/2)^2 / 2 in each direction.
// It costs a few us if there is a path down and some 50 us in a well. It runs only when the forces nearly balance, and ever more rarely.
#pragma once

#include "planners/potential.h"

namespace kb::planners {

class WellProbe {
 public:
  /// The field must outlive the probe. A part that comes within `tolerance_m` of the goal is no trap.
  WellProbe(const PotentialField& field, double cell_m, double tolerance_m);

  /// True if the robot is caught for ever. Call it for every step of a drive.
  [[nodiscard]] bool add(Point at, double speed, double mass, double time_s);

  /// Whether the part of { U <= energy } round a place is closed within `kReach_cells` and keeps away from the goal.
  [[nodiscard]] bool is_closed(Point at, double energy) const;

  static constexpr double kReach_cells = 1.5;

 private:
  const PotentialField* field_;
  double cell_m_, tolerance_m_;
  double next_s_ = 0.0, pause_s_;
  static constexpr double kFirstPause_s = 0.5, kLongestPause_s = 8.0;   // see note [a cell is the unit of a drive]
};

}  // namespace kb::planners
