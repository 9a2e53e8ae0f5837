// kbc export: fuzzy controllers and maps for other programs.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "compiler/model/ground.h"
#include "tools/kbc/fll/fll.h"
#include "tools/kbc/find_named.h"
#include "tools/kbc/json/date_time.h"
#include "tools/kbc/layout/layout.h"

namespace kb::cli {
namespace {

struct ExportOptions {
  std::string format, file, name, output;
  std::string vehicle = "robot", timestamp = "1970-01-01T00:00:00Z";
};

std::optional<std::string> export_fuzzy(const ExportOptions& options, const driver::Compilation& compiled, diagnostics::Diagnostics& diagnostics) {
  const fuzzy::Controller* controller = find_fuzzy(compiled.program.fuzzy, options.file, options.name, diagnostics);
  return controller == nullptr ? std::nullopt : fll::export_engine(*controller, diagnostics);
}

/// The map as places and ways, each named by the landmark and the exit by which it leaves, as orders of a master name roads. Nothing (reported)
/// if its relations are the user's own and do not say where things lie.
std::optional<layout::Layout> layout_of(const model::Model& model, const model::Map& map, const ExportOptions& options, diagnostics::Diagnostics& diagnostics) {
  layout::Layout made{.name = std::filesystem::path(options.file).stem().string(), .places = {}, .ways = {}};
  auto roads = model::ground_roads(model, map);
  for (const model::RowId id : map.landmarks) {
    const model::Point* at = model.point_in(model[id], "at");
    if (at == nullptr) roads.reset();
    else made.places.push_back({std::string(model[id].name), "", {at->x, at->y}, {}});
  }
  if (!roads) {
    diagnostics.report(diagnostics::Kind::kGraphNothing, {}, {options.file, model::ground_lacking(model, map)});
    return std::nullopt;
  }
  for (const model::GroundRoad& road : *roads) {
    layout::Way way{.id = fmt::format("{}.{}", road.from, road.exit), .from = std::string(road.from), .to = std::string(road.to), .through = {}, .from_span = {}, .to_span = {}};
    for (const model::Point& bend : std::span(road.course).subspan(1, road.course.size() - 2)) way.through.push_back({bend.x, bend.y});
    way.limit_m_s = static_cast<double>(road.limit_m_per_s);
    way.method = road.by;
    made.ways.push_back(std::move(way));
  }
  return made;
}

std::optional<std::string> export_map(const ExportOptions& options, const driver::Compilation& compiled, diagnostics::Diagnostics& diagnostics) {
  const model::Map* map = find_named(compiled.model.maps, options.name, [&](const std::string& which) {
    return diagnostics.report(diagnostics::Kind::kGraphNothing, {}, {options.file, "map" + which});
  });
  if (map == nullptr) return std::nullopt;
  const auto layout = layout_of(compiled.model, *map, options, diagnostics);
  if (!layout) return std::nullopt;
  return layout::write_lif(*layout, {.map = map->name, .vehicle = options.vehicle, .timestamp = options.timestamp});
}

int run_export(const ExportOptions& options, Session& session) {
  const auto compiled = session.compile(options.file, driver::Stage::kProgram);
  if (!compiled->ok()) return kErrors;
  auto diagnostics = session.diagnostics(compiled->sources);
  auto text = options.format == "fll" ? export_fuzzy(options, *compiled, diagnostics) : export_map(options, *compiled, diagnostics);
  return text ? session.deliver(options.output, std::move(*text)) : kErrors;
}

}  // namespace

Run setup_export(CLI::App& app) {
  auto options = std::make_shared<ExportOptions>();
  app.add_option("FORMAT", options->format, "What to write: fll, a fuzzy controller; lif, a map")->required()->check(CLI::IsMember({"fll", "lif"}));
  app.add_option("FILE", options->file, "The knowledge base")->required();
  app.add_option("NAME", options->name, "Which fuzzy controller, or which map; needed if there are several");
  auto* vehicle = app.add_option("--vehicle", options->vehicle, "lif: the type of vehicle that may use its nodes and edges")->type_name("TYPE")->capture_default_str();
  auto* timestamp = app.add_option("--timestamp", options->timestamp, "lif: when the file was made; as long as it is not given, the same map is the same file")->type_name("TIME")->capture_default_str();
  app.add_option("-o,--output", options->output, "Write to this file")->type_name("FILE");
  app.parse_complete_callback([options, vehicle, timestamp] {
    if (!json::is_date_time(options->timestamp)) throw CLI::ValidationError("--timestamp", "`" + options->timestamp + "` is no time like 2026-03-02T07:45:00Z");
    if (options->format == "fll" && (vehicle->count() > 0 || timestamp->count() > 0)) throw CLI::ValidationError("--vehicle and --timestamp stand in a layout, so they need `lif`");
  });
  return [options](Session& session) { return run_export(*options, session); };
}

}  // namespace kb::cli
