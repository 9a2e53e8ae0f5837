#include "compiler/analysis/analysis.h"

#include "compiler/analysis/subject.h"

namespace kb::analysis {
namespace {

/// Such as what is left of a file that was cut off. What a module may consist of is something; a level and the relation Command are always there.
bool is_empty(const model::Model& model) {
  const bool levels = !model.level_spans.empty() && model.level_spans.front().known();
  return !levels && model.cells.empty() && model.sets.empty() && model.relations.size() <= 1 && model.tables.empty() && model.maps.empty() &&
         model.prototypes.empty() && model.sensors.empty() && model.fuzzy.empty();
}

/// Reports levels that no rule uses. The control level always has rules.
void diagnose_levels(Subject& subject) {
  const program::Program& program = subject.program;
  std::vector<bool> used(program.levels.size(), false);
  for (const program::Rule& rule : program.rules) used[rule.level] = true;
  for (std::size_t i = 0; i + 1 < used.size(); ++i) {
    if (used[i]) continue;
    const auto place = i < subject.model.level_spans.size() ? subject.model.level_spans[i] : source::Span{};
    subject.diagnostics.report(diagnostics::Kind::kEmptyLevel, place, {program.levels[i]});
  }
}

}  // namespace

void diagnose(const model::Model& model, const program::Program& program, const KnownArguments& known, diagnostics::Diagnostics& diagnostics) {
  if (is_empty(model)) {
    diagnostics.report(diagnostics::Kind::kNothingDeclared, {source::FileId{0}, 0, 0}, {});
    return;
  }
  Subject subject(model, program, diagnostics);
  diagnose_levels(subject);
  diagnose_look_alikes(subject);
  diagnose_cells(subject);
  diagnose_strategies(subject);
  diagnose_circles(subject);
  diagnose_arguments(subject, known);
  diagnose_lasting(subject);
  diagnose_priority(subject);
  diagnose_conditions(subject);
  diagnose_effects(subject);
  diagnose_already_so(subject);
  diagnose_silenced(subject);
  diagnose_taken_back(subject);
  diagnose_gaps(subject);
  diagnose_conflicts(subject);
  diagnose_loose_timers(subject);
  diagnose_lost_to_reset(subject);
  diagnose_lazy(subject);
  diagnose_perception(subject);
  diagnose_fuzzy(program, diagnostics);
}

}  // namespace kb::analysis
