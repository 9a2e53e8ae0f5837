// The inference: one tick over the tables, as docs/language.md describes it. Freestanding: no heap, no exceptions, no recursion.
//
// note [what a tick costs]
// A tick does work for what changed: each changed cell flips at most three atoms, each flipped atom marks the awake rules
// that read it, each marked rule is evaluated once at its level. If nothing changed and no time is due, the last decision
// stands and the tick is a few comparisons.
//
// note [snapshot per level]
// All rules of a level are evaluated before any of them is committed, so they read the cells as they were when the level
// began; what they write is read by the levels below on this tick and by all on the next.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>

#include "bits.h"
#include "compact_state.h"
#include "state.h"
#include "table.h"

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0)
#error "the inference compares floats exactly: do not compile it with -ffast-math or -ffinite-math-only"
#endif

namespace mts {

/// Tables that are known only at run time. Must outlive the engine.
template <class TableIndex>
class DynamicTables {
 public:
  using Ix = TableIndex;
  static constexpr bool kCompact = false, kWholeValues = false, kZeroTerms = true;
  constexpr explicit DynamicTables(const Tables<Ix>& tables) : tables_(&tables) {}
  constexpr const Tables<Ix>* operator->() const { return tables_; }

 private:
  const Tables<Ix>* tables_;
};

/// Tables that are constants of the program, so the compiler knows every address and count in them.
template <class K>
struct ConstantTables {
  using Ix = typename K::Index;
  using Knowledge = K;
  static constexpr bool kCompact = false, kWholeValues = false, kZeroTerms = true;
  constexpr const Tables<typename K::Index>* operator->() const { return &K::kTables; }
};

/// How deep the nodes of a small `K` nest; the stack is made for no more. Only where `K::kTables` is a constant.
template <class K>
inline constexpr std::uint32_t kDepthOf = [] {
  constexpr std::uint32_t kNodes = K::kShape.nodes, kFirst = K::kShape.atoms - kNodes;
  const auto& t = K::kTables;
  std::uint32_t depth[kNodes + 1] = {}, most = 1;
  for (std::uint32_t n = 0; t.children != nullptr && n < kNodes; ++n) {   // a node's parts have smaller numbers than the node
    depth[n] = 1;
    for (std::uint32_t c = t.child_begin[n]; c < t.child_begin[n + 1]; ++c) {
      const std::uint32_t atom = t.children[c] >> 1;
      if (atom >= kFirst && depth[atom - kFirst] >= depth[n]) depth[n] = depth[atom - kFirst] + 1;
    }
    if (depth[n] > most) most = depth[n];
  }
  return most;
}();

template <class A, class B>
class Transplant;  // runtime/swap.h
template <class K>
class LanePort;    // fleet/lane.h

/// The engine over tables `T` (DynamicTables or ConstantTables) and state `S` (DynamicState or StaticState). Holds nothing
/// itself: make one where it is needed. All functions are total; none allocates, throws or recurses.
template <class S, class T>
class Engine {
 public:
  using Ix = typename S::Ix;   ///< of the state's lists
  using J = typename T::Ix;   ///< of the tables
  static constexpr bool kCompact = S::kCompact;
  static_assert(kCompact == T::kCompact, "compact tables go with compact state");

  /// Whether there may be enough words of rules for summaries.
  static constexpr bool kSummaries = [] {
    if constexpr (S::kConstantShape) return S::shape.words > kWordBits;
    else return true;
  }();

  /// Where it is a constant.
  static constexpr Shape kShape = [] {
    if constexpr (S::kConstantShape) return S::shape;
    else return Shape{};
  }();

