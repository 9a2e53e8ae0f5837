#include "sim/drive/judge.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

// A robot that has been carried away cannot know it before it meets the next sign. So it counts as lost without knowing it only if it
// drives over a crossing that it takes for another, or drives on for longer than any road takes.
constexpr double kNotices = 20.0;     // s

/// How far out from the middle the stop lines of a crossing lie in the direction of `spot`.
double reach_of(const Labyrinth& labyrinth, const Crossing& crossing, Spot spot) {
  const double far_m = distance(crossing.at, spot);
  double reach_m = labyrinth.size * kLeastStop;
  for (const Arm& arm : crossing.arms) {
    const bool nearest = dot(spot - crossing.at, direction(arm.heading_rad)) > 0.7 * far_m;
    if (nearest) reach_m = std::max(reach_m, arm.stop_m);
  }
  return reach_m;
}

}  // namespace

bool is_at(const Labyrinth& labyrinth, CrossingId id, Spot spot) {
  return distance(labyrinth[id].at, spot) < labyrinth.size * (kAtLandmark - kLeastStop) + reach_of(labyrinth, labyrinth[id], spot);
}

Whereabouts locate(const Labyrinth& labyrinth, Spot spot) {
  Whereabouts best;
  best.aside_m = 1e9;
  double nearest_m = 1e9;
  for (std::size_t c = 0; c < labyrinth.crossings.size(); ++c) {
    const Crossing& crossing = labyrinth.crossings[c];
    const double far_m = distance(crossing.at, spot);
    if (far_m < reach_of(labyrinth, crossing, spot)) return {static_cast<CrossingId>(c), RoadId::kNone, 0.0, far_m};
  }
  for (std::size_t r = 0; r < labyrinth.roads.size(); ++r) {
    const Road& road = labyrinth.roads[r];
    const Along near = nearest_along(road.along, spot);
    const double inside_m = 0.5 * (road.width_m - labyrinth.size * kRoadWidth);   // a hall is wider than a road: a robot anywhere in it is on it
    const double outside_m = std::max(near.distance_m - inside_m, 0.0);
    if (outside_m >= nearest_m) continue;
    nearest_m = outside_m;
    best = {CrossingId::kNone, static_cast<RoadId>(r), near.along_m - road.begins_m, near.distance_m};
  }
  return best;
}

bool Summary::lost_unaware() const { return outcome == Outcome::kAstray || mistaken_crossings > 0 || unaware_s > kNotices; }

double Summary::impact_m_s() const {
  double most = 0.0;
  for (const auto* contacts : {&collisions, &standing_contacts}) {
    for (const Contact& contact : *contacts) most = std::max(most, contact.speed_m_s);
  }
  return most;
}

std::string describe(const Summary& summary) {
  using Outcome = Summary::Outcome;
  const std::string reports = fmt::format("{}", fmt::join(summary.reports, ", "));
  switch (summary.outcome) {
    case Outcome::kArrived: return "arrived at " + summary.landmark;
    case Outcome::kAstray: return "believes to be at " + summary.landmark + ", and is not";
    case Outcome::kAborted: return "aborted";
    case Outcome::kGivenUp: return "gave up on the way to " + summary.landmark;
    case Outcome::kStopped: return "stopped: " + reports;
    case Outcome::kStuck: return "stands without saying why" + (summary.running.empty() ? "" : ", while `" + summary.running + "` runs");
    case Outcome::kTimeUp: return reports.empty() ? "still driving when the time was up" : "still driving when the time was up: " + reports;
    case Outcome::kNeverStarted: return "never started";
  }
  return {};
}

void Judge::fault(Summary::Fault::Ban broken, std::string what) {
  if (summary.faults.empty() || summary.faults.back().what != what) summary.faults.push_back({broken, std::move(what)});
}

void Judge::enter(CrossingId crossing, const Floor& floor) {
  const Crossing& entered = labyrinth_[crossing];
  if (!floor.safe(crossing)) fault(Summary::Fault::Ban::kUnsafeCrossing, fmt::format("entered {}, which was not safe", entered.name));
  closed_.clear();
  for (const Arm& arm : entered.arms) {
    if (floor.closed(arm.road)) closed_.push_back(arm.road);
  }
  inside_ = crossing;
}

