// The roads that legs lead along, as data for controllers/road_map.h.
#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compiler/emit/cpp.h"
#include "compiler/model/ground.h"

namespace kb::emit {
namespace {

using Out = std::back_insert_iterator<std::string>;
using model::GroundRoad;

/// The rows of the tables.
struct Rows {
  std::string pieces, roads, legs;
  std::size_t piece_count = 0, leg_count = 0;
};

/// What a robot on its routes has to know.
struct Roads {
  std::vector<GroundRoad> all;
  std::map<model::RowId, std::size_t> number;   // of those that legs lead along
};

/// The roads that meet the landmarks of legs, each from both ends: a robot may come to the first crossing of a mission on any of them, and may be carried to
/// one. Nothing if a map does not say where its roads lie.
std::optional<Roads> roads_of_legs(const model::Model& model) {
  Roads roads;
  for (const model::LegRoad& leg : model.leg_roads) {
    if (leg.road != model::RowId::kNone) roads.number.emplace(leg.road, 0);
  }
  for (const model::Map& map : model.maps) {
    auto ground = model::ground_roads(model, map);
    if (!ground) return std::nullopt;
    std::set<std::string_view> landmarks;
    std::set<std::pair<std::string_view, std::string_view>> begins;
    for (const GroundRoad& road : *ground) {
      begins.emplace(road.from, road.exit);
      if (roads.number.contains(road.row)) landmarks.insert({road.from, road.to});
    }
    for (GroundRoad& road : *ground) {
      if (!landmarks.contains(road.from) && !landmarks.contains(road.to)) continue;
      if (const auto leg = roads.number.find(road.row); leg != roads.number.end()) leg->second = roads.all.size();
      roads.all.push_back(std::move(road));
      const GroundRoad& there = roads.all.back();
      if (!there.approach.empty() && !begins.contains({there.to, there.approach})) roads.all.push_back(model::reversed(there));
    }
  }
  return roads;
}

void add_road(const GroundRoad& road, Rows& rows) {
  const std::size_t first = rows.piece_count;
  for (const model::GroundPiece& piece : model::pieces_of(road.course)) {
    fmt::format_to(Out(rows.pieces), "    {{{}, {}}},  // {}.{}\n", float_literal(static_cast<float>(piece.heading_rad)), float_literal(static_cast<float>(piece.length_m)), road.from, road.exit);
    ++rows.piece_count;
  }
  const std::string limit = road.limit_m_per_s > 0.0f ? float_literal(road.limit_m_per_s) : "mts::kInfinity";
  fmt::format_to(Out(rows.roads), "    {{\"{}\", \"{}\", \"{}\", \"{}\", \"{}\", {}, kMapPieces + {}, {}, {}, {}}},\n", road.from, road.exit, road.to, road.approach, road.by, limit, first,
                 rows.piece_count - first, float_literal(static_cast<float>(road.begins_apart_rad)), float_literal(static_cast<float>(road.ends_apart_rad)));
}

Rows rows_of(const model::Model& model, const program::Program& program, const Names& names, const Roads& roads) {
  Rows rows;
  for (const GroundRoad& road : roads.all) add_road(road, rows);
  std::unordered_map<std::string_view, std::size_t> satellites;
  const auto cells = program.cells_of(program::CellKind::kSatellite);
  for (std::size_t i = 0; i < cells.size(); ++i) satellites.emplace(cells[i].name, i);
  for (const model::LegRoad& leg : model.leg_roads) {
    const auto cell = satellites.find(model[leg.leg].name);
    if (leg.road == model::RowId::kNone || cell == satellites.end()) continue;
    fmt::format_to(Out(rows.legs), "      {{Satellite::{}, {}}},\n", names.satellites[cell->second], roads.number.at(leg.road));
    ++rows.leg_count;
  }
  return rows;
}

/// The landmarks of all maps as runs of facts: `      {26, 3},`.
std::string landmark_runs(const model::Model& model, const program::Program& program) {
  std::string out;
  for (const program::CellRun& run : program::landmark_runs(model)) {
    fmt::format_to(Out(out), "      {{{}, {}}},  // from {}\n", program::index(run.first), run.count, program[run.first].name);
  }
  return out;
}

}  // namespace

std::string map_body(const model::Model& model, const program::Program& program, const tables::Tables& tables) {
  const auto roads = roads_of_legs(model);
  if (!roads || roads->number.empty()) return {};
  const Rows rows = rows_of(model, program, make_names(program, tables), *roads);
  return fmt::format(
      "/// The roads that meet the landmarks of routes and their detours, each from both ends, whether or not it may be driven so.\n"
      "inline constexpr mts::Piece kMapPieces[] = {{   // heading in rad, length in m\n{1}}};\n"
      "inline constexpr mts::MapRoad kMapRoads[] = {{\n{2}}};\n\n"
      "/// The road that leaves a landmark by one of its sides; null if there is none, or no leg comes to the landmark. O(roads).\n"
      "[[nodiscard]] inline const mts::MapRoad* find_road(const char* from, const char* exit) noexcept {{\n"
      "  for (const mts::MapRoad& road : kMapRoads) {{\n    if (mts::same_text(road.from, from) && mts::same_text(road.exit, exit)) return &road;\n  }}\n"
      "  return nullptr;\n}}\n\n"
      "/// The road that the robot's present leg leads along: the one that it is on, or, from the sign of a crossing on, the one by which it\n"
      "/// leaves. Null on the way to the first landmark of a route, and while no route is driven. Reads up to {0} satellites.\n"
      "[[nodiscard]] inline const mts::MapRoad* road_of_leg(const Mind& mind) noexcept {{\n"
      "  static constexpr struct {{\n    Satellite satellite;\n    std::uint32_t road;\n  }} kLegs[] = {{\n{3}  }};\n"
      "  for (const auto& leg : kLegs) {{\n    if (mind.high(leg.satellite)) return &kMapRoads[leg.road];\n  }}\n  return nullptr;\n}}\n\n"
      "/// The landmarks among the facts.\n"
      "[[nodiscard]] inline mts::FactRuns landmarks() noexcept {{\n"
      "  static constexpr mts::FactRun kRuns[] = {{   // the first, and how many\n{4}  }};\n"
      "  return {{kRuns, sizeof kRuns / sizeof kRuns[0]}};\n}}\n\n",
      rows.leg_count, rows.pieces, rows.roads, rows.legs, landmark_runs(model, program));
}

std::uint64_t print_of_map(std::string_view body) {
  const std::uint64_t print = print_of_code(body, "");
  return print != 0 ? print : 1;
}

/// The assertion: see note [files of one make].
std::string cpp_map(std::string_view body, const CppOptions& options, std::uint64_t mind_print) {
  return fmt::format("{0}#pragma once\n\n#include <cstdint>\n\n#include <waymark/controllers/road_map.h>\n\n#include \"{1}\"\n\n"
                     "static_assert({2}::kMadeOf == 0x{5:016x}u && {2}::kMapMadeOf == 0x{6:x}u,\n"
                     "              \"this map was made of another version of the knowledge base than the mind of {2}, or the mind was made without --map: \"\n"
                     "              \"compile the knowledge base with --map again (with CMake: MAP in kb_add_library, then build)\");\n\n"
                     "namespace {2} {{\ninline namespace {3} {{\n\n{4}}}  // namespace {3}\n}}  // namespace {2}\n",
                     kGenerated, options.header_name, options.name_space, version_name(options.map_print), body, mind_print, options.map_print);
}

}  // namespace kb::emit
