// A new mind while driving: between two ticks, the state of a running engine is carried over to another image. Freestanding.
// docs/image.md explains this at length, with its consequences.
//
// note [what carries over]
// Things are the same in two images if they have the same name (timers: the same key, see TimerKey).
//   fact       its certainty, whether it is seen, whether it came or went on the last tick. A new fact is unknown and unseen.
//   satellite  its value. A new one has its initial value.
//   strategy   whether it is active, dispatched, held. A new one is not.
//   rule       that it has fired and is disarmed until its condition fails, if it is `when` in both. A new rule is armed: if
//              its condition holds, it fires on the next tick.
//   timer      since when its condition holds, and that it is over. A new timer begins on the next tick.
//   the clock, the count of ticks, since when no strategy is active. What has stopped does not go on where `hold` may last longer.
// What only the old image has is lost, and is reported if there was something to lose. Everything else follows from these and from the
// new tables. A swap to the same image therefore changes nothing in the ticks that follow.
#pragma once

#include <cstdint>

#include "engine.h"
#include "image.h"

namespace mts {

enum class Loss : std::uint8_t {
  kFact,       ///< was known or seen; `value` is its certainty
  kSatellite,  ///< was not at its initial value; `value` is what it had
  kStrategy,   ///< was active, drove or was held
  kRule,       ///< had fired and its condition held: one that does the same under another name fires again
  kTimer,      ///< was running (`value` 0) or over (1); `name` is its level's
};
// As in runtime/status.h.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wswitch-default"
[[nodiscard]] constexpr const char* text(Loss what) {
  switch (what) {
    case Loss::kFact: return "fact";
    case Loss::kSatellite: return "satellite";
    case Loss::kStrategy: return "strategy";
    case Loss::kRule: return "rule";
    case Loss::kTimer: return "timer";
  }
  return "unknown";
}
#pragma GCC diagnostic pop

/// Something that could not be carried over. The name points into the old image.
struct SwapLoss {
  Loss what;
  const char* name;
  float value;
};

/// How much of the old image was carried over, and how much is new in the new one.
struct SwapReport {
  struct Count { std::uint32_t carried = 0, lost = 0, fresh = 0; };
  Count facts, satellites, strategies, rules, timers;   ///< `lost` counts all that the new image lacks, also what was not told
  std::uint32_t told = 0;                               ///< calls of the callback
};

/// Carries from image `A` to image `B` (std::uint16_t or std::uint32_t). Use `carry_over`.
template <class A, class B>
class Transplant {
 public:
  using To = Engine<DynamicState<B>, DynamicTables<B>>;

  Transplant(const Image<A>& from, const DynamicState<A>& before, const Image<B>& to, DynamicState<B>& after)
      : old_(from), o_(before), new_(to), s_(after), engine_(DynamicTables<B>(to.tables), after) {}

  template <class F>
  SwapReport run(F&& lost) {
    engine_.reset();
    clock();
    facts(lost);
    satellites(lost);
    attention();
    strategies(lost);
    engine_.settle();
    timers(lost);
    engine_.settle();
    rules(lost);
    engine_.resume();
    return report_;
  }

 private:
  /// Calls `both(old, new)` for things of one name and `only(old)` for what the new image lacks, in the order of names.
  template <class Both, class Only>
  void pair_up(ImageKind kind, SwapReport::Count& count, Both&& both, Only&& only) {
    const auto a = old_.range(kind);
    const auto b = new_.range(kind);
    std::uint32_t k = 0;
    for (std::uint32_t i = 0; i < a.count; ++i) {
      const std::uint32_t x = old_.names.order[a.first + i] - a.first;
      int order = 1;
      while (k < b.count && (order = image::compare(new_.name(kind, new_.names.order[b.first + k] - b.first), old_.name(kind, x))) < 0) ++k;
      if (k < b.count && order == 0) {
        both(x, new_.names.order[b.first + k++] - b.first);
        ++count.carried;
      } else {
        only(x);
        ++count.lost;
      }
    }
    count.fresh = b.count - count.carried;
  }

  template <class F>
  void tell(F& lost, Loss what, const char* name, float value) {
    ++report_.told;
    lost(SwapLoss{what, name, value});
  }

  void clock() {
    s_.now_us = o_.now_us;
    s_.last_active_us = o_.last_active_us;
    s_.ticks = o_.ticks;
    s_.status = o_.status;
    s_.driving = o_.driving;
    const std::int64_t over_us = s_.now_us - new_.tables.hold_limit_us - 1;
    if (s_.driving == Status::kHoldExpired && s_.last_active_us > over_us) s_.last_active_us = over_us;
  }

