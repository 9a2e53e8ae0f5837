// One tick: facts are noticed, the levels run one after another, the strategy is chosen. Part of runtime/engine.h.
#pragma once

#include "engine.h"

namespace mts {

/// Sets all of the state to 0, in place: a temporary object of that size would lie on the stack.
template <class S, class T>
inline void Engine<S, T>::clear() {
  if constexpr (S::kConstantShape) {
    ::new (static_cast<void*>(&s)) S{};
  } else {
    static_cast<Scalars<Ix>&>(s) = Scalars<Ix>{};
    [[maybe_unused]] const Shape& shape = t->shape;
#define KB_ARRAY(name, type, length) \
  for (std::uint32_t i = 0; i < (length); ++i) s.name[i] = type{};
    MTS_STATE_ARRAYS(KB_ARRAY)
#undef KB_ARRAY
  }
}

template <class S, class T>
inline void Engine<S, T>::reset() {
  const Shape& n = shape();
  clear();
  for (std::uint32_t i = 0; i < n.satellites; ++i) {
    if constexpr (kCompact) {
      if (t.slot(i) == S::bounds.written) continue;
    }
    put_satellite(n.facts + i, t->initial[i]);
  }
  for (std::uint32_t i = 0; i < n.strategies; ++i) put(n.facts + n.satellites + i, -1.0f);
  for (std::uint32_t i = 0; i < n.nodes; ++i) s.count[i] = static_cast<Ix>(t->initial_count[i]);
  for (std::uint32_t a = 0; a < n.atoms; ++a) set_truth(a, false);
  for (std::uint32_t a = 0; a < n.atoms; ++a) {
    if (!bits::test(t->initial_truth, a)) continue;
    set_truth(a, true);
    if constexpr (kCompact) follow(a, true);
    else tell_readers(a, true);
  }
  for (std::uint32_t i = 0; i < n.timers; ++i) bits::set(s.timer_set, i);  // on the first tick each timer looks at its condition
  for (std::uint32_t w = 0; w < timer_words(); ++w) bits::note_full(s.timer_sum, w, timer_words());
  s.timers_changed = true;
  s.due_us = (std::numeric_limits<std::int64_t>::max)();
  for (std::uint32_t i = 0; i < n.satellites; ++i) {
    if (at_least(t->initial[i], t->firing)) attend(i, true);
    if (!same(t->initial[i], -1.0f)) note_live(i, true);
  }
}

template <class S, class T>
inline void Engine<S, T>::take_fact(std::uint32_t fact, float raw) {
  bool bad = false;
  const float value = sane(raw, bad);
  if (bad != flag(fact, kBad)) {
    flip_flag(fact, kBad);
    if (bad) ++s.bad_given;
    else --s.bad_given;
    s.quiet = false;
  }
  if (same(value_of(fact), value)) return;
  put(fact, value);
  s.quiet = false;
  set_terms(fact, value);
  recheck(fact);
}

template <class S, class T>
inline void Engine<S, T>::forget_events() {
  for (std::uint32_t i = 0; i < s.events; ++i) {
    const std::uint32_t atom = t->fact_atoms[s.event_list[i]].event;
    if (atom != 0) flip(atom);
  }
  for (std::uint32_t i = 0; i < s.lost; ++i) {
    const std::uint32_t atom = t->fact_atoms[lost_fact(i)].lost;
    if (atom != 0) flip(atom);
  }
  s.events = s.lost = 0;
}

/// Decides for the facts whose value or attention has changed since the last tick whether they are seen, and so which came (event)
/// and which went (lost). The first tick only decides what is seen.
template <class S, class T>
inline void Engine<S, T>::notice() {
  const bool first = s.ticks == 0;
  const std::uint32_t count = kCompact && s.recheck != 0 ? shape().facts : s.recheck;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t fact = to_recheck(i);
    if (kCompact && !flag(fact, kRecheck)) continue;
    flip_flag(fact, kRecheck);
    const FactAtoms<J>& a = t->fact_atoms[fact];
    const bool was = flag(fact, kSeen);
    const bool now = !at_least(was || s.attended[fact] != 0 ? a.attended : a.plain, value_of(fact));
    if (now == was) continue;
    flip_flag(fact, kSeen);
    s.busy = true;
    if (a.seen != 0) flip(a.seen);
    if (first) continue;
    if (now) s.event_list[s.events++] = static_cast<Ix>(fact);
    else note_lost(fact);
    const std::uint32_t momentary = now ? a.event : a.lost;
    if (momentary != 0) flip(momentary);
  }
  s.recheck = 0;
}

