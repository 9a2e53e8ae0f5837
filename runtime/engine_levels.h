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
    else if constexpr (!kMasked) tell_readers(a, true);
  }
  if constexpr (kMasked) {
    if constexpr (kMaskedTimers) s.timer_input = kTimersAtStart<typename T::Knowledge>;
    for (std::uint32_t i = 0; i < S::kMaskPlanes; ++i) s.plane[i] = kPlanesOf<typename T::Knowledge>.at_start[i];
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
  if constexpr (kMasked) {
    if (take_masked(fact, raw)) return;
  }
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

/// The same if neither this value nor any other is bad; returns false otherwise. What a term was follows from the value that was.
template <class S, class T>
[[gnu::always_inline]] inline bool Engine<S, T>::take_masked(std::uint32_t fact, float raw) {
  if (s.bad_given != 0 || !(raw >= -1.0f && raw <= 1.0f)) [[unlikely]] return false;
  const float old = s.cf[fact];
  if (old == raw) return true;
  s.cf[fact] = raw;
  s.quiet = false;
  bits::set(s.recheck_set, fact);
  const CellAtoms<J>& a = t->cell_atoms[fact];
  if (a.high != 0 && (old >= t->firing) != (raw >= t->firing)) flip(a.high);
  if (a.low != 0 && (-t->firing >= old) != (-t->firing >= raw)) flip(a.low);
  if (kFactsAskZero<typename T::Knowledge> && a.zero != 0 && (distance_from_one(old) >= t->firing) != (distance_from_one(raw) >= t->firing)) flip(a.zero);
  return true;
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
  if constexpr (kMasked) return notice_masked();
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

/// The same by masks, in the order of the facts.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::notice_masked() {
  const bool first = s.ticks == 0;
  for (std::uint32_t w = 0; w < Shape::words_for(kShape.facts); ++w) {
    Word left = s.recheck_set[w];
    s.recheck_set[w] = 0;
    for (; left != 0; left &= left - 1u) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(left));
      const std::uint32_t fact = w * kWordBits + bit;
      const Notice& a = kNoticeOf<typename T::Knowledge>.fact[fact];
      const Word was = s.seen_set[w] >> bit & 1u;
      const Word now = s.cf[fact] > a.above[was | static_cast<Word>(s.attended[fact] != 0)];
      if (now == was) continue;
      s.seen_set[w] ^= Word{1} << bit;
      s.busy = true;
      if (a.seen != 0) flip(a.seen);
      if (first) continue;
      if (now != 0) s.event_list[s.events++] = static_cast<Ix>(fact);
      else note_lost(fact);
      if (a.momentary[now] != 0) flip(a.momentary[now]);
    }
  }
}

template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::infer_here(std::uint32_t dt_us) {
  s.busy = s.events != 0 || s.lost != 0;
  if (s.active != 0) s.last_active_us = s.now_us;
  if (s.ticks != 0) s.now_us += dt_us;
  s.fired = s.conflicts = s.wanted = 0;
  if constexpr (kMasked) {
    for (std::uint32_t w = 0; w < masks_for(kShape.satellites); ++w) {
      s.before_one[w] = s.at_one[w];
      s.before_minus_one[w] = s.at_minus_one[w];
    }
  }
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
  if constexpr (kMasked) return run_masked(l);
  if (!asked(level)) return;
  const std::uint32_t first = s.fired;
  evaluate_level(l);
  if (s.fired != first) commit(l, first);
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
  const auto [begin, end] = conditions_of(rule);
  for (std::uint32_t i = begin; i < end; ++i) {
    if (!literal(t->conditions[i])) return false;
  }
  return true;
}

/// The rules of the word that hold: the `and` of its planes.
template <class S, class T>
[[gnu::always_inline]] inline Word Engine<S, T>::holding(std::uint32_t word) const {
  constexpr const Planes& p = kPlanesOf<typename T::Knowledge>;
  static_assert(p.first[kShape.words] == S::kMaskPlanes && kMasksFit<typename T::Knowledge, S::kMaskPlanes>);
  Word hold = s.plane[p.first[word]];
  for (std::uint32_t i = p.first[word] + 1u; i < p.first[word + 1]; ++i) hold &= s.plane[i];
  return hold;
}

/// The rules of the word that fire: those that hold and are `while` or armed. They are disarmed.
template <class S, class T>
[[gnu::always_inline]] inline Word Engine<S, T>::firing(std::uint32_t word) {
  const Word hold = holding(word), fire = hold & (t->while_rules[word] | ~s.rules[word].done);
  s.rules[word].done = hold;
  return fire;
}

template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::note_fired(std::uint32_t word, Word fire) {
  const std::uint32_t base = t->word_rule[word];
  for (Word left = fire; left != 0; left &= left - 1u) {
    s.fired_list[s.fired++] = static_cast<Ix>(base + static_cast<std::uint32_t>(std::countr_zero(left)));
  }
}

/// Runs the rules of a level, and commits what they write.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::run_masked(std::uint32_t l) {
  const Level<J>& level = t->levels[l];
  if (level.end_word - level.first_word == 1u) return run_word(l);
  const std::uint32_t first = s.fired;
  for (std::uint32_t w = level.first_word; w < level.end_word; ++w) note_fired(w, firing(w));
  if (s.fired != first) commit(l, first);
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
  note_fired(word, fire);
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

/// Notes the satellites that are or were 1 or -1 and have changed.
template <class S, class T>
inline void Engine<S, T>::note_turned() {
  for (std::uint32_t w = 0; w < masks_for(kShape.satellites); ++w) {
    for (Mask left = (s.before_one[w] ^ s.at_one[w]) | (s.before_minus_one[w] ^ s.at_minus_one[w]); left != 0; left &= left - 1u) {
      const std::uint32_t cell = kShape.facts + w * kMaskBits + static_cast<std::uint32_t>(std::countr_zero(left));
      note_change(cell, s.cf[cell]);
    }
  }
}

/// Whether `note_turned` has noted the satellite, if it has changed.
template <class S, class T>
inline bool Engine<S, T>::noted_turned(std::uint32_t satellite) const {
  const std::uint32_t w = satellite / kMaskBits;
  return ((s.before_one[w] | s.before_minus_one[w] | s.at_one[w] | s.at_minus_one[w]) & mask_of(satellite)) != 0;
}

template <class S, class T>
inline void Engine<S, T>::finish() {
  s.changed = 0;
  if constexpr (kMasked) note_turned();
  for (std::uint32_t i = 0; i < s.touched; ++i) {
    const std::uint32_t satellite = s.touched_list[i];
    bits::clear(s.touched_set, satellite);
    if constexpr (kMasked) {
      if (noted_turned(satellite)) continue;
    }
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
