#include <algorithm>
#include <map>

#include <waymark/runtime/image_layout.h>
#include <waymark/runtime/state.h>
#include "compiler/program/net_effects.h"
#include "compiler/tables/compact.h"
#include "compiler/tables/perception.h"
#include "compiler/tables/planes.h"
#include "compiler/tables/tables.h"
#include "compiler/tables/planes.h"

namespace kb::tables {
namespace {

/// The size of the tables in bytes, with indexes of type `Ix`.
template <class Ix>
std::size_t table_bytes(const Tables& t) {
  std::size_t total = 0;
#define KB_ARRAY(name, type, length) total += t.name.size() * sizeof(type);
  MTS_IMAGE_TABLES(KB_ARRAY)
#undef KB_ARRAY
  return total;
}

/// How many rules can be awake at once. Of the rules that sleep under members of an exclusive group, only those of one member can.
std::uint32_t most_awake(const Tables& t, const program::Program& p) {
  std::map<std::uint32_t, std::uint32_t> by_key;
  for (const I key : t.rule_key) ++by_key[key];
  const std::vector<std::uint32_t> group_of = program::group_of_cells(p);
  std::vector<std::uint32_t> most(p.exclusive.size(), 0);
  std::uint32_t sum = 0;
  for (const auto& [key, rules] : by_key) {
    const AtomOrigin& o = t.origins[key];
    const bool high = o.kind == AtomOrigin::Kind::kTerm && o.term == program::Term::kHigh;
    const std::uint32_t g = high ? group_of[index(o.cell)] : program::kNoGroup;
    if (g == program::kNoGroup) sum += rules;
    else most[g] = std::max(most[g], rules);
  }
  for (const std::uint32_t m : most) sum += m;
  return sum;
}

/// The number of rules that contain a conjunction which is counted because it is too long to be written out.
std::uint32_t counted_rules(const Tables& t, const program::Program& p) {
  const auto counted = [&](I literal) {
    const AtomOrigin& o = t.origins[literal >> 1];
    return (literal & 1u) == 0 && o.kind == AtomOrigin::Kind::kNode && p[o.condition].op == program::Cond::Op::kAnd;
  };
  std::uint32_t count = 0;
  for (std::size_t r = 0; r + 1 < t.rules.size(); ++r) {
    const auto begin = t.conditions.begin() + static_cast<std::ptrdiff_t>(t.rules[r].conditions);
    count += std::any_of(begin, t.conditions.begin() + static_cast<std::ptrdiff_t>(t.rules[r + 1].conditions), counted) ? 1 : 0;
  }
  return count;
}

/// The layout of mts::PerceptionTables with indexes of `w` bytes.
std::size_t perception_table_bytes(const PerceptionForm& form, std::size_t w) {
  if (form.empty()) return 0;
  const auto step = sizeof(std::uint32_t) == w ? sizeof(mts::PerceptStep<std::uint32_t>) : sizeof(mts::PerceptStep<std::uint16_t>);
  const auto demand = sizeof(std::uint32_t) == w ? sizeof(mts::Demand<std::uint32_t>) : sizeof(mts::Demand<std::uint16_t>);
  const std::size_t indexes = form.sensor_of.size() + form.fits_begin.size() + 2 * form.fits.size() + form.fact.size() + form.steps_begin.size() +
                              form.uses_begin.size() + form.uses.size() + form.alternatives_begin.size() + form.demands_begin.size();
  return indexes * w + form.sensors.size() * sizeof(mts::Sensor) + form.prototypes.size() * sizeof(mts::Membership) + form.steps.size() * step +
         form.demands.size() * demand + form.lazy.size();
}

/// The size of mts::Perception and the readings, without the facts, which count as part of the mind's state.
std::size_t perception_state_bytes(const mts::PerceptionShape& n) {
  if (n.facts == 0 && n.readings == 0) return 0;
  const std::size_t reading = 3 * sizeof(float) + 3 * sizeof(std::int64_t) + 1, fit = sizeof(float) + 1, fact = sizeof(float) + 1;
  return n.readings * reading + n.fits * fit + n.facts * fact + 2 * sizeof(std::int64_t) + sizeof(mts::SightReport) + 1;
}

/// What walking the tables takes; the degrees of a condition and of what it is `given` have a fixed bound.
std::size_t fuzzy_stack_bytes(const FuzzyForm& form) {
  constexpr std::size_t kWalk = (mts::kMaxFuzzyStack + mts::kMaxFuzzyDepth + 1) * sizeof(float);
  return kWalk + (form.inputs.size() + form.outputs.size() + form.slot_of_degree.size()) * sizeof(float) + form.fired * sizeof(mts::FuzzyFired) +
         form.outputs.size() * (sizeof(mts::FuzzySums) + sizeof(mts::FuzzyStrongest) + sizeof(std::uint32_t));
}

}  // namespace

Budget budget(const Tables& tables, const program::Program& program, bool image) {
  Budget b;
  const mts::Shape& n = tables.shape;
  b.table_bytes = tables.narrow ? table_bytes<std::uint16_t>(tables) : table_bytes<std::uint32_t>(tables);
  b.state_bytes = tables.narrow
                      ? mts::DynamicState<std::uint16_t>::bytes(n) + sizeof(mts::Scalars<std::uint16_t>)
                      : mts::DynamicState<std::uint32_t>::bytes(n) + sizeof(mts::Scalars<std::uint32_t>);
  if (!image) {
    const std::uint32_t planes = build_planes(tables).planes();
    b.state_bytes += mts::mask_state_bytes(n, planes);
    b.mask_bytes = mts::mask_table_bytes(n, planes);
    if (against_compact(tables, program).empty()) b.compact_state_bytes = compact_state_bytes(n, compact_shape(tables));
  }
  for (const program::Cell& cell : program.cells) b.name_bytes += cell.name.size() + 1;
  for (const program::Rule& rule : program.rules) b.name_bytes += rule.name.size() + 1;
  const PerceptionForm perception = build_perception(program);
  b.perception_table_bytes = perception_table_bytes(perception, tables.narrow ? 2 : 4);
  b.perception_state_bytes = perception_state_bytes(perception.shape);
  if (b.perception_table_bytes != 0) b.perception_stack_bytes = mts::kMaxPerceptDepth * sizeof(float);
  for (const FuzzyForm& form : tables.fuzzy) {
    b.fuzzy_table_bytes += bytes(form);
    b.fuzzy_stack_bytes = std::max(b.fuzzy_stack_bytes, fuzzy_stack_bytes(form));
  }
  b.facts = n.facts;
  b.satellites = n.satellites;
  b.strategies = n.strategies;
  b.rules = n.rules;
  b.atoms = n.atoms;
  b.nodes = n.nodes;
  b.timers = n.timers;
  b.counted = counted_rules(tables, program);
  b.most_awake = most_awake(tables, program);
  return b;
}

}  // namespace kb::tables
