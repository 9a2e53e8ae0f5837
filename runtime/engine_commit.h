// The end of a level: its rules' writes are carried out together. Part of runtime/engine.h.
#pragma once

#include "runtime/engine.h"

namespace mts {

/// What the rules fired from `first` on write. One rule alone, without clears and reset, is the common case.
template <class S, class T>
inline void Engine<S, T>::commit(std::uint32_t level, std::uint32_t first) {
  const std::uint32_t rule = s.fired_list[first];
  const Place at = place(rule, level);
  const bool alone = s.fired == first + 1u && !has_clears(rule) &&
                     (t->reset_rules[at.word] & at.bit) == 0;
  if (alone) apply(rule);
  else commit_many(level, first);
  settle_nodes();
  if (alone) return rearm(rule, at);
  for (std::uint32_t i = first; i < s.fired; ++i) rearm(s.fired_list[i], place(s.fired_list[i], level));
}

template <class S, class T>
inline void Engine<S, T>::want(std::uint32_t strategy) {
  for (std::uint32_t i = 0; i < s.wanted; ++i) {
    if (s.wanted_list[i] == strategy) return;
  }
  s.wanted_list[s.wanted++] = static_cast<I>(strategy);
}

/// A reset silences its level: the other rules that would fire do nothing and stay armed.
template <class S, class T>
inline void Engine<S, T>::silence(std::uint32_t level, std::uint32_t first) {
  std::uint32_t kept = first;
  for (std::uint32_t i = first; i < s.fired; ++i) {
    const I rule = s.fired_list[i];
    if (resets(rule, level)) {
      s.fired_list[kept++] = rule;
      continue;
    }
    const Place at = place(rule, level);
    if ((t->while_rules[at.word] & at.bit) != 0) continue;
    s.done[at.word] &= ~at.bit;
    ask(at.word, at.bit);
    s.busy = true;
  }
  s.fired = static_cast<I>(kept);
}

/// The writes of one rule, but for cells that are blended.
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

/// Members of the large groups that the rule clears become -1, but those that a rule of this level writes itself.
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

/// Satellites that no fired rule of the level writes, and that are not `keep`, return to their initial values.
template <class S, class T>
inline void Engine<S, T>::apply_reset(std::uint32_t first) {
  const std::uint32_t n = shape().satellites;
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
  for (std::uint32_t i = first; i < s.fired; ++i) {
    const auto [begin, end] = writes_of(s.fired_list[i]);
    for (std::uint32_t k = begin; k < end; ++k) {
      const std::uint32_t satellite = t->writes[k].cell - shape().facts;
      if (satellite < shape().satellites) bits::clear(s.written_set, satellite);
    }
  }
  for (std::uint32_t i = 0; i < s.blends; ++i) bits::clear(s.written_set, blend_cell(i) - shape().facts);
  s.blends = 0;
}

/// A `when` rule that fired is disarmed until its condition is false, be it right after this commit; one whose writes were
/// contradicted stays armed. It was disarmed when it fired, so that a change that the commit made has marked it.
template <class S, class T>
inline void Engine<S, T>::rearm(std::uint32_t rule, Place at) {
  const bool bad = (s.bad_rules[at.word] & at.bit) != 0;
  s.bad_rules[at.word] &= ~at.bit;
  if ((t->while_rules[at.word] & at.bit) != 0) return;
  s.busy = true;
  if (bad) {
    s.done[at.word] &= ~at.bit;
    ask(at.word, at.bit);
  } else if ((s.pending[at.word] & at.bit) != 0) {
    s.pending[at.word] &= ~at.bit;
    if (!holds(rule)) s.done[at.word] &= ~at.bit;
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

/// Strategies are -1 before the control level and +1 if it wants them; the difference to the last tick is carried out.
template <class S, class T>
inline void Engine<S, T>::commit_strategies() {
  if (s.wanted == s.active && (s.wanted == 0 || (s.wanted == 1 && s.wanted_list[0] == s.active_list[0]))) return;
  const auto among = [](const I* list, std::uint32_t n, std::uint32_t x) {
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
    if (among(s.wanted_list, s.wanted, t->priority[i])) s.active_list[s.active++] = static_cast<I>(t->priority[i]);
  }
}

}  // namespace mts
