// kbc expand: the core rules, in the language's own words.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "compiler/program/program.h"
#include "tools/kbc/support.h"

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
  std::vector<std::string_view> rules, cells;
  for (const program::Rule& rule : program.rules) rules.insert(rules.end(), {rule.tmpl(), rule.name});
  for (const program::Cell& cell : program.cells) cells.push_back(cell.name);
  const std::vector<std::string_view> levels(program.levels.begin(), program.levels.end());
  const std::pair<const std::string&, const std::vector<std::string_view>&> given[] = {{options.rule, rules}, {options.level, levels}, {options.cell, cells}};
  for (const auto& [word, names] : given) {
    if (!word.empty() && std::find(names.begin(), names.end(), word) == names.end()) return diagnostics::closest(word, names);
  }
  return std::nullopt;
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
  const auto rules = program::select(program, {.rule = options.rule, .level = options.level, .cell = options.cell});
  if (rules.empty()) {
    session.diagnostics(compiled->sources)
        .report(Kind::kNothingSelected, {}, {describe(options)})
        .suggest(suggest(options, program));
    return kErrors;
  }
  program::print(program, rules, sink);
  return session.exit_code();
}

}  // namespace

Run setup_expand(CLI::App& app) {
  auto options = std::make_shared<ExpandOptions>();
  app.add_option("FILE", options->file, "The knowledge base, or an image of it (.kbt)")->required();
  app.add_option("--rule", options->rule, "Only this rule: as written, or one instance such as 'enter[right,mark]'")
      ->type_name("NAME");
  app.add_option("--level", options->level, "Only the rules of this level")->type_name("NAME");
  app.add_option("--cell", options->cell, "Only the rules that read or write this cell")->type_name("NAME");
  return [options](Session& session) { return expand(*options, session); };
}

}  // namespace kb::cli
