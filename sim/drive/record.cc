// A drive as a recording.
#include <fmt/format.h>

#include <algorithm>

#include "compiler/program/tick.h"
#include "sim/drive/drive.h"
#include "sim/mind/control_words.h"
#include "sim/world/geometry.h"

namespace kb::sim {

namespace {

std::uint32_t number(auto id) { return static_cast<std::uint32_t>(id); }

std::vector<std::uint32_t> numbers(const auto& ids) {
  std::vector<std::uint32_t> out;
  for (const auto id : ids) out.push_back(number(id));
  return out;
}

MindNames::Cell cell_of(const program::Cell& cell) {
  MindNames::Cell out;
  out.name = cell.name;
  out.kind = static_cast<MindNames::Cell::Kind>(cell.kind);   // both list the kinds in the same order
  out.initial = cell.initial;
  out.command = cell.command;
  out.keep = cell.keep;
  out.satellites = numbers(cell.satellites);
  const program::Thresholds thresholds = program::thresholds(cell);
  out.plain = thresholds.plain;
  out.attended = thresholds.attended;
  return out;
}

MindNames::Rule rule_of(const program::Program& program, const program::Rule& rule) {
  MindNames::Rule out;
  out.name = rule.name;
  out.level = program.levels[rule.level];
  out.at = program.at(rule);
  if (rule.condition != program::CondId::kNone) out.condition = static_cast<std::int32_t>(rule.condition);
  for (const program::Write& write : rule.writes) out.writes.push_back({number(write.cell), write.value});
  out.clears.assign(rule.clears.begin(), rule.clears.end());
  out.reset = rule.reset;
  out.each_tick = rule.mode == program::Mode::kWhile;
  return out;
}

/// A control line as it was written: `follow_line(speed: 0.4 m/s)`.
std::string control_text(const program::Control& control) {
  std::string arguments;
  for (const auto& argument : control.arguments) arguments += fmt::format("{}{}: {}", arguments.empty() ? "" : ", ", argument.name, value_text(argument));
  return fmt::format("{}({})", control.controller, arguments);
}

MindNames names_of(const program::Program& program) {
  MindNames names;
  for (const program::Cell& cell : program.cells) names.cells.push_back(cell_of(cell));
  for (const program::Control& control : program.controls) names.cells[program::index(control.strategy)].control = control_text(control);
  for (const program::Rule& rule : program.rules) names.rules.push_back(rule_of(program, rule));
  for (const program::Cond& cond : program.conds) {
    names.conditions.push_back({static_cast<MindNames::Condition::Op>(cond.op), static_cast<MindNames::Condition::Term>(cond.term),
                                number(cond.cell), static_cast<double>(cond.duration_us) / 1e6, numbers(cond.children)});
  }
  for (const auto& group : program.exclusive) names.exclusive.push_back(numbers(group));
  names.levels = program.levels;
  names.firing = static_cast<float>(program.settings.firing);
  return names;
}

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
  for (const MindNames::Cell& cell : recording.names.cells) recorded_.push_back(cell.initial);
  for (const Leg& leg : knowledge_.legs) {
    recording.legs.push_back({leg.name, leg.from, leg.to, road_between(labyrinth_, leg), leg.detour});
  }
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
  const std::size_t first_strategy = recorded_.size() - knowledge_.program->strategies, cells_before = knowledge_.program->cells.size() - recorded_.size();
  if (belief.strategy != nullptr) frame.strategy = static_cast<std::int32_t>(program::index(belief.strategy->cell) - cells_before);
  if (options_.helm != nullptr) {
    for (std::size_t s = 0; s < recorded_.size(); ++s) change(s, static_cast<std::int32_t>(s) == frame.strategy ? 1.0f : -1.0f);
  } else {
    for (std::size_t f = 0; f < driver_.mind().facts().size(); ++f) change(f, driver_.mind().facts()[f]);
    for (const program::CellValue& set : tick.set) change(program::index(set.cell), set.value);
    for (std::size_t s = first_strategy; s < recorded_.size(); ++s) change(s, driver_.mind().value(static_cast<program::CellId>(s)));
  }
  frame.events = numbers(tick.events);
  frame.lost = numbers(tick.lost);
  frame.fired = numbers(tick.fired);
  frame.status = !powered_ ? "off" : waits_ ? "waits" : options_.helm == nullptr ? program::status_text(tick.status) : options_.helm->gone() ? "gone" : "";
  if (belief.leg != nullptr) frame.leg = belief.leg->name;
  frame.notes = std::move(notes_);
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
