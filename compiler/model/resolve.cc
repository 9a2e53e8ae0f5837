// The model as a table of contents.
#include <algorithm>

#include "compiler/model/draft.h"

namespace kb::model {

Model resolve(const Forest& forest, diagnostics::Diagnostics& diagnostics, StandardNames* standard, std::size_t first_leg) {
  if (diagnostics.broken()) report_only_certain(forest, diagnostics);
  Draft draft(forest, diagnostics);
  draft.library = standard;
  draft.first_leg = first_leg;
  constexpr void (*kSteps[])(Draft&) = {
      declare_levels,  declare_sets,    declare_all,    declare_prototypes,
      declare_sensors, declare_fuzzy,   declare_tables, apply_settings,    plan_routes,
      report_islands, write_rows,      plan_detours,    attach_satellites, read_perception, order_perception,
      resolve_kept_conditions,          forget_roads,   expand_rules,   order_strategies,  bind_controllers,
      report_unused,
  };
  for (const auto step : kSteps) {
    if (!draft.exhausted) step(draft);
  }
  if (draft.model.levels.empty()) {
    // A knowledge base without levels has nothing to run; it needs the control level only if it has a strategy.
    if (!draft.said_no_levels && !draft.library_missing && !draft.model.priority.empty()) {
      report_no_levels(draft, draft.model[draft.model.priority.front()].declared);
    }
    draft.model.levels.emplace_back("control");
    draft.model.level_spans.emplace_back();
  }
  return std::move(draft.model);
}

void forget_details(Model& model) {
  const auto has_cell = [](const Row& row) { return row.cell != CellId::kNone; };
  std::vector<Row> rows;
  rows.reserve(static_cast<std::size_t>(std::count_if(model.rows.begin(), model.rows.end(), has_cell)));
  std::vector<RowId> number(model.rows.size(), RowId::kNone);
  for (std::size_t i = 0; i < model.rows.size(); ++i) {
    if (!has_cell(model.rows[i])) continue;
    number[i] = RowId{static_cast<std::uint32_t>(rows.size())};
    rows.emplace_back();
    rows.back().relation = model.rows[i].relation;
    rows.back().cell = model.rows[i].cell;
  }
  const auto renumber = [&](std::vector<RowId>& ids) {
    for (RowId& id : ids) id = number[index(id)];
    std::erase(ids, RowId::kNone);
    ids.shrink_to_fit();
  };
  for (Relation& relation : model.relations) renumber(relation.rows);
  for (Map& map : model.maps) {
    renumber(map.landmarks);
    source::release(map.roads);
    source::release(map.bends);
  }
  model.rows = std::move(rows);
  source::release(model.values);
  source::release(model.points);
  source::release(model.kept);
  source::release(model.tables);
}

void forget_rules(Model& model) {
  source::release(model.conds);
  std::erase_if(model.rules, [](const Rule& rule) { return rule.effects.size() <= 1; });
  model.rules.shrink_to_fit();
}

}  // namespace kb::model
