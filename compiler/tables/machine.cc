// The runtime's engine on tables in memory. It returns the compiler's record of a tick.
#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include <waymark/runtime/engine.h>
#include <waymark/runtime/swap.h>
#include "compiler/program/net_effects.h"
#include "compiler/source/same_number.h"
#include "compiler/tables/image.h"
#include "compiler/tables/tables.h"

namespace kb::tables {

/// An engine, whatever the width of its indexes.
struct Machine::Impl {
  explicit Impl(const program::Program& p) : program(p) {}
  virtual ~Impl() = default;
  virtual program::Tick tick(std::span<const float> facts, std::uint32_t dt_us) = 0;
  virtual void reset() = 0;
  [[nodiscard]] virtual std::unique_ptr<Impl> taken_over_by(const program::Program& next, const LoadedImage& image) const = 0;
  virtual void poke(std::uint32_t satellite, float value) = 0;
  [[nodiscard]] virtual float value(std::size_t cell) const = 0;
  [[nodiscard]] virtual bool seen(std::size_t fact) const = 0;
  const program::Program& program;
};

namespace {

using source::same_number;
static_assert(same_number(program::Status::kOk, mts::Status::kOk) && same_number(program::Status::kNoStrategy, mts::Status::kNoStrategy) &&
              same_number(program::Status::kHolding, mts::Status::kHolding) && same_number(program::Status::kHoldExpired, mts::Status::kHoldExpired) &&
              same_number(program::Status::kBadFact, mts::Status::kBadFact) && same_number(program::Status::kConflict, mts::Status::kConflict) &&
              same_number(program::Status::kTwoStrategies, mts::Status::kTwoStrategies));

template <class Id, class Index>
std::vector<Id> sorted(const Index* list, std::uint32_t count) {
  std::vector<Id> out;
  out.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) out.push_back(Id{list[i]});
  std::sort(out.begin(), out.end());
  return out;
}

/// Reads the last tick out of the state, in the program's ids.
template <class Index>
program::Tick tick_of(const mts::DynamicState<Index>& s, const program::Program& program) {
  program::Tick tick;
  tick.number = s.ticks;
  tick.time_us = s.now_us;
  tick.events = sorted<program::CellId>(s.event_list, s.events);
  tick.lost = sorted<program::CellId>(s.lost_list, s.lost);
  tick.fired = sorted<program::RuleId>(s.fired_list, s.fired);
  for (std::uint32_t i = 0; i < s.changed; ++i) tick.set.push_back({program::CellId{s.changes[i].cell}, s.changes[i].value});
  std::sort(tick.set.begin(), tick.set.end(), [](const auto& a, const auto& b) { return a.cell < b.cell; });
  std::vector<mts::Conflict<Index>> conflicts(s.conflict_list, s.conflict_list + s.conflicts);
  std::sort(conflicts.begin(), conflicts.end(), [](const auto& a, const auto& b) {
    return a.level != b.level ? a.level < b.level : a.cell < b.cell;
  });
  for (const auto& c : conflicts) {
    const program::CellId cell{c.cell};
    tick.conflicts.push_back({cell, program::writers_among(program, tick.fired, c.level, cell)});
  }
  for (std::uint32_t i = 0; i < s.active; ++i) tick.active.push_back(program::CellId{s.active_list[i] + program.first_strategy()});
  if (s.strategy != 0) tick.strategy = program::CellId{s.strategy - 1 + program.first_strategy()};
  tick.bad_facts = s.bad_facts;
  tick.status = static_cast<program::Status>(s.status);
  return tick;
}

template <class Index>
struct MachineOf final : Machine::Impl {
  using State = mts::DynamicState<Index>;

  MachineOf(const program::Program& p, const mts::Tables<Index>& tables)
      : Impl(p), view(tables), memory((State::bytes(view.shape) + 7) / 8) {
    state.attach(view.shape, reinterpret_cast<std::byte*>(memory.data()));
    engine().reset();
  }
  MachineOf(const program::Program& p, const mts::Image<Index>& from) : MachineOf(p, from.tables) { image = &from; }

  mts::Engine<State, mts::DynamicTables<Index>> engine() { return {mts::DynamicTables<Index>(view), state}; }

  program::Tick tick(std::span<const float> facts, std::uint32_t dt_us) override {
    auto running = engine();
    for (std::uint32_t i = 0; i < program.facts; ++i) running.take_fact(i, i < facts.size() ? facts[i] : 0.0f);
    running.advance(dt_us);
    return tick_of(state, program);
  }
  void reset() override { engine().reset(); }
  [[nodiscard]] std::unique_ptr<Impl> taken_over_by(const program::Program& next, const LoadedImage& to) const override {
    if (image == nullptr) throw std::logic_error("a machine that runs on no image has no names to carry anything over by");
    return to.visit([&]<class Other>(const mts::Image<Other>& fresh) -> std::unique_ptr<Impl> {
      auto machine = std::make_unique<MachineOf<Other>>(next, fresh);
      mts::carry_over(*image, state, fresh, machine->state, [](const mts::SwapLoss&) {});
      return machine;
    });
  }
  void poke(std::uint32_t satellite, float value) override { engine().poke(satellite, value); }
  [[nodiscard]] float value(std::size_t cell) const override { return state.cf[cell]; }
  [[nodiscard]] bool seen(std::size_t fact) const override { return (state.fact_flags[fact] & mts::kSeen) != 0; }

  mts::Tables<Index> view;
  const mts::Image<Index>* image = nullptr;
  std::vector<std::uint64_t> memory;
  State state;
};

}  // namespace

Machine::Machine(const program::Program& program, const Tables& tables)
    : impl_(std::make_unique<MachineOf<I>>(program, view(tables))) {}
Machine::Machine(const program::Program& program, const LoadedImage& image)
    : impl_(image.visit([&]<class Index>(const mts::Image<Index>& from) -> std::unique_ptr<Impl> {
        return std::make_unique<MachineOf<Index>>(program, from);
      })) {}
Machine::~Machine() = default;
Machine::Machine(Machine&&) noexcept = default;

program::Tick Machine::tick(std::span<const float> facts, std::uint32_t dt_us) { return impl_->tick(facts, dt_us); }

void Machine::reset() { impl_->reset(); }

void Machine::take(const program::Program& program, const LoadedImage& image) { impl_ = impl_->taken_over_by(program, image); }

float Machine::value(program::CellId cell) const { return impl_->value(index(cell)); }

void Machine::poke(program::CellId satellite, float value) {
  impl_->poke(static_cast<std::uint32_t>(index(satellite)) - impl_->program.facts, value);
}

bool Machine::seen(program::CellId fact) const { return impl_->seen(index(fact)); }

}  // namespace kb::tables
