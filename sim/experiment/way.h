// Routes and shortest ways over a labyrinth's roads.
#pragma once

#include <optional>
#include <vector>

#include "sim/world/labyrinth.h"

namespace kb::sim::experiment {

inline constexpr double kMarkSpeed = 0.4, kOtherSpeed = 0.3;   ///< m/s, as in the control lines of the experiment
inline constexpr double kCrossingSpeed = 0.25;                 ///< m/s, of the manoeuvres

/// Landmarks in order, and the arm by which each except the last is left.
struct RoutePlan {
  std::vector<CrossingId> crossings;
  std::vector<const Arm*> exits;
};

/// What must not be used.
struct Bans {
  std::vector<RoadId> roads;
  [[nodiscard]] bool holds(RoadId road) const;
};

/// A shortest way by length, from landmark to landmark (Dijkstra); nothing if there is none. Of equally short ones, always the same.
[[nodiscard]] std::optional<RoutePlan> shortest_way(const Labyrinth& labyrinth, CrossingId from, CrossingId to, const Bans& bans = {});

/// The time, in s, for `road_m` along a road and `crossing_m` through crossings at its ends, at the controllers' speeds without a halt.
[[nodiscard]] double time_for(const Road& road, double road_m, double crossing_m);

struct Extent { double length_m = 0.0, time_s = 0.0; };
/// The length of a way along the middle of its roads, from the middle of its first crossing to the goal's stop line, and the time that
/// it takes at the controllers' speeds without a halt. A robot that cuts bends may drive a few per cent less.
[[nodiscard]] Extent extent_of(const Labyrinth& labyrinth, const RoutePlan& way);

}  // namespace kb::sim::experiment
