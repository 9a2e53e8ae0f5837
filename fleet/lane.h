// Moves the state of one robot of a fleet from the planes to the scalar engine and back. Needed for robots whose rules contradict each
// other or blend a cell: that takes numbers that planes do not have.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "clock.h"
#include "memory.h"
#include "../runtime/mind.h"

namespace mts {

/// A plane that the host gives, and the certainties from `low` to `high` for which its bit is 1.
struct PlaneRange {
  std::uint32_t plane;
  float low, high;
  /// Without a branch, which a processor would guess wrong.
  [[nodiscard]] bool has(float certainty) const { return static_cast<int>(certainty >= low) & static_cast<int>(certainty <= high); }
};

/// Facts of knowledge base `K` as planes.
template <class K>
struct FactPlanes {
  /// The planes that a fact may have, without that of bad facts; `plane` is kNoPlane for those that it has not.
  [[nodiscard]] static std::array<PlaneRange, 5> ranges(const FleetFact& at, std::uint32_t fact) {
    constexpr float kAll = std::numeric_limits<float>::infinity();
    const float firing = K::kTables.firing, zero = zero_up_to(firing);
    const auto& limits = K::kTables.fact_atoms[fact];
    return {{{at.high, firing, kAll}, {at.low, -kAll, -firing}, {at.zero, -zero, zero},
             {at.plain, std::nextafter(limits.plain, kAll), kAll}, {at.attended, std::nextafter(limits.attended, kAll), kAll}}};
  }
  /// A certainty that the host may have given to the robot: exactly that one if it is kept, otherwise one that leads to the same decisions.
  [[nodiscard]] static float certainty(const FleetMemory& memory, FleetPlace place, const FleetFact& at, std::uint32_t fact,
                                       const float* weight) {
    const bool bad = memory.test(place, at.bad);
    if (weight != nullptr) return !bad ? *weight : *weight == 0.0f ? NAN : *weight * 2.0f;
    const std::array<PlaneRange, 5> all = ranges(at, fact);
    const auto may_be = [&](float x) {
      return std::all_of(all.begin(), all.end(), [&](const PlaneRange& r) { return !memory.has(r.plane) || memory.test(place, r.plane) == r.has(x); });
    };
    if (bad) return may_be(0.0f) ? NAN : may_be(1.0f) ? 2.0f : -2.0f;   // what they count as
    for (const float x : {0.0f, 1.0f, -1.0f}) {
      if (may_be(x)) return x;
    }
    for (const PlaneRange& r : all) {
      for (const float x : {r.low, r.high, std::nextafter(r.low, -2.0f), std::nextafter(r.high, 2.0f)}) {
        if (x >= -1.0f && x <= 1.0f && may_be(x)) return x;
      }
    }
    return 0.0f;
  }

 private:
  /// The greatest x for which 1 - x, as floats round it, is `firing` or more. Such x form an interval, and floats from 0 on are ordered as
  /// their bits.
  static float zero_up_to(float firing) {
    std::uint32_t yes = 0, no = std::bit_cast<std::uint32_t>(1.0f) + 1;
    while (no - yes > 1) {
      const std::uint32_t middle = yes + (no - yes) / 2;
      (1.0f - std::bit_cast<float>(middle) >= firing ? yes : no) = middle;
    }
    return std::bit_cast<float>(yes);
  }
};

/// Carries robots between a fleet's planes and the engine's state.
template <class K>
class LanePort {
 public:
  using State = StateOf<K>;
  /// Tables are compile-time constants only in the mind's own source: see note [the engine stands where its tables are].
  using Tables = DynamicTables<typename K::Index>;
  using TheEngine = Engine<State, Tables>;
  static_assert(!State::kCompact, "a compact knowledge base has no fleet");

  LanePort(const FleetTables& planes, FleetMemory& memory, const FleetClock& clock, const std::uint32_t* stamp_bits)
      : p_(planes), memory_(memory), clock_(clock), bits_(stamp_bits) {}

  /// Sets `s` to the robot's state as the last tick left it, with the facts as they are now. The clock must stand at the tick to come.
  /// `weight(fact)`: address of the fact's certainty, or null.
  template <class F>
  void take_out(FleetPlace at, State& s, F&& weight) const {
    TheEngine engine(Tables(K::kTables), s);
    engine.reset();
    s.now_us = clock_.last_us();
    s.ticks = clock_.ticks() - 1;
    satellites(at, s, engine);
    facts(at, s, engine, weight);
    strategies(at, s, engine);
    engine.settle();
    timers(at, s, engine);
    engine.settle();
    for (std::uint32_t r = 0; r < K::kShape.rules; ++r) {
      const auto rule = bit_of(r);
      if (memory_.test(at, p_.rules[r].done)) s.rules[rule.word].done |= rule.bit;
    }
    engine.resume();
  }