template <class S, class T>
inline void Engine<S, T>::infer(std::uint32_t dt_us) {
  s.busy = s.events != 0 || s.lost != 0;
  if (s.active != 0) s.last_active_us = s.now_us;
  if (s.ticks != 0) s.now_us += dt_us;
  s.fired = s.conflicts = s.wanted = 0;
  forget_events();
  notice();
  settle();
  if constexpr (kStraight) {
    [this]<std::uint32_t... kLevel>(std::integer_sequence<std::uint32_t, kLevel...>) {
      (pass(kLevel), ...);
    }(std::make_integer_sequence<std::uint32_t, kShape.levels>());
  } else {
    for (std::uint32_t l = 0; l < shape().levels; ++l) pass(l);
  }
  commit_strategies();
  settle();
  decide();
  finish();
}

/// Runs one level: its timers, then its rules, then their writes. On most ticks most levels have nothing to do.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::pass(std::uint32_t l) {
  if constexpr (S::kConstantShape) {
    if constexpr (S::shape.rules == 0) return;
  }
  const Level<J>& level = t->levels[l];
  if (timed(level)) run_timers(l);
  if (!asked(level)) return;
  if constexpr (kMasked) {
    if (level.end_word - level.first_word == 1u) return run_word(l);
  }
  const std::uint32_t first = s.fired;
  evaluate_level(l);
  if (s.fired != first) commit(l, first);
}

/// Whether a timer of the level may be due, or the condition of one may have changed.
template <class S, class T>
[[gnu::always_inline]] inline bool Engine<S, T>::timed(const Level<J>& level) const {
  if (level.first_stage == level.end_stage) return false;
  if (s.now_us >= s.due_us) return true;
  if (shape().timers > kWordBits) return s.timers_changed;
  const std::uint32_t first = t->stages[level.first_stage].first_timer, end = t->stages[level.end_stage - 1u].end_timer;
  return (s.timer_set[0] & bits::within(0, first, end)) != 0;
}

/// Whether the level has a rule to evaluate, or one that fires on each tick. Large programs leave that question to the summary.
template <class S, class T>
[[gnu::always_inline]] inline bool Engine<S, T>::asked(const Level<J>& level) const {
  if (many_words()) return true;
  Word todo = 0;
  for (std::uint32_t w = level.first_word; w < level.end_word; ++w) todo |= s.rules[w].pending | (s.rules[w].done & t->while_rules[w]);
  return todo != 0;
}

template <class S, class T>
inline bool Engine<S, T>::holds(std::uint32_t rule) const {
  if constexpr (kMasked) {
    const auto& m = kMasksOf<typename T::Knowledge>.rule[rule];
    Mask wrong = 0;
    for (std::uint32_t w = 0; w < masks_for(kShape.atoms); ++w) wrong |= (s.truth_mask[w] & m.asked[w]) ^ m.wanted[w];
    return wrong == 0;
  }
  const auto [begin, end] = conditions_of(rule);
  for (std::uint32_t i = begin; i < end; ++i) {
    if (!literal(t->conditions[i])) return false;
  }
  return true;
}

template <class S, class T>
[[gnu::always_inline]] inline Word Engine<S, T>::evaluate_word(std::uint32_t word) {
  const std::uint32_t base = t->word_rule[word];
  const Word whiles = t->while_rules[word];
  RuleWord& rules = s.rules[word];
  const Word pending = rules.pending, before = rules.done;
  Word hold = 0;
  for (Word left = pending & rules.awake; left != 0; left &= left - 1u) {   // a rule that sleeps does not hold
    const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
    hold |= static_cast<Word>(holds(base + i)) << i;
  }
  const Word done = (before & ~pending) | hold;
  const Word fire = (done & whiles) | (hold & ~before);
  rules.pending = 0;
  rules.done = done;
  if constexpr (kSummaries) {
    if (many_words() && (done & whiles) == 0) bits::note_empty(s.busy_sum, word, shape().words);
  }
  for (Word left = fire; left != 0; left &= left - 1u) {
    s.fired_list[s.fired++] = static_cast<Ix>(base + static_cast<std::uint32_t>(std::countr_zero(left)));
  }
  return fire;
}

