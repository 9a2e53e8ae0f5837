// How a knowledge base lies in a file (.kbt): a head, then sections in one fixed order. docs/image.md describes it.
//
// note [one form of an image]
// An image has no offsets: where a section stands follows from the counts in the head. Each section begins at the next multiple of
// four, the bytes between are zero, and the last section ends the file. So the same tables have only one form, and no offset can point
// elsewhere.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "table.h"

namespace mts {

/// The first bytes of every image. The first one occurs in no text.
inline constexpr std::uint8_t kImageMagic[4] = {0x8A, 'K', 'B', 'T'};
/// Number of the file's own form; that of the tables in it is `kAbi`.
inline constexpr std::uint32_t kImageForm = 1;

/// The head of an image: words of four bytes, little-endian.
struct ImageHead {
  std::uint8_t magic[4];
  std::uint32_t form;
  std::uint32_t abi;
  std::uint32_t checksum;       ///< CRC-32C of the whole file, with these four bytes counted as zero
  std::uint32_t bytes;          ///< of the whole file
  std::uint32_t index_bytes;    ///< 2 where every index fits (see `is_narrow`), else 4
  Shape shape;
  float firing;
  std::uint32_t idle, idle_strategy, hold_limit_us;
  // lengths that do not follow from the shape
  std::uint32_t readers, parents, broad, attends, stages, conditions, writes, clears, values, children, name_bytes;

  /// Names stand in this order: facts, satellites, strategies, rules, levels.
  [[nodiscard]] constexpr std::uint32_t names() const { return shape.cells() + shape.rules + shape.levels; }
  [[nodiscard]] constexpr bool has_groups() const { return shape.groups != 0; }
  [[nodiscard]] constexpr bool has_conflicts() const { return shape.contested != 0; }
};
static_assert(sizeof(ImageHead) == 4 * (6 + 13 + 4 + 11), "no padding in the head");
static_assert(std::numeric_limits<float>::is_iec559 && sizeof(float) == 4, "floats are those of IEEE 754");
static_assert(sizeof(Readers<std::uint16_t>) == 16 && sizeof(FactAtoms<std::uint16_t>) == 16 &&
              sizeof(Readers<std::uint32_t>) == 16 && sizeof(FactAtoms<std::uint32_t>) == 20, "rows as docs/image.md has them");

/// Identifies a timer across knowledge bases: a number made of its level, condition and duration.
struct TimerKey {
  std::uint32_t high, low;
  friend constexpr bool operator==(const TimerKey&, const TimerKey&) = default;
  [[nodiscard]] constexpr bool before(const TimerKey& other) const {
    return high != other.high ? high < other.high : low < other.low;
  }
};

// Member of Tables<Ix>, type, length. Those of MTS_IMAGE_NAMES are beside the tables.
#define MTS_IMAGE_TABLES(X)                                                                \
  X(atoms, mts::Atom<Ix>, n.atoms + 1)                                                      \
  X(readers, mts::Readers<Ix>, h.readers)                                                   \
  X(parents, Ix, h.parents)                                                                 \
  X(timer_inputs, Ix, n.timers)                                                             \
  X(broad, std::uint8_t, h.broad)                                                          \
  X(cell_atoms, mts::CellAtoms<Ix>, n.cells())                                              \
  X(fact_atoms, mts::FactAtoms<Ix>, n.facts)                                                \
  X(attends_begin, Ix, n.satellites + 1)                                                    \
  X(attends, Ix, h.attends)                                                                 \
  X(nodes, mts::Node<Ix>, n.nodes)                                                          \
  X(timers, mts::Timer<Ix>, n.timers)                                                       \
  X(queue_us, std::uint32_t, n.queues)                                                     \
  X(stages, mts::Stage<Ix>, h.stages)                                                       \
  X(levels, mts::Level<Ix>, n.levels)                                                       \
  X(rules, mts::Rule<Ix>, n.rules + 1)                                                      \
  X(word_rule, Ix, n.words)                                                                 \
  X(while_rules, mts::Word, n.words)                                                       \
  X(reset_rules, mts::Word, n.words)                                                       \
  X(conditions, Ix, h.conditions)                                                           \
  X(writes, mts::Write<Ix>, h.writes)                                                       \
  X(clears, Ix, h.clears)                                                                   \
  X(values, float, h.values)                                                               \
  X(group_of, Ix, h.has_groups() ? n.satellites : 0)                                        \
  X(group_slot, Ix, h.has_groups() ? n.satellites : 0)                                      \
  X(group_begin, Ix, h.has_groups() ? n.groups + 1 : 0)                                     \
  X(priority, Ix, n.strategies)                                                             \
  X(initial, float, n.satellites)                                                          \
  X(keep, mts::Word, mts::Shape::words_for(n.satellites))                                  \
  X(initial_truth, mts::Word, mts::Shape::words_for(n.atoms))                              \
  X(initial_count, Ix, n.nodes)                                                             \
  X(child_begin, Ix, h.has_conflicts() ? n.nodes + 1 : 0)                                   \
  X(children, Ix, h.children)                                                               \
  X(is_and, std::uint8_t, h.has_conflicts() ? n.nodes : 0)                                 \
  X(atom_cell, Ix, h.has_conflicts() ? n.atoms : 0)                                         \
  X(atom_term, std::uint8_t, h.has_conflicts() ? n.atoms : 0)

#define MTS_IMAGE_NAMES(X)                                                                 \
  X(begin, std::uint32_t, h.names() + 1) /* into `bytes` */                                \
  X(order, std::uint32_t, h.names())     /* of each kind by itself, ascending by name */   \
  X(timer_key, mts::TimerKey, n.timers)                                                    \
  X(timer_order, std::uint32_t, n.timers) /* ascending by key */                           \
  X(bytes, char, h.name_bytes)           /* UTF-8, each name ended by a zero */

/// Bytes of a row of each section, where indexes are `Ix`.
#define KB_ARRAY(name, type, length) sizeof(type),
template <class Ix>
inline constexpr std::uint8_t kImageRows[] = {MTS_IMAGE_TABLES(KB_ARRAY) MTS_IMAGE_NAMES(KB_ARRAY)};
#undef KB_ARRAY

/// Bytes of an image with this head. No count may be larger than the largest file.
[[nodiscard]] constexpr std::uint64_t image_bytes(const ImageHead& h) {
  const Shape& n = h.shape;
#define KB_ARRAY(name, type, length) length,
  const std::uint32_t lengths[] = {MTS_IMAGE_TABLES(KB_ARRAY) MTS_IMAGE_NAMES(KB_ARRAY)};
#undef KB_ARRAY
  const std::uint8_t* rows = h.index_bytes == 2 ? kImageRows<std::uint16_t> : kImageRows<std::uint32_t>;
  std::uint64_t total = sizeof(ImageHead);
  for (const std::uint32_t length : lengths) total += (std::uint64_t{*rows++} * length + 3u) & ~std::uint64_t{3};
  return total;
}

/// Whether every index fits into 16 bits. A literal and a parent link need one bit more than an atom and a node.
[[nodiscard]] constexpr bool is_narrow(const ImageHead& h) {
  constexpr std::uint32_t most = 0xFFFF;
  const Shape& n = h.shape;
  return n.atoms + 1 <= most / 2 && n.cells() < most && n.rules < most && h.conditions < most && h.readers < most &&
         h.writes < most && h.parents < most && n.timers < most && h.children < most && h.attends < most &&
         n.group_members < most && n.levels < most;
}

}  // namespace mts
