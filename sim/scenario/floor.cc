// Reads how a scenario file builds the floor: the size, the paint, the halls and what stands in them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/scenario/scenario.h"
#include "sim/scenario/toml_reader.h"

namespace kb::sim {
namespace {

constexpr double kNarrowest = 1.2, kBroadest = 20.0, kLongest = 1000.0;   // m
constexpr TomlTable::Range kSizes{static_cast<double>(kLeastSize), static_cast<double>(kMostSize)};

// A robot that drives over another road's line has it under its sensors for the width of that line and the way of one control period more.
// Half of a stop line has to be broader than that: see note [a stop line is broad] in controllers/stop_line.h.
PaintWidths read_widths(TomlTable& floor, double size, PaintWidths widths) {
  constexpr double kPeriod = 0.01, kRounding = 1e-6;   // m, at the speeds of size 1
  const std::size_t before = floor.diagnostics().errors();
  widths.line_m = floor.number("line_width", around({0.02, 0.05}, size)).value_or(widths.line_m);
  widths.stop_line_m = floor.number("stop_line_width", around({0.06, 0.2}, size)).value_or(widths.stop_line_m);
  floor.done();
  const double least_m = 2.0 * (widths.line_m + kPeriod * std::sqrt(size));
  if (widths.stop_line_m > least_m - kRounding || floor.diagnostics().errors() != before) return widths;
  floor.diagnostics().report(diagnostics::Kind::kSimStopLine, floor.span(floor.has("stop_line_width") ? "stop_line_width" : "line_width"),
                             {fmt::format("{:g}", widths.stop_line_m), fmt::format("{:g}", widths.line_m), fmt::format("{:g}", least_m)});
  return widths;
}

HallBuild::Box read_box(TomlTable& table) {
  for (const std::string_view key : {"from", "to"}) {
    if (!table.has(key)) table.missing(key);
  }
  const auto corner = [&](std::string_view key) {
    return table.pair(key, {0.0, kLongest}, {-0.5 * kBroadest, 0.5 * kBroadest}).value_or(TomlTable::Pair{});
  };
  const TomlTable::Pair from = corner("from"), to = corner("to");
  table.done();
  return {std::min(from.x, to.x), std::min(from.y, to.y), std::max(from.x, to.x), std::max(from.y, to.y), table.span("to")};
}

}  // namespace

std::optional<FloorBuild> read_floor(source::FileId file, Settings settings, diagnostics::Diagnostics& diagnostics) {
  const TomlPlaces places(file, diagnostics.sources());
  const auto parsed = parse_scenario(file, settings, places, diagnostics);
  if (!parsed) return std::nullopt;
  const std::size_t before = diagnostics.errors();
  TomlTable scenario(*parsed, "a scenario", places, diagnostics);
  FloorBuild build;
  if (auto robot = scenario.table("robot")) build.size = robot->number("size", kSizes).value_or(1.0);
  build.widths = widths_of(robot_of(static_cast<float>(build.size)));
  if (auto floor = scenario.table("floor")) build.widths = read_widths(*floor, build.size, build.widths);
  for (TomlTable& table : scenario.tables("hall")) {
    HallBuild hall;
    if (!table.has("road")) table.missing("road");
    hall.road = table.text("road").value_or("");
    hall.span = table.span("road");
    hall.width_m = table.number("width", around({kNarrowest, kBroadest}, build.size));
    const auto furnished = table.text("pillars");
    if (furnished && *furnished != "none" && *furnished != "row") {
      constexpr std::string_view kWords[] = {"none", "row"};
      table.unknown_name("pillars", "arrangement", *furnished, kWords);
    }
    hall.pillars = !furnished || *furnished == "row";
    for (TomlTable& box : table.tables("box")) hall.boxes.push_back(read_box(box));
    table.done();
    build.halls.push_back(std::move(hall));
  }
  if (diagnostics.errors() != before) return std::nullopt;
  return build;
}

}  // namespace kb::sim
