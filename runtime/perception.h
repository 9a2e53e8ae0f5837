// Perception: readings become facts. Freestanding: no heap, no exceptions, no recursion; a reading can be anything.
//
//   mission::Readings readings;
//   mission::Perception perception;
//   mission::Mind mind;
//   for (;;) {
//     readings.range[2] = {echo_m, measured_at};
//     perception.facts().Start1 = button ? 1.0f : -1.0f;     // set given facts as usual, before the look, which may read them
//     mission::Facts& facts = perception.look(readings, now, mind);
//     drive(mind.tick(facts, mts::milliseconds(20)), controllers);
//   }
//
// note [what a look costs]
//   A reading whose value and spread have not changed costs a comparison. A changed one is compared with each prototype that facts
//   compare it with, once however many facts do. Then each perceived fact is computed in a few operations. A lazy fact that nobody
//   waits for costs only the check whether somebody does.
//
// note [who waits for a fact]
//   A lazy fact is perceived on a tick only if, as the last tick left the satellites,
//     - one of its own satellites is high, or
//     - some rule that reads it has all the satellites that its condition asks for as plain parts of its `and`, or
//     - a fact that is perceived on this tick is defined by it.
//   Else it is 0: nothing is known. Each of the first two is an *alternative*: a list of demands on cells, which must all hold.
//
// note [a clock that is set back]
//   A reading is new if its instant is another than at the look before. Its age is then what the host's clock says, and grows on a clock
//   of perception's own, which stands while the host's is set back: a silent sensor does not become young again. A new reading from the
//   future, as clocks differ a little, counts as measured now; if it is ahead by more than a second or than its `stale`, as none.
#pragma once

#include <cstdint>

#include "bits.h"
#include "certainty.h"
#include "mind.h"
#include "perception_tables.h"
#include "readings.h"
#include "sight.h"

namespace mts {

/// What is kept from one look to the next: arrays with the lengths that the shape gives. The caller owns them.
struct PerceptionState {
  float* value = nullptr;          ///< readings: as it is taken
  float* spread = nullptr;         ///< readings: of the datum; below 0: there is none
  float* fit = nullptr;            ///< fits: certainty
  std::uint8_t* known = nullptr;   ///< fits: `fit` is that of the present reading
  float* certainty = nullptr;      ///< facts
  std::uint8_t* needed = nullptr;  ///< facts
  std::int64_t* at_us = nullptr;   ///< readings: the instant that the present one states, if there is one
  std::int64_t* born_us = nullptr; ///< readings: that of the present one on perception's own clock, or kNoReading, or kRefused
  std::int64_t now_us = 0;         ///< the host's clock at the last look
  std::int64_t clock_us = 0;       ///< see note [a clock that is set back]
  bool first = true;
  SightReport report;
};

/// One look over tables that may be constants. `S` is anything with `value`, `at_us` and `there`, as ReadingStore has.
template <class Ix>
class PerceptionEngine {
 public:
  constexpr PerceptionEngine(const PerceptionTables<Ix>& tables, PerceptionState& state) : t(tables), s(state) {}

  void reset() {
    for (std::uint32_t r = 0; r < t.shape.readings; ++r) {
      s.value[r] = 0.0f;
      s.spread[r] = -1.0f;
      s.born_us[r] = kNoReading;
    }
    for (std::uint32_t f = 0; f < t.shape.fits; ++f) {
      s.fit[f] = 0.0f;
      s.known[f] = 0;
    }
    for (std::uint32_t f = 0; f < t.shape.facts; ++f) {
      s.certainty[f] = 0.0f;
      s.needed[f] = 1;
    }
    s.now_us = s.clock_us = 0;
    s.first = true;
    s.report = {};
  }

