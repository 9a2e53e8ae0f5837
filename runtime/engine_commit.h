// The end of a level: the writes of its rules are carried out together. Part of runtime/engine.h.
#pragma once

#include "engine.h"

namespace mts {

/// Carries out what the rules fired from `first` on write. Commonly none of them clears or resets, and all that write a cell agree.
template <class S, class T>
inline void Engine<S, T>::commit(std::uint32_t level, std::uint32_t first) {
  bool plain = true;
  for (std::uint32_t i = first; i < s.fired; ++i) plain = plain && !has_clears(s.fired_list[i]) && !resets(s.fired_list[i], level);
  if (plain && agree(first)) {
    for (std::uint32_t i = first; i < s.fired; ++i) apply(s.fired_list[i]);
  } else {
    commit_many(level, first);
  }
  settle();
  for (std::uint32_t i = first; i < s.fired; ++i) rearm(s.fired_list[i], place(s.fired_list[i], level));
}

/// True if a quick look shows that no two of the rules fired from `first` on write different values to one satellite.
template <class S, class T>
inline bool Engine<S, T>::agree(std::uint32_t first) {
  if (s.fired == first + 1u) return true;
  if constexpr (kCompact) {
    return false;   // the code would cost more flash than the time it saves is worth
  } else if constexpr (kMasked) {
    Mask raised[masks_for(kShape.satellites)] = {}, lowered[masks_for(kShape.satellites)] = {}, both = 0;
    for (std::uint32_t i = first; i < s.fired; ++i) {
      const auto& m = kMasksOf<typename T::Knowledge>.rule[s.fired_list[i]];
      if (m.wants == kListed) return false;
      for (std::uint32_t w = 0; w < masks_for(kShape.satellites); ++w) both |= (raised[w] |= m.raised[w]) & (lowered[w] |= m.lowered[w]);
    }
    return both == 0;
  } else {
    bool twice = false;
    each_written(first, [&](std::uint32_t satellite, std::uint32_t) {
      twice = twice || bits::test(s.written_set, satellite);
      bits::set(s.written_set, satellite);
    });
    forget_written(first);
    return !twice;
  }
}

/// Calls `f(satellite, value)` for each write of a satellite by a rule fired from `first` on; `value` is an index into `values`. Clears
/// and resets do not count.
template <class S, class T>
template <class F>
[[gnu::always_inline]] inline void Engine<S, T>::each_written(std::uint32_t first, F&& f) const {
  for (std::uint32_t i = first; i < s.fired; ++i) {
    const auto [begin, end] = writes_of(s.fired_list[i]);
    for (std::uint32_t k = begin; k < end; ++k) {
      const std::uint32_t satellite = t->writes[k].cell - shape().facts;
      if (satellite < shape().satellites) f(satellite, std::uint32_t{t->writes[k].value});
    }
  }
}

template <class S, class T>
inline void Engine<S, T>::forget_written(std::uint32_t first) {
  each_written(first, [&](std::uint32_t satellite, std::uint32_t) { s.written_set[satellite / kWordBits] = 0; });
}

template <class S, class T>
inline void Engine<S, T>::want(std::uint32_t strategy) {
  for (std::uint32_t i = 0; i < s.wanted; ++i) {
    if (s.wanted_list[i] == strategy) return;
  }
  s.wanted_list[s.wanted++] = static_cast<Ix>(strategy);
}

/// A reset silences its level: the other rules that would fire do nothing and stay armed.
template <class S, class T>
inline void Engine<S, T>::silence(std::uint32_t level, std::uint32_t first) {
  std::uint32_t kept = first;
  for (std::uint32_t i = first; i < s.fired; ++i) {
    const Ix rule = s.fired_list[i];
    if (resets(rule, level)) {
      s.fired_list[kept++] = rule;
      continue;
    }
    const Place at = place(rule, level);
    if ((t->while_rules[at.word] & at.bit) != 0) continue;
    s.rules[at.word].done &= ~at.bit;
    ask(at.word, at.bit);
    s.busy = true;
  }
  s.fired = static_cast<Ix>(kept);
}

/// Carries out the writes of one rule, except to cells that are blended.
template <class S, class T>
inline void Engine<S, T>::apply(std::uint32_t rule) {
  const auto [begin, end] = writes_of(rule);
  const std::uint32_t strategies = shape().facts + shape().satellites;
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::uint32_t cell = t->writes[i].cell;
    if (cell >= strategies) {
      want(cell - strategies);
    } else if (const float value = t->values[t->writes[i].value]; !same(value, value_of(cell))) {
      if (s.blends == 0 || !blended(cell)) set_satellite(cell, value);
    }
  }
}

