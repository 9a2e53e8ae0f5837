// The memory of a running mind. The caller owns it, either as one object whose size is known at compile time
// (`StaticState`, for emitted code) or as one block of bytes (`DynamicState`, for tables that are loaded).
#pragma once

#include <cstddef>
#include <cstdint>

#include "masks.h"
#include "status.h"
#include "table.h"

namespace mts {

/// A satellite that a tick has changed, and its value now.
template <class Ix>
struct Change { Ix cell; float value; };

/// A cell that rules of one level contradicted each other about.
template <class Ix>
struct Conflict { Ix cell, level; };

/// The rules of a word.
struct RuleWord {
  Word awake;    ///< their key is true
  Word pending;  ///< to be evaluated at their level
  Word done;     ///< `when`: fired and still true (disarmed); `while`: true
  Word bad;      ///< contradicted in the level that is being committed
};

/// The part of a state that is not arrays.
template <class Ix>
struct Scalars {
  std::int64_t now_us = 0;         ///< since the first tick
  std::int64_t due_us = 0;         ///< nothing happens by itself before this time
  std::int64_t last_active_us = 0; ///< when a strategy was last active
  std::uint64_t ticks = 0;
  Ix events = 0, lost = 0, recheck = 0;       ///< lengths of the lists below
  Ix fired = 0, touched = 0, changed = 0, conflicts = 0, blends = 0;
  Ix active = 0, wanted = 0;
  Ix strategy = 0;                  ///< dispatched strategy + 1, or 0
  Ix held = 0;                      ///< what `hold` holds + 1, or 0
  Ix bad_facts = 0;                 ///< as the last tick found them
  Ix bad_given = 0;                 ///< as they are given now
  Status status = Status::kNoStrategy;
  Status driving = Status::kNoStrategy;  ///< the status if nothing is wrong: one of the first four
  bool quiet = false;              ///< the last tick changed nothing: with the same facts the next one repeats it
  bool busy = false;               ///< this tick has changed something
  bool nodes_changed = false;      ///< some node may have to flip; kept only if there are many nodes
  bool timers_changed = false;     ///< some timer's condition has changed since its stage was run
  bool ask_awake = false, ask_done = false;  ///< all rules that are awake, or that hold, are to be asked: see Engine::tell_all
};

// name, type, length
#define MTS_STATE_ARRAYS(X)                                                                                            \
  X(cf, float, shape.cells())                  /* certainty of each cell */                                            \
  X(before, float, shape.satellites)           /* of each in `touched_list`: the value before this tick */             \
  X(start_us, std::int64_t, shape.timers)      /* since when a timer's condition holds */                              \
  X(rules, RuleWord, shape.words)                                                                                      \
  X(awake_sum, Word, Shape::summary_for(shape.words))   /* see note [summaries] */                                     \
  X(busy_sum, Word, Shape::summary_for(shape.words))    /* words with a pending rule, or a true `while` rule */       \
  X(node_set, Word, Shape::words_for(shape.nodes)) /* nodes whose truth is to flip */                                  \
  X(node_sum, Word, Shape::summary_for(Shape::words_for(shape.nodes)))                                                 \
  X(timer_set, Word, Shape::words_for(shape.timers)) /* timers whose condition has changed */                          \
  X(timer_sum, Word, Shape::summary_for(Shape::words_for(shape.timers)))                                               \
  X(touched_set, Word, Shape::words_for(shape.satellites))                                                             \
  X(written_set, Word, Shape::words_for(shape.satellites)) /* in the level that is being committed */                  \
  X(moved_set, Word, Shape::words_for(shape.satellites))   /* satellites that are not at their initial value */        \
  X(moved_sum, Word, Shape::summary_for(Shape::words_for(shape.satellites)))                                           \
  X(changes, Change<Ix>, shape.satellites)                                                                              \
  X(conflict_list, Conflict<Ix>, shape.contested)                                                                       \
  X(blend_list, Change<Ix>, shape.contested)                                                                            \
  X(count, Ix, shape.nodes)                     /* child literals that hold */                                          \
  X(timer_next, Ix, shape.timers)               /* queue links: timer + 1, or 0 */                                      \
  X(timer_prev, Ix, shape.timers)                                                                                       \
  X(queue_head, Ix, shape.queues)                                                                                       \
  X(queue_tail, Ix, shape.queues)                                                                                       \
  X(attended, Ix, shape.facts)                  /* how many of its satellites are high */                               \
  X(event_list, Ix, shape.facts)                                                                                        \
  X(lost_list, Ix, shape.facts)                                                                                         \
  X(recheck_list, Ix, shape.facts)              /* facts whose value or attention has changed */                        \
  X(fired_list, Ix, shape.rules)                                                                                        \
  X(touched_list, Ix, shape.satellites)                                                                                 \
  X(active_list, Ix, shape.strategies)          /* strategies that are active, by priority */                           \
  X(wanted_list, Ix, shape.strategies)          /* the same, while the control level is being committed */              \
  X(live, Ix, shape.group_members)              /* of each large group: the members that are not -1 */                  \
  X(live_place, Ix, shape.group_members)        /* of each member: its place in `live` */                               \
  X(live_count, Ix, shape.groups)                                                                                       \
  X(truth, bool, 2 * shape.atoms)              /* of each literal */                                                   \
  X(timer_state, std::uint8_t, shape.timers)   /* TimerState */                                                        \
  X(fact_flags, std::uint8_t, shape.facts)     /* FactFlag */

enum TimerState : std::uint8_t { kTimerOff, kTimerWaits, kTimerDone };
enum FactFlag : std::uint8_t { kSeen = 1, kRecheck = 2, kBad = 4 };

/// State as one object, for a shape that is a constant. No pointers inside: it may be copied. `kPlanes`: see note [planes]; 0 if rules are no masks.
template <class Index, Shape kShape, std::uint32_t kPlanes>
struct StaticState : Scalars<Index>, MaskState<kShape, kPlanes> {
  using Ix = Index;
  static constexpr bool kConstantShape = true;
  static constexpr bool kCompact = false;
  static constexpr Shape shape = kShape;
#define KB_ARRAY(name, type, length) type name[(length) != 0 ? (length) : 1];
  MTS_STATE_ARRAYS(KB_ARRAY)
#undef KB_ARRAY
};

/// State in a block of memory that the caller owns. `attach` sets the pointers; `bytes` says how long the block must be.
template <class Index>
struct DynamicState : Scalars<Index> {
  using Ix = Index;
  static constexpr bool kConstantShape = false;
  static constexpr bool kCompact = false;
#define KB_ARRAY(name, type, length) type* name = nullptr;
  MTS_STATE_ARRAYS(KB_ARRAY)
#undef KB_ARRAY

  /// Bytes of the block for this shape; the block must be aligned to 8. An image may want more than a machine of 32 bits can address.
  [[nodiscard]] static constexpr std::uint64_t bytes(const Shape& shape) {
    std::uint64_t total = 0;
#define KB_ARRAY(name, type, length) total += (std::uint64_t{sizeof(type)} * (length) + 7u) & ~std::uint64_t{7};
    MTS_STATE_ARRAYS(KB_ARRAY)
#undef KB_ARRAY
    return total;
  }

  /// Lays the arrays out in `block`. Call `Engine::reset` before the first tick.
  void attach(const Shape& shape, std::byte* block) {
#define KB_ARRAY(name, type, length)                   \
  name = static_cast<type*>(static_cast<void*>(block)); \
  block += (sizeof(type) * (length) + 7u) & ~std::size_t{7};
    MTS_STATE_ARRAYS(KB_ARRAY)
#undef KB_ARRAY
  }
};
static_assert(DynamicState<std::uint32_t>::bytes({.contested = std::uint32_t{1} << 29}) > 0xFFFF'FFFFu, "on machines of 32 bits as well");

}  // namespace mts
