// The tables as the engine reads them.
#include "compiler/tables/form.h"

namespace kb::tables {

mts::Tables<I> view(const Tables& t) {
  mts::Tables<I> v;
  v.shape = t.shape;
  v.firing = t.firing;
  v.idle = t.idle;
  v.idle_strategy = t.idle_strategy;
  v.hold_limit_us = t.hold_limit_us;
  v.atoms = t.atoms.data();
  v.readers = t.readers.data();
  v.parents = t.parents.data();
  v.timer_inputs = t.timer_inputs.data();
  v.broad = t.broad.empty() ? nullptr : t.broad.data();
  v.cell_atoms = t.cell_atoms.data();
  v.fact_atoms = t.fact_atoms.data();
  v.attends_begin = t.attends_begin.data();
  v.attends = t.attends.data();
  v.nodes = t.nodes.data();
  v.timers = t.timers.data();
  v.queue_us = t.queue_us.data();
  v.stages = t.stages.data();
  v.levels = t.levels.data();
  v.rules = t.rules.data();
  v.word_rule = t.word_rule.data();
  v.while_rules = t.while_rules.data();
  v.reset_rules = t.reset_rules.data();
  v.conditions = t.conditions.data();
  v.writes = t.writes.data();
  v.clears = t.clears.data();
  v.values = t.values.data();
  v.group_of = t.group_of.empty() ? nullptr : t.group_of.data();
  v.group_slot = t.group_slot.data();
  v.group_begin = t.group_begin.data();
  v.priority = t.priority.data();
  v.initial = t.initial.data();
  v.keep = t.keep.data();
  v.initial_truth = t.initial_truth.data();
  v.initial_count = t.initial_count.data();
  v.child_begin = t.child_begin.data();
  v.children = t.children.data();
  v.is_and = t.is_and.data();
  v.atom_cell = t.atom_cell.data();
  v.atom_term = t.atom_term.data();
  return v;
}

}  // namespace kb::tables