/// Runs a level that is a single word: the set of fired rules is then a word, too.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::run_word(std::uint32_t level) {
  const std::uint32_t word = t->levels[level].first_word;
  const Word fire = firing(word);
  if (fire == 0) return;
  if (kMasksOf<typename T::Knowledge>.wants_only[word]) {
    note_fired(word, fire);
    want_all(word, fire);
  } else {
    commit_word_in(s, level, word, fire);
  }
  const Word again = fire & ~t->while_rules[word];
  if (again == 0) return;
  s.busy = true;
  s.rules[word].done &= holding(word) | ~again;
}

/// Wants the strategies that the rules of a word want.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::want_all(std::uint32_t word, Word fire) {
  const std::uint32_t base = t->word_rule[word];
  for (Word left = fire; left != 0; left &= left - 1u) {
    const std::uint32_t wants = kMasksOf<typename T::Knowledge>.rule[base + static_cast<std::uint32_t>(std::countr_zero(left))].wants;
    if (wants != 0) want(wants - 1u);
  }
}

/// Carries out what the rules of a word write: by their masks, all at once, unless one of them resets, clears a group or writes another value,
/// or they contradict each other.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::commit_word(std::uint32_t level, std::uint32_t word, Word fire) {
  constexpr auto& all = kMasksOf<typename T::Knowledge>;
  constexpr std::uint32_t kMasks = masks_for(kShape.satellites);
  const std::uint32_t base = t->word_rule[word], first = s.fired;
  const auto note = [&](Word left) {
    const std::uint32_t rule = base + static_cast<std::uint32_t>(std::countr_zero(left));
    s.fired_list[s.fired++] = static_cast<Ix>(rule);
    return rule;
  };
  RuleMasks<kShape> sum = all.rule[note(fire)];
  Mask both = fire & all.special[word];
  for (Word left = fire & (fire - 1u); left != 0; left &= left - 1u) {
    const auto& m = all.rule[note(left)];
#pragma GCC unroll 4
    for (std::uint32_t w = 0; w < kMasks; ++w) both |= (sum.raised[w] |= m.raised[w]) & (sum.lowered[w] |= m.lowered[w]);
    sum.wants |= m.wants;   // kListed has all bits
  }
  if (both != 0 || sum.wants == kListed) [[unlikely]] return commit(level, first);
#pragma GCC unroll 4
  for (std::uint32_t w = 0; w < kMasks; ++w) turn_satellites(w, sum.raised[w] & ~s.at_one[w], sum.lowered[w] & ~s.at_minus_one[w]);
  if (sum.wants != 0) want_all(word, fire);
  settle();
}

/// Brings satellites of a mask to 1 (`up`) or to -1.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::turn_satellites(std::uint32_t w, Mask up, Mask down) {
  if ((up | down) == 0) return;
  s.busy = true;
  const Mask graded = (up | down) & ~(s.at_one[w] | s.at_minus_one[w]);
  if (graded != 0) [[unlikely]] turn_graded(w, up & graded, down & graded);
  s.at_one[w] = (s.at_one[w] | up) & ~down;
  s.at_minus_one[w] = (s.at_minus_one[w] | down) & ~up;
  for (Mask left = up & ~graded; left != 0; left &= left - 1u) {
    turn_satellite(w * kMaskBits + static_cast<std::uint32_t>(std::countr_zero(left)), 1.0f, 1);
  }
  for (Mask left = down & ~graded; left != 0; left &= left - 1u) {
    turn_satellite(w * kMaskBits + static_cast<std::uint32_t>(std::countr_zero(left)), -1.0f, -1);
  }
}

/// Brings satellites between 1 and -1 to 1 (`up`) or to -1.
template <class S, class T>
[[gnu::noinline]] inline void Engine<S, T>::turn_graded(std::uint32_t w, Mask up, Mask down) {
  for (Mask left = up | down; left != 0; left &= left - 1u) {
    const std::uint32_t satellite = w * kMaskBits + static_cast<std::uint32_t>(std::countr_zero(left));
    set_satellite(kShape.facts + satellite, (up & mask_of(satellite)) != 0 ? 1.0f : -1.0f);
  }
}

/// Brings a satellite from -1 to 1 or from 1 to -1, with what follows from it. `change` is 1 or -1, as its new value. What is high and what is
/// low both flip, and nothing is zero.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::turn_satellite_at(std::uint32_t satellite, float value, std::int32_t change) {
  const CellAtoms<J>& a = t->cell_atoms[shape().facts + satellite];
  s.cf[shape().facts + satellite] = value;
  if (a.high != 0) flip_at(a.high);
  if (a.low != 0) flip_at(a.low);
  for (std::uint32_t i = t->attends_begin[satellite]; i < t->attends_begin[satellite + 1]; ++i) {
    const std::uint32_t fact = t->attends[i];
    s.attended[fact] = static_cast<Ix>(s.attended[fact] + change);
    recheck(fact);
  }
  note_live(satellite, change > 0);
}