template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::evaluate_level_at(std::uint32_t l) {
  const Level<J>& level = t->levels[l];
  if constexpr (kSummaries) {
    if (many_words()) {
      const auto next = [&](std::uint32_t w) { return bits::next_full(s.busy_sum, w, level.end_word, shape().words); };
      for (std::uint32_t w = next(level.first_word); w < level.end_word; w = next(w + 1)) evaluate_word(w);
      return;
    }
  }
  for (std::uint32_t w = level.first_word; w < level.end_word; ++w) {
    if ((s.rules[w].pending | (s.rules[w].done & t->while_rules[w])) != 0) evaluate_word(w);
  }
}

// ---- timers: `C for d` is true when C has been true at every evaluation of its level for d

template <class S, class T>
inline void Engine<S, T>::link(std::uint32_t timer) {
  const std::uint32_t q = t->timers[timer].queue;
  s.timer_prev[timer] = s.queue_tail[q];
  s.timer_next[timer] = 0;
  if (s.queue_tail[q] != 0) s.timer_next[s.queue_tail[q] - 1u] = static_cast<Ix>(timer + 1);
  else s.queue_head[q] = static_cast<Ix>(timer + 1);
  s.queue_tail[q] = static_cast<Ix>(timer + 1);
  start(timer);
  const std::int64_t due = s.now_us + t->queue_us[q];
  if (due < s.due_us) s.due_us = due;
}

/// Puts the timer into its queue behind those that began no later. For a state that comes from elsewhere.
template <class S, class T>
inline void Engine<S, T>::link_since(std::uint32_t timer, std::int64_t start_us) {
  const std::uint32_t q = t->timers[timer].queue;
  Ix behind = s.queue_tail[q];
  while (behind != 0 && s.start_us[behind - 1u] > start_us) behind = s.timer_prev[behind - 1u];
  const Ix before = behind == 0 ? s.queue_head[q] : s.timer_next[behind - 1u];
  s.timer_prev[timer] = behind;
  s.timer_next[timer] = before;
  (behind == 0 ? s.queue_head[q] : s.timer_next[behind - 1u]) = static_cast<Ix>(timer + 1);
  (before == 0 ? s.queue_tail[q] : s.timer_prev[before - 1u]) = static_cast<Ix>(timer + 1);
  s.start_us[timer] = start_us;
}

template <class S, class T>
inline void Engine<S, T>::unlink(std::uint32_t timer) {
  const std::uint32_t q = t->timers[timer].queue;
  const Ix previous = s.timer_prev[timer], next = s.timer_next[timer];
  if (previous != 0) s.timer_next[previous - 1u] = next;
  else s.queue_head[q] = next;
  if (next != 0) s.timer_prev[next - 1u] = previous;
  else s.queue_tail[q] = previous;
}

template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::sample(std::uint32_t timer) {
  const bool on = literal(t->timers[timer].input);
  const TimerState state = state_of(timer);
  if (on == (state != kTimerOff)) return;
  if (on) {
    set_state(timer, kTimerWaits);
    link(timer);
    return;
  }
  set_state(timer, kTimerOff);
  if (state == kTimerWaits) unlink(timer);
  else flip(shape().first_timer() + timer);
}

/// For each stage of the level: looks at the timers whose condition has changed, then at those that are due.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::run_timers_at(std::uint32_t l) {
  for (std::uint32_t g = t->levels[l].first_stage; g < t->levels[l].end_stage; ++g) run_stage(t->stages[g]);
}

