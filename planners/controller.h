// Planners that drive: asked again and again where to go next, from where the robot is. This is how a simulator, or the
// controller of an `open` road, uses a method.
#pragma once

#include <cstddef>

#include "planners/problem.h"

namespace kb::planners {

/// Where the robot is. A controller believes this, and not where it sent the robot before.
struct Observation {
  Point at;                  ///< m
  double heading_rad = 0.0;
  Point velocity;            ///< m/s
  double time_s = 0.0;
};

/// Where to go next.
struct Advice {
  enum class State : std::uint8_t { kDrive, kArrived, kUnreachable, kTrapped, kLimit };
  State state = State::kDrive;
  Point target;              ///< m; drive straight to it, then ask again. The robot's own place unless kDrive
  Point velocity;            ///< m/s, at most 1 long: the wanted velocity as a share of the robot's top speed
  Trap trap;                 ///< when kTrapped
};

class Controller {
 public:
  virtual ~Controller() = default;
  /// The next step. Cheap enough to be called at every tick.
  [[nodiscard]] virtual Advice next(const Observation& seen) = 0;
};

/// Follows the path of a result: to the first point of the path that has not been passed yet.
class PathFollower {
 public:
  PathFollower(const Problem& problem, Result result);
  [[nodiscard]] Advice next(const Observation& seen);

 private:
  Result result_;
  double near_m_;
  std::size_t at_ = 0;
};

/// Drives a point from the start by what the controller says, straight from target to target, for at most `max_steps`
/// steps: for tests, and for methods whose plan is the record of what their controller did.
[[nodiscard]] Result drive(Controller& controller, const Problem& problem, const RunOptions& run, std::uint64_t max_steps);

}  // namespace kb::planners
