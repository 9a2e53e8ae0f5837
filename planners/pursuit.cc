#include "planners/pursuit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kb::planners {
namespace {

constexpr double kTrackEvery = 0.1;   // s

Point limited(Point v, double most) {
  const double size = norm(v);
  return size > most ? (most / size) * v : v;
}

Point repel(const MovingPoint& robot, const MovingDisc& disc, const PursuitParameters& p) {
  const Point to = disc.at - robot.at;
  const double centre = norm(to);
  if (centre == 0.0) return {};
  const Point n = (1.0 / centre) * to, relative = robot.velocity - disc.velocity;
  const double closing = dot(relative, n);
  if (closing <= 0.0) return {};
  const double gap = centre - disc.radius_m;
  const double room = gap - closing * closing / (2.0 * p.top_acceleration);   // how much of the gap is left after braking
  if (room >= p.zone_m) return {};
  // It cannot stop in time: full acceleration away from the obstacle.
  if (room <= 0.0) return -p.top_acceleration * n;
  const double back = p.repulsion / (room * room) * (1.0 + closing / p.top_acceleration);
  const double aside = p.repulsion * closing / (gap * p.top_acceleration * room * room);
  return -back * n + aside * (relative - closing * n);
}

bool is_usable(const PursuitParameters& p, const PursuitRun& how) {
  for (const double value : {p.pull, p.near_m, p.velocity_gain, p.zone_m, p.top_speed, p.top_acceleration, how.step_s,
                             how.time_s, how.tolerance_m, how.tolerance_m_s}) {
    if (!(value > 0.0) || !std::isfinite(value)) return false;
  }
  return p.repulsion >= 0.0 && std::isfinite(p.repulsion) && how.hold_s >= 0.0 && how.time_s / how.step_s < 1e9;
}

}  // namespace

Point pursuit_acceleration(const MovingPoint& robot, const MovingPoint& goal, std::span<const MovingDisc> obstacles,
                           const PursuitParameters& p) {
  const Point away = goal.at - robot.at;
  const double d = norm(away);
  Point a = (p.pull / std::max(d, p.near_m)) * away + 2.0 * p.velocity_gain * (goal.velocity - robot.velocity);
  for (const MovingDisc& disc : obstacles) a = a + repel(robot, disc, p);
  return limited(a, p.top_acceleration);
}

PursuitResult pursue(const PursuitScene& scene, const PursuitParameters& parameters, const PursuitRun& how,
                     const RunOptions& run) {
  PursuitResult result;
  if (!is_usable(parameters, how) || !scene.goal) {
    result.fault = Fault::kBadParameter;
    return result;
  }
  result.outcome = Outcome::kLimit;
  result.least_clearance_m = std::numeric_limits<double>::infinity();
  Watch watch(run);
  MovingPoint robot = scene.robot;
  double held_since = -1.0;
  const auto steps = static_cast<std::uint64_t>(how.time_s / how.step_s);
  const auto every = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(kTrackEvery / how.step_s));
  for (std::uint64_t i = 0; i <= steps && !watch.stopped(); ++i) {
    const double t = static_cast<double>(i) * how.step_s;
    const MovingPoint goal = scene.goal(t);
    const std::vector<MovingDisc> discs = scene.obstacles ? scene.obstacles(t) : std::vector<MovingDisc>{};
    result.time_s = t;
    if (i % every == 0) {
      result.robot.push_back(robot.at);
      result.goal.push_back(goal.at);
    }
    for (const MovingDisc& disc : discs) {
      result.least_clearance_m = std::min(result.least_clearance_m, distance(robot.at, disc.at) - disc.radius_m);
    }
    if (result.least_clearance_m <= 0.0) {
      result.outcome = Outcome::kNumeric;
      break;
    }
    const bool beside = distance(robot.at, goal.at) < how.tolerance_m &&
                        distance(robot.velocity, goal.velocity) < how.tolerance_m_s;
    if (!beside) {
      held_since = -1.0;
    } else if (held_since < 0.0) {
      held_since = t;
    }
    if (beside && t - held_since >= how.hold_s) {
      result.outcome = Outcome::kReached;
      break;
    }
    // Semi-implicit Euler.
    const Point a = pursuit_acceleration(robot, goal, discs, parameters);
    robot.velocity = limited(robot.velocity + how.step_s * a, parameters.top_speed);
    robot.at = robot.at + how.step_s * robot.velocity;
  }
  return result;
}

}  // namespace kb::planners
