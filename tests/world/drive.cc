#include "tests/world/drive.h"

#include <fmt/format.h>

#include <algorithm>

namespace kb::world {
namespace {

constexpr double kAvoidFactor = 0.4;          // round an obstacle it drives slower
constexpr double kTouch_m = 0.02;
constexpr double kBesideObstacle_m = 0.3;
constexpr std::int64_t kRoundMs = 3000;
constexpr double kPatienceOffTrackS = 1.0;
constexpr double kExitRun_m = 0.3;            // a manoeuvre may still run so far on the road of exit

void turn_round(World& world, std::int64_t dt_ms) {
  world.turning_ms += dt_ms;
  if (world.turning_ms < kRoundMs) return;
  world.turning_ms = 0;
  world.turned = true;
  const OnRoad* here = world.on_road();
  const auto back = here ? world.map[here->edge].back : std::nullopt;
  if (!back) return world.fault("turned round where it cannot");
  world.put(*back, world.map.road(*back).length_m - here->s_m);
}

/// Whether something stands in the way of the next `step_m` that the action does not get round.
bool held_up(World& world, Action action, double step_m) {
  for (const Obstacle& obstacle : world.obstacles_here()) {
    const double gap = world.place_of(obstacle) - world.position_m();
    if (gap < 0.0 || gap > step_m + kTouch_m) continue;
    const bool avoids = action.kind == Action::Kind::kAvoid;
    if (avoids && obstacle.passable) continue;
    if (!avoids) world.fault("drove into an obstacle");
    return true;
  }
  return false;
}

void enter_crossing(World& world, OnRoad here, Action action, double step_m) {
  const Edge& edge = world.map[here.edge];
  const Landmark& landmark = world.map[edge.to];
  const Direction exit = exit_after(edge.approach, action.turn);
  const auto out = world.map.leaving(edge.to, exit);
  if (!out) return world.fault(fmt::format("crossed {} to {}, where there is no road", landmark.name, name(exit)));
  if (!landmark.cross_by.contains(action.method)) {
    world.fault(fmt::format("crossed {} by {}", landmark.name, name(action.method)));
  }
  if (!landmark.safe) world.fault(fmt::format("entered {}, which was not safe", landmark.name));
  if (world.map.road(*out).closed) world.fault(fmt::format("took the closed road {}.{}", landmark.name, name(exit)));
  world.way.push_back({edge.to, exit});
  world.pose = InCrossing{edge.to, edge.approach, step_m, out};
}

void drive_road(World& world, OnRoad here, Action action, double step_m, std::int64_t dt_ms) {
  const Road& road = world.map.road(here.edge);
  if (action.kind == Action::Kind::kCross) {
    if (here.s_m >= road.length_m - kLineWidth) return enter_crossing(world, here, action, step_m);
    if (here.s_m > kExitRun_m) world.fault("a manoeuvre on the road");
    return world.put(here.edge, here.s_m + step_m);
  }
  if (action.kind == Action::Kind::kMove) {
    const bool tracked = road.tracks.contains(action.method);
    world.off_track_s = tracked ? 0.0 : world.off_track_s + static_cast<double>(dt_ms) / 1000.0;
    if (world.off_track_s > kPatienceOffTrackS) {
      world.fault(fmt::format("drove by {} where it cannot be followed", name(action.method)));
    }
  }
  const double end_m = road.length_m + 0.1;
  if (here.s_m + step_m > end_m) {
    world.fault(fmt::format("over the stop line of {} without a manoeuvre", world.map[world.map[here.edge].to].name));
  }
  world.put(here.edge, std::min(here.s_m + step_m, end_m));
}

void drive_crossing(World& world, InCrossing here, Action action, double step_m) {
  if (action.kind == Action::Kind::kMove && here.p_m < kCrossingLength - kLineWidth) {
    world.fault(fmt::format("drove as on a road inside the crossing {}", world.map[here.landmark].name));
  }
  here.p_m += step_m;
  world.pose = here;
  if (here.p_m < kCrossingLength) return;
  if (!here.exit) return world.fault("left a crossing where there is no road");
  world.put(*here.exit, here.p_m - kCrossingLength);
}

}  // namespace

Action action_of(std::string_view strategy) {
  if (strategy == "Avoid") return {Action::Kind::kAvoid};
  if (strategy == "Round") return {Action::Kind::kRound};
  if (strategy.starts_with("Move.")) {
    if (const auto method = find<Method>(kMethodNames, strategy.substr(5))) {
      return {Action::Kind::kMove, Turn::kForward, *method};
    }
  }
  const std::size_t comma = strategy.find(',');
  if (strategy.starts_with("Cross[") && comma != std::string_view::npos) {
    const auto turn = find<Turn>(kTurnNames, strategy.substr(6, comma - 6));
    const auto method = find<Method>(kMethodNames, strategy.substr(comma + 1, strategy.size() - comma - 2));
    if (turn && method) return {Action::Kind::kCross, *turn, *method};
  }
  return {};
}

void drive(World& world, Action action, std::int64_t dt_ms) {
  world.time_ms += dt_ms;
  world.turned = false;
  if (action.kind == Action::Kind::kStand) return;
  if (action.kind == Action::Kind::kRound) return turn_round(world, dt_ms);
  const bool avoids = action.kind == Action::Kind::kAvoid;
  const double step_m = kSpeedMps * static_cast<double>(dt_ms) / 1000.0 * (avoids ? kAvoidFactor : 1.0);
  if (!world.on_road()) {
    world.aside = false;
  } else if (avoids) {
    world.aside = world.obstacle_within(kBesideObstacle_m, false);
  } else if (world.aside && action.kind == Action::Kind::kMove) {
    world.fault("drove on beside the track");
  }
  if (held_up(world, action, step_m)) return;
  if (const OnRoad* road = world.on_road()) {
    drive_road(world, *road, action, step_m, dt_ms);
  } else {
    drive_crossing(world, *world.in_crossing(), action, step_m);
  }
}

}  // namespace kb::world
