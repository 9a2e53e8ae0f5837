// A drive as a recording.
#include <algorithm>

#include "compiler/program/tick.h"
#include "sim/drive/drive.h"
#include "sim/world/geometry.h"

namespace kb::sim {

void Drive::begin_recording() {
  Recording& recording = *options_.recording;
  const program::Program& program = *knowledge_.program;
  recording.title = scenario_.title;
  recording.picture = picture_of(labyrinth_, kRobotRadius);
  using Kind = MindNames::Cell::Kind;
  for (const program::Cell& cell : program.cells) {
    const Kind kind = cell.kind == program::CellKind::kFact ? Kind::kFact : cell.kind == program::CellKind::kSatellite ? Kind::kSatellite : Kind::kStrategy;
    recording.names.cells.push_back({cell.name, kind, cell.initial});
    recorded_.push_back(cell.initial);
  }
  for (const program::Rule& rule : program.rules) recording.names.rules.push_back({rule.name, program.levels[rule.level], rule.at});
  recording.names.levels = program.levels;
}

void Drive::record(const program::Tick& tick, const Judge::Belief& belief) {
  Frame frame;
  frame.t_s = time_s();
  frame.pose = arena_.pose();
  frame.senses = senses_;
  const auto change = [&](std::size_t cell, float value) {
    if (recorded_[cell] == value) return;
    recorded_[cell] = value;
    frame.changed.push_back({static_cast<std::uint32_t>(cell), value});
  };
  const std::size_t first_strategy = recorded_.size() - knowledge_.program->strategies;
  for (std::size_t f = 0; f < mind_.facts().size(); ++f) change(f, mind_.facts()[f]);
  for (const program::CellValue& set : tick.set) change(program::index(set.cell), set.value);
  for (std::size_t s = first_strategy; s < recorded_.size(); ++s) change(s, mind_.value(static_cast<program::CellId>(s)));
  const auto copy = [](const auto& from, std::vector<std::uint32_t>& to) {
    for (const auto id : from) to.push_back(static_cast<std::uint32_t>(id));
  };
  copy(tick.events, frame.events);
  copy(tick.lost, frame.lost);
  copy(tick.fired, frame.fired);
  if (belief.strategy != nullptr) frame.strategy = static_cast<std::int32_t>(program::index(belief.strategy->cell));
  frame.status = !powered_ ? "off" : waits_ ? "waits" : program::status_text(tick.status);
  if (belief.leg != nullptr) frame.leg = belief.leg->name;
  frame.notes = std::move(notes_);
  notes_.clear();
  options_.recording->frames.push_back(std::move(frame));
  record_things();
}

/// What stands on the floor now, beside what stood there a frame ago.
void Drive::record_things() {
  std::vector<Thing> now;
  for (const Obstacle& obstacle : arena_.obstacles()) {
    const Spot half{obstacle.radius_m, obstacle.radius_m};
    now.push_back({Thing::Kind::kObstacle, obstacle.name, obstacle.at - half, obstacle.at + half});
  }
  for (std::size_t r = 0; r < labyrinth_.roads.size(); ++r) {
    const Road& road = labyrinth_.roads[r];
    if (!floor_.closed(static_cast<RoadId>(r))) continue;
    const auto part = part_of(road.along, road.begins_m, road.ends_m);
    now.push_back({Thing::Kind::kClosedRoad, road.name, part.front(), part.back()});
  }
  for (std::size_t c = 0; c < labyrinth_.crossings.size(); ++c) {
    const Crossing& crossing = labyrinth_.crossings[c];
    const Spot half{kLeastStop, kLeastStop};
    if (!floor_.safe(static_cast<CrossingId>(c))) now.push_back({Thing::Kind::kUnsafeCrossing, crossing.name, crossing.at - half, crossing.at + half});
  }
  for (const Floor::Worn& worn : floor_.worn()) {
    const Road& road = labyrinth_[worn.road];
    now.push_back({Thing::Kind::kLostMarking, road.name, point_on(road.along, road.begins_m + worn.from_m).at, point_on(road.along, road.begins_m + worn.to_m).at});
  }
  auto& stays = options_.recording->stays;
  const auto frames = static_cast<std::uint32_t>(options_.recording->frames.size());
  const auto same = [](Spot a, Spot b) { return a.x_m == b.x_m && a.y_m == b.y_m; };
  for (const Thing& thing : now) {
    const auto lasting = std::find_if(stays.begin(), stays.end(), [&](const Recording::Stay& stay) {
      return stay.last + 1 == frames && stay.thing.kind == thing.kind && stay.thing.name == thing.name && same(stay.thing.from, thing.from) &&
             same(stay.thing.to, thing.to);
    });
    if (lasting != stays.end()) lasting->last = frames;
    else stays.push_back({thing, frames - 1, frames});
  }
}

}  // namespace kb::sim
