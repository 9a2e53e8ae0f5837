// Says when a robot that follows a field is caught (Filimonov and Filimonov 2019, on local minima).
//
// The paper: a kinematic robot is caught when its speed is below a threshold away from the goal; a dynamic one when its
// trajectory stays within a bounded zone for some time. With a discrete step a kinematic robot in a valley runs to and fro at
// full speed, so the second test is for both.
#pragma once

#include <cstddef>
#include <deque>

#include "planners/problem.h"

namespace kb::planners {

/// Fed with every step of a drive. O(1) a step on average.
class TrapDetector {
 public:
  explicit TrapDetector(double cell_m) : cell_m_(cell_m) {}

  /// True once the robot is caught; `trap` then says how.
  [[nodiscard]] bool add(Point at, double speed, double time_s);
  [[nodiscard]] const Trap& trap() const { return trap_; }
  void reset() { *this = TrapDetector(cell_m_); }

 private:
  struct Sample {
    Point at;
    Point sum;         // of all places up to here
    double way_m;      // since the beginning
    bool turns_back;   // against the step before
  };
  [[nodiscard]] bool at_rest(Point at, double speed, double time_s);
  [[nodiscard]] bool in_a_box(Point at, double time_s);

  static constexpr double kSlow_m_s = 0.02;       // rest: slower than this ...
  static constexpr double kHold_s = 0.5;          // ... for so long, times the side of a cell in m, while its speed falls to a tenth
  static constexpr double kBox_cells = 1.5;       // chatter and cycle: the last kWindow_cells of way lie within a box of this diameter
  static constexpr double kDrift_cells = 0.05;    // ... and their middle stays where it is, from one half of it to the other
  static constexpr double kWindow_cells = 12.0;   // 60 steps of a fifth of a cell
  double cell_m_;
  Trap trap_;
  std::deque<Sample> window_;
  std::size_t first_ = 0;         // number of the first sample of the window
  std::size_t turns_ = 0;
  std::deque<std::pair<std::size_t, double>> extremes_[4];   // greatest of x, -x, y, -y
  double slow_since_s_ = -1.0, speed_then_ = 0.0, last_speed_ = 0.0;
};

}  // namespace kb::planners
