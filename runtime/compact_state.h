// The memory of a compact mind: what StaticState holds, in less than half of the bytes. Part of runtime/compact_mind.h.
//
// note [compact state]
//   The truth of an atom is one bit, not a byte for each of its two literals. Satellites that no rule writes have no memory. Lists
//   that a tick needs only while it runs share their memory with those that it leaves behind: the list of touched satellites becomes
//   the list of changes. Facts that came and facts that went stand at the two ends of one array, since no fact does both. A list
//   index is a byte if all counts fit. Timers keep 32 bits of the time at which they began, which is enough as long as none waits for
//   more than 35 minutes and no tick is longer.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "compact_tables.h"
#include "state.h"

namespace mts {

namespace compact {

/// The largest number that a list of the state holds or counts.
[[nodiscard]] constexpr std::uint32_t largest(const Shape& n) {
  std::uint32_t most = n.cells();
  for (const std::uint32_t x : {n.rules, n.timers + 1, n.queues, n.atoms, n.contested, n.strategies + 1, n.levels}) most = x > most ? x : most;
  return most;
}

/// Summaries of the words of rules, if there are enough words for the engine to use summaries.
template <std::uint32_t kWords, bool = (kWords > kWordBits)>
struct Summaries {};
template <std::uint32_t kWords>
struct Summaries<kWords, true> {
  Word awake_sum[Shape::summary_for(kWords)], busy_sum[Shape::summary_for(kWords)];
};

}  // namespace compact

// name, type, length
#define MTS_COMPACT_ARRAYS(X)                                                                                          \
  X(start_us, std::uint32_t, shape.timers)    /* since when a timer's condition holds, modulo 2^32 */                  \
  X(fact_cf, float, shape.facts)                                                                                       \
  X(satellite_cf, float, bounds.written)      /* by slot: see CompactTables::slot */                                   \
  X(before, float, bounds.written)            /* of touched_list: the value before this tick; then what changed: the value now */ \
  X(blend_value, float, bounds.blends)                                                                                 \
  X(truth_set, Word, Shape::words_for(shape.atoms))                                                                    \
  X(strategy_set, Word, Shape::words_for(shape.strategies)) /* those that ran on the last tick */                      \
  X(rules, RuleWord, shape.words)             /* this and the sets below mean what they mean in MTS_STATE_ARRAYS */     \
  X(node_set, Word, Shape::words_for(shape.nodes))                                                                     \
  X(node_sum, Word, Shape::summary_for(Shape::words_for(shape.nodes)))                                                 \
  X(timer_set, Word, Shape::words_for(shape.timers))                                                                   \
  X(timer_sum, Word, Shape::summary_for(Shape::words_for(shape.timers)))                                               \
  X(touched_set, Word, Shape::words_for(shape.satellites))                                                             \
  X(written_set, Word, Shape::words_for(shape.satellites))                                                             \
  X(moved_set, Word, Shape::words_for(shape.satellites))                                                               \
  X(waiting, Word, Shape::words_for(shape.timers)) /* timers whose condition holds, and that are not due */            \
  X(conflict_list, Conflict<Ix>, shape.contested)                                                                       \
  X(blend_cell, Ix, bounds.blends)                                                                                      \
  X(count, Ix, shape.nodes)                                                                                             \
  X(timer_next, Ix, shape.timers)                                                                                       \
  X(timer_prev, Ix, shape.timers)                                                                                       \
  X(queue_head, Ix, shape.queues)                                                                                       \
  X(queue_tail, Ix, shape.queues)                                                                                       \
  X(attended, Ix, shape.facts)                                                                                          \
  X(event_list, Ix, shape.facts)               /* events from the front, lost from the back */                          \
  X(fired_list, Ix, shape.rules)                                                                                        \
  X(touched_list, Ix, bounds.written)          /* then what changed: cells */                                           \
  X(active_list, Ix, shape.strategies)                                                                                  \
  X(wanted_list, Ix, shape.strategies)                                                                                  \
  X(fact_flags, std::uint8_t, (shape.facts + 1) / 2) /* FactFlag, two facts in a byte */

/// State as one object. No pointers inside: it may be copied. Only for knowledge bases without large exclusive groups.
template <Shape kShape, CompactShape kBounds>
struct CompactState : Scalars<compact::Small<compact::largest(kShape)>>, compact::Summaries<kShape.words> {
  using Ix = compact::Small<compact::largest(kShape)>;
  static constexpr bool kConstantShape = true;
  static constexpr bool kCompact = true;
  static constexpr Shape shape = kShape;
  static constexpr CompactShape bounds = kBounds;
#define KB_ARRAY(name, type, length) type name[(length) != 0 ? (length) : 1];
  MTS_COMPACT_ARRAYS(KB_ARRAY)
#undef KB_ARRAY

  /// The last `lost` items of event_list: facts that went out of view.
  [[nodiscard]] const Ix* lost_list() const { return event_list + shape.facts - this->lost; }
};

}  // namespace mts
