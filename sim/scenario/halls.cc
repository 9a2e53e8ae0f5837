// Halls, as a scenario file builds and furnishes them.
#include <algorithm>

#include "sim/scenario/scenario.h"
#include "sim/scenario/toml_reader.h"

namespace kb::sim {
namespace {

constexpr double kNarrowest = 1.2, kBroadest = 20.0, kLongest = 1000.0;   // m

HallBuild::Box read_box(TomlTable& table) {
  for (const std::string_view key : {"from", "to"}) {
    if (!table.has(key)) table.missing(key);
  }
  const auto corner = [&](std::string_view key) {
    return table.pair(key, {0.0, kLongest}, {-0.5 * kBroadest, 0.5 * kBroadest}).value_or(TomlTable::Pair{});
  };
  const TomlTable::Pair from = corner("from"), to = corner("to");
  table.done();
  return {std::min(from.x, to.x), std::min(from.y, to.y), std::max(from.x, to.x), std::max(from.y, to.y)};
}

}  // namespace

std::optional<std::vector<HallBuild>> read_halls(source::FileId file, Settings settings, diagnostics::Diagnostics& diagnostics) {
  const TomlPlaces places(file, diagnostics.sources());
  const auto parsed = parse_scenario(file, settings, places, diagnostics);
  if (!parsed) return std::nullopt;
  const std::size_t before = diagnostics.errors();
  TomlTable scenario(*parsed, "a scenario", places, diagnostics);
  std::vector<HallBuild> halls;
  for (TomlTable& table : scenario.tables("hall")) {
    HallBuild hall;
    if (!table.has("road")) table.missing("road");
    hall.road = table.text("road").value_or("");
    hall.span = table.span("road");
    hall.width_m = table.number("width", {kNarrowest, kBroadest}).value_or(kHallWidth);
    const auto furnished = table.text("pillars");
    if (furnished && *furnished != "none" && *furnished != "row") {
      constexpr std::string_view kWords[] = {"none", "row"};
      table.unknown_name("pillars", "arrangement", *furnished, kWords);
    }
    hall.pillars = !furnished || *furnished == "row";
    for (TomlTable& box : table.tables("box")) hall.boxes.push_back(read_box(box));
    table.done();
    halls.push_back(std::move(hall));
  }
  if (diagnostics.errors() != before) return std::nullopt;
  return halls;
}

}  // namespace kb::sim
