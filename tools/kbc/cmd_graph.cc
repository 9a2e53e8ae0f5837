// kbc graph: pictures of a knowledge base.
#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

#include "compiler/analysis/confusion.h"
#include "compiler/emit/dot.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/cell_names.h"
#include "tools/kbc/trace/graphviz.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

struct GraphOptions {
  std::string file;
  bool map = false, levels = false, confusion = false;
  std::string rules;
  std::string format;  // dot, svg; empty: by the name of the output
  std::string output;

  [[nodiscard]] bool svg() const { return format.empty() ? ending(output) == ".svg" : format == "svg"; }
};

// Refuses an output whose name promises a format that cannot be written.
void refuse_other_formats(const GraphOptions& options) {
  if (options.confusion && options.svg()) throw CLI::ValidationError("--confusion", "the table is text, and no picture");
  if (!options.format.empty() || options.confusion || !is_other_picture(options.output)) return;
  throw CLI::ValidationError("--output", "`" + options.output + "` cannot be written; a graph is DOT (`.dot`), or SVG (`.svg`)");
}

// The graph in DOT; empty if there is nothing to draw (reported).
std::string draw(const GraphOptions& options, const driver::Compilation& compiled, diagnostics::Diagnostics& diagnostics) {
  if (!options.rules.empty()) {
    const std::vector<program::RuleId> rules = trace::find_rules(compiled.program, options.rules);
    if (!rules.empty()) return emit::print_rules_dot(compiled.program, rules);
    diagnostics.report(Kind::kWhyNoRule, {}, {options.rules})
        .suggest(trace::closest_rule(compiled.program, options.rules));
    return {};
  }
  const bool has_map = !compiled.model.maps.empty();
  if (options.levels || (!options.map && !has_map)) return emit::print_levels_dot(compiled.model, compiled.program);
  if (has_map) return emit::print_map_dot(compiled.model);
  diagnostics.report(Kind::kGraphNothing, {}, {options.file, "map to draw; `--levels` draws its rules"});
  return {};
}

int graph(const GraphOptions& options, Session& session) {
  const auto compiled = session.compile(options.file, driver::Stage::kProgram);
  if (!compiled->ok()) return kErrors;
  auto diagnostics = session.diagnostics(compiled->sources);
  if (options.confusion && compiled->program.perception.perceived.empty()) {
    diagnostics.report(Kind::kGraphNothing, {}, {options.file, "fact that is perceived, so none to compare"});
    return kErrors;
  }
  if (options.confusion) return session.deliver(options.output, analysis::print_confusion(compiled->program));
  std::string picture = draw(options, *compiled, diagnostics);
  if (picture.empty()) return kErrors;
  if (options.svg()) {
    trace::Drawing drawing = trace::draw_svg(picture);
    using Outcome = trace::Drawing::Outcome;
    if (drawing.outcome == Outcome::kNotInstalled) diagnostics.report(Kind::kGraphNoDot, {}, {});
    if (drawing.outcome == Outcome::kFailed) diagnostics.report(Kind::kGraphDotFailed, {}, {drawing.error});
    if (drawing.outcome != Outcome::kDrawn) return kErrors;
    picture = std::move(drawing.svg);
  }
  return session.deliver(options.output, std::move(picture));
}

}  // namespace

Run setup_graph(CLI::App& app) {
  auto options = std::make_shared<GraphOptions>();
  app.add_option("FILE", options->file, "The knowledge base")->required();
  auto* map =
      app.add_flag("--map", options->map, "Draw landmarks, roads, routes and detours; the default if there is a map");
  auto* levels =
      app.add_flag("--levels", options->levels, "Draw the levels with their rules, and which level writes and reads what");
  auto* rules =
      app.add_option("--rules", options->rules, "Draw the instances of one rule, with the cells that each reads and writes")->type_name("RULE");
  app.add_flag("--confusion", options->confusion,
               "Print a table: how certain any two perceived facts can be at once, and at which readings")
      ->excludes(map)
      ->excludes(levels)
      ->excludes(rules);
  map->excludes(levels)->excludes(rules);
  levels->excludes(rules);
  app.add_option("--format", options->format,
                 "dot, or svg if Graphviz is installed; by default it follows from the name of the output")
      ->check(CLI::IsMember({"dot", "svg"}));
  app.add_option("-o,--output", options->output, "Write to this file")->type_name("FILE");
  app.parse_complete_callback([options] { refuse_other_formats(*options); });
  return [options](Session& session) { return graph(*options, session); };
}

}  // namespace kb::cli