  /// Gives the robot its facts of this tick, and ticks it.
  template <class F>
  void tick(FleetPlace at, State& s, std::uint32_t dt_us, F&& weight) const {
    TheEngine engine(Tables(K::kTables), s);
    for (std::uint32_t f = 0; f < K::kShape.facts; ++f) {
      engine.take_fact(f, FactPlanes<K>::certainty(memory_, at, p_.facts[f], f, weight(f)));
    }
    engine.advance(dt_us);
  }

  /// The strategy that runs because it is wanted or held, by its number; kNoPlane if none does.
  [[nodiscard]] static std::uint32_t runs(const State& s) {
    const bool idle = s.active == 0 && K::kTables.idle == Idle::kStrategy;
    return idle || s.strategy == 0 ? kNoPlane : s.strategy - 1u;
  }

  /// Writes the state into the planes. Returns whether they can represent it; if not, the robot stays on the scalar engine.
  bool put_back(FleetPlace at, const State& s) {
    if (!representable(s)) return false;
    for (std::uint32_t i = 0; i < K::kShape.satellites; ++i) put_satellite(at, i, s.cf[K::kShape.facts + i]);
    for (std::uint32_t f = 0; f < K::kShape.facts; ++f) memory_.put(at, p_.facts[f].seen, (s.fact_flags[f] & kSeen) != 0);
    each_bit(s, [&](std::uint32_t plane, bool value) { memory_.put(at, plane, value); });
    put_stamps(at, s);
    bool agree = true;   // derived parts with their values: certain only after a tick without contradictions
    each_bit(s, [&](std::uint32_t plane, bool value) { agree = agree && (plane == kNoPlane || memory_.test_made(at, plane) == value); });
    return agree;
  }

 private:
  static bits::RuleBit bit_of(std::uint32_t rule) { return bits::of_rule(K::kTables.word_rule, K::kShape.words, rule); }

  template <class E>
  void satellites(FleetPlace at, State& s, E& engine) const {
    for (std::uint32_t f = 0; f < K::kShape.facts; ++f) s.attended[f] = 0;
    for (std::uint32_t i = 0; i < s.recheck; ++i) s.fact_flags[s.recheck_list[i]] = 0;
    s.recheck = 0;
    for (std::uint32_t i = 0; i < K::kShape.satellites; ++i) {
      const FleetSatellite& satellite = p_.satellites[i];
      const float value = p_.values[satellite.values + memory_.code(at, satellite.plane, satellite.bits)];
      engine.restore(i, value);
      if (value >= K::kTables.firing) engine.attend(i, true);
    }
  }

  template <class E, class F>
  void facts(FleetPlace at, State& s, E& engine, F&& weight) const {
    for (std::uint32_t f = 0; f < K::kShape.facts; ++f) {
      const SaneFact fact = sane_fact(FactPlanes<K>::certainty(memory_, at, p_.facts[f], f, weight(f)));
      s.cf[f] = fact.value;
      engine.set_terms(f, fact.value);
      if (fact.bad) engine.flip_flag(f, kBad);
      if (fact.bad) ++s.bad_given;
      engine.recheck(f);
      if (!memory_.test(at, p_.facts[f].seen)) continue;
      engine.flip_flag(f, kSeen);
      if (K::kTables.fact_atoms[f].seen != 0) engine.flip(K::kTables.fact_atoms[f].seen);
    }
  }

  template <class E>
  void strategies(FleetPlace at, State& s, E& engine) const {
    using Ix = typename State::Ix;
    const std::uint32_t first = K::kShape.facts + K::kShape.satellites;
    for (std::uint32_t i = 0; i < K::kShape.strategies; ++i) {
      const Ix u = K::kTables.priority[i];
      if (memory_.test(at, p_.strategies[u].active)) {
        s.cf[first + u] = 1.0f;
        engine.set_terms(first + u, 1.0f);
        s.active_list[s.active++] = u;
      }
      if (memory_.test(at, p_.strategies[u].runs)) s.strategy = static_cast<Ix>(u + 1);
      if (memory_.test(at, p_.strategies[u].held)) s.held = static_cast<Ix>(u + 1);
    }
    const std::uint32_t hold = K::kShape.timers;
    s.last_active_us = clock_.last_us() - K::kTables.hold_limit_us - 1;
    if (memory_.test(at, p_.timers[hold].on) && !memory_.test(at, p_.timers[hold].over)) s.last_active_us = began_us(at, hold, K::kShape.queues);
  }

  [[nodiscard]] std::int64_t began_us(FleetPlace at, std::uint32_t timer, std::uint32_t queue) const {
    const std::uint32_t low = memory_.stamp(at, timer, bits_[queue]);
    const std::uint32_t mask = (std::uint32_t{1} << bits_[queue]) - 1u;
    return clock_.time_us(clock_.last_stamp() - ((clock_.last_stamp() - low) & mask));
  }

