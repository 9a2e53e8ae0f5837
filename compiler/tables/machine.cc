// The runtime's engine on tables in memory, speaking the compiler's own record of a tick.
#include <algorithm>
#include <cstddef>

#include "compiler/program/net_effects.h"
#include "compiler/tables/tables.h"
#include "runtime/engine.h"

namespace kb::tables {

struct Machine::Impl {
  using State = mts::DynamicState<I>;

  Impl(const program::Program& p, const Tables& tables)
      : program(p), view(tables::view(tables)), memory((State::bytes(view.shape) + 7) / 8) {
    state.attach(view.shape, reinterpret_cast<std::byte*>(memory.data()));
    engine().reset();
  }

  mts::Engine<State, mts::DynamicTables<I>> engine() { return {mts::DynamicTables<I>(view), state}; }

  const program::Program& program;
  mts::Tables<I> view;
  std::vector<std::uint64_t> memory;
  State state;
};

Machine::Machine(const program::Program& program, const Tables& tables)
    : impl_(std::make_unique<Impl>(program, tables)) {}
Machine::~Machine() = default;
Machine::Machine(Machine&&) noexcept = default;

namespace {

template <class Id>
std::vector<Id> sorted(const I* list, I count, std::uint32_t offset = 0) {
  std::vector<Id> out;
  out.reserve(count);
  for (I i = 0; i < count; ++i) out.push_back(Id{list[i] + offset});
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

program::Tick Machine::tick(std::span<const float> facts, std::uint32_t dt_us) {
  Impl::State& s = impl_->state;
  const program::Program& program = impl_->program;
  auto engine = impl_->engine();
  for (std::uint32_t i = 0; i < program.facts; ++i) engine.take_fact(i, i < facts.size() ? facts[i] : 0.0f);
  engine.advance(dt_us);

  program::Tick tick;
  tick.number = s.ticks;
  tick.time_us = s.now_us;
  tick.events = sorted<program::CellId>(s.event_list, s.events);
  tick.lost = sorted<program::CellId>(s.lost_list, s.lost);
  tick.fired = sorted<program::RuleId>(s.fired_list, s.fired);
  for (I i = 0; i < s.changed; ++i) tick.set.push_back({program::CellId{s.changes[i].cell}, s.changes[i].value});
  std::sort(tick.set.begin(), tick.set.end(), [](const auto& a, const auto& b) { return a.cell < b.cell; });
  std::vector<mts::Conflict<I>> conflicts(s.conflict_list, s.conflict_list + s.conflicts);
  std::sort(conflicts.begin(), conflicts.end(), [](const auto& a, const auto& b) {
    return a.level != b.level ? a.level < b.level : a.cell < b.cell;
  });
  for (const auto& c : conflicts) {
    const program::CellId cell{c.cell};
    tick.conflicts.push_back({cell, program::writers_among(program, tick.fired, c.level, cell)});
  }
  const std::uint32_t first_strategy = program.facts + program.satellites;
  for (I i = 0; i < s.active; ++i) tick.active.push_back(program::CellId{s.active_list[i] + first_strategy});
  if (s.strategy != 0) tick.strategy = program::CellId{s.strategy - 1 + first_strategy};
  tick.bad_facts = s.bad_facts;
  tick.status = static_cast<program::Status>(s.status);
  return tick;
}

void Machine::reset() { impl_->engine().reset(); }

float Machine::value(program::CellId cell) const { return impl_->state.cf[index(cell)]; }

void Machine::poke(program::CellId satellite, float value) {
  impl_->engine().poke(static_cast<std::uint32_t>(index(satellite)) - impl_->program.facts, value);
}

bool Machine::seen(program::CellId fact) const { return (impl_->state.fact_flags[index(fact)] & mts::kSeen) != 0; }

}  // namespace kb::tables
