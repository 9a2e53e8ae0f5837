// kbc dump: what the compiler holds after each phase.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "compiler/syntax/syntax.h"
#include "tools/kbc/support.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

struct DumpOptions {
  std::string form, file;
  bool json = false;
};

// Tokens and tree are those of one file: nothing that it imports is read. Both come out whatever errors there are.
int dump_syntax(const DumpOptions& options, Session& session) {
  source::Sources sources;
  const auto file = session.open(options.file, sources);
  if (!file) return kErrors;
  auto diagnostics = session.diagnostics(sources);
  if (options.form == "tokens")
    session.print(syntax::print_tokens(sources, syntax::lex(sources, *file, diagnostics)));
  else
    session.print(syntax::print_tree(sources, syntax::parse(sources, *file, diagnostics)));
  return session.exit_code();
}

// What a name stands for, where it is declared, and what belongs to it: for those who look something up.
struct NamedThing {
  std::string_view kind, name;
  source::Span declared;
  std::string more;
};

std::string members_of(const model::Model& model, const std::vector<model::SetId>& sets) {
  std::string out;
  for (const model::SetId set : sets) out += (out.empty() ? "[" : ", ") + model.sets[index(set)].name;
  return out + "]";
}

void add_cells(const model::Model& model, std::vector<NamedThing>& out) {
  constexpr std::array<std::string_view, 3> kKinds{"fact", "satellite", "strategy"};
  std::vector<bool> told(model.cells.size(), false);
  for (const model::Group& group : model.groups) {
    out.push_back({kKinds[static_cast<std::size_t>(group.kind)], group.name, group.declared, members_of(model, group.dimensions)});
    for (const model::CellId cell : group.cells) told[index(cell)] = true;
  }
  for (const model::Row& row : model.rows) {
    if (row.declared.known()) out.push_back({model[row.relation].name, row.name, row.declared, ""});
    if (row.cell != model::CellId::kNone) told[index(row.cell)] = true;
  }
  for (std::size_t i = 0; i < model.cells.size(); ++i) {
    const model::Cell& cell = model.cells[i];
    if (!told[i] && !cell.name.starts_with("sat ")) out.push_back({kKinds[static_cast<std::size_t>(cell.kind)], cell.name, cell.declared, ""});
  }
}

std::vector<NamedThing> names_of(const model::Model& model) {
  std::vector<NamedThing> out;
  for (std::size_t i = 0; i < model.levels.size(); ++i) out.push_back({"level", model.levels[i], model.level_spans[i], ""});
  for (const model::FiniteSet& set : model.sets) out.push_back({"set", set.name, set.declared, fmt::format("{{ {} }}", fmt::join(set.members, ", "))});
  for (const model::Relation& relation : model.relations) out.push_back({"relation", relation.name, relation.declared, fmt::format("({})", fmt::join(relation.fields, ", "))});
  add_cells(model, out);
  for (const model::Map& map : model.maps) out.push_back({"map", map.name, map.declared, ""});
  for (const model::Template& rule : model.templates) out.push_back({"rule", rule.name, rule.span, "at " + model.levels[rule.level]});
  for (const model::Prototype& prototype : model.prototypes) out.push_back({"prototype", prototype.name, prototype.declared, ""});
  for (const model::Sensor& sensor : model.sensors) out.push_back({"sensor", sensor.name, sensor.declared, sensor.text ? "text" : sensor.unit});
  for (const fuzzy::Controller& controller : model.fuzzy) out.push_back({"fuzzy", controller.name, controller.declared, ""});
  for (const model::Control& control : model.controls) out.push_back({"control", model[control.strategy].name, control.span, "= " + control.controller});
  std::stable_sort(out.begin(), out.end(), [](const NamedThing& a, const NamedThing& b) { return a.name < b.name; });
  return out;
}

// A line a name, by the alphabet; a group is one line, however many members it has.
std::string print_names(const driver::Compilation& c) {
  const std::vector<NamedThing> names = names_of(c.model);
  std::size_t name = 4, kind = 4;
  for (const NamedThing& one : names) {
    name = std::max(name, std::min<std::size_t>(one.name.size(), 32));
    kind = std::max(kind, one.kind.size());
  }
  std::string out;
  for (const NamedThing& one : names) {
    fmt::format_to(std::back_inserter(out), "{:<{}}  {:<{}}  {}{}{}\n", one.name, name, one.kind, kind, c.sources.origin(one.declared), one.more.empty() ? "" : "  ", one.more);
  }
  return out;
}

struct Form {
  std::string_view name;
  driver::Stage stage;
  std::string (*print)(const driver::Compilation&);
};
constexpr std::array kForms = {
    Form{"model", driver::Stage::kModel, [](const driver::Compilation& c) { return model::print(c.model, c.sources); }},
    Form{"names", driver::Stage::kModel, print_names},
    Form{"program", driver::Stage::kProgram, [](const driver::Compilation& c) { return program::print(c.program); }},
    Form{"tables", driver::Stage::kTables,
         [](const driver::Compilation& c) { return tables::print(c.tables, c.program); }},
};

bool image_has(std::string_view form) { return form == "program" || form == "tables"; }

// Of an image, or of the one that a knowledge base would become.
int dump_image(const DumpOptions& options, Session& session) {
  const auto loaded = session.load(options.file, driver::Stage::kTables);
  if (!loaded->ok()) return kErrors;
  if (!loaded->image) {
    const std::string image = session.make_image(*loaded);
    if (image.empty()) return kErrors;
    Session::require_sound_image(image);
    loaded->image = std::make_unique<tables::LoadedImage>(image);
  }
  session.print(tables::print_image(*loaded->image));
  return session.exit_code();
}

int dump(const DumpOptions& options, Session& session) {
  if (options.form == "image") return dump_image(options, session);
  for (const Form& form : kForms) {
    if (form.name != options.form) continue;
    const auto compiled = image_has(form.name) ? session.load(options.file, form.stage) : session.compile(options.file, form.stage);
    if (!compiled->ok()) return kErrors;
    session.print(options.json ? program::print_json(compiled->program) : form.print(*compiled));
    return session.exit_code();
  }
  return dump_syntax(options, session);
}

}  // namespace

Run setup_dump(CLI::App& app) {
  auto options = std::make_shared<DumpOptions>();
  app.add_option("FORM", options->form, "Which form")
      ->required()
      ->check(CLI::IsMember({"tokens", "tree", "names", "model", "program", "tables", "image"}));
  app.add_option("FILE", options->file, "The knowledge base; for program, tables and image also an image of it (.kbt)")->required();
  app.add_flag("--json", options->json, "The program as JSON");
  app.callback([options] {
    if (options->json && options->form != "program")
      throw CLI::ValidationError("--json", "only `program` has a form in JSON");
  });
  return [options](Session& session) { return dump(*options, session); };
}

}  // namespace kb::cli