  /// `cells`: the mind's certainties as its last tick left them. `given`: those of facts that are not perceived.
  template <class S>
  void look(const S& readings, Instant now, const float* cells, float firing, const float* given) {
    s.report = {};
    if (!s.first && now.us < s.now_us) worsen(Sight::kTimeBackwards);
    else if (!s.first && __builtin_add_overflow(s.clock_us, age_at(now, s.now_us), &s.clock_us)) s.clock_us = INT64_MAX;
    s.now_us = now.us;
    s.first = false;
    take_all(readings, now);
    if (t.lazy != nullptr) settle_needs(cells, firing);
    put_all_together(given);
  }

 private:
  static constexpr std::int64_t kNoReading = INT64_MIN, kRefused = INT64_MAX;
  static constexpr float kMostAhead_s = 1.0f;

  void worsen(Sight sight) {
    if (sight > s.report.sight) s.report.sight = sight;
  }
  void count(std::uint32_t& counter, Sight sight) {
    ++counter;
    worsen(sight);
  }

  struct Datum { float value, spread; };

  /// When a reading was measured, on perception's own clock: see note [a clock that is set back].
  [[nodiscard]] std::int64_t born(std::uint32_t r, const Sensor& sensor, std::int64_t at_us, bool there, Instant now) {
    std::int64_t& birth = s.born_us[r];
    if (!there) return birth = kNoReading;
    if (birth != kNoReading && s.at_us[r] == at_us) return birth;
    s.at_us[r] = at_us;
    const std::int64_t age_us = age_at(now, at_us);
    const bool refused = age_us < 0 && static_cast<float>(age_us) * -1e-6f > least(kMostAhead_s, sensor.stale_s);
    return birth = refused ? kRefused : age_at({s.clock_us}, age_us);
  }

  /// What a reading says now. A spread below 0 means that it says nothing.
  [[nodiscard]] Datum take(const Sensor& sensor, float value, std::int64_t born_us) {
    if (born_us == kNoReading) {
      if (!sensor.text) count(s.report.silent, Sight::kSilent);
      return {value, -1.0f};
    }
    if (!is_finite(value)) {
      count(s.report.not_a_number, Sight::kNotANumber);
      return {value, -1.0f};
    }
    if (sensor.strict && (value < sensor.low || value > sensor.high)) {   // the error code of a sensor
      count(s.report.out_of_range, Sight::kBeyondRange);
      return {value, -1.0f};
    }
    std::int64_t age_us = age_at({s.clock_us}, born_us);
    if (age_us < 0) {
      count(s.report.from_the_future, Sight::kFromTheFuture);
      if (born_us == kRefused) return {value, -1.0f};
      age_us = 0;
    }
    const float age_s = static_cast<float>(age_us) * 1e-6f;
    const bool stale = age_s > sensor.stale_s;
    if (stale) count(s.report.stale, Sight::kStale);
    if (sensor.text) return {value, stale ? -1.0f : 0.0f};
    return {into_range(sensor, value), aged_spread(sensor.noise, sensor.growth, age_s)};
  }

  /// Where no fact is lazy every fit is needed, and those of a changed reading are computed while it is at hand.
  template <class S>
  void take_all(const S& readings, Instant now) {
    const PerceptionTables<Ix> table = t;   // copies: what is stored below cannot change them
    const PerceptionState to = s;
    const bool at_once = table.lazy == nullptr;
    std::uint32_t fits = 0;
    for (std::uint32_t r = 0; r < table.shape.readings; ++r) {
      const Sensor& sensor = table.sensors[table.sensor_of[r]];
      const Datum datum = take(sensor, readings.value[r], born(r, sensor, readings.at_us[r], readings.there[r] != 0, now));
      if (datum.spread == to.spread[r] && datum.value == to.value[r]) continue;
      if (datum.spread < 0.0f && to.spread[r] < 0.0f) continue;
      to.spread[r] = datum.spread;
      to.value[r] = datum.value;
      const std::uint32_t end = table.fits_begin[r + 1];
      for (std::uint32_t f = table.fits_begin[r]; f < end; ++f) {
        if (at_once) to.fit[f] = hold(table, table.fits[f].prototype, datum, sensor.text);
        fits += at_once ? 1u : 0u;
        to.known[f] = at_once ? 1 : 0;
      }
    }
    s.report.fits += fits;
  }