  template <class E>
  void timers([[maybe_unused]] FleetPlace at, [[maybe_unused]] State& s, [[maybe_unused]] E& engine) const {
    if constexpr (K::kShape.timers != 0) {
      for (std::uint32_t i = 0; i < K::kShape.timers; ++i) {
        if (!memory_.test(at, p_.timers[i].on)) continue;
        const bool over = memory_.test(at, p_.timers[i].over);
        s.timer_state[i] = over ? kTimerDone : kTimerWaits;
        if (over) engine.flip(K::kShape.first_timer() + i);
        else engine.link_since(i, began_us(at, i, K::kTables.timers[i].queue));
      }
    }
  }

  [[nodiscard]] bool representable(const State& s) const {
    for (std::uint32_t i = 0; i < K::kShape.satellites; ++i) {
      if (code_of(i, s.cf[K::kShape.facts + i]) == p_.satellites[i].count) return false;
    }
    for (std::uint32_t g = 0; g < p_.group_count; ++g) {
      std::uint32_t high = 0;
      for (std::uint32_t k = p_.group_begin[g]; k < p_.group_begin[g + 1]; ++k) {
        high += s.cf[K::kShape.facts + p_.groups[k]] >= K::kTables.firing ? 1 : 0;
      }
      if (high > 1) return false;
    }
    for (std::uint32_t r = 0; r < K::kShape.rules; ++r) {
      const auto rule = bit_of(r);
      const bool disarmed = (s.rules[rule.word].done & ~K::kTables.while_rules[rule.word] & rule.bit) != 0;
      if (disarmed && p_.rules[r].done == kNoPlane) return false;
    }
    return true;
  }
  /// Calls `f(plane, value)` for each plane that strategies, rules and timers may have.
  template <class F>
  void each_bit(const State& s, F&& f) const {
    for (std::uint32_t u = 0; u < K::kShape.strategies; ++u) {
      f(p_.strategies[u].active, s.cf[K::kShape.facts + K::kShape.satellites + u] > 0.0f);
      f(p_.strategies[u].runs, runs(s) == u);
      f(p_.strategies[u].held, s.held == u + 1u);
    }
    for (std::uint32_t r = 0; r < K::kShape.rules; ++r) {
      const auto rule = bit_of(r);
      f(p_.rules[r].done, (s.rules[rule.word].done & rule.bit) != 0);
    }
    for (std::uint32_t i = 0; i < K::kShape.timers; ++i) {
      f(p_.timers[i].on, s.timer_state[i] != kTimerOff);
      f(p_.timers[i].over, s.timer_state[i] == kTimerDone);
    }
    f(p_.timers[K::kShape.timers].on, holding(s));
    f(p_.timers[K::kShape.timers].over, held_for_too_long(s));
  }
  /// Whether no strategy is active and one is held.
  [[nodiscard]] static bool holding(const State& s) { return s.active == 0 && s.held != 0; }
  [[nodiscard]] bool held_for_too_long(const State& s) const {
    return holding(s) && clock_.now_us() - s.last_active_us > K::kTables.hold_limit_us;
  }
  /// The code of a satellite's value; `count` if it is none of its values.
  [[nodiscard]] std::uint32_t code_of(std::uint32_t satellite, float value) const {
    const FleetSatellite& at = p_.satellites[satellite];
    std::uint32_t code = 0;
    while (code < at.count && p_.values[at.values + code] != value) ++code;
    return code;
  }
  void put_satellite(FleetPlace at, std::uint32_t i, float value) {
    const std::uint32_t code = code_of(i, value);
    for (std::uint32_t b = 0; b < p_.satellites[i].bits; ++b) memory_.put(at, p_.satellites[i].plane + b, (code >> b & 1u) != 0);
  }

  void put_stamps(FleetPlace at, const State& s) {
    for (std::uint32_t i = 0; i < K::kShape.timers; ++i) {
      if (s.timer_state[i] == kTimerWaits) memory_.put_stamp(at, i, bits_[K::kTables.timers[i].queue], clock_.stamp_of(s.start_us[i]));
    }
    const std::uint32_t hold = K::kShape.timers;
    if (p_.timers[hold].on != kNoPlane && holding(s) && !held_for_too_long(s)) {
      memory_.put_stamp(at, hold, bits_[K::kShape.queues], clock_.stamp_of(s.last_active_us));
    }
  }

  const FleetTables& p_;
  FleetMemory& memory_;
  const FleetClock& clock_;
  const std::uint32_t* bits_;   // of stamps, by queue
};

}  // namespace mts