/// The members of the large groups that the rule clears become -1, except those that a rule of this level writes itself.
template <class S, class T>
inline void Engine<S, T>::apply_clears([[maybe_unused]] std::uint32_t rule) {
  if constexpr (!kCompact) {
    for (std::uint32_t i = t->rules[rule].clears; i < t->rules[rule + 1].clears; ++i) {
      const std::uint32_t group = t->clears[i];
      for (std::uint32_t k = s.live_count[group]; k-- > 0;) {
        const std::uint32_t satellite = s.live[t->group_begin[group] + k];
        if (!bits::test(s.written_set, satellite)) set_satellite(shape().facts + satellite, -1.0f);
      }
    }
  }
}

/// Satellites return to their initial values, except those that are `keep` and those that a fired rule of the level writes.
template <class S, class T>
inline void Engine<S, T>::apply_reset(std::uint32_t first) {
  const std::uint32_t n = shape().satellites;
  if constexpr (kMasked) collect_moved();
  for (std::uint32_t i = next_moved(0); i < n; i = next_moved(i + 1)) {
    if (bits::test(s.written_set, i) || bits::test(t->keep, i)) continue;
    bool cleared = false;
    for (std::uint32_t k = first; k < s.fired && !cleared; ++k) cleared = clears(s.fired_list[k], shape().facts + i);
    if (!cleared) set_satellite(shape().facts + i, t->initial[i]);
  }
}

template <class S, class T>
[[gnu::noinline]] inline void Engine<S, T>::commit_many(std::uint32_t level, std::uint32_t first) {
  bool reset = false;
  for (std::uint32_t i = first; i < s.fired; ++i) reset = reset || resets(s.fired_list[i], level);
  if (reset) silence(level, first);
  find_blends(level, first);  // also fills written_set
  for (std::uint32_t i = 0; i < s.blends; ++i) blend(level, first, i);
  for (std::uint32_t i = first; i < s.fired; ++i) apply(s.fired_list[i]);
  for (std::uint32_t i = 0; i < s.blends; ++i) set_satellite(blend_cell(i), blend_value(i));
  for (std::uint32_t i = first; i < s.fired; ++i) apply_clears(s.fired_list[i]);
  if (reset) apply_reset(first);
  forget_written(first);
  for (std::uint32_t i = 0; i < s.blends; ++i) bits::clear(s.written_set, blend_cell(i) - shape().facts);
  s.blends = 0;
}

/// A `when` rule that fired is disarmed until its condition is false, which may be right after this commit; a rule whose writes were
/// contradicted stays armed. The rule was disarmed when it fired, so a change made by the commit has marked it.
template <class S, class T>
inline void Engine<S, T>::rearm(std::uint32_t rule, Place at) {
  const bool bad = (s.rules[at.word].bad & at.bit) != 0;
  s.rules[at.word].bad &= ~at.bit;
  if ((t->while_rules[at.word] & at.bit) != 0) return;
  s.busy = true;
  if (bad) {
    s.rules[at.word].done &= ~at.bit;
    ask(at.word, at.bit);
  } else if constexpr (kMasked) {
    s.rules[at.word].done &= holding(at.word) | ~at.bit;
  } else if ((s.rules[at.word].pending & at.bit) != 0) {
    s.rules[at.word].pending &= ~at.bit;
    if (!holds(rule)) s.rules[at.word].done &= ~at.bit;
  }
}

template <class S, class T>
inline void Engine<S, T>::set_strategy(std::uint32_t strategy, bool active) {
  const std::uint32_t cell = shape().facts + shape().satellites + strategy;
  const float value = active ? 1.0f : -1.0f;
  put(cell, value);
  s.busy = true;
  set_terms(cell, value);
}

/// A strategy is 1 if the control level wants it, else -1. Only the differences from the last tick are carried out.
template <class S, class T>
inline void Engine<S, T>::commit_strategies() {
  if constexpr (S::kConstantShape) {
    if constexpr (S::shape.strategies == 0) return;   // a knowledge base that only perceives, or only has fuzzy blocks
  }
  if (s.wanted == s.active && (s.wanted == 0 || (s.wanted == 1 && s.wanted_list[0] == s.active_list[0]))) return;
  const auto among = [](const Ix* list, std::uint32_t n, std::uint32_t x) {
    for (std::uint32_t i = 0; i < n; ++i) {
      if (list[i] == x) return true;
    }
    return false;
  };
  for (std::uint32_t i = 0; i < s.active; ++i) {
    if (!among(s.wanted_list, s.wanted, s.active_list[i])) set_strategy(s.active_list[i], false);
  }
  for (std::uint32_t i = 0; i < s.wanted; ++i) {
    if (!among(s.active_list, s.active, s.wanted_list[i])) set_strategy(s.wanted_list[i], true);
  }
  s.active = 0;
  if (s.wanted < 2) {
    if (s.wanted == 1) s.active_list[s.active++] = s.wanted_list[0];
    return;
  }
  for (std::uint32_t i = 0; i < shape().strategies; ++i) {
    if (among(s.wanted_list, s.wanted, t->priority[i])) s.active_list[s.active++] = static_cast<Ix>(t->priority[i]);
  }
}

}  // namespace mts