void Judge::follow_crossings(const Floor& floor) {
  if (where_.crossing != CrossingId::kNone) {
    if (inside_ != where_.crossing) enter(where_.crossing, floor);
    return;
  }
  if (inside_ == CrossingId::kNone || where_.road == RoadId::kNone) return;
  const Road& road = labyrinth_[where_.road];
  const bool begins = road.from == inside_, ends = road.to == inside_;
  const double behind_m = begins && !(ends && where_.along_m > 0.5 * (road.ends_m - road.begins_m)) ? where_.along_m : road.ends_m - road.begins_m - where_.along_m;
  if (!begins && !ends) {
    inside_ = CrossingId::kNone;
    return;
  }
  if (behind_m < 0.2 * labyrinth_.size) return;   // it may still turn back
  const std::string& exit = begins && behind_m == where_.along_m ? road.exit : road.approach;
  summary.way.push_back(fmt::format("{}.{}", labyrinth_[inside_].name, exit));
  const bool told = std::find(closed_.begin(), closed_.end(), where_.road) != closed_.end();
  if (told && floor.closed(where_.road)) fault(Summary::Fault::Ban::kClosedRoad, fmt::format("took the closed road {}", summary.way.back()));
  inside_ = CrossingId::kNone;
}

bool Judge::believes_rightly(const Leg& leg) const {
  const auto touches = [&](const std::string& landmark) {
    if (where_.crossing != CrossingId::kNone) return labyrinth_[where_.crossing].name == landmark;
    if (where_.road == RoadId::kNone || where_.aside_m > labyrinth_[where_.road].width_m) return false;
    const Road& road = labyrinth_[where_.road];
    return labyrinth_[road.from].name == landmark || labyrinth_[road.to].name == landmark;
  };
  return touches(leg.to) || (!leg.from.empty() && touches(leg.from));
}

void Judge::look(const Pose& pose, const Floor& floor, const Belief& belief, double dt_s) {
  const Spot spot{pose.x_m, pose.y_m};
  where_ = locate(labyrinth_, spot);
  if (looked_) summary.length_m += distance(last_, spot);
  last_ = spot;
  looked_ = true;
  ++summary.ticks;
  follow_crossings(floor);
  if (belief.place) {
    if (belief.driving && !belief.reports && distance(*belief.place, spot) > labyrinth_.size * kAtLandmark) summary.unaware_s += dt_s;
    return;
  }
  if (belief.leg != leg_) {
    leg_before_ = leg_;
    leg_ = belief.leg;
  }
  if (belief.leg == nullptr || belief.reports || !belief.driving) return;
  const bool right = believes_rightly(*belief.leg) || (leg_before_ != nullptr && believes_rightly(*leg_before_));
  if (!right) summary.unaware_s += dt_s;
  const bool enters = !right && where_.crossing != CrossingId::kNone && belief.strategy->doing == Doing::kCross;
  if (enters && where_.crossing != mistaken_) ++summary.mistaken_crossings;
  mistaken_ = enters ? where_.crossing : CrossingId::kNone;
}

void Judge::hit(const Hit& hit, double t_s, bool stood) {
  (stood ? summary.standing_contacts : summary.collisions).push_back({t_s, hit.what, hit.at, hit.speed_m_s});
}

void Judge::feel(const Arena& arena, double t_s, double dt_s) {
  if (arena.touching()) summary.touched_s += dt_s;
  if (arena.obstacles().empty()) return;
  const Pose pose = arena.pose();
  for (const Obstacle& obstacle : arena.obstacles()) {
    const double gap_m = std::max(distance(obstacle.at, {pose.x_m, pose.y_m}) - obstacle.radius_m - arena.radius_m(), 0.0);
    if (!summary.closest || gap_m < summary.closest->gap_m) summary.closest = {gap_m, t_s, obstacle.name};
  }
}

void Judge::carried(const Pose& pose) {
  where_ = {};
  last_ = {pose.x_m, pose.y_m};
  inside_ = CrossingId::kNone;
}

}  // namespace kb::sim
