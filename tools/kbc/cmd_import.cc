// kbc import: fuzzy controllers and layouts of plants from other programs.
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <tuple>

#include "compiler/syntax/syntax.h"
#include "tools/kbc/fll/fll.h"
#include "tools/kbc/layout/layout.h"
#include "tools/kbc/layout_file.h"
#include "tools/kbc/support.h"
#include "tools/kbc/template.h"

namespace kb::cli {
namespace {

struct ImportOptions {
  LayoutImport how;   // its format may also be `fll`, which is not a layout
  std::string file, output;
  std::optional<std::string> order;
  std::vector<std::string> stops;
  bool trim = false;

  [[nodiscard]] bool is_engine() const { return how.format == "fll"; }
};

/// The controllers that `kbc new` gives a robot. The simulator has all of them.
std::string_view template_controllers() {
  for (const TemplateFile& file : template_files()) {
    const std::size_t at = file.path.ends_with(".kb") ? file.text.find("control ") : std::string_view::npos;
    if (at != std::string_view::npos) return file.text.substr(at);
  }
  return {};
}

/// What the resulting text says about the file that it was made from.
layout::Wording wording_of(const ImportOptions& options, std::string_view path) {
  layout::Wording wording = options.how.wording;
  wording.file = std::filesystem::path(path).filename().string();
  wording.format = options.how.format;
  wording.controllers = template_controllers();
  return wording;
}

struct Inputs {
  source::Sources sources;
  source::FileId file;
  std::optional<source::FileId> order;
};

std::optional<std::string> import_layout(const ImportOptions& options, Inputs& in, Session& session, diagnostics::Diagnostics& diagnostics) {
  layout::Adaptations adaptations;
  auto map = read_layout(options.how, in.sources, in.file, adaptations, diagnostics, session);
  if (!map) return std::nullopt;
  std::optional<layout::Mission> mission;
  if (in.order) mission = layout::mission_of_order(in.sources, *in.order, *map, adaptations, diagnostics);
  else if (!options.stops.empty()) mission = layout::mission_by_stops(*map, options.stops, diagnostics);
  adaptations.report(diagnostics);
  if (diagnostics.failed()) return std::nullopt;
  if (mission) layout::take_limits(*mission, *map);
  if (options.trim) std::tie(*map, *mission) = layout::trimmed(*map, *mission);
  const layout::Wording wording = wording_of(options, in.sources.path(in.file));
  return layout::write_map(*map, wording) + (mission ? layout::write_mission(*mission, *map, wording) : "");
}

int run_import(const ImportOptions& options, Session& session) {
  Inputs in;
  const auto file = session.open(options.file, in.sources);
  if (!file) return kErrors;
  in.file = *file;
  if (options.order && !(in.order = session.open(*options.order, in.sources))) return kErrors;
  auto diagnostics = session.diagnostics(in.sources);
  auto text = options.is_engine() ? fll::import_engine(in.sources, in.file, diagnostics) : import_layout(options, in, session, diagnostics);
  if (!text) return kErrors;
  const source::FileId made = in.sources.add(options.file + ".kb", std::move(*text));
  std::string formatted = syntax::format(in.sources, made);
  // Mistakes that do not belong to a single line of the engine, for example that it is too large, are found by compiling the result.
  if (options.is_engine() && !session.compile_text(options.file + ".kb", formatted)->ok()) return kErrors;
  return session.deliver(options.output, std::move(formatted));
}

}  // namespace

Run setup_import(CLI::App& app) {
  auto options = std::make_shared<ImportOptions>();
  std::vector<std::string> formats{"fll"};
  for (const LayoutFormat& format : layout_formats()) formats.emplace_back(format.name);
  app.add_option("FORMAT", options->how.format, "What the file is written in: fll, lif, nav2, opentcs")->required()->check(CLI::IsMember(formats));
  app.add_option("FILE", options->file, "The file; `-` is standard input")->required();
  app.add_option("-o,--output", options->output, "Write to this file")->type_name("FILE");
  const std::string group = "Layouts";
  auto* route = app.add_option("--route", options->stops, "A mission as well: from each of these places, or stations, to the next by the shortest way")
                    ->delimiter(',')->type_name("ID,...")->group(group);
  auto* order = app.add_option("--order", options->order, "A mission as well: what is released of this order (VDA 5050, JSON), by its edges alone")
                    ->type_name("FILE")->excludes(route)->group(group);
  app.add_flag("--trim", options->trim, "Keep only the roads of the mission, and one that leads to its beginning")->group(group);
  app.add_option("--by", options->how.wording.method, "How to drive roads that have no method of their own")
      ->check(CLI::IsMember({"mark", "dist", "azimuth"}))->capture_default_str()->group(group);
  app.add_option("--map", options->how.wording.map, "The name of the map")->type_name("NAME")->check(name_fault)->capture_default_str()->group(group);
  app.add_option("--prefix", options->how.wording.prefix, "Stands before an id that cannot be a name, such as 7")
      ->type_name("NAME")->check(name_fault)->capture_default_str()->group(group);
  const auto* layout = app.add_option("--layout", options->how.choice.layout, "Of several layouts in a LIF file, this one")->type_name("ID")->group(group);
  const auto* vehicle = app.add_option("--vehicle", options->how.choice.vehicle, "Of a LIF file, only what this type of vehicle may use")
                            ->type_name("ID")->group(group);
  app.callback([&app, options, route, order, layout, vehicle, group] {
    if (options->trim && route->empty() && order->empty()) throw CLI::ValidationError("--trim wants a mission: --route or --order");
    if (options->file == "-" && options->order == "-") throw CLI::ValidationError("standard input can be one of FILE and --order; name a file for the other");
    for (const CLI::Option* option : app.get_options()) {
      if (option->get_group() != group || option->count() == 0) continue;
      if (options->is_engine() || (options->how.format != "lif" && (option == layout || option == vehicle))) {
        throw CLI::ValidationError(option->get_name(), "is not for `" + options->how.format + "`");
      }
    }
  });
  return [options](Session& session) { return run_import(*options, session); };
}

}  // namespace kb::cli
