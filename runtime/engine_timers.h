// Timers: `C for d` is true when C has been true at every evaluation of its level for d. Part of runtime/engine.h.
#pragma once

#include "engine.h"

namespace mts {

/// Whether a timer of the level may be due, or the condition of one may have changed.
template <class S, class T>
[[gnu::always_inline]] inline bool Engine<S, T>::timed(const Level<J>& level) const {
  if (level.first_stage == level.end_stage) return false;
  if (s.now_us >= s.due_us) return true;
  if (shape().timers > kWordBits) return s.timers_changed;
  const Word mine = bits::within(0, t->stages[level.first_stage].first_timer, t->stages[level.end_stage - 1u].end_timer);
  if constexpr (kMaskedTimers) return ((s.timer_input ^ s.timer_on) & mine) != 0;
  else return (s.timer_set[0] & mine) != 0;
}

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
  if constexpr (kMasked) s.busy = s.busy || state != kTimerWaits;
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
  if constexpr (kMaskedTimers && kShape.timers != 0) return run_stage_masked(stage);
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

/// The same for timers as masks. They stand in no queues: all that run are looked at when one may be due.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::run_stage_masked(const Stage<J>& stage) {
  const auto turn_timer = [this](std::uint32_t timer) {
    s.busy = true;
    flip(shape().first_timer() + timer);
  };
  const auto each = [](Word timers, auto&& f) {
    for (; timers != 0; timers &= timers - 1u) f(static_cast<std::uint32_t>(std::countr_zero(timers)));
  };
  const Word mine = bits::within(0, stage.first_timer, stage.end_timer), changed = (s.timer_input ^ s.timer_on) & mine;
  if (changed != 0) {
    const Word begun = changed & s.timer_input, over = changed & ~s.timer_input & ~s.timer_waits;
    s.timer_on ^= changed;
    s.timer_waits = (s.timer_waits & ~changed) | begun;
    each(begun, [this](std::uint32_t timer) {
      s.start_us[timer] = s.now_us;
      const std::int64_t due = s.now_us + t->queue_us[t->timers[timer].queue];
      if (due < s.due_us) s.due_us = due;
    });
    each(over, turn_timer);
  }
  if (s.now_us >= s.due_us) {
    each(s.timer_waits & mine, [&](std::uint32_t timer) {
      if (s.now_us - s.start_us[timer] < t->queue_us[t->timers[timer].queue]) return;
      s.timer_waits ^= bits::mask(timer);
      turn_timer(timer);
    });
  }
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
      if constexpr (kMasked) s.busy = true;
      flip(shape().first_timer() + timer);
    }
  }
}

template <class S, class T>
inline std::int64_t Engine<S, T>::next_timer_due() const {
  std::int64_t due = (std::numeric_limits<std::int64_t>::max)();
  const auto wait_for = [&](std::uint32_t timer, std::uint32_t queue) {
    const std::int64_t at = started_us(timer) + t->queue_us[queue];
    if (at < due) due = at;
  };
  if constexpr (kMaskedTimers) {
    for (Word left = kShape.timers == 0 ? 0 : s.timer_waits; left != 0; left &= left - 1u) {
      const auto timer = static_cast<std::uint32_t>(std::countr_zero(left));
      wait_for(timer, t->timers[timer].queue);
    }
  } else {
    for (std::uint32_t q = 0; q < shape().queues; ++q) {
      if (s.queue_head[q] != 0) wait_for(s.queue_head[q] - 1u, q);
    }
  }
  return due;
}

template <class S, class T>
inline std::int64_t Engine<S, T>::next_due() const {
  std::int64_t due = next_timer_due();
  if (t->idle == Idle::kHold && s.active == 0 && s.strategy != 0) {
    const std::int64_t at = s.last_active_us + t->hold_limit_us + 1;
    if (at < due) due = at;
  }
  return due;
}

}  // namespace mts
