#include "tests/world/world.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace kb::world {

bool World::comes_from(std::string_view landmark) const {
  return on_road() && map[map[on_road()->edge].from].name == landmark;
}

bool World::heads_for(std::string_view landmark) const {
  return on_road() && map[map[on_road()->edge].to].name == landmark;
}

bool World::inside(std::string_view landmark) const {
  return in_crossing() && map[in_crossing()->landmark].name == landmark;
}

double World::position_m() const { return on_road() ? on_road()->s_m : in_crossing()->p_m; }

double World::to_end_m() const {
  return on_road() ? map.road(on_road()->edge).length_m - on_road()->s_m : std::numeric_limits<double>::infinity();
}

const std::vector<Obstacle>& World::obstacles_here() const {
  return on_road() ? map.road(on_road()->edge).obstacles : map[in_crossing()->landmark].obstacles;
}

double World::place_of(const Obstacle& obstacle) const {
  if (!on_road() || !obstacle.seen_from || *obstacle.seen_from == on_road()->edge) return obstacle.at_m;
  return map.road(on_road()->edge).length_m - obstacle.at_m;
}

bool World::obstacle_within(double range_m, bool ahead_only) const {
  for (const Obstacle& obstacle : obstacles_here()) {
    const double gap = place_of(obstacle) - position_m();
    if (ahead_only ? (gap >= 0.0 && gap < range_m) : std::abs(gap) < range_m) return true;
  }
  return false;
}

void World::put_in_crossing(LandmarkId landmark, Direction arm, Turn turn, double p_m) {
  pose = InCrossing{landmark, arm, p_m, map.leaving(landmark, exit_after(arm, turn))};
}

void World::fault(std::string what) {
  if (faults.empty() || faults.back().what != what) faults.push_back({time_ms, std::move(what)});
}

std::string World::way_text() const {
  std::string text;
  for (const Crossed& crossed : way) {
    if (!text.empty()) text += ' ';
    text += fmt::format("{}.{}", map[crossed.landmark].name, name(crossed.exit));
  }
  return text;
}

std::string World::where() const {
  if (const InCrossing* in = in_crossing()) return fmt::format("in {} {:.2f}", map[in->landmark].name, in->p_m);
  const Edge& edge = map[on_road()->edge];
  return fmt::format("{}.{}@{:.2f}", map[edge.from].name, name(edge.exit), on_road()->s_m);
}

}  // namespace kb::world
