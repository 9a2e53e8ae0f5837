// A mind: a knowledge base compiled to C++, together with its state. User code includes this through the generated header.
//
//   mission::Mind mind;
//   mission::Facts facts;
//   for (;;) {
//     facts.Line = line_sensor.certainty();
//     const auto decision = mind.tick(facts, mts::milliseconds(20));
//     mission::drive(decision, controllers);
//   }
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "compact_state.h"
#include "engine.h"
#include "facts.h"
#include "list_iterator.h"
#include "state.h"
#include "status.h"
#include "table.h"

namespace mts {

/// A duration as std::chrono has them: a number of periods, each the fraction num / den of a second. (<chrono> itself is not freestanding.)
template <class D>
concept ChronoDuration = requires(const D& d) {
  d.count();
  D::period::num / D::period::den;
};

/// The time between two ticks, in whole microseconds, from 0 to about 71 minutes. The functions below clamp to that range.
struct Duration {
  std::uint32_t us = 0;

  constexpr Duration() = default;
  /// Takes only unsigned integers of at most 32 bits, since every value of theirs fits. For other types use the functions below.
  template <std::unsigned_integral N>
    requires(sizeof(N) <= sizeof(std::uint32_t))
  constexpr explicit Duration(N microseconds) : us(microseconds) {}
  /// Takes durations of std::chrono: `mind.tick(facts, 20ms)`, `mind.tick(facts, now - before)`. Clamps to the range; finer ones are rounded to
  /// the nearest microsecond, in integers if they count in integers.
  template <ChronoDuration D>
  constexpr Duration(const D& d) : Duration(rounded<D>(d.count())) {}