  template <class F>
  void facts(F& lost) {
    const auto& atoms = new_.tables.fact_atoms;
    pair_up(ImageKind::kFact, report_.facts,
        [&](std::uint32_t x, std::uint32_t f) {
          s_.cf[f] = o_.cf[x];
          engine_.set_terms(f, s_.cf[f]);
          s_.fact_flags[f] = o_.fact_flags[x] & (kSeen | kBad);
          if ((o_.fact_flags[x] & kBad) != 0) ++s_.bad_given;
          if ((o_.fact_flags[x] & kSeen) != 0 && atoms[f].seen != 0) engine_.flip(atoms[f].seen);
        },
        [&](std::uint32_t x) {
          if (o_.cf[x] != 0.0f || (o_.fact_flags[x] & kSeen) != 0) tell(lost, Loss::kFact, old_.name(ImageKind::kFact, x), o_.cf[x]);
        });
    s_.bad_facts = s_.bad_given;   // of those that are carried over
    for (std::uint32_t i = 0; i < o_.events; ++i) {
      const std::uint32_t f = counterpart(o_.event_list[i]);
      if (f == new_.tables.shape.facts) continue;
      s_.event_list[s_.events++] = static_cast<B>(f);
      if (atoms[f].event != 0) engine_.flip(atoms[f].event);
    }
    for (std::uint32_t i = 0; i < o_.lost; ++i) {
      const std::uint32_t f = counterpart(o_.lost_list[i]);
      if (f == new_.tables.shape.facts) continue;
      s_.lost_list[s_.lost++] = static_cast<B>(f);
      if (atoms[f].lost != 0) engine_.flip(atoms[f].lost);
    }
  }
  [[nodiscard]] std::uint32_t counterpart(std::uint32_t fact) const {
    return new_.find(ImageKind::kFact, old_.name(ImageKind::kFact, fact));
  }

  template <class F>
  void satellites(F& lost) {
    const std::uint32_t old_facts = old_.tables.shape.facts;
    pair_up(ImageKind::kSatellite, report_.satellites,
        [&](std::uint32_t x, std::uint32_t i) { engine_.restore(i, o_.cf[old_facts + x]); },
        [&](std::uint32_t x) {
          const float value = o_.cf[old_facts + x];
          if (value != old_.tables.initial[x]) tell(lost, Loss::kSatellite, old_.name(ImageKind::kSatellite, x), value);
        });
  }

  /// How many satellites of each fact are high; and which facts must be looked at again, because what they are noticed by
  /// has changed, or because the old engine was to look at them.
  void attention() {
    const Tables<B>& t = new_.tables;
    for (std::uint32_t f = 0; f < t.shape.facts; ++f) s_.attended[f] = 0;
    for (std::uint32_t i = 0; i < s_.recheck; ++i) s_.fact_flags[s_.recheck_list[i]] &= static_cast<std::uint8_t>(~kRecheck);
    s_.recheck = 0;
    for (std::uint32_t i = 0; i < t.shape.satellites; ++i) {
      if (!(s_.cf[t.shape.facts + i] >= t.firing)) continue;
      for (std::uint32_t k = t.attends_begin[i]; k < t.attends_begin[i + 1]; ++k) ++s_.attended[t.attends[k]];
    }
    for (std::uint32_t f = 0; f < t.shape.facts; ++f) {
      const std::uint32_t x = old_.find(ImageKind::kFact, new_.name(ImageKind::kFact, f));
      const bool fresh = x == old_.tables.shape.facts;
      const bool same = !fresh && t.fact_atoms[f].plain == old_.tables.fact_atoms[x].plain &&
                        t.fact_atoms[f].attended == old_.tables.fact_atoms[x].attended &&
                        (s_.attended[f] != 0) == (o_.attended[x] != 0) && (o_.fact_flags[x] & kRecheck) == 0;
      if (fresh ? s_.attended[f] != 0 : !same) engine_.recheck(f);
    }
  }

