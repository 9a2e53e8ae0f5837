// Says early that a robot cannot get away: it lies in a well of the potential that its energy does not lead out of.
//
// With friction, or driven by q' = F, the energy E = U + v^2 / 2 (of a unit of mass; U alone if kinematic) never grows. So a robot
// stays for ever in the part of { U <= E } that it is in. If that part lies within a few cells and does not come near the goal,
// the robot is caught, however slowly it may still creep towards the lowest point, which takes long where a mass with critical
// friction comes into a flat minimum. On a saddle, in a corridor, or on a slope the part reaches out of the neighbourhood: no alarm.
//
// The part is looked for on a lattice round the robot, lowest places first. What is lost between lattice points is added to E: a
// line that passes a point at half a step's distance h/2 is higher there by U'' (h/2)^2 / 2 in each direction.
// Costs a few us where there is a way down, some 50 us in a well; asked only where the forces nearly balance, and ever more rarely.
#pragma once

#include "planners/potential.h"

namespace kb::planners {

class WellProbe {
 public:
  /// The field must outlive it. `tolerance_m`: a part that comes so near to the goal is no trap.
  WellProbe(const PotentialField& field, double cell_m, double tolerance_m);

  /// True if the robot is caught for ever. Fed with every step of a drive.
  [[nodiscard]] bool add(Point at, double speed, double mass, double time_s);

  /// The part of { U <= energy } round a place is closed, within `kReach_cells`, and away from the goal.
  [[nodiscard]] bool is_closed(Point at, double energy) const;

  static constexpr double kReach_cells = 1.5;

 private:
  const PotentialField* field_;
  double cell_m_, tolerance_m_;
  double next_s_ = 0.0, pause_s_;
  static constexpr double kFirstPause_s = 0.5, kLongestPause_s = 8.0;   // see note [a cell is the unit of a drive]
};

}  // namespace kb::planners
