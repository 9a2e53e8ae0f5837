#include "sim/mind/small_memories.h"

#include <utility>

namespace kb::sim {
namespace {

void shrink(Spot& spot, double size) { spot = {spot.x_m / size, spot.y_m / size}; }

}  // namespace

const TagHeard& SmallMemories::of(const TagHeard& tag) {
  if (size_ == 1.0) return tag;
  heard_.alive = tag.alive;
  heard_.arm = tag.arm;
  if (tag.memory != nullptr && tag.memory != read_) {
    read_ = tag.memory;
    small_ = smaller(*read_);
  }
  heard_.memory = tag.memory != nullptr ? small_ : nullptr;
  return heard_;
}

std::shared_ptr<const Memory> SmallMemories::smaller(const Memory& memory) {
  auto small = std::make_shared<Memory>(memory);
  for (Memory::Exit& exit : small->exits) {
    exit.stop_m /= size_;
    for (Spot& spot : exit.course) shrink(spot, size_);
    shrink(exit.hall_begins, size_);
    if (exit.hall != nullptr) exit.hall = smaller(exit.hall);
  }
  return small;
}

std::shared_ptr<const HallMap> SmallMemories::smaller(const std::shared_ptr<const HallMap>& hall) {
  auto& known = halls_[hall];
  if (known != nullptr) return known;
  auto small = std::make_shared<HallMap>(*hall);
  for (Spot& spot : small->along) shrink(spot, size_);
  for (double* length_m : {&small->width_m, &small->door_m}) *length_m /= size_;
  for (Picture::Wall& wall : small->walls) {
    shrink(wall.from, size_);
    shrink(wall.to, size_);
  }
  for (Pillar& pillar : small->pillars) {
    shrink(pillar.at, size_);
    pillar.radius_m /= size_;
  }
  known = std::move(small);
  return known;
}

}  // namespace kb::sim
