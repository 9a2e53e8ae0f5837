// An engine on an image, for tests: its memory, its trace, a swap that leaves the old one behind, and a program of many facts.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <waymark/runtime/swap.h>
#include "compiler/tables/image.h"
#include "tests/unit/program/program_builder.h"

namespace kb::tables::testing {

/// A state on a view; `I` is the width of the image's indexes.
template <class I>
struct Running {
  using State = mts::DynamicState<I>;

  explicit Running(const mts::Image<I>& from) : image(from), memory(State::bytes(from.tables.shape) / 8 + 1, 0xA5A5A5A5A5A5A5A5u) {
    state.attach(image.tables.shape, reinterpret_cast<std::byte*>(memory.data()));
  }
  mts::Engine<State, mts::DynamicTables<I>> engine() { return {mts::DynamicTables<I>(image.tables), state}; }

  void tick(const std::vector<float>& facts, std::uint32_t dt_us) {
    auto running = engine();
    for (std::uint32_t f = 0; f < image.tables.shape.facts; ++f) running.take_fact(f, f < facts.size() ? facts[f] : 0.0f);
    running.advance(dt_us);
  }

  /// Everything that the last tick decided, and every cell.
  [[nodiscard]] std::string trace() const {
    const auto list = [](const I* items, std::uint32_t count) {
      std::vector<I> all(items, items + count);
      std::sort(all.begin(), all.end());
      return fmt::format("[{}]", fmt::join(all, " "));
    };
    std::string out = fmt::format("{} {} events{} lost{} fired{} active{} strategy {} held {} bad {} {}", state.ticks, state.now_us,
                                  list(state.event_list, state.events), list(state.lost_list, state.lost),
                                  list(state.fired_list, state.fired), list(state.active_list, state.active), state.strategy,
                                  state.held, state.bad_facts, mts::text(state.status));
    std::vector<std::string> rest;
    for (std::uint32_t i = 0; i < state.changed; ++i) rest.push_back(fmt::format(" {}:={}", state.changes[i].cell, state.changes[i].value));
    for (std::uint32_t i = 0; i < state.conflicts; ++i) {
      rest.push_back(fmt::format(" conflict {}@{}", state.conflict_list[i].cell, state.conflict_list[i].level));
    }
    std::sort(rest.begin(), rest.end());
    for (const std::string& text : rest) out += text;
    for (std::uint32_t c = 0; c < image.tables.shape.cells(); ++c) out += fmt::format(" {}", state.cf[c]);
    return out;
  }

  mts::Image<I> image;
  std::vector<std::uint64_t> memory;
  State state;
};

/// What goes over to another image; losses are counted in the report.
template <class A, class B>
[[nodiscard]] std::unique_ptr<Running<B>> swapped(const Running<A>& from, const mts::Image<B>& to, mts::SwapReport& report,
                                                  std::vector<std::string>* losses = nullptr) {
  auto next = std::make_unique<Running<B>>(to);
  report = mts::carry_over(from.image, from.state, next->image, next->state, [&](const mts::SwapLoss& loss) {
    if (losses != nullptr) losses->push_back(fmt::format("{} {} {}", mts::text(loss.what), loss.name, loss.value));
  });
  return next;
}

/// `facts` facts, each with a satellite, and a few rules about the first forty; above 32,767 facts indexes need 32 bits.
inline program::Program many_facts(std::size_t facts) {
  using namespace program::testing;
  ProgramBuilder b({"goal", "control"});
  for (std::size_t i = 0; i < facts; ++i) b.fact("F" + std::to_string(i));
  b.strategy("Go").strategy("Wait");
  for (std::size_t i = 0; i < 40; ++i) {
    const std::string name = "F" + std::to_string(i);
    b.when("note " + name, "goal", all({held(seen(name), 300'000)}), {raise("sat " + name), i % 2 == 0 ? raise("sat Go") : lower("sat Go")});
  }
  b.when("wait", "goal", all({event("F1")}), {raise("sat Wait")});
  return b.build();
}

}  // namespace kb::tables::testing
