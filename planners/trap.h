// Says when a robot that follows a field is caught, judging by its motion (Filimonov and Filimonov 2019, on local minima).
//
// In the paper a kinematic robot is caught when its speed is below a threshold away from the goal, and a dynamic one when its trajectory
// stays within a bounded zone for some time. With discrete steps a kinematic robot in a valley runs to and fro at full speed, so here the
// second test applies to both.
#pragma once

#include <cstddef>
#include <deque>

#include "planners/problem.h"

namespace kb::planners {

/// Call `add` for every step of a drive. O(1) a step on average.
class TrapDetector {
 public:
  explicit TrapDetector(double cell_m) : cell_m_(cell_m) {}

  /// True once the robot is caught; `trap` then says how. `pull` is the speed in m/s at which the goal alone would draw the robot from
  /// here. A robot rests that is slow for that pull: far away under a parabolic attraction the whole approach is slow, and no rest.
  [[nodiscard]] bool add(Point at, double speed, double pull, double time_s);
  [[nodiscard]] const Trap& trap() const { return trap_; }
  /// The mean of the places of the last `kWindow_cells` of path. Call it only after an `add` that found chatter or a cycle.
  [[nodiscard]] Point middle() const;
  void reset() { *this = TrapDetector(cell_m_); }

 private:
  struct Sample {
    Point at;
    Point sum;         // of all places up to here
    double way_m;      // driven since the beginning
    bool turns_back;   // this step goes against the one before
  };
  [[nodiscard]] bool at_rest(Point at, double speed, double pull, double time_s);
  [[nodiscard]] bool in_a_box(Point at, double time_s);
  [[nodiscard]] bool remember(Point at);
  [[nodiscard]] bool gets_on() const;

  static constexpr double kSlow = 0.02;           // rest: slower than this share of the pull
  static constexpr double kHold_s = 0.5;          // ... for this long, times the side of a cell in m, while the speed falls to a tenth
  static constexpr double kBox_cells = 1.5;       // chatter and cycle: the last kWindow_cells of path lie in a box of this diameter
  static constexpr double kDrift_cells = 0.05;    // ... and the middles of its two halves are no farther apart than this
  static constexpr double kWindow_cells = 12.0;   // such as 60 steps of a fifth of a cell
  double cell_m_;
  Trap trap_;
  std::deque<Sample> window_;
  std::size_t first_ = 0;         // number of the first sample of the window
  std::size_t turns_ = 0;
  std::deque<std::pair<std::size_t, double>> extremes_[4];   // greatest of x, -x, y, -y
  double slow_since_s_ = -1.0, speed_then_ = 0.0, last_speed_ = 0.0;
};

}  // namespace kb::planners
