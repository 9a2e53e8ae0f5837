#include "sim/mind/hall_host.h"

#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

void shrink(Spot& spot, double size) { spot = {spot.x_m / size, spot.y_m / size}; }

/// The map as a robot of size 1 would have it.
std::shared_ptr<const HallMap> smaller(const HallMap& hall, double size) {
  auto small = std::make_shared<HallMap>(hall);
  for (Spot& spot : small->along) shrink(spot, size);
  for (double* length_m : {&small->width_m, &small->door_m}) *length_m /= size;
  for (Picture::Wall& wall : small->walls) {
    shrink(wall.from, size);
    shrink(wall.to, size);
  }
  for (Pillar& pillar : small->pillars) {
    shrink(pillar.at, size);
    pillar.radius_m /= size;
  }
  return small;
}

}  // namespace

HallHost::HallHost(const Knowledge& knowledge, const Labyrinth& labyrinth, const MapRoads& roads, const mts::Pilot& pilot)
    : labyrinth_(labyrinth), roads_(roads), pilot_(pilot) {
  using Id = mts::ControllerId;
  for (const Strategy& strategy : knowledge.strategies) {
    const Id id = strategy.controller;
    auto& planner = planners_.emplace_back();
    auto& rules = rules_.emplace_back();
    if (id == Id::kNeuralMap || id == Id::kGenetic) planner = std::make_unique<HallPlanner>(id == Id::kGenetic ? HallPlanner::Method::kGenetic : HallPlanner::Method::kNeuralMap);
    if (id == Id::kFollowRules) rules = std::make_unique<HallRules>(knowledge.program->fuzzy[strategy.control->fuzzy], *strategy.control);
  }
}

void HallHost::choose(int strategy) {
  if (strategy < 0) return;
  const auto i = static_cast<std::size_t>(strategy);
  if (planners_[i] != nullptr) planner_ = planners_[i].get();
  if (rules_[i] != nullptr) rule_ = rules_[i].get();
  enters_ = enters_ || planners_[i] != nullptr;
}

mts::Host HallHost::host() {
  mts::Host host;
  host.self = this;
  host.look = [](void* self, const mts::WayQuestion& question, mts::Way& way) { return static_cast<HallHost*>(self)->look(question, way); };
  host.decide = [](void* self, const mts::RulesInput& input) { return static_cast<HallHost*>(self)->rule_->decide(input); };
  return host;
}

mts::WayNews HallHost::look(const mts::WayQuestion& question, mts::Way& way) {
  if (enters_) enter(*planner_);
  enters_ = false;
  return planner_->look(question, way);
}

void HallHost::enter(HallPlanner& planner) {
  const mts::MapRoad* const road = pilot_.place().road();
  if (road == nullptr) return planner.enter(nullptr, {});
  if (maps_.empty()) {
    maps_ = maps_of_halls(labyrinth_);
    for (auto& map : maps_) {
      if (map != nullptr) map = smaller(*map, labyrinth_.size);
    }
  }
  const Labyrinth::End& end = roads_.end_of(*road);
  Spot begins = labyrinth_.course(*end.arm).front();
  shrink(begins, labyrinth_.size);
  planner.enter(maps_[at(end.arm->road)], begins);
}

}  // namespace kb::sim
