#include "tools/kbc/trace/diff_inputs.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <unordered_map>

namespace kb::trace {
namespace {

using program::CellId;
using program::Perception;
using program::Program;
using program::Sensor;

/// The place of each fact, by name.
using Places = std::unordered_map<std::string_view, std::size_t>;

Places facts_of(const Program& program) {
  Places places;
  for (std::size_t f = 0; f < program.facts; ++f) places.emplace(program.cells[f].name, f);
  return places;
}

/// Works for const and other vectors of sensors.
auto find_sensor(auto& sensors, std::string_view name) {
  return std::find_if(sensors.begin(), sensors.end(), [&](const Sensor& s) { return s.name == name; });
}

/// Facts of a knowledge base that it does not perceive.
std::set<std::string_view> given_in(const Program& program) {
  std::set<std::string_view> given;
  for (std::size_t f = 0; f < program.facts; ++f) given.insert(program.cells[f].name);
  for (const program::Perceived& perceived : program.perception.perceived) given.erase(program[perceived.fact].name);
  return given;
}

void add_sensors(const Perception& from, Perception& all) {
  for (const Sensor& sensor : from.sensors) {
    const auto there = find_sensor(all.sensors, sensor.name);
    if (there == all.sensors.end()) {
      all.sensors.push_back(sensor);
      continue;
    }
    there->count = std::max(there->count, sensor.count);
    for (const std::string& text : sensor.texts) {
      if (std::find(there->texts.begin(), there->texts.end(), text) == there->texts.end()) there->texts.push_back(text);
    }
  }
  std::uint32_t first = 0;
  for (Sensor& sensor : all.sensors) {
    std::sort(sensor.texts.begin(), sensor.texts.end());
    sensor.first = first;
    first += sensor.count;
  }
}

/// The number in `all` of a reading of `from`.
std::uint32_t place_of(std::uint32_t reading, const Perception& from, const Perception& all) {
  const Sensor& sensor = from.sensor_of(reading);
  return find_sensor(all.sensors, sensor.name)->first + (reading - sensor.first);
}

/// `places`: of the facts of `all`.
void add_perceived(const Program& from, const std::set<std::string_view>& given, const Places& places, Program& all) {
  Perception& to = all.perception;
  const std::size_t prototypes = to.prototypes.size(), percepts = to.percepts.size();
  const auto moved = [&](program::PerceptId id) { return static_cast<program::PerceptId>(static_cast<std::size_t>(id) + percepts); };
  to.prototypes.insert(to.prototypes.end(), from.perception.prototypes.begin(), from.perception.prototypes.end());
  for (program::Percept percept : from.perception.percepts) {
    using Op = program::Percept::Op;
    if (percept.op == Op::kFits || percept.op == Op::kReads) percept.reading = place_of(percept.reading, from.perception, to);
    if (percept.op == Op::kFits) percept.prototype += static_cast<std::uint32_t>(prototypes);
    if (percept.op == Op::kFact) percept.cell = CellId{static_cast<std::uint32_t>(places.at(from[percept.cell].name))};
    for (program::PerceptId& child : percept.children) child = moved(child);
    to.percepts.push_back(std::move(percept));
  }
  std::set<CellId> there;
  for (const program::Perceived& perceived : to.perceived) there.insert(perceived.fact);
  for (program::Perceived perceived : from.perception.perceived) {
    const std::string_view name = from[perceived.fact].name;
    perceived.fact = CellId{static_cast<std::uint32_t>(places.at(name))};
    perceived.percept = moved(perceived.percept);
    if (!given.contains(name) && !there.contains(perceived.fact)) to.perceived.push_back(perceived);
  }
}

}  // namespace

Program union_of_inputs(const Program& before, const Program& after) {
  Program all;
  all.cells.assign(before.cells.begin(), before.cells.begin() + before.facts);
  Places places = facts_of(before);
  for (std::size_t f = 0; f < after.facts; ++f) {
    if (places.emplace(after.cells[f].name, all.cells.size()).second) all.cells.push_back(after.cells[f]);
  }
  for (program::Cell& fact : all.cells) fact.satellites.clear();
  all.facts = static_cast<std::uint32_t>(all.cells.size());
  add_sensors(before.perception, all.perception);
  add_sensors(after.perception, all.perception);
  std::set<std::string_view> given = given_in(before);
  given.merge(given_in(after));
  add_perceived(before, given, places, all);
  add_perceived(after, given, places, all);
  return all;
}

namespace {

/// The kind of a column of this name in a recording of readings; empty if there is no such column.
std::string column_kind(const Program& program, const std::set<std::string_view>& given, std::string_view name) {
  if (given.contains(name)) return "a fact";
  const auto sensor = find_sensor(program.perception.sensors, name);
  if (sensor == program.perception.sensors.end()) return {};
  const std::string of = sensor->text ? "of texts" : sensor->unit.empty() ? "of numbers" : "in " + sensor->unit;
  return (sensor->array ? "an array of sensors " : "a sensor ") + of;
}

}  // namespace

std::optional<TornColumn> torn_column(const Program& before, const Program& after) {
  const std::set<std::string_view> given_before = given_in(before), given_after = given_in(after);
  std::vector<std::string_view> names;
  for (const Program* program : {&before, &after}) {
    for (const Sensor& sensor : program->perception.sensors) names.push_back(sensor.name);
  }
  for (const std::string_view name : names) {
    std::string one = column_kind(before, given_before, name), other = column_kind(after, given_after, name);
    if (!one.empty() && !other.empty() && one != other) return TornColumn{std::string(name), std::move(one), std::move(other)};
  }
  return std::nullopt;
}

Share::Share(const Program& program, const Program& all) : readings_(all.perception.readings()), given_(program.facts) {
  const auto there = facts_of(all);
  for (std::size_t f = 0; f < program.facts; ++f) facts_.push_back(there.at(program.cells[f].name));
  for (std::uint32_t r = 0; r < program.perception.readings(); ++r) {
    const Sensor& sensor = program.perception.sensor_of(r);
    const std::uint32_t place = place_of(r, program.perception, all.perception);
    readings_[place] = {r, {0.0f}};
    for (const std::string& text : all.perception.sensor_of(place).texts) {
      const auto found = std::find(sensor.texts.begin(), sensor.texts.end(), text);
      readings_[place].texts.push_back(found == sensor.texts.end() ? 0.0f : static_cast<float>(found - sensor.texts.begin() + 1));
    }
  }
}

const FactsRow& Share::of(const FactsRow& row) {
  for (std::size_t f = 0; f < facts_.size(); ++f) given_[f] = row.facts[facts_[f]];
  updates_.clear();
  for (ReadingUpdate update : row.readings) {
    const Reading& reading = readings_[update.reading];
    if (reading.here == Reading::kNone) continue;
    update.reading = reading.here;
    if (reading.texts.size() > 1) update.value = reading.texts[static_cast<std::size_t>(update.value)];
    updates_.push_back(update);
  }
  row_ = row;
  row_.facts = given_;
  row_.readings = updates_;
  return row_;
}

}  // namespace kb::trace
