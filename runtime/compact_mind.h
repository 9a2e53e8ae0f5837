// A mind for a small microcontroller, as `kbc compile --compact` emits it. It makes the same decisions as mts::Mind, tick by tick, with half
// the tables and less than half the memory. It needs no floating point unit: certainties are compared as integers, and blends of rules
// that write -1, 0 and 1 are ratios of integers.
//
//   route1::Mind mind;
//   for (;;) {
//     mind.give(route1::Fact::Line, line_sensor.certainty());
//     const auto decision = mind.tick(mts::milliseconds(20));
//     route1::drive(decision, controllers);
//   }
#pragma once

#include "compact_state.h"
#include "compact_tables.h"
#include "mind.h"

namespace mts {

/// A running compact mind. Holds all of its memory; may be static, on the stack, or copied; threads as for mts::Mind. Perception, which looks at all
/// certainties at once, needs the ordinary mind.
///
/// All functions that need the tables are compiled once, in the emitted source.
template <class K>
class CompactMind {
 public:
  using State = StateOf<K>;
  using Facts = typename K::Facts;

  static_assert(K::kAbi == kAbi, "this knowledge base was compiled for another version of the runtime: compile it again (with CMake: run cmake, then build)");

  CompactMind() { reset(); }

  /// Returns to the state at start-up.
  void reset();

  /// Gives a fact its certainty from the next tick on, in [-1, 1]. Facts that are not given keep theirs; at start-up 0.
  void give(typename K::Fact fact, float certainty);
  /// One tick, `since_last` after the one before (ignored on the first; longer than 35 minutes counts as 35), with the facts as
  /// given. Never fails. Cost: see note [what a tick costs].
  Decision<K> tick(Duration since_last);
  /// The same with all facts taken from `facts`, whatever was given before it, which costs their memory once more.
  Decision<K> tick(Facts& facts, Duration since_last);

  /// The decision of the last tick.
  [[nodiscard]] Decision<K> decision() const { return Decision<K>(state_); }
  [[nodiscard]] float value(typename K::Fact fact) const { return state_.fact_cf[static_cast<std::uint32_t>(fact)]; }
  [[nodiscard]] float value(typename K::Satellite satellite) const;
  /// Whether rules ran the strategy on the last tick. False of one that only goes on because it is held, or named by `idle`: see Mind::ran.
  [[nodiscard]] bool ran(typename K::Strategy strategy) const {
    return bits::test(state_.strategy_set, static_cast<std::uint32_t>(strategy));
  }
  [[nodiscard]] bool high(typename K::Satellite satellite) const;
  /// Whether some satellite of the fact is high.
  [[nodiscard]] bool attended(typename K::Fact fact) const { return state_.attended[static_cast<std::uint32_t>(fact)] != 0; }
  /// Sets a satellite between two ticks, for tests: see Mind::set. False, and nothing is set, if no rule writes the satellite:
  /// a compact mind has no memory for it, only its initial value among the constants.
  bool set(typename K::Satellite satellite, float value);

 private:
  using TheEngine = Engine<State, CompactTables<K>>;
  State state_;
};

template <class K>
void CompactMind<K>::reset() {
  TheEngine(CompactTables<K>{}, state_).reset();
}

template <class K>
void CompactMind<K>::give(typename K::Fact fact, float certainty) {
  TheEngine(CompactTables<K>{}, state_).take_fact(static_cast<std::uint32_t>(fact), certainty);
}

template <class K>
Decision<K> CompactMind<K>::tick(Duration since_last) {
  constexpr std::uint32_t kLongest = 0x7FFF'FFFF;   // see note [compact state]
  TheEngine(CompactTables<K>{}, state_).advance(since_last.us < kLongest ? since_last.us : kLongest);
  return Decision<K>(state_);
}

template <class K>
Decision<K> CompactMind<K>::tick(Facts& facts, Duration since_last) {
  for (std::uint32_t f = 0; f < K::kShape.facts; ++f) give(static_cast<typename K::Fact>(f), facts.store().value[f]);
  return tick(since_last);
}

template <class K>
float CompactMind<K>::value(typename K::Satellite satellite) const {
  const std::uint32_t slot = CompactTables<K>::slot(static_cast<std::uint32_t>(satellite));
  if (slot == K::kCompact.written) return CompactTables<K>{}->initial[static_cast<std::uint32_t>(satellite)];
  return state_.satellite_cf[slot];
}

template <class K>
bool CompactMind<K>::high(typename K::Satellite satellite) const {
  return compact::ordered(value(satellite)) >= compact::ordered(K::kTables.firing);
}

template <class K>
bool CompactMind<K>::set(typename K::Satellite satellite, float value) {
  const auto at = static_cast<std::uint32_t>(satellite);
  if (CompactTables<K>::slot(at) == K::kCompact.written) return false;
  TheEngine(CompactTables<K>{}, state_).poke(at, value);
  return true;
}

}  // namespace mts