template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::run_stage(const Stage<J>& stage) {
  if (shape().timers == 0) return;   // then there are no stages either, but a compiler does not know that and warns of empty arrays
  const std::uint32_t words = Shape::words_for(shape().timers);
  const std::uint32_t end = (stage.end_timer - 1u) / kWordBits + 1u;
  const auto next = [&](std::uint32_t w) { return words == 1 ? end : bits::next_full(s.timer_sum, w, end, words); };
  for (std::uint32_t w = stage.first_timer / kWordBits; w < end; w = next(w + 1)) {
    Word changed = s.timer_set[w] & bits::within(w, stage.first_timer, stage.end_timer);
    if (changed == 0) continue;
    s.timer_set[w] &= ~changed;
    if (words > 1 && s.timer_set[w] == 0) bits::note_empty(s.timer_sum, w, words);
    for (; changed != 0; changed &= changed - 1u) {
      sample(w * kWordBits + static_cast<std::uint32_t>(std::countr_zero(changed)));
    }
  }
  if (s.now_us >= s.due_us) expire(stage);
  settle();
}

/// Ends the timers that are due. The timers of a queue have the same duration, so they are due in the order in which they began.
template <class S, class T>
inline void Engine<S, T>::expire(const Stage<J>& stage) {
  for (std::uint32_t q = stage.first_queue; q < stage.end_queue; ++q) {
    while (s.queue_head[q] != 0 && s.now_us - started_us(s.queue_head[q] - 1u) >= t->queue_us[q]) {
      const std::uint32_t timer = s.queue_head[q] - 1u;
      unlink(timer);
      set_state(timer, kTimerDone);
      flip(shape().first_timer() + timer);
    }
  }
}

template <class S, class T>
inline std::int64_t Engine<S, T>::next_due() const {
  std::int64_t due = (std::numeric_limits<std::int64_t>::max)();
  for (std::uint32_t q = 0; q < shape().queues; ++q) {
    if (s.queue_head[q] == 0) continue;
    const std::int64_t at = started_us(s.queue_head[q] - 1u) + t->queue_us[q];
    if (at < due) due = at;
  }
  if (t->idle == Idle::kHold && s.active == 0 && s.strategy != 0) {
    const std::int64_t at = s.last_active_us + t->hold_limit_us + 1;
    if (at < due) due = at;
  }
  return due;
}

// ---- the end of a tick

/// Decides which controller runs, and the status.
template <class S, class T>
inline void Engine<S, T>::decide() {
  s.driving = Status::kOk;
  s.strategy = 0;
  if (s.active != 0) {
    s.strategy = s.held = static_cast<Ix>(s.active_list[0] + 1);
  } else if (t->idle == Idle::kHold && s.held != 0) {
    if (s.now_us - s.last_active_us <= t->hold_limit_us) {
      s.strategy = s.held;
      s.driving = Status::kHolding;
    } else {
      s.driving = Status::kHoldExpired;
    }
  } else {
    s.held = 0;   // otherwise a later image that holds would start a robot that stands
    s.driving = Status::kNoStrategy;
    if (t->idle == Idle::kStrategy) s.strategy = static_cast<Ix>(t->idle_strategy + 1);
  }
  s.bad_facts = s.bad_given;   // what is given from now on is no matter of this decision
  s.status = s.bad_facts != 0 ? Status::kBadFact : s.driving;
  if (s.conflicts != 0) s.status = Status::kConflict;
  if (s.active > 1) s.status = Status::kTwoStrategies;
}

template <class S, class T>
inline void Engine<S, T>::finish() {
  s.changed = 0;
  for (std::uint32_t i = 0; i < s.touched; ++i) {
    const std::uint32_t satellite = s.touched_list[i];
    bits::clear(s.touched_set, satellite);
    const float value = value_of(shape().facts + satellite);
    if (!same(value, s.before[i])) note_change(shape().facts + satellite, value);
  }
  s.touched = 0;
  s.quiet = !s.busy && s.ticks != 0;
  ++s.ticks;
  if (s.now_us >= s.due_us || t->idle == Idle::kHold) s.due_us = next_due();
  const std::uint32_t words = timer_words();
  if (words > 1) s.timers_changed = bits::next_full(s.timer_sum, 0, words, words) < words;
}

}  // namespace mts
