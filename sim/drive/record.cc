// A drive as a recording.
#include <algorithm>

#include "compiler/program/tick.h"
#include "sim/drive/drive.h"
#include "sim/drive/mind_names.h"
#include "sim/world/geometry.h"

namespace kb::sim {

namespace {

/// The names for a drive by a helm: only the strategies, since nothing is known of a helm's mind but the strategy that it says it drives by.
MindNames strategies_of(const program::Program& program) {
  MindNames all = names_of(program), names;
  names.cells.assign(all.cells.end() - program.strategies, all.cells.end());
  for (MindNames::Cell& cell : names.cells) cell.satellites.clear();
  return names;
}

/// The road of the picture that leads from one landmark to another, -1 if there is none.
std::int32_t road_between(const Labyrinth& labyrinth, const Leg& leg) {
  for (std::size_t r = 0; r < labyrinth.roads.size(); ++r) {
    const std::string& from = labyrinth[labyrinth.roads[r].from].name;
    const std::string& to = labyrinth[labyrinth.roads[r].to].name;
    if ((from == leg.from && to == leg.to) || (from == leg.to && to == leg.from)) return static_cast<std::int32_t>(r);
  }
  return -1;
}

}  // namespace

void Drive::begin_recording() {
  Recording& recording = *options_.recording;
  if (!scenario_.title.empty()) recording.title = scenario_.title;
  recording.picture = picture_of(labyrinth_, arena_.radius_m());
  recording.names = options_.helm != nullptr ? strategies_of(*knowledge_.program) : names_of(*knowledge_.program);
  recorded_ = CellChanges(recording.names);
  for (const Leg& leg : knowledge_.legs) {
    recording.legs.push_back({leg.name, leg.from, leg.to, road_between(labyrinth_, leg), leg.detour});
  }
}

void Drive::record(const program::Tick& tick, const Judge::Belief& belief) {
  Frame frame;
  frame.t_s = time_s();
  frame.pose = arena_.pose();
  frame.senses = senses_;
  const auto change = [&](std::size_t cell, float value) { recorded_.put(cell, value, frame); };
  const std::size_t cells = recorded_.cells(), first_strategy = cells - knowledge_.program->strategies, cells_before = knowledge_.program->cells.size() - cells;
  if (belief.strategy != nullptr) frame.strategy = static_cast<std::int32_t>(program::index(belief.strategy->cell) - cells_before);
  if (options_.helm != nullptr) {
    for (std::size_t s = 0; s < cells; ++s) change(s, static_cast<std::int32_t>(s) == frame.strategy ? 1.0f : -1.0f);
  } else {
    for (std::size_t f = 0; f < driver_.mind().facts().size(); ++f) change(f, driver_.mind().facts()[f]);
    for (const program::CellValue& set : tick.set) change(program::index(set.cell), set.value);
    for (std::size_t s = first_strategy; s < cells; ++s) change(s, driver_.mind().value(static_cast<program::CellId>(s)));
  }
  tell(tick, *knowledge_.program, frame);
  frame.status = !powered_ ? "off" : waits_ ? "waits" : options_.helm == nullptr ? program::status_text(tick.status) : options_.helm->gone() ? "gone" : "";
  if (belief.leg != nullptr) frame.leg = belief.leg->name;
  frame.notes.insert(frame.notes.end(), notes_.begin(), notes_.end());
  notes_.clear();
  options_.recording->frames.push_back(std::move(frame));
  record_things();
}

/// Records what stands on the floor now: a thing that stood there unchanged a frame ago stays longer, any other begins a stay.
void Drive::record_things() {
  std::vector<Thing> now;
  for (const Obstacle& obstacle : arena_.obstacles()) {
    const Spot half{obstacle.radius_m, obstacle.radius_m};
    now.push_back({Thing::Kind::kObstacle, obstacle.name, obstacle.at - half, obstacle.at + half});
  }
  for (std::size_t r = 0; r < labyrinth_.roads.size(); ++r) {
    const Road& road = labyrinth_.roads[r];
    if (!floor_.closed(static_cast<RoadId>(r))) continue;
    const auto part = road.between_stop_lines();
    now.push_back({Thing::Kind::kClosedRoad, road.name, part.front(), part.back()});
  }
  for (std::size_t c = 0; c < labyrinth_.crossings.size(); ++c) {
    const Crossing& crossing = labyrinth_.crossings[c];
    const double half_m = labyrinth_.size * kLeastStop;
    const Spot half{half_m, half_m};
    if (!floor_.safe(static_cast<CrossingId>(c))) now.push_back({Thing::Kind::kUnsafeCrossing, crossing.name, crossing.at - half, crossing.at + half});
  }
  for (const Floor::Worn& worn : floor_.worn()) {
    const Road& road = labyrinth_[worn.road];
    now.push_back({Thing::Kind::kLostMarking, road.name, point_on(road.along, road.begins_m + worn.from_m).at, point_on(road.along, road.begins_m + worn.to_m).at});
  }
  auto& stays = options_.recording->stays;
  const auto frames = static_cast<std::uint32_t>(options_.recording->frames.size());
  const auto same = [](Spot a, Spot b) { return a.x_m == b.x_m && a.y_m == b.y_m; };
  std::vector<std::size_t> standing;
  for (const Thing& thing : now) {
    const auto lasting = std::find_if(standing_.begin(), standing_.end(), [&](std::size_t s) {
      const Recording::Stay& stay = stays[s];
      return stay.last + 1 == frames && stay.thing.kind == thing.kind && stay.thing.name == thing.name && same(stay.thing.from, thing.from) &&
             same(stay.thing.to, thing.to);
    });
    standing.push_back(lasting != standing_.end() ? *lasting : stays.size());
    if (lasting != standing_.end()) stays[*lasting].last = frames;
    else stays.push_back({thing, frames - 1, frames});
  }
  standing_ = std::move(standing);
}

}  // namespace kb::sim
