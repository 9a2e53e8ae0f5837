// How the engine reads and writes state and tables where the compact form differs from the ordinary one. In the ordinary form
// each function is one line. The rest of the engine is the same for both. Part of runtime/engine.h.
#pragma once

#include "engine.h"
#include "facts.h"

namespace mts {

template <class S, class T>
inline bool Engine<S, T>::literal(std::uint32_t literal) const {
  if constexpr (kCompact || kMasked) return bits::test(s.truth_set, literal >> 1) != ((literal & 1u) != 0);
  else return s.truth[literal];
}

template <class S, class T>
inline bool Engine<S, T>::truth(std::uint32_t atom) const {
  if constexpr (kCompact || kMasked) return bits::test(s.truth_set, atom);
  else return s.truth[2 * atom];
}

template <class S, class T>
inline void Engine<S, T>::set_truth(std::uint32_t atom, bool now) {
  if constexpr (kCompact || kMasked) {
    if (now) bits::set(s.truth_set, atom);
    else bits::clear(s.truth_set, atom);
  } else {
    s.truth[2 * atom] = now;
    s.truth[2 * atom + 1] = !now;
  }
}

template <class S, class T>
inline float Engine<S, T>::value_of(std::uint32_t cell) const {
  if constexpr (kCompact) {
    if (cell < shape().facts) return s.fact_cf[cell];
    const std::uint32_t satellite = cell - shape().facts;
    if (satellite >= shape().satellites) return bits::test(s.strategy_set, satellite - shape().satellites) ? 1.0f : -1.0f;
    const std::uint32_t slot = t.slot(satellite);
    return slot != S::bounds.written ? s.satellite_cf[slot] : t->initial[satellite];
  } else {
    return s.cf[cell];
  }
}

template <class S, class T>
inline void Engine<S, T>::put(std::uint32_t cell, float value) {
  if constexpr (kCompact) {
    const std::uint32_t satellite = cell - shape().facts;
    const std::uint32_t strategy = satellite - shape().satellites;
    if (cell < shape().facts) s.fact_cf[cell] = value;
    else if (satellite < shape().satellites) s.satellite_cf[t.slot(satellite)] = value;
    else if (!at_least(0.0f, value)) bits::set(s.strategy_set, strategy);
    else bits::clear(s.strategy_set, strategy);
  } else {
    s.cf[cell] = value;
  }
}

template <class S, class T>
inline void Engine<S, T>::put_satellite(std::uint32_t cell, float value) {
  put(cell, value);
  if constexpr (kMasked) {
    const std::uint32_t satellite = cell - shape().facts, word = satellite / kMaskBits;
    const Mask bit = mask_of(satellite);
    s.at_one[word] = value == 1.0f ? s.at_one[word] | bit : s.at_one[word] & ~bit;
    s.at_minus_one[word] = value == -1.0f ? s.at_minus_one[word] | bit : s.at_minus_one[word] & ~bit;
  }
}

/// A fact's value as the engine keeps it (sane_fact). `bad` is set if the value had to be changed for that. The compact form keeps no
/// -0, so that equal numbers have equal bits.
template <class S, class T>
inline float Engine<S, T>::sane(float raw, bool& bad) {
  if constexpr (kCompact) {
    constexpr std::uint32_t kSign = 0x8000'0000u, kInfinite = 0x7F80'0000u, kOne = 0x3F80'0000u;
    const std::uint32_t word = std::bit_cast<std::uint32_t>(raw), size = word & ~kSign;
    bad = size > kOne;
    if (size > kInfinite || size == 0) return 0.0f;
    return bad ? std::bit_cast<float>((word & kSign) | kOne) : raw;
  } else {
    const SaneFact fact = sane_fact(raw);
    bad = fact.bad;
    return fact.value;
  }
}

template <class S, class T>
inline bool Engine<S, T>::at_least(float a, float b) {
  if constexpr (kCompact) return compact::ordered(a) >= compact::ordered(b);
  else return a >= b;
}

template <class S, class T>
inline bool Engine<S, T>::same(float a, float b) {
  if constexpr (kCompact) return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
  else return a == b;
}

/// 1 - |x|: how well `zero` fits. Left out of compact programs that never ask for `zero`, because it would link a library of floats.
template <class S, class T>
inline float Engine<S, T>::distance_from_one([[maybe_unused]] float x) {
  if constexpr (T::kZeroTerms) return 1.0f - (at_least(x, 0.0f) ? x : -x);
  else return 0.0f;
}

template <class S, class T>
inline compact::Range Engine<S, T>::conditions_of(std::uint32_t rule) const {
  if constexpr (kCompact) return t.conditions_of(rule);
  else return {t->rules[rule].conditions, t->rules[rule + 1].conditions};
}

template <class S, class T>
inline compact::Range Engine<S, T>::writes_of(std::uint32_t rule) const {
  if constexpr (kCompact) return t.writes_of(rule);
  else return {t->rules[rule].writes, t->rules[rule + 1].writes};
}

template <class S, class T>
inline bool Engine<S, T>::has_clears([[maybe_unused]] std::uint32_t rule) const {
  if constexpr (kCompact) return false;
  else return shape().groups != 0 && t->rules[rule].clears != t->rules[rule + 1].clears;
}

template <class S, class T>
inline std::int64_t Engine<S, T>::started_us(std::uint32_t timer) const {
  if constexpr (kCompact) {
    return s.now_us - (static_cast<std::uint32_t>(s.now_us) - s.start_us[timer]);
  } else {
    return s.start_us[timer];
  }
}

template <class S, class T>
inline void Engine<S, T>::start(std::uint32_t timer) {
  if constexpr (kCompact) {
    s.start_us[timer] = static_cast<std::uint32_t>(s.now_us);
  } else {
    s.start_us[timer] = s.now_us;
  }
}

/// Whether a timer is off, waits, or is done. In compact form a timer is done if its atom is true.
template <class S, class T>
inline TimerState Engine<S, T>::state_of(std::uint32_t timer) const {
  if constexpr (kCompact) {
    if (bits::test(s.waiting, timer)) return kTimerWaits;
    return truth(shape().first_timer() + timer) ? kTimerDone : kTimerOff;
  } else {
    return static_cast<TimerState>(s.timer_state[timer]);
  }
}

/// To be called before the timer's atom flips.
template <class S, class T>
inline void Engine<S, T>::set_state(std::uint32_t timer, TimerState state) {
  if constexpr (!kCompact) s.timer_state[timer] = state;
  else if (state == kTimerWaits) bits::set(s.waiting, timer);
  else bits::clear(s.waiting, timer);
}

template <class S, class T>
inline std::uint32_t Engine<S, T>::blend_cell(std::uint32_t i) const {
  if constexpr (kCompact) return s.blend_cell[i];
  else return s.blend_list[i].cell;
}

template <class S, class T>
inline float Engine<S, T>::blend_value(std::uint32_t i) const {
  if constexpr (kCompact) return s.blend_value[i];
  else return s.blend_list[i].value;
}

template <class S, class T>
inline void Engine<S, T>::note_blend(std::uint32_t cell) {
  if constexpr (kCompact) s.blend_cell[s.blends++] = static_cast<Ix>(cell);
  else s.blend_list[s.blends++].cell = static_cast<Ix>(cell);
}

template <class S, class T>
inline void Engine<S, T>::set_blend(std::uint32_t i, float value) {
  if constexpr (kCompact) s.blend_value[i] = value;
  else s.blend_list[i].value = value;
}

/// Membership of a term in its cell: high(x) = max(0, x), low(x) = max(0, -x), zero(x) = 1 - |x|.
template <class S, class T>
inline float Engine<S, T>::term_of(std::uint32_t atom) const {
  std::uint32_t cell = 0;
  std::uint32_t term = 2;
  if constexpr (kCompact) {
    cell = t.cell_of(atom);
    if (cell < shape().cells()) term = t->cell_atoms[cell].high == atom ? 2 : t->cell_atoms[cell].low == atom ? 0 : 1;
  } else {
    cell = t->atom_cell[atom];
    term = t->atom_term[atom];
  }
  if (cell >= shape().cells()) return truth(atom) ? 1.0f : 0.0f;
  const float x = value_of(cell);
  const bool positive = at_least(x, 0.0f);
  switch (term) {
    case 0: return positive ? 0.0f : -x;
    case 1: return distance_from_one(x);
    default: return positive ? x : 0.0f;
  }
}

/// In compact form two facts share a byte.
template <class S, class T>
inline bool Engine<S, T>::flag(std::uint32_t fact, FactFlag flag) const {
  if constexpr (kCompact) return (s.fact_flags[fact / 2] >> (fact % 2 * 4) & flag) != 0;
  else return (s.fact_flags[fact] & flag) != 0;
}

template <class S, class T>
inline void Engine<S, T>::flip_flag(std::uint32_t fact, FactFlag flag) {
  if constexpr (kCompact) s.fact_flags[fact / 2] ^= static_cast<std::uint8_t>(flag << (fact % 2 * 4));
  else s.fact_flags[fact] ^= flag;
}

/// Gives a satellite its value. The caller has to set which facts get attention.
template <class S, class T>
inline void Engine<S, T>::restore(std::uint32_t satellite, float value) {
  const float initial = t->initial[satellite];
  s.cf[shape().facts + satellite] = value;
  set_terms(shape().facts + satellite, value);
  if (value != initial) note_moved(satellite, true);
  if ((initial == -1.0f) != (value == -1.0f)) note_live(satellite, value != -1.0f);
}

/// To be called when all is restored: on the next tick every rule that is awake or disarmed is asked again, which has no effect where
/// nothing has changed, and the timers that are due are found.
template <class S, class T>
inline void Engine<S, T>::resume() {
  for (std::uint32_t w = 0; w < shape().words; ++w) ask(w, s.rules[w].awake | s.rules[w].done);
  s.quiet = false;
  s.due_us = s.now_us;
}

/// The i-th fact whose value or attention has changed. In compact form there is no such list: the facts are only marked.
template <class S, class T>
inline std::uint32_t Engine<S, T>::to_recheck(std::uint32_t i) const {
  if constexpr (kCompact) return i;
  else return s.recheck_list[i];
}

template <class S, class T>
inline void Engine<S, T>::note_lost(std::uint32_t fact) {
  if constexpr (kCompact) s.event_list[shape().facts - ++s.lost] = static_cast<Ix>(fact);
  else s.lost_list[s.lost++] = static_cast<Ix>(fact);
}

template <class S, class T>
inline std::uint32_t Engine<S, T>::lost_fact(std::uint32_t i) const {
  if constexpr (kCompact) return s.lost_list()[i];
  else return s.lost_list[i];
}

/// In compact form the list of changes overwrites the part of the list of touched satellites that has been read.
template <class S, class T>
inline void Engine<S, T>::note_change(std::uint32_t cell, float value) {
  if constexpr (kCompact) {
    s.touched_list[s.changed] = static_cast<Ix>(cell);
    s.before[s.changed++] = value;
  } else {
    s.changes[s.changed++] = {static_cast<Ix>(cell), value};
  }
}

}  // namespace mts