  [[nodiscard]] float into_range(const Sensor& sensor, float value) {
    if (sensor.period > 0.0f) return wrapped(value, sensor.low, sensor.period);
    const float inside = clamped(value, sensor.low, sensor.high);
    if (inside != value) count(s.report.out_of_range, Sight::kBeyondRange);
    return inside;
  }

  [[nodiscard]] static bool holds(const Demand<Ix>& demand, float x, float firing) {
    const float size = x < 0.0f ? -x : x;
    const bool is = demand.term == 2 ? x >= firing : demand.term == 0 ? x <= -firing : 1.0f - size >= firing;
    return is != demand.negated;
  }

  /// See note [who waits for a fact]. From the last fact to the first, so that a fact knows who is defined by it.
  void settle_needs(const float* cells, float firing) {
    for (std::uint32_t f = 0; f < t.shape.facts; ++f) s.needed[f] = t.lazy[f] == 0 ? 1 : 0;
    for (std::uint32_t f = t.shape.facts; f-- > 0;) {
      if (s.needed[f] == 0 && awaited(f, cells, firing)) s.needed[f] = 1;
      if (s.needed[f] == 0) continue;
      for (std::uint32_t u = t.uses_begin[f]; u < t.uses_begin[f + 1]; ++u) s.needed[t.uses[u]] = 1;
    }
  }

  [[nodiscard]] bool awaited(std::uint32_t f, const float* cells, float firing) const {
    for (std::uint32_t a = t.alternatives_begin[f]; a < t.alternatives_begin[f + 1]; ++a) {
      bool all = true;
      for (std::uint32_t d = t.demands_begin[a]; all && d < t.demands_begin[a + 1]; ++d) {
        all = holds(t.demands[d], cells[t.demands[d].cell], firing);
      }
      if (all) return true;
    }
    return false;
  }

  [[nodiscard]] static float hold(const PerceptionTables<Ix>& table, std::uint32_t prototype, Datum datum, bool text) {
    if (!(datum.spread >= 0.0f)) return 0.0f;
    if (text) return datum.value == static_cast<float>(prototype) ? 1.0f : -1.0f;
    return certainty(table.prototypes[prototype], datum.value, datum.spread);
  }

  [[nodiscard]] float fit(std::uint32_t f, bool text) {
    if (s.known[f] != 0) return s.fit[f];
    const FitRow<Ix>& row = t.fits[f];
    s.fit[f] = hold(t, row.prototype, {s.value[row.reading], s.spread[row.reading]}, text);
    s.known[f] = 1;
    ++s.report.fits;
    return s.fit[f];
  }

  void put_all_together(const float* given) {
    const PerceptionTables<Ix> table = t;
    float* const certainty = s.certainty;
    const std::uint8_t* const needed = s.needed;
    std::uint32_t asleep = 0;
    std::uint32_t first = 0;
    for (std::uint32_t f = 0; f < table.shape.facts; ++f) {
      const std::uint32_t end = table.steps_begin[f + 1];
      const bool wanted = needed[f] != 0;
      certainty[f] = wanted ? put_together(table, first, end, given) : 0.0f;
      asleep += wanted ? 0u : 1u;
      first = end;
    }
    s.report.asleep += asleep;
    s.report.facts += table.shape.facts - asleep;
  }

  /// The top of the stack is kept apart: most facts are one step.
  [[nodiscard]] float put_together(const PerceptionTables<Ix>& table, std::uint32_t first, std::uint32_t end, const float* given) {
    float stack[kMaxPerceptDepth];
    std::uint32_t below = 0;
    float top = 0.0f;
    for (std::uint32_t i = first; i < end; ++i) {
      const PerceptStep<Ix> step = table.steps[i];
      if (step.op <= PerceptOp::kFact && i != first) stack[below++] = top;
// As in runtime/status.h.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wswitch-default"
      switch (step.op) {
        case PerceptOp::kFits: top = fit(step.argument, false); break;
        case PerceptOp::kReads: top = fit(step.argument, true); break;
        case PerceptOp::kFact: {
          const float x = step.argument < table.shape.facts ? s.certainty[step.argument] : given[step.argument - table.shape.facts];
          top = is_nan(x) ? 0.0f : clamped(x, -1.0f, 1.0f);
          break;
        }
        case PerceptOp::kNot: top = 0.0f - top; break;
        case PerceptOp::kAnd: top = least(stack[--below], top); break;
        case PerceptOp::kOr: top = greatest(stack[--below], top); break;
      }
#pragma GCC diagnostic pop
    }
    return top;
  }