  template <class F>
  void strategies(F& lost) {
    const Shape &from = old_.tables.shape, &to = new_.tables.shape;
    pair_up(ImageKind::kStrategy, report_.strategies,
        [&](std::uint32_t x, std::uint32_t u) {
          s_.cf[to.facts + to.satellites + u] = o_.cf[from.facts + from.satellites + x];
          engine_.set_terms(to.facts + to.satellites + u, s_.cf[to.facts + to.satellites + u]);
          if (o_.strategy == x + 1u) s_.strategy = static_cast<B>(u + 1);
          if (o_.held == x + 1u) s_.held = static_cast<B>(u + 1);
        },
        [&](std::uint32_t x) {
          const float value = o_.cf[from.facts + from.satellites + x];
          if (value > 0.0f || o_.strategy == x + 1u || o_.held == x + 1u) tell(lost, Loss::kStrategy, old_.name(ImageKind::kStrategy, x), value);
        });
    if (o_.strategy != 0 && s_.strategy == 0) {   // the strategy that drove no longer exists
      if (s_.status == s_.driving) s_.status = Status::kNoStrategy;
      s_.driving = Status::kNoStrategy;
    }
    for (std::uint32_t i = 0; i < to.strategies; ++i) {
      const B u = new_.tables.priority[i];
      if (s_.cf[to.facts + to.satellites + u] > 0.0f) s_.active_list[s_.active++] = u;
    }
  }

  template <class F>
  void timers(F& lost) {
    const std::uint32_t m = old_.tables.shape.timers, n = new_.tables.shape.timers;
    const std::uint32_t first = new_.tables.shape.first_timer();
    std::uint32_t k = 0;
    for (std::uint32_t i = 0; i < m; ++i) {
      const std::uint32_t x = old_.names.timer_order[i];
      const TimerKey& key = old_.names.timer_key[x];
      while (k < n && new_.names.timer_key[new_.names.timer_order[k]].before(key)) ++k;
      const bool there = k < n && new_.names.timer_key[new_.names.timer_order[k]] == key;
      if (!there) {
        ++report_.timers.lost;
        if (o_.timer_state[x] != kTimerOff) tell(lost, Loss::kTimer, level_of(x), o_.timer_state[x] == kTimerDone ? 1.0f : 0.0f);
        continue;
      }
      const std::uint32_t timer = new_.names.timer_order[k++];
      ++report_.timers.carried;
      s_.timer_state[timer] = o_.timer_state[x];
      if (o_.timer_state[x] == kTimerWaits) engine_.link_since(timer, o_.start_us[x]);
      if (o_.timer_state[x] == kTimerDone) engine_.flip(first + timer);
    }
    report_.timers.fresh = n - report_.timers.carried;
  }
  [[nodiscard]] const char* level_of(std::uint32_t timer) const {
    std::uint32_t l = 0;
    for (; l + 1 < old_.tables.shape.levels; ++l) {
      const Level<A>& level = old_.tables.levels[l];
      if (level.first_stage != level.end_stage && timer < old_.tables.stages[level.end_stage - 1u].end_timer) break;
    }
    return old_.name(ImageKind::kLevel, l);
  }

  template <class Ix>
  [[nodiscard]] static bits::RuleBit bit_of(const Tables<Ix>& t, std::uint32_t rule) { return bits::of_rule(t.word_rule, t.shape.words, rule); }

  template <class F>
  void rules(F& lost) {
    pair_up(ImageKind::kRule, report_.rules,
        [&](std::uint32_t x, std::uint32_t r) {
          const bits::RuleBit from = bit_of(old_.tables, x), to = bit_of(new_.tables, r);
          const bool whiles = (old_.tables.while_rules[from.word] & from.bit) != 0;
          if ((o_.rules[from.word].done & from.bit) == 0 || whiles != ((new_.tables.while_rules[to.word] & to.bit) != 0)) return;
          s_.rules[to.word].done |= to.bit;
        },
        [&](std::uint32_t x) {
          const bits::RuleBit from = bit_of(old_.tables, x);
          const bool fired = (o_.rules[from.word].done & ~old_.tables.while_rules[from.word] & from.bit) != 0;
          if (fired) tell(lost, Loss::kRule, old_.name(ImageKind::kRule, x), 0.0f);
        });
  }

  const Image<A>& old_;
  const DynamicState<A>& o_;
  const Image<B>& new_;
  DynamicState<B>& s_;
  To engine_;
  SwapReport report_;
};

/// Makes `after` the state that corresponds to `before` under the new image: see note [what carries over]. `after` must be attached to
/// memory for the new image's shape. `lost(const SwapLoss&)` is called for what is lost; it must not keep the names longer than the old
/// image lives. `before` is not changed, so until the next tick you can go back. Never fails. Cost: linear in the names and state of both
/// images; a timer begun out of order costs a step for each timer that it precedes.
template <class A, class B, class F>
SwapReport carry_over(const Image<A>& from, const DynamicState<A>& before, const Image<B>& to, DynamicState<B>& after, F&& lost) {
  return Transplant<A, B>(from, before, to, after).run(lost);
}

}  // namespace mts
