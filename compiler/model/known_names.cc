#include "compiler/model/known_names.h"

#include <fmt/format.h>

#include <algorithm>

namespace kb::model {
namespace {

std::string written(const FiniteSet& set) { return fmt::format("{{ {} }}", fmt::join(set.members, ", ")); }

/// `strategies Drive { ahead, back }` is a group over a set of the same name.
bool has_its_own_set(const Model& model, const Group& group) {
  return group.dimensions.size() == 1 && model.sets[index(group.dimensions.front())].declared == group.declared;
}

void add_sets(const Model& model, std::vector<KnownName>& out) {
  std::vector<bool> own(model.sets.size(), false);
  for (const Group& group : model.groups) {
    if (has_its_own_set(model, group)) own[index(group.dimensions.front())] = true;
  }
  for (std::size_t i = 0; i < model.sets.size(); ++i) {
    const FiniteSet& set = model.sets[i];
    if (!own[i]) out.push_back({"set", set.name, set.declared, written(set), &set});
  }
}

std::string listed(const Model& model, const std::vector<SetId>& sets) {
  std::string out;
  for (const SetId set : sets) out += (out.empty() ? "" : ", ") + model.sets[index(set)].name;
  return out;
}

std::string dimensions(const Model& model, const Group& group) {
  return has_its_own_set(model, group) ? written(model.sets[index(group.dimensions.front())]) : fmt::format("[{}]", listed(model, group.dimensions));
}

std::string output(const Cell& cell) { return cell.output ? "output" : ""; }

void add_cells(const Model& model, std::vector<KnownName>& out) {
  std::vector<bool> told(model.cells.size(), false);
  for (const Group& group : model.groups) {
    const FiniteSet* const members = group.dimensions.size() == 1 ? &model.sets[index(group.dimensions.front())] : nullptr;
    out.push_back({word(group.kind), group.name, group.declared, dimensions(model, group) + (!group.cells.empty() && model[group.cells.front()].output ? " output" : ""), members});
    for (const CellId cell : group.cells) told[index(cell)] = true;
  }
  for (const Row& row : model.rows) {
    if (row.declared.known()) out.push_back({model[row.relation].name, row.name, row.declared, ""});
    if (row.cell != CellId::kNone) told[index(row.cell)] = true;
  }
  for (std::size_t i = 0; i < model.cells.size(); ++i) {
    const Cell& cell = model.cells[i];
    if (!told[i] && !cell.name.starts_with("sat ")) out.push_back({word(cell.kind), cell.name, cell.declared, output(cell)});
  }
}

}  // namespace

std::vector<KnownName> known_names(const Model& model) {
  std::vector<KnownName> out;
  for (std::size_t i = 0; i < model.levels.size(); ++i) out.push_back({"level", model.levels[i], model.level_spans[i], ""});
  add_sets(model, out);
  for (const Relation& relation : model.relations) out.push_back({"relation", relation.name, relation.declared, fmt::format("({})", fmt::join(relation.fields, ", "))});
  add_cells(model, out);
  for (const Table& table : model.tables) out.push_back({"table", table.name, table.declared, fmt::format("({}) -> {}", listed(model, table.parameters), model.sets[index(table.result)].name)});
  for (const Map& map : model.maps) out.push_back({"map", map.name, map.declared, ""});
  for (const Template& rule : model.templates) out.push_back({"rule", rule.name, rule.span, "at " + model.levels[rule.level]});
  for (const Prototype& prototype : model.prototypes) out.push_back({"prototype", prototype.name, prototype.declared, ""});
  for (const Sensor& sensor : model.sensors) out.push_back({"sensor", sensor.name, sensor.declared, sensor.text ? "text" : sensor.unit});
  for (const fuzzy::Controller& controller : model.fuzzy) out.push_back({"fuzzy", controller.name, controller.declared, ""});
  for (const Control& control : model.controls) out.push_back({"control", model[control.strategy].name, control.span, "= " + control.controller});
  std::stable_sort(out.begin(), out.end(), [](const KnownName& a, const KnownName& b) { return a.name < b.name; });
  return out;
}

}  // namespace kb::model
