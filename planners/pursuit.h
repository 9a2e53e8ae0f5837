// Moving goals and moving obstacles: potential fields over relative place and velocity (Ge and Cui, Autonomous Robots 13:207-222, 2002).
//
//   U_att = a_p ||p_g - p||^m + a_v ||v_g - v||^n,   F_att = m a_p ||p_g - p||^(m-1) n_p + n a_v ||v_g - v||^(n-1) n_v
//
// In the paper's spirit m = 1 (conic: the same pull at any distance) and n = 2. Within `near_m` of the goal m = 2, joined without a jump,
// so that the robot comes to rest beside the goal and does not chatter. An obstacle repels only while the robot closes in on it, with
// v_RO > 0 along the line between them, and only if the distance that remains after braking, p - v_RO^2 / (2 a_max), is less than p0
// (their equations (19) and (20)). Like theirs it is the sum of a gradient by place and one by velocity; the gain of the second is 1/s.
//
// There is no guarantee with moving obstacles: the field knows neither where they will be nor the way out of a pit.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "planners/problem.h"

namespace kb::planners {

struct MovingPoint {
  Point at;         ///< m
  Point velocity;   ///< m/s
};
struct MovingDisc {
  Point at, velocity;
  double radius_m = 0.0;
};

struct PursuitParameters {
  double pull = 2.0;                 ///< a_p, m/s^2
  double near_m = 1.0;
  double velocity_gain = 1.0;        ///< a_v, 1/s. Far away the robot closes in on the goal at a_p / (2 a_v) m/s
  double repulsion = 0.5;            ///< eta, m^3/s^2
  double zone_m = 1.0;               ///< p0
  double top_speed = 1.0;            ///< m/s
  double top_acceleration = 3.0;     ///< a_max, m/s^2
};

/// The acceleration that the field asks of the robot, at most `top_acceleration`, m/s^2. The robot is a point of unit mass.
[[nodiscard]] Point pursuit_acceleration(const MovingPoint& robot, const MovingPoint& goal,
                                         std::span<const MovingDisc> obstacles, const PursuitParameters& parameters);

struct PursuitScene {
  MovingPoint robot;
  std::function<MovingPoint(double time_s)> goal;
  std::function<std::vector<MovingDisc>(double time_s)> obstacles;   ///< may be empty
};
struct PursuitRun {
  double step_s = 0.01;
  double time_s = 600.0;          ///< after which the pursuit gives up
  double tolerance_m = 0.1;       ///< the goal is caught when the robot is this near to it,
  double tolerance_m_s = 0.05;    ///< ... its velocity differs from the goal's by at most this,
  double hold_s = 0.5;            ///< ... and both hold for this long
};
/// kReached: the goal was caught. kNumeric: the robot touched an obstacle. kLimit: neither in time. kInvalid: `fault` says why.
struct PursuitResult {
  Outcome outcome = Outcome::kInvalid;
  Fault fault = Fault::kNone;           ///< kInvalid: a parameter is not positive, or there is no goal (kBadParameter)
  double time_s = 0.0;                  ///< when it ended
  double least_clearance_m = 0.0;       ///< to any obstacle; infinite if there are none
  std::vector<Point> robot, goal;       ///< tracks, one point every tenth of a second
};
[[nodiscard]] PursuitResult pursue(const PursuitScene& scene, const PursuitParameters& parameters, const PursuitRun& how,
                                   const RunOptions& run);

}  // namespace kb::planners
