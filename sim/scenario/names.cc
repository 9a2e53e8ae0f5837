#include "sim/scenario/names.h"

#include <fmt/format.h>

#include "compiler/diagnostics/display.h"
#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

/// A road is named by a landmark that it does not end at by such an exit: `Hub` or `Hub.W` for `Hub.E`. Which one is meant cannot be guessed.
void report_no_exit(const TomlTable& table, std::string_view key, std::string_view written, const Crossing& crossing) {
  std::vector<std::string> ends;
  for (const Arm& arm : crossing.arms) ends.push_back(crossing.name + "." + arm.name);
  const std::vector<std::string_view> roads(ends.begin(), ends.end());
  table.diagnostics().report(diagnostics::Kind::kSimUnknownName, table.span(key), {"road", written})
      .note(diagnostics::Kind::kSimRoadsOf, {}, {crossing.name, diagnostics::in_a_row(roads)});
}

}  // namespace

std::optional<CrossingId> Names::crossing(TomlTable& table, std::string_view key) const {
  const auto name = table.text(key);
  if (!name) return std::nullopt;
  const CrossingId found = labyrinth.crossing(*name);
  if (found != CrossingId::kNone) return found;
  std::vector<std::string_view> candidates;
  for (const Crossing& crossing : labyrinth.crossings) candidates.emplace_back(crossing.name);
  table.unknown_name(key, "landmark", *name, candidates);
  return std::nullopt;
}

std::optional<Labyrinth::End> Names::end(TomlTable& table, std::string_view key) const {
  const auto name = table.text(key);
  if (!name) return std::nullopt;
  if (const auto found = labyrinth.end(*name)) return found;
  std::vector<std::string> ends;
  for (const Crossing& crossing : labyrinth.crossings) {
    if (crossing.name == name->substr(0, name->find('.'))) {
      report_no_exit(table, key, *name, crossing);
      return std::nullopt;
    }
    for (const Arm& arm : crossing.arms) ends.push_back(crossing.name + "." + arm.name);
  }
  const std::vector<std::string_view> candidates(ends.begin(), ends.end());
  table.unknown_name(key, "road", *name, candidates);
  return std::nullopt;
}

std::optional<program::CellId> Names::cell(TomlTable& table, std::string_view key, program::CellKind kind) const {
  const auto name = table.text(key);
  if (!name) return std::nullopt;
  std::vector<std::string_view> candidates;
  for (std::size_t i = 0; i < knowledge.program->cells.size(); ++i) {
    const program::Cell& cell = knowledge.program->cells[i];
    if (cell.name != *name) {
      if (cell.kind == kind) candidates.emplace_back(cell.name);
      continue;
    }
    if (cell.kind == kind) return static_cast<program::CellId>(i);
    table.diagnostics().report(diagnostics::Kind::kSimUnknownName, table.span(key), {word(kind), *name})
        .note(diagnostics::Kind::kSimOtherKind, {}, {*name, word(cell.kind)});
    return std::nullopt;
  }
  table.unknown_name(key, word(kind), *name, candidates);
  return std::nullopt;
}

std::optional<program::CellId> Names::fact(TomlTable& table, std::string_view key) const {
  return cell(table, key, program::CellKind::kFact);
}

std::optional<program::CellId> Names::strategy(TomlTable& table, std::string_view key) const {
  return cell(table, key, program::CellKind::kStrategy);
}

std::optional<program::CellId> Names::satellite(TomlTable& table, std::string_view key) const {
  return cell(table, key, program::CellKind::kSatellite);
}

std::vector<program::CellId> Names::legs(TomlTable& table, std::string_view key) const {
  std::vector<program::CellId> found;
  const auto name = table.text(key);
  if (!name) return found;
  std::vector<std::string> known;
  for (const Leg& leg : knowledge.legs) {
    known.push_back(leg.from.empty() ? leg.name : leg.from + ">" + leg.to);
    if (*name == known.back() || *name == leg.name) found.push_back(leg.cell);
  }
  const std::vector<std::string_view> candidates(known.begin(), known.end());
  if (found.empty()) table.unknown_name(key, "leg", *name, candidates);
  return found;
}

std::optional<Pose> Names::place(TomlTable& table) const {
  if (table.has("road")) {
    const auto found = end(table, "road");
    if (!found) return std::nullopt;
    const Road& road = labyrinth[found->arm->road];
    if (!table.has("metres")) {
      table.missing("metres");
      return std::nullopt;
    }
    const auto metres = table.number("metres", along(road));
    const double aside_m = table.number("aside", {-2.0 * labyrinth.size, 2.0 * labyrinth.size}).value_or(0.0);
    if (!metres) return std::nullopt;
    Pose pose = labyrinth.place(*found, *metres);
    const Spot aside = aside_m * left_of(direction(pose.heading_rad));
    return Pose{pose.x_m + aside.x_m, pose.y_m + aside.y_m, pose.heading_rad};
  }
  if (table.has("crossing")) {
    const auto found = crossing(table, "crossing");
    if (!found) return std::nullopt;
    return Pose{labyrinth[*found].at.x_m, labyrinth[*found].at.y_m, 0.0};
  }
  const Spot low = (1.0 / labyrinth.scale) * labyrinth.low, high = (1.0 / labyrinth.scale) * labyrinth.high;
  const auto at = table.pair("at", {low.x_m, high.x_m}, {low.y_m, high.y_m});
  const double degrees = table.number("heading", {-360.0, 360.0}).value_or(90.0);
  if (at) return Pose{at->x * labyrinth.scale, at->y * labyrinth.scale, wrap((90.0 - degrees) * kPi / 180.0)};
  if (table.has("at")) return std::nullopt;
  for (const char* beside : {"metres", "aside"}) static_cast<void>(table.has(beside));
  for (const char* other : {"landmark", "place"}) table.call(other, "crossing");
  table.missing_among("road` or `crossing` or `at");
  return std::nullopt;
}

bool Names::check_room(const Pose& pose, source::Span at, diagnostics::Diagnostics& diagnostics) const {
  const Spot spot{pose.x_m, pose.y_m};
  if (labyrinth.has_room(spot, radius_m)) return true;
  diagnostics.report(diagnostics::Kind::kSimInWall, at, {fmt::format("{:.2f}", spot.x_m / labyrinth.scale), fmt::format("{:.2f}", spot.y_m / labyrinth.scale)});
  return false;
}

const model::Row* begin_of(const model::Model& model, const model::Row& route) {
  const model::Row* leg = model.row_in(route, "first");
  return leg != nullptr ? model.row_in(*leg, "to") : nullptr;
}

}  // namespace kb::sim
