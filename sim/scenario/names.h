// Looks up names of scenarios in the labyrinth and in the knowledge base. Each function reads the key `key` of a table; the result is
// nothing if the key is not there or its value was reported.
#pragma once

#include "sim/scenario/scenario.h"
#include "sim/scenario/toml_reader.h"

namespace kb::sim {

/// What names are looked up in.
struct Names {
  const Labyrinth& labyrinth;
  const Knowledge& knowledge;
  double radius_m = kRobotRadius;   ///< of the robot

  [[nodiscard]] std::optional<CrossingId> crossing(TomlTable& table, std::string_view key) const;
  /// A road by one of its ends: `LM7.E`.
  [[nodiscard]] std::optional<Labyrinth::End> end(TomlTable& table, std::string_view key) const;
  /// A fact, a strategy, a satellite; `kind` as it is called in messages.
  [[nodiscard]] std::optional<program::CellId> fact(TomlTable& table, std::string_view key) const;
  [[nodiscard]] std::optional<program::CellId> strategy(TomlTable& table, std::string_view key) const;
  [[nodiscard]] std::optional<program::CellId> satellite(TomlTable& table, std::string_view key) const;
  /// The legs of a name, `Route1.1:LM5>LM2` or `LM5>LM2`.
  [[nodiscard]] std::vector<program::CellId> legs(TomlTable& table, std::string_view key) const;
  /// A place: `road` and `metres` (and `aside`, to the left), or `crossing`, or `at` in metres of the map (and `heading` in
  /// degrees from north, clockwise).
  [[nodiscard]] std::optional<Pose> place(TomlTable& table) const;
  /// Reports (KB1333) a place where the robot would stand in a wall; `at` is where the scenario says so.
  [[nodiscard]] bool check_room(const Pose& pose, source::Span at, diagnostics::Diagnostics& diagnostics) const;

 private:
  [[nodiscard]] std::optional<program::CellId> cell(TomlTable& table, std::string_view key, program::CellKind kind) const;
};

/// Where something on a road can be: behind the stop line by one of whose sides the road is named, and behind `from_m`.
[[nodiscard]] inline TomlTable::Range along(const Road& road, double from_m = 0.0) {
  return {from_m, road.ends_m - road.begins_m, "metres of the floor behind the stop line,"};
}

/// The landmark where a route begins; null if it has none.
[[nodiscard]] const model::Row* begin_of(const model::Model& model, const model::Row& route);

/// The action and the text of an event that says `sensor = "range"`. False if it is wrong (reported).
[[nodiscard]] bool read_sensor_fault(TomlTable& table, Event& event);

/// The events of a scenario, in order.
[[nodiscard]] std::vector<Event> read_events(TomlTable& file, const Names& names, double limit_s);

}  // namespace kb::sim