  /// Nodes within nodes.
  static constexpr std::uint32_t kStackDepth = [] {
    if constexpr (std::is_empty_v<T> && kShape.atoms <= 4'096) return kDepthOf<typename T::Knowledge>;
    else return kMaxDepth;
  }();

  /// Whether there is code for each atom and each level: see note [straight code]. Not if code is to be small (-Os), nor if nothing
  /// would be gained (-O0).
#if defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__)
  static constexpr bool kStraight = S::kConstantShape && !S::kCompact && std::is_empty_v<T> && kShape.atoms <= 512 && kShape.levels <= 32;
#else
  static constexpr bool kStraight = false;
#endif

  /// Whether rules are masks: see note [masks], see note [planes].
  static constexpr bool kMasked = [] {
    if constexpr (kStraight) return S::kMaskPlanes != 0;
    else return false;
  }();

  /// Whether timers are, too.
  static constexpr bool kMaskedTimers = kMasked && kShape.timers <= kWordBits;

  constexpr Engine(T tables, S& state) : t(tables), s(state) {}

  /// Returns to the state at start-up.
  void reset();
  /// Gives a fact its value for the next tick. NaN is taken as 0, values outside [-1, 1] are clamped; both are counted in
  /// `bad_facts`, on each tick for as long as the fact keeps such a value. Facts that are not given keep their value.
  void take_fact(std::uint32_t fact, float raw);
  /// Runs one tick, `dt_us` after the last one (ignored on the first). The result is in the state's lists.
  void advance(std::uint32_t dt_us) {
    if (!rests(dt_us)) infer(dt_us);
  }
  /// Runs the tick and returns true if nothing happens on it, so that the last decision stands. Otherwise does nothing: call `infer`.
  [[nodiscard]] bool rests(std::uint32_t dt_us) {
    if (!s.quiet || s.now_us + dt_us >= s.due_us) return false;
    s.now_us += dt_us;
    ++s.ticks;
    return true;
  }
  /// Runs the tick, whatever happens on it.
  void infer(std::uint32_t dt_us) {
    if constexpr (kMasked) infer_in(s, dt_us);
    else infer_here(dt_us);
  }
  /// Sets a satellite between two ticks, for tests and for restoring a saved state. Other members of an exclusive group keep their values.
  /// NaN is taken as 0; values outside [-1, 1] are clamped.
  void poke(std::uint32_t satellite, float value) {
    bool bad = false;
    bits::set(s.touched_set, satellite);   // so that it is not noted in a list that may still hold the last tick's changes
    set_satellite(shape().facts + satellite, sane(value, bad));
    bits::clear(s.touched_set, satellite);
    s.quiet = false;
  }

 private:
  // note [straight code]
  // Where the tables are constants and small, the functions below whose name ends in `_at` exist once for each number that they
  // are called with. All come from the one source, but with a constant in place of the number, so that the compiler reads the
  // tables: of a loop over a list only its bodies remain, often one instruction each, and what an atom or a level does not have
  // leaves no code. A function is written out only if that saves more than its code costs: an event tick visits most code once, so
  // instructions that are not in the first cache cost more than those that are left out. The functions that such a function
  // consists of are `always_inline`, since a call would hide the constant; but `_at` functions call each other, so each exists once.
  // Functions whose name ends in `_in` are static and take the state: `this` would be an address on the stack, from which the state's
  // address is read anew after each call.

  /// Calls `kMember(i, a...)`, i < kCount: the copy written out for `i` if there is one.
  template <auto kMember, std::uint32_t kCount, class... A>
  auto at(std::uint32_t i, A... a) {
    if constexpr (kStraight && kCount != 0) return pick<kMember>(std::make_integer_sequence<std::uint32_t, kCount>(), i, a...);
    else return (this->*kMember)(i, a...);
  }
  template <auto kMember, std::uint32_t... kNumber, class... A>
  auto pick(std::integer_sequence<std::uint32_t, kNumber...>, std::uint32_t i, A... a) {
    static constexpr decltype(&written_out<kMember, 0, A...>) kOf[] = {&written_out<kMember, kNumber, A...>...};
    return kOf[i](s, a...);
  }
  template <auto kMember, std::uint32_t kNumber, class... A>
  [[gnu::noinline]] static auto written_out(S& s, A... a) { return (Engine(T{}, s).*kMember)(kNumber, a...); }

  template <class A, class B>
  friend class Transplant;
  template <class K>
  friend class LanePort;

  // engine_flips.h: the consequences of one change
  void flip(std::uint32_t atom) { at<&Engine::flip_at, kShape.atoms>(atom); }
  void flip_at(std::uint32_t atom);
  void turn(std::uint32_t atom, bool now);
  void tell_readers(std::uint32_t atom, bool now);
  [[nodiscard]] const Readers<J>* first_told(const Readers<J>* r, const Readers<J>* end, Word waking) const;
  void set_awake(std::uint32_t word, Word rules);
  void follow(std::uint32_t atom, bool now);
  void ask(std::uint32_t word, Word rules);
  void tell_all(std::uint8_t broad, bool now);
  void ask_all(Word RuleWord::*among);
  void count(std::uint32_t atom, bool now);
  void count_in(std::uint32_t parent, bool now);
  void time(std::uint32_t timer);
  void settle();
  [[nodiscard]] bool nodes_changed() const;
  void settle_changed_nodes();
  [[gnu::noinline]] static void settle_nodes_in(S& s) { Engine(T{}, s).settle_node_word(0); }
  void settle_node_word(std::uint32_t word);
  void set_terms(std::uint32_t cell, float value);
  void set_satellite(std::uint32_t cell, float value);
  void put_satellite(std::uint32_t cell, float value);
  void note_touched(std::uint32_t satellite, float before);
  void note_live(std::uint32_t satellite, bool live);
  void note_moved(std::uint32_t satellite, bool moved);
  void collect_moved();
  [[nodiscard]] std::uint32_t next_moved(std::uint32_t from) const;
  void attend(std::uint32_t satellite, bool high);
  void recheck(std::uint32_t fact);

  // engine_access.h: to fill a state that was reset from one that comes from elsewhere
  void restore(std::uint32_t satellite, float value);
  void resume();

  // engine_levels.h: the tick
  void clear();
  [[gnu::noinline]] static void infer_in(S& s, std::uint32_t dt_us) { Engine(T{}, s).infer_here(dt_us); }
  void infer_here(std::uint32_t dt_us);
  [[nodiscard]] bool take_masked(std::uint32_t fact, float raw);
  void notice();
  void notice_masked();
  void forget_events();
  void pass(std::uint32_t level);
  [[nodiscard]] bool asked(const Level<J>& level) const;
  void evaluate_level(std::uint32_t level) { at<&Engine::evaluate_level_at, kShape.levels>(level); }
  void evaluate_level_at(std::uint32_t level);
  Word evaluate_word(std::uint32_t word);
  void run_masked(std::uint32_t level);
  [[nodiscard]] Word holding(std::uint32_t word) const;
  Word firing(std::uint32_t word);
  void note_fired(std::uint32_t word, Word fire);
  void decide();
  void finish();
  void note_turned();
  [[nodiscard]] bool noted_turned(std::uint32_t satellite) const;
  [[nodiscard]] bool holds(std::uint32_t rule) const;

  // engine_timers.h
  [[nodiscard]] bool timed(const Level<J>& level) const;
  void run_timers(std::uint32_t level) { at<&Engine::run_timers_at, kShape.levels>(level); }
  void run_timers_at(std::uint32_t level);
  void run_stage(const Stage<J>& stage);
  void run_stage_masked(const Stage<J>& stage);
  void expire(const Stage<J>& stage);
  void sample(std::uint32_t timer);
  void link(std::uint32_t timer);
  void link_since(std::uint32_t timer, std::int64_t start_us);
  void unlink(std::uint32_t timer);
  [[nodiscard]] std::int64_t next_due() const;
  [[nodiscard]] std::int64_t next_timer_due() const;

  // engine_access.h: what differs in compact form
  [[nodiscard]] bool literal(std::uint32_t literal) const;
  [[nodiscard]] bool truth(std::uint32_t atom) const;
  void set_truth(std::uint32_t atom, bool now);
  [[nodiscard]] float value_of(std::uint32_t cell) const;
  void put(std::uint32_t cell, float value);
  [[nodiscard]] static float sane(float raw, bool& bad);
  [[nodiscard]] static bool at_least(float a, float b);
  [[nodiscard]] static bool same(float a, float b);
  [[nodiscard]] static float distance_from_one(float x);
  [[nodiscard]] compact::Range conditions_of(std::uint32_t rule) const;
  [[nodiscard]] compact::Range writes_of(std::uint32_t rule) const;
  [[nodiscard]] bool has_clears(std::uint32_t rule) const;
  [[nodiscard]] std::int64_t started_us(std::uint32_t timer) const;
  void start(std::uint32_t timer);
  [[nodiscard]] TimerState state_of(std::uint32_t timer) const;
  void set_state(std::uint32_t timer, TimerState state);
  [[nodiscard]] std::uint32_t blend_cell(std::uint32_t i) const;
  [[nodiscard]] float blend_value(std::uint32_t i) const;
  void note_blend(std::uint32_t cell);
  void set_blend(std::uint32_t i, float value);
  [[nodiscard]] float term_of(std::uint32_t atom) const;
  [[nodiscard]] bool flag(std::uint32_t fact, FactFlag flag) const;
  void flip_flag(std::uint32_t fact, FactFlag flag);
  [[nodiscard]] std::uint32_t to_recheck(std::uint32_t i) const;
  void note_lost(std::uint32_t fact);
  [[nodiscard]] std::uint32_t lost_fact(std::uint32_t i) const;
  void note_change(std::uint32_t cell, float value);

  struct Place { std::uint32_t word; Word bit; };
  [[nodiscard]] Place place(std::uint32_t rule, std::uint32_t level) const {
    const std::uint32_t first = t->levels[level].first_word;
    const std::uint32_t offset = rule - t->word_rule[first];
    return {first + offset / kWordBits, bits::mask(offset)};
  }

  // engine_commit.h: writes
  void commit(std::uint32_t level, std::uint32_t first);
  void commit_many(std::uint32_t level, std::uint32_t first);
  [[nodiscard]] bool agree(std::uint32_t first);
  void run_word(std::uint32_t level);
  void want_all(std::uint32_t word, Word fire);
  [[gnu::noinline]] static void commit_word_in(S& s, std::uint32_t level, std::uint32_t word, Word fire) { Engine(T{}, s).commit_word(level, word, fire); }
  void commit_word(std::uint32_t level, std::uint32_t word, Word fire);
  void turn_satellites(std::uint32_t w, Mask up, Mask down);
  void turn_satellite(std::uint32_t satellite, float value, std::int32_t change) { at<&Engine::turn_satellite_at, kShape.satellites>(satellite, value, change); }
  void turn_satellite_at(std::uint32_t satellite, float value, std::int32_t change);
  void turn_graded(std::uint32_t w, Mask up, Mask down);
  template <class F>
  void each_written(std::uint32_t first, F&& f) const;
  void forget_written(std::uint32_t first);
  void silence(std::uint32_t level, std::uint32_t first);
  void apply(std::uint32_t rule);
  void apply_clears(std::uint32_t rule);
  void apply_reset(std::uint32_t first);
  void rearm(std::uint32_t rule, Place at);
  void commit_strategies();
  void want(std::uint32_t strategy);
  void set_strategy(std::uint32_t strategy, bool active);
  [[nodiscard]] bool resets(std::uint32_t rule, std::uint32_t level) const {
    const Place at = place(rule, level);
    return (t->reset_rules[at.word] & at.bit) != 0;
  }

  // engine_blend.h: cells that several rules write
  void find_blends(std::uint32_t level, std::uint32_t first);
  void compare_writers(std::uint32_t level, std::uint32_t first, std::uint32_t cell);
  void blend(std::uint32_t level, std::uint32_t first, std::uint32_t i);
  void contradict(std::uint32_t level, std::uint32_t first, std::uint32_t cell);
  [[nodiscard]] bool writes(std::uint32_t rule, std::uint32_t level, std::uint32_t cell, float& value) const;
  [[nodiscard]] bool clears(std::uint32_t rule, std::uint32_t cell) const;
  [[nodiscard]] bool blended(std::uint32_t cell) const;
  [[nodiscard]] float strength(std::uint32_t rule) const;
  [[nodiscard]] float degree(std::uint32_t literal) const;
  [[nodiscard]] float leaf_degree(std::uint32_t literal) const;
  static void raise_or_lower(float& value, float by, bool lower) {
    if (lower ? !at_least(by, value) : !at_least(value, by)) value = by;
  }

  [[nodiscard]] constexpr const Shape& shape() const {
    if constexpr (S::kConstantShape) return S::shape;
    else return t->shape;
  }

  /// Whether there are so many words of rules that a summary says which ones to look at. A few words are looked at one by one.
  [[nodiscard]] bool many_words() const { return kSummaries && shape().words > kWordBits; }

  [[nodiscard]] std::uint32_t node_words() const { return Shape::words_for(shape().nodes); }
  [[nodiscard]] std::uint32_t satellite_words() const { return Shape::words_for(shape().satellites); }
  [[nodiscard]] std::uint32_t timer_words() const { return Shape::words_for(shape().timers); }

  [[no_unique_address]] T t;
  S& s;
};

}  // namespace mts

#include "engine_access.h"
#include "engine_blend.h"
#include "engine_commit.h"
#include "engine_flips.h"
#include "engine_levels.h"
#include "engine_timers.h"