  const PerceptionTables<Ix>& t;
  PerceptionState& s;
};

/// The perception of a knowledge base: its memory between two looks, and the facts that it computes. `P` is the generated description:
/// tables, shape, and the knowledge base `P::Knowledge` that the facts belong to. It holds no pointers into itself, so it may be copied.
template <class P>
class Perception {
 public:
  using Knowledge = typename P::Knowledge;
  using Facts = typename Knowledge::Facts;
  using Readings = typename P::Readings;

  static_assert(P::kAbi == kAbi, "this perception was compiled for another version of the runtime: compile it again (with CMake: run cmake, then build)");

  Perception() { reset(); }

  /// Returns to the state at start-up: nothing has been read, and all of `facts()` are 0, also given ones.
  void reset();

  /// Computes the perceived facts from the readings at this time. `mind` tells which facts are awaited. Writes into `facts()` and returns
  /// it; given facts stay as they were set. Set them before the look, since perceived facts may be defined by them. Never fails;
  /// `report()` tells what was wrong with the readings. Cost: see note [what a look costs].
  Facts& look(const Readings& readings, Instant now, const Mind<Knowledge>& mind);

  [[nodiscard]] Facts& facts() { return facts_; }
  [[nodiscard]] const SightReport& report() const { return report_; }

 private:
  using Ix = typename P::Index;
  static constexpr std::uint32_t length(std::uint32_t n) { return n == 0 ? 1 : n; }

  PerceptionState attach() {
    return {value_, spread_, fit_, known_, certainty_, needed_, at_us_, born_us_, now_us_, clock_us_, first_, report_};
  }
  void detach(const PerceptionState& state) {
    now_us_ = state.now_us;
    clock_us_ = state.clock_us;
    first_ = state.first;
    report_ = state.report;
  }

  Facts facts_;
  float value_[length(P::kShape.readings)] = {};
  float spread_[length(P::kShape.readings)] = {};
  float fit_[length(P::kShape.fits)] = {};
  std::uint8_t known_[length(P::kShape.fits)] = {};
  float certainty_[length(P::kShape.facts)] = {};
  std::uint8_t needed_[length(P::kShape.facts)] = {};
  std::int64_t at_us_[length(P::kShape.readings)] = {}, born_us_[length(P::kShape.readings)] = {};
  std::int64_t now_us_ = 0, clock_us_ = 0;
  bool first_ = true;
  SightReport report_;
};

// Not inline, as Mind's: see note [the engine stands where its tables are]. And the user's code may be compiled with
// contracted floats, the generated .cc is not: see runtime/math.h.

template <class P>
void Perception<P>::reset() {
  PerceptionState state = attach();
  PerceptionEngine<Ix>(P::kTables, state).reset();
  detach(state);
  facts_.clear();   // in place: a fresh object to assign would need 4 bytes of stack a fact
}

template <class P>
typename Perception<P>::Facts& Perception<P>::look(const Readings& readings, Instant now, const Mind<Knowledge>& mind) {
  PerceptionState state = attach();
  PerceptionEngine<Ix>(P::kTables, state)
      .look(readings.store(), now, mind.certainties(), Knowledge::kTables.firing, facts_.store().value);
  detach(state);
  for (std::uint32_t f = 0; f < P::kShape.facts; ++f) {
    const std::uint32_t fact = P::kTables.fact[f];
    if (facts_.store().value[fact] != certainty_[f]) facts_.store().set(fact, certainty_[f]);
  }
  return facts_;
}

}  // namespace mts
