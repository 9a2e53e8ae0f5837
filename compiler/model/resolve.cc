// The model as a table of contents.
#include "compiler/model/draft.h"

namespace kb::model {

Model resolve(const Forest& forest, diagnostics::Diagnostics& diagnostics) {
  Draft draft(forest, diagnostics);
  constexpr void (*kSteps[])(Draft&) = {
      declare_levels,  declare_sets,    declare_all,    finish_maps,       declare_prototypes,
      declare_sensors, declare_fuzzy,   declare_tables, apply_settings,    plan_routes,
      write_rows,      plan_detours,    attach_satellites, read_perception, order_perception,
      resolve_kept_conditions,          expand_rules,   order_strategies,  bind_controllers,
  };
  for (const auto step : kSteps) {
    if (!draft.exhausted) step(draft);
  }
  if (draft.model.levels.empty()) {
    // Without levels there is nothing to run: only a strategy needs the control level then.
    if (!draft.said_no_levels && !draft.library_missing && !draft.model.priority.empty()) {
      diagnostics.report(diagnostics::Kind::kNoLevels, draft.model[draft.model.priority.front()].declared);
    }
    draft.model.levels.emplace_back("control");
    draft.model.level_spans.emplace_back();
  }
  return std::move(draft.model);
}

}  // namespace kb::model
