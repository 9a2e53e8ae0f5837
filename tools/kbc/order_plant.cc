#include "tools/kbc/order_plant.h"

#include <algorithm>
#include <cmath>

#include "compiler/syntax/syntax.h"
#include "sim/world/geometry.h"

namespace kb::cli {
namespace {

constexpr double kBeside_m = 0.35;      // how far beside the middle of a road, for a robot of size 1
constexpr double kFacesAlong = 0.7;     // cosine

}  // namespace

RoadPlant::RoadPlant(const sim::Labyrinth& labyrinth, std::string map_id, bool turns, std::string prefix)
    : labyrinth_(labyrinth), map_id_(std::move(map_id)), prefix_(std::move(prefix)), turns_(turns) {}

sim::CrossingId RoadPlant::crossing_of(std::string_view node) const {
  const std::string plain(node), worded = syntax::worded(plain);
  for (const std::string& name : {plain, worded, prefix_ + worded}) {
    if (const sim::CrossingId found = labyrinth_.crossing(name); found != sim::CrossingId::kNone) return found;
  }
  return sim::CrossingId::kNone;
}

std::optional<std::string> RoadPlant::landmark_of(std::string_view node) const {
  const sim::CrossingId crossing = crossing_of(node);
  return crossing == sim::CrossingId::kNone ? std::nullopt : std::optional(labyrinth_[crossing].name);
}

std::optional<std::string> RoadPlant::node_at(std::string_view landmark) const {
  return labyrinth_.crossing(landmark) != sim::CrossingId::kNone ? std::optional<std::string>(landmark) : std::nullopt;
}

std::optional<vda5050::Pose> RoadPlant::place_of(std::string_view node) const {
  const sim::CrossingId crossing = crossing_of(node);
  if (crossing == sim::CrossingId::kNone) return std::nullopt;
  return vda5050::Pose{labyrinth_[crossing].at.x_m / labyrinth_.scale, labyrinth_[crossing].at.y_m / labyrinth_.scale, 0.0};
}

std::vector<const sim::Arm*> RoadPlant::arms_to(sim::CrossingId from, sim::CrossingId to) const {
  std::vector<const sim::Arm*> arms;
  for (const sim::Arm& arm : labyrinth_[from].arms) {
    const sim::Road& road = labyrinth_[arm.road];
    if (arm.leads_out && (arm.forward ? road.to : road.from) == to) arms.push_back(&arm);
  }
  return arms;
}

std::optional<std::vector<vda5050::Visit>> RoadPlant::way(std::string_view edge, std::string_view from, std::string_view to) const {
  const sim::CrossingId begin = crossing_of(from), end = crossing_of(to);
  if (begin == sim::CrossingId::kNone || end == sim::CrossingId::kNone) return std::nullopt;
  const std::string& name = labyrinth_[begin].name;
  const std::vector<const sim::Arm*> arms = arms_to(begin, end);
  const auto named = std::find_if(arms.begin(), arms.end(), [&](const sim::Arm* arm) { return edge == name + "." + arm->name || edge == labyrinth_[arm->road].name; });
  if (named == arms.end() && arms.size() != 1) return std::nullopt;
  return std::vector{vda5050::Visit{name, named != arms.end() ? (*named)->name : arms.front()->name}};
}

bool RoadPlant::leads(const vda5050::Visit& from, std::string_view to) const {
  const sim::CrossingId begin = labyrinth_.crossing(from.landmark), end = labyrinth_.crossing(to);
  if (begin == sim::CrossingId::kNone || end == sim::CrossingId::kNone) return false;
  const std::vector<const sim::Arm*> arms = arms_to(begin, end);
  return std::any_of(arms.begin(), arms.end(), [&](const sim::Arm* arm) { return arm->name == from.exit; });
}

std::optional<vda5050::Pose> RoadPlant::pose(const vda5050::Whereabouts& where) const {
  const sim::CrossingId begin = labyrinth_.crossing(where.road.landmark);
  if (begin == sim::CrossingId::kNone) return std::nullopt;
  const sim::Crossing& crossing = labyrinth_[begin];
  const sim::Arm* arm = crossing.arm(where.road.exit);
  const double scale = labyrinth_.scale;
  if (arm == nullptr) return vda5050::Pose{crossing.at.x_m / scale, crossing.at.y_m / scale, 0.0};
  std::vector<sim::Spot> along = labyrinth_[arm->road].along;
  if (!arm->forward) std::reverse(along.begin(), along.end());
  const auto at = sim::point_on(along, std::clamp(where.along_m, 0.0, sim::length_of(along)));
  return vda5050::Pose{at.at.x_m / scale, at.at.y_m / scale, where.outwards ? at.heading_rad : sim::wrap(at.heading_rad + sim::kPi)};
}

std::optional<vda5050::Standing> RoadPlant::standing_at(const vda5050::Pose& pose) const {
  const sim::Spot spot{pose.x_m * labyrinth_.scale, pose.y_m * labyrinth_.scale};
  std::optional<vda5050::Standing> best;
  double best_m = kBeside_m * labyrinth_.size;
  for (const sim::Road& road : labyrinth_.roads) {
    const sim::Along at = sim::nearest_along(road.along, spot);
    if (at.distance_m > best_m || at.along_m < road.begins_m || at.along_m > road.ends_m) continue;
    const double cosine = std::cos(pose.theta_rad - sim::point_on(road.along, at.along_m).heading_rad);
    const bool forward = cosine > 0.0;
    const sim::Crossing &from = labyrinth_[forward ? road.from : road.to], &to = labyrinth_[forward ? road.to : road.from];
    const sim::Arm* arm = from.arm(forward ? road.exit : road.approach);
    if (std::abs(cosine) < kFacesAlong || arm == nullptr || !arm->leads_out) continue;
    best_m = at.distance_m;
    best = vda5050::Standing{{{from.name, arm->name}, forward ? at.along_m : sim::length_of(road.along) - at.along_m}, to.name};
  }
  return best;
}

bool RoadPlant::leads_back(const vda5050::Visit& road) const {
  const sim::CrossingId begin = labyrinth_.crossing(road.landmark);
  const sim::Arm* arm = begin == sim::CrossingId::kNone ? nullptr : labyrinth_[begin].arm(road.exit);
  if (arm == nullptr || !turns_) return false;
  const sim::Road& both = labyrinth_[arm->road];
  const sim::Arm* other = arm->forward ? labyrinth_[both.to].arm(both.approach) : labyrinth_[both.from].arm(both.exit);
  return other != nullptr && other->leads_out;
}

}  // namespace kb::cli