 private:
  template <class D, class N>
  static constexpr Duration rounded(N count);
};
namespace detail {
/// `n` times so many microseconds, at most the longest duration; 0 below 0.
template <std::uint32_t kMicroseconds, std::integral N>
[[nodiscard]] constexpr Duration lasting(N n) {
  if (n <= 0) return {};
  const auto whole = static_cast<std::uint64_t>(n);
  return Duration(whole > 0xFFFF'FFFFu / kMicroseconds ? 0xFFFF'FFFFu : static_cast<std::uint32_t>(whole) * kMicroseconds);
}
}  // namespace detail
template <std::integral N>
[[nodiscard]] constexpr Duration microseconds(N n) { return detail::lasting<1>(n); }
template <std::integral N>
[[nodiscard]] constexpr Duration milliseconds(N n) { return detail::lasting<1'000>(n); }
/// Rounds to the nearest microsecond; NaN gives 0. `milliseconds` and `microseconds` reject floating point, since 0.02 of them would
/// come to nothing.
[[nodiscard]] constexpr Duration seconds(double s) {
  if (!(s > 0.0)) return {};
  return Duration(s >= 4294.967295 ? 0xFFFF'FFFFu : static_cast<std::uint32_t>(s * 1e6 + 0.5));
}
[[nodiscard]] constexpr Duration seconds(long double s) { return seconds(static_cast<double>(s)); }
/// The same for `float`, in integer arithmetic: it needs neither `double` nor a floating point unit. Rounds the float's exact value to
/// the nearest microsecond. A float has only 24 bits: below 16 s it is within a microsecond of the intended time, at an hour within
/// 0.13 ms. That is enough for the time between two ticks, but not for a clock: subtract clocks as integers (see `elapsed`).
[[nodiscard]] constexpr Duration seconds(float s) {
  constexpr std::uint32_t kInfinite = 0x7F80'0000u, kTooLong = 0x4600'0000u;   // 8192 s
  const auto word = std::bit_cast<std::uint32_t>(s);
  if (word > kInfinite) return {};   // below 0, or NaN
  if (word >= kTooLong) return Duration(0xFFFF'FFFFu);
  const std::uint32_t shift = 150u - (word >> 23);   // the float is (2^23 + its fraction) / 2^shift
  if (shift > 44) return {};
  const std::uint64_t us = (std::uint64_t{(word & 0x7F'FFFFu) | 0x80'0000u} * 1'000'000u + (std::uint64_t{1} << (shift - 1))) >> shift;
  return Duration(us > 0xFFFF'FFFFu ? 0xFFFF'FFFFu : static_cast<std::uint32_t>(us));
}
template <std::integral N>
[[nodiscard]] constexpr Duration seconds(N n) { return detail::lasting<1'000'000>(n); }
template <class D, class N>
constexpr Duration Duration::rounded(N count) {
  constexpr auto kNum = static_cast<std::uint64_t>(D::period::num), kDen = static_cast<std::uint64_t>(D::period::den);
  if constexpr (std::floating_point<N>) {
    if constexpr (kNum == 1 && kDen == 1) return seconds(count);   // a float needs no double
    else return seconds(static_cast<double>(count) * static_cast<double>(kNum) / static_cast<double>(kDen));
  } else {
    constexpr std::uint64_t kCommon = [] {   // the greatest common divisor
      std::uint64_t a = kDen, b = 1'000'000;
      while (b != 0) {
        const std::uint64_t rest = a % b;
        a = b;
        b = rest;
      }
      return a;
    }();
    constexpr std::uint64_t kTimes = kNum * (1'000'000 / kCommon), kOver = kDen / kCommon;
    static_assert(kTimes <= ~std::uint64_t{0} / 2 / kOver, "the periods of this duration are no plain parts or multiples of a microsecond");
    if (count <= 0) return {};
    const auto n = static_cast<std::uint64_t>(count), whole = n / kOver;
    if (whole > 0xFFFF'FFFFu / kTimes) return Duration(0xFFFF'FFFFu);
    return microseconds(whole * kTimes + (n % kOver * kTimes + kOver / 2) / kOver);
  }
}
template <std::floating_point N>
Duration microseconds(N n) = delete;
template <std::floating_point N>
Duration milliseconds(N n) = delete;

/// The counts between two readings of an unsigned counter that may have wrapped once: `milliseconds(elapsed(now, before))`. With a
/// counter of 8 or 16 bits, a bare `now - before` is an int and goes negative after a wrap.
template <std::unsigned_integral N>
[[nodiscard]] constexpr N elapsed(N now, N before) {
  return static_cast<N>(now - before);
}

/// A read-only view of part of an array. Valid until the next tick of the mind that returned it.
template <class T>
class List {
 public:
  constexpr List(const T* data, std::size_t size) : data_(data), size_(size) {}
  [[nodiscard]] constexpr const T* begin() const { return data_; }
  [[nodiscard]] constexpr const T* end() const { return data_ + size_; }
  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
  [[nodiscard]] constexpr const T& operator[](std::size_t i) const { return data_[i]; }

 private:
  const T* data_;
  std::size_t size_;
};

/// The same for stored indexes of type `Ix`, read as members of the enumeration `E`.
template <class E, class Ix>
class EnumList {
 public:
  using Iterator = ListIterator<EnumList, E>;

  constexpr EnumList() = default;
  constexpr EnumList(const Ix* data, std::size_t size) : data_(data), size_(size) {}
  [[nodiscard]] constexpr Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] constexpr Iterator end() const { return {*this, size_}; }
  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
  [[nodiscard]] constexpr E operator[](std::size_t i) const { return static_cast<E>(data_[i]); }

 private:
  const Ix* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Satellites changed by a tick, for states that keep cells and values in separate arrays.
template <class Ix>
class ChangeList {
 public:
  using Iterator = ListIterator<ChangeList, Change<Ix>>;

  constexpr ChangeList() = default;
  constexpr ChangeList(const Ix* cells, const float* values, std::size_t size) : cells_(cells), values_(values), size_(size) {}
  [[nodiscard]] constexpr Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] constexpr Iterator end() const { return {*this, size_}; }
  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
  [[nodiscard]] constexpr Change<Ix> operator[](std::size_t i) const { return {cells_[i], values_[i]}; }

 private:
  const Ix* cells_ = nullptr;
  const float* values_ = nullptr;
  std::size_t size_ = 0;
};

namespace detail {
/// Sources that were emitted before there were planes have none.
template <class K>
inline constexpr std::uint32_t kPlanesIn = [] {
  if constexpr (requires { K::kPlanes; }) return K::kPlanes;
  else return 0u;
}();
template <class K>
struct StateFor { using Type = StaticState<typename K::Index, K::kShape, kPlanesIn<K>>; };
template <class K>
  requires requires { K::kCompact; }
struct StateFor<K> { using Type = CompactState<K::kShape, K::kCompact>; };
}  // namespace detail

/// The memory of a mind of `K`.
template <class K>
using StateOf = typename detail::StateFor<K>::Type;

/// What a tick decided. A view into the mind: valid until the mind is ticked again, reset or destroyed.
///
/// `K` is the generated description of a knowledge base: its tables, its shape, its enumerations.
template <class K>
class Decision {
 public:
  using State = StateOf<K>;
  using Ix = typename State::Ix;

  explicit Decision(const State& state) : s_(&state) {}

  /// Whether a controller is to drive. If not, the robot must stand still.
  [[nodiscard]] bool drives() const { return s_->strategy != 0; }
  /// The strategy whose controller is to drive. Call it only if `drives()`.
  [[nodiscard]] typename K::Strategy strategy() const { return static_cast<typename K::Strategy>(s_->strategy - 1); }
  /// The worst thing that happened on this tick.
  [[nodiscard]] Status status() const { return s_->status; }
  /// `holding`: no strategy is active and the last one goes on (idle = hold). `hold_expired`: it has gone on for as long as it may, and the
  /// robot stops. `status()` reports either only if nothing worse happened, so a watchdog should ask here: bad facts and conflicts do not
  /// hide the answer.
  [[nodiscard]] bool holding() const { return s_->driving == Status::kHolding; }
  [[nodiscard]] bool hold_expired() const { return s_->driving == Status::kHoldExpired; }
  /// Number of the tick; the first is 1.
  [[nodiscard]] std::uint64_t tick() const { return s_->ticks; }
  /// Time since the first tick, in microseconds.
  [[nodiscard]] std::int64_t time_us() const { return s_->now_us; }
  /// How many facts were NaN or outside [-1, 1] on this tick.
  [[nodiscard]] std::uint32_t bad_facts() const { return s_->bad_facts; }

  /// Rules that fired, from the highest level to the lowest; within a level in order of declaration.
  [[nodiscard]] EnumList<typename K::Rule, Ix> fired() const { return {s_->fired_list, s_->fired}; }
  /// Facts that came into view on this tick (`events`) and that went out of view (`lost`). In no particular order.
  [[nodiscard]] EnumList<typename K::Fact, Ix> events() const { return {s_->event_list, s_->events}; }
  [[nodiscard]] EnumList<typename K::Fact, Ix> lost() const {
    if constexpr (State::kCompact) return {s_->lost_list(), s_->lost};
    else return {s_->lost_list, s_->lost};
  }
  /// Satellites whose value differs from that before the tick, in no particular order. `cell` is an index over all cells, facts first.
  [[nodiscard]] auto changed() const {
    if constexpr (State::kCompact) return ChangeList<Ix>(s_->touched_list, s_->before, s_->changed);
    else return List<Change<Ix>>(s_->changes, s_->changed);
  }
  /// Cells about which rules of one level contradicted each other.
  [[nodiscard]] List<Conflict<Ix>> conflicts() const { return {s_->conflict_list, s_->conflicts}; }
  /// All strategies active on this tick, by priority. More than one is a fault (Status::kTwoStrategies).
  [[nodiscard]] EnumList<typename K::Strategy, Ix> active() const { return {s_->active_list, s_->active}; }

 private:
  const State* s_;
};

/// A running mind. The object holds all of its memory (`kbc budget` tells roughly how much) and may be static or on the stack. A copy continues
/// from the state of the original; to restore a saved state, assign a copy back. On its next tick, a mind that is a copy or was assigned to
/// reads all facts rather than only the changed ones; so does a mind given Facts that are a copy or were assigned to.
///
/// Minds share only constants, so each may run in its own thread. One mind, its Facts and its decisions belong to one thread at a time.
/// Since `tick` records in Facts which mind has read them, two threads must not share one Facts.
template <class K>
class Mind {
 public:
  using State = StateOf<K>;
  using Facts = typename K::Facts;

  static_assert(K::kAbi == kAbi, "this knowledge base was compiled for another version of the runtime: compile it again (with CMake: run cmake, then build)");

  Mind() { reset(); }

  /// Returns to the state at start-up.
  void reset();

  /// Runs one tick. `since_last` is the time since the tick before; it is ignored on the first tick, and 0 means that no time passes.
  /// Reads the facts that were set since this mind last read them. Never fails. Cost: see note [what a tick costs].
  Decision<K> tick(Facts& facts, Duration since_last) {
    auto& store = facts.store();
    if (!has_read(store) || store.has_changed() || !engine().rests(since_last.us)) act(store, since_last);
    return Decision<K>(state_);
  }

  /// The other way to feed a mind, without a Facts object: `give` sets the certainty of one fact from the next tick on, and this `tick`
  /// uses the facts as given. Use one way or the other: `tick(facts, ...)` takes all facts from `facts` and discards what was given.
  void give(typename K::Fact fact, float certainty);
  Decision<K> tick(Duration since_last) {
    if (!engine().rests(since_last.us)) act(since_last);
    return Decision<K>(state_);
  }

  /// The decision of the last tick.
  [[nodiscard]] Decision<K> decision() const { return Decision<K>(state_); }

  /// The certainty of a fact in [-1, 1] as the mind has it: a NaN is 0, all else is clamped. At start-up 0. `give` shows at once, although
  /// nothing is decided by it before the next tick; of `tick(facts, ...)` it shows what that tick has read.
  [[nodiscard]] float value(typename K::Fact fact) const { return state_.cf[static_cast<std::uint32_t>(fact)]; }
  /// The value of a satellite in [-1, 1], as the last tick or `set` left it; at start-up its initial value.
  [[nodiscard]] float value(typename K::Satellite satellite) const {
    return state_.cf[K::kShape.facts + static_cast<std::uint32_t>(satellite)];
  }
  /// Whether rules ran the strategy on the last tick, which is what conditions read of it on the next: `decision().active()` lists these.
  /// One that is held (idle = hold), or that drives because `idle` names it, was run by no rule: false. What moves the robot now is
  /// `decision().strategy()`, if `decision().drives()`.
  [[nodiscard]] bool ran([[maybe_unused]] typename K::Strategy strategy) const {
    if constexpr (K::kShape.strategies == 0) return false;
    else return state_.cf[K::kShape.facts + K::kShape.satellites + static_cast<std::uint32_t>(strategy)] > 0.0f;
  }
  /// Whether the satellite is as high as conditions ask for: at least the knowledge base's `firing` threshold.
  [[nodiscard]] bool high(typename K::Satellite satellite) const { return value(satellite) >= K::kTables.firing; }

  /// Whether some satellite of the fact is high. Such a fact is a goal or part of the context, and its threshold is lower.
  [[nodiscard]] bool attended(typename K::Fact fact) const { return state_.attended[static_cast<std::uint32_t>(fact)] != 0; }

  /// The certainty of every cell: facts, then satellites, then strategies. Perception uses it to see which facts are awaited.
  [[nodiscard]] const float* certainties() const { return state_.cf; }

  /// Sets a satellite between two ticks, for tests. Rules react to the new value on the next tick. Unlike a rule, `set` does not lower
  /// the other members of an exclusive group. NaN is taken as 0; values outside [-1, 1] are clamped. Timers, facts in view and fired
  /// rules are left alone: to restore a saved state, assign a copy of the mind. Always true here; a compact mind has no memory for some
  /// satellites, and refuses these.
  bool set(typename K::Satellite satellite, float value);

 private:
  Engine<State, ConstantTables<K>> engine() { return {ConstantTables<K>{}, state_}; }

  using Store = FactStore<K::kShape.facts>;
  void act(Store& store, Duration since_last);
  void act(Duration since_last);
  [[nodiscard]] bool has_read(const Store& store) const { return read_.address == &store && store.reader.address == this; }

  State state_;
  Partner read_;   ///< see note [who has read what]; none if facts came from elsewhere
};

// note [the engine stands where its tables are]
// Functions that read the tables are not inline. They are compiled once, in the generated .cc, where the tables are constants. In user
// code the tables are not constants: an engine instantiated there would load every address and count from memory, and the linker
// might keep that engine for both.

template <class K>
void Mind<K>::reset() {
  engine().reset();
  read_.address = nullptr;
}

template <class K>
void Mind<K>::act(Duration since_last) {
  engine().advance(since_last.us);
}

template <class K>
void Mind<K>::act(Store& store, Duration since_last) {
  if (!has_read(store)) {
    for (std::uint32_t f = 0; f < K::kShape.facts; ++f) engine().take_fact(f, store.value[f]);
    for (Word& w : store.changed) w = 0;
    for (Word& w : store.changed_sum) w = 0;
    store.reader.address = this;
    read_.address = &store;
  }
  const auto take = [&](std::uint32_t w) {
    for (Word left = std::exchange(store.changed[w], 0); left != 0; left &= left - 1u) {
      const std::uint32_t f = w * kWordBits + static_cast<std::uint32_t>(std::countr_zero(left));
      engine().take_fact(f, store.value[f]);
    }
  };
  if constexpr (Store::kSummed) {
    for (std::uint32_t g = 0; g < Store::kSums; ++g) {
      for (Word words = store.changed_sum[g]; words != 0; words &= words - 1u) take(g * kWordBits + static_cast<std::uint32_t>(std::countr_zero(words)));
      store.changed_sum[g] = 0;
    }
  } else {
    for (std::uint32_t w = 0; w < Store::kWords; ++w) take(w);
  }
  engine().advance(since_last.us);
}

template <class K>
void Mind<K>::give(typename K::Fact fact, float certainty) {
  engine().take_fact(static_cast<std::uint32_t>(fact), certainty);
  read_.address = nullptr;
}

template <class K>
bool Mind<K>::set([[maybe_unused]] typename K::Satellite satellite, [[maybe_unused]] float value) {
  if constexpr (K::kShape.satellites != 0) engine().poke(static_cast<std::uint32_t>(satellite), value);
  return true;
}

}  // namespace mts
