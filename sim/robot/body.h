// The robot's body among walls and obstacles, by Box2D: where it stands, what it hits, what its rays meet.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/world/labyrinth.h"

namespace kb::sim {

inline constexpr double kRobotRadius = static_cast<double>(kRobot.radius_m);

/// A round thing that stands on the floor.
struct Obstacle {
  std::string name;
  Spot at;
  double radius_m = 0.0;
};

/// The robot has hit something.
struct Hit {
  std::string what;        ///< `a wall`, or the name of an obstacle
  Spot at;                 ///< where the robot was
  double speed_m_s = 0.0;  ///< the speed at which they came together
};

class Arena {
 public:
  Arena(const Labyrinth& labyrinth, Pose start, double radius_m = kRobotRadius);
  ~Arena();
  Arena(Arena&&) noexcept;
  Arena& operator=(Arena&&) = delete;

  /// The wheels push the body for `dt_s`: `speed` ahead, `turn` counter-clockwise. Things in the way hold it up.
  void push(double speed_m_s, double turn_rad_s, double dt_s);
  [[nodiscard]] Pose pose() const;
  [[nodiscard]] double radius_m() const;
  /// Puts it elsewhere, standing.
  void put(Pose pose);

  /// The distance from `from` to the nearest surface in a direction, at most `most_m`. The robot itself is ignored.
  [[nodiscard]] float ray(Spot from, Spot ahead, double most_m) const;
  [[nodiscard]] bool touching() const;
  /// The hits since the last call, one for each thing; a touch that lasts is one.
  [[nodiscard]] std::vector<Hit> take_hits();

  void place_obstacle(const Obstacle& obstacle);   ///< an obstacle of the same name is moved
  /// Moves an existing obstacle, during the step of the next `push`.
  void move_obstacle(const Obstacle& there, double dt_s);
  void remove_obstacle(const std::string& name);
  [[nodiscard]] const std::vector<Obstacle>& obstacles() const;

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace kb::sim
