// kbc expand: the core rules, in the language's own words.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "compiler/program/cell_uses.h"
#include "compiler/program/program.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/cell_names.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

struct ExpandOptions {
  std::string file;
  std::string rule, level, cell;
};

std::string describe(const ExpandOptions& options) {
  std::string text;
  const auto add = [&text](std::string_view what, const std::string& value) {
    if (!value.empty()) text += (text.empty() ? "" : " and ") + std::string(what) + " `" + value + "`";
  };
  add("rule", options.rule);
  add("level", options.level);
  add("cell", options.cell);
  return text;
}

// What was probably meant by the first unknown name; nothing if all names are known but no rule matches all of them.
std::optional<std::string> suggest(const ExpandOptions& options, const program::Program& program) {
  if (!options.rule.empty() && trace::find_rules(program, options.rule).empty()) return trace::closest_rule(program, options.rule);
  const bool vain = !options.cell.empty() && trace::find_cells(program, options.cell).empty();
  return vain ? trace::meant_by(program, options.cell) : std::nullopt;
}

// False (reported) if there is no level of this name.
bool knows_level(const program::Program& program, const std::string& level, diagnostics::Diagnostics diagnostics) {
  if (level.empty() || std::ranges::find(program.levels, level) != program.levels.end()) return true;
  const std::vector<std::string_view> levels(program.levels.begin(), program.levels.end());
  diagnostics.report(Kind::kUnknownLevelSelected, {}, {level, fmt::format("`{}`", fmt::join(levels, "`, `"))}).suggest(diagnostics::closest(level, levels));
  return false;
}

// A comment line for each rule as written: how many instances of it there are among `rules`.
void count(const program::Program& program, const std::vector<program::RuleId>& rules, std::string_view what, Session& session) {
  if (rules.empty()) return;
  struct Written { std::string_view name, at; std::size_t instances = 0; };
  std::vector<Written> written;
  std::unordered_map<std::string_view, std::size_t> places;
  std::size_t widest = 0;
  for (const program::RuleId id : rules) {
    const program::Rule& rule = program[id];
    const auto [place, is_new] = places.try_emplace(rule.tmpl(), written.size());
    if (is_new) written.push_back({rule.tmpl(), program.at(rule)});
    ++written[place->second].instances;
    widest = std::max(widest, rule.tmpl().size());
  }
  session.print(fmt::format("# {} {}\n", what, diagnostics::counted(rules.size(), "rule")));
  for (const Written& one : written)
    session.print(fmt::format("#   {:<{}}  {}  {}\n", one.name, widest, diagnostics::counted(one.instances, "instance"), one.at));
}

// What has to do with the cells, which ascend: how they are perceived, and the rules, those that write them first.
void print_uses(const program::Program& program, const std::vector<program::CellId>& cells, const program::CellUses& uses, Session& session) {
  const auto sink = [&session](std::string_view piece) { session.print(piece); };
  for (const program::Perceived& perceived : program.perception.perceived) {
    if (std::ranges::binary_search(cells, perceived.fact)) session.print(program::print(program, perceived));
  }
  const std::string_view apart = cells.size() == 1 ? "does not name it, but" : "names none of them, but";
  const auto number = [](std::size_t count) { return count == 0 ? std::string("no rule") : diagnostics::counted(count, "rule"); };
  session.print(fmt::format("# written by {}\n", number(uses.writers.size())));
  program::print(program, uses.writers, sink);
  const std::string above = uses.reading_writers == 0 ? "" : fmt::format(", and by {} of those above", uses.reading_writers);
  session.print(fmt::format("# read by {}{}\n", number(uses.readers.size()), above));
  program::print(program, uses.readers, sink);
  count(program, uses.silencers, fmt::format("{} raises another member of an exclusive group:", apart), session);
  count(program, uses.resetters, fmt::format("{} says `reset`:", apart), session);
}

int expand(const ExpandOptions& options, Session& session) {
  const auto compiled = session.load(options.file, driver::Stage::kProgram);
  if (!compiled->ok()) return kErrors;
  const program::Program& program = compiled->program;
  const auto sink = [&session](std::string_view piece) { session.print(piece); };
  if (describe(options).empty()) {
    program::print(program, sink);
    return session.exit_code();
  }
  auto diagnostics = session.diagnostics(compiled->sources);
  if (!knows_level(program, options.level, diagnostics)) return kErrors;
  std::vector<program::RuleId> rules = program::select(program, {.rule = options.rule, .level = options.level});
  std::vector<std::string> vain;
  const std::vector<program::CellId> cells = trace::find_cells(program, options.cell, &vain);
  if (!cells.empty() && !vain.empty()) {
    for (const std::string& name : vain) diagnostics.report(Kind::kCellsNone, {}, {name}).suggest(trace::meant_by(program, name));
    return kErrors;
  }
  program::CellUses uses;
  if (!options.cell.empty()) uses = program::uses_of(program, cells, rules);
  if (options.cell.empty() ? rules.empty() : uses.empty()) {
    diagnostics.report(Kind::kNothingSelected, {}, {describe(options)}).suggest(suggest(options, program));
    return kErrors;
  }
  if (options.cell.empty()) {
    program::print(program, rules, sink);
  } else {
    print_uses(program, cells, uses, session);
  }
  return session.exit_code();
}

}  // namespace

Run setup_expand(CLI::App& app) {
  auto options = std::make_shared<ExpandOptions>();
  app.add_option("FILE", options->file, "The knowledge base, or an image of it (.kbt)")->required();
  app.add_option("--rule", options->rule, "Only this rule: as written, or one instance such as 'enter[right,mark]'")
      ->type_name("NAME");
  app.add_option("--level", options->level, "Only the rules of this level")->type_name("NAME");
  app.add_option("--cell", options->cell, "Only the rules that write or read this cell, all members of this group, or the cells that match, such as 'Say.*': first those that write it")
      ->type_name("NAMES");
  return [options](Session& session) { return expand(*options, session); };
}

}  // namespace kb::cli
