// The contract between a fleet (fleet.h) and the kernel that `kbc compile --fleet` emits for a knowledge base: where bits are stored, and
// what a tick is given. Hosted C++20, for g++ and clang.
//
// note [blocks of planes]
// 512 robots are a block. A *plane* of a block is 64 bytes: one bit for each of its robots. All planes of a block lie next to each other,
// so a tick goes through memory once, from block to block. Blocks share nothing, so threads may tick different ones at the same time.
// Planes that the host gives stay where they are. Planes that the kernel makes are written to another place than those of the last tick;
// after each block the two places change roles. So the planes of the last tick stay until everything is decided, for robots that fall back,
// and each new plane is stored at once and read again from there. A kernel works on *words* of a plane, as wide as the processor's
// registers: 64, 256 or 512 bits; the layout is the same for all.
//
// note [resting blocks]
// Some planes are the same for all robots most of the time. They come last. A block in which all of them have the bit that they have *at rest*
// is resting, and a kernel ticks it that neither reads nor writes them. So each thread has a second place for new planes, in which these are
// always at rest. A word in which one of them wakes is ticked by the whole kernel, in that place, which the block keeps; what it gives
// in exchange is at rest, since the block was.
//
// note [stamps]
// All robots of a fleet share a clock. A *stamp* is the number of one of its distinct times. When a timer begins to wait in a robot, the low
// bits of the stamp are stored there, one plane for each bit. For each duration the clock knows which stamps are old enough (`ripe`); a timer
// is over in a robot if its stamp is ripe. The longer a duration is in ticks, the more bits the stamps of its timers have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../runtime/table.h"

#if defined(__x86_64__)
#define MTS_FLEET_X86 1   // kernels of 256 and 512 bits are there as well
#endif

namespace mts {

/// Number of this contract, which includes what fleet.h and kernel_code.h require of emitted files. Every change of the contract raises it.
/// The number of the tables is kAbi.
inline constexpr std::uint32_t kFleetAbi = 4;
// check_abi: 4 d12c507304f7

inline constexpr std::uint32_t kBlockRobots = 512;
inline constexpr std::uint32_t kPlaneBytes = kBlockRobots / 8;
inline constexpr std::uint32_t kPlaneWords = kBlockRobots / 64;   ///< of 64 bits
inline constexpr std::uint32_t kNoPlane = 0xFFFF'FFFFu;

/// The planes of a fact; kNoPlane for those that nothing reads. Thresholds are those of the knowledge base's tables.
struct FleetFact {
  std::uint32_t high, low, zero;         ///< terms
  std::uint32_t plain, attended, seen;   ///< sightings
  std::uint32_t bad;                     ///< given as NaN or out of range
  std::uint32_t event, lost;             ///< traced fleets: on the last tick
  std::uint32_t weight;                  ///< its place among the facts whose certainty is kept, or kNoPlane
};

/// A satellite has one of a few values: `values[code]`. The bits of the code are in the planes from `plane` on.
struct FleetSatellite {
  std::uint32_t plane, before;   ///< `before`: traced fleets, the code before the last tick
  std::uint32_t bits;
  std::uint32_t values, count;   ///< into FleetTables::values, ascending
};

/// Bits that are not stored, since they follow from planes: `a & b`. Each operand is a plane or an earlier part, as `number << 1 | negated`;
/// parts are numbered after all planes. The structures below may name a part wherever they may name a plane that the kernel makes.
/// Before the first tick all parts are 0.
struct FleetPart { std::uint32_t a, b; };

struct FleetStrategy { std::uint32_t active, runs, held; };
struct FleetRule { std::uint32_t done, fired; };   ///< `fired`: traced fleets
struct FleetTimer { std::uint32_t on, over; };

/// How a knowledge base's state is laid out in planes. All arrays are of static storage.
struct FleetTables {
  std::uint32_t read_given;              ///< planes that the host gives come first; of these, those that a kernel reads
  std::uint32_t plain_given, given;      ///< all planes that the host gives; `given` counts those of traced fleets too
  std::uint32_t planes, traced_planes;   ///< all planes of a block; `traced_planes` counts those of traced fleets too
  std::uint32_t several;                 ///< plane: several strategies are active; kNoPlane if that cannot be
  std::uint32_t weights;                 ///< facts whose certainty is kept as a number
  std::uint32_t busy_given, busy_planes; ///< the planes from here to `read_given` and to `planes` can rest
  const std::uint8_t* rest;              ///< from busy_planes on: the bit of a plane at rest. Planes that the host gives are 0 at rest
  const FleetPart* parts;                ///< numbered from traced_planes on
  const FleetFact* facts;
  const FleetSatellite* satellites;
  const FleetStrategy* strategies;
  const FleetRule* rules;
  const FleetTimer* timers;              ///< one more than the knowledge base has: the last is that of `idle = hold`
  const float* values;
  const std::uint32_t* group_begin;      ///< groups + 1: satellites of which at most one is ever high
  const std::uint32_t* groups;
  std::uint32_t group_count;
};

/// Planes of the next block, which are prefetched while this one is ticked: some at each level, since a processor that has requested some
/// dozens of cache lines waits until they come.
struct FleetAhead {
  static constexpr std::size_t kPart = 24;
  const std::byte* at = nullptr;
  const std::byte* end = nullptr;

  [[gnu::always_inline]] void fetch(std::size_t planes) {
    for (; planes > 0 && at < end; --planes, at += kPlaneBytes) __builtin_prefetch(at, 0, 2);
  }
};

/// A block, as the kernel sees it.
struct FleetBlock {
  const std::byte* given;   ///< planes that the host gives
  const std::byte* before;  ///< planes that the kernel makes, as the last tick left them
  std::byte* now;           ///< the same planes of this tick: the kernel writes all of them
  std::uint32_t index;
  std::uint32_t* oldest;    ///< by 64-bit word, then by timer: no waiting robot has an older stamp. A wider word uses the items of its first 64 bits
  FleetAhead* ahead;
  const std::uint64_t* robots;   ///< by 64-bit word, aligned to 64 bytes: which robots there are. Others wake nobody
  bool* woke;               ///< a resting kernel sets it if it has changed planes that were at rest
};

/// What a tick knows of a duration, if at most one stamp has become ripe; otherwise both numbers of bits are 0. Words of ones or zeros stand
/// for single bits, so that a kernel spreads them without asking.
struct FleetQueue {
  static constexpr std::uint32_t kShort = 5;   ///< with stamps of so many bits it is cheaper to compare all than to find out which is the oldest
  std::uint32_t short_bits = 0, long_bits = 0; ///< of a stamp, if it is short; if it is not
  std::uint64_t rises = 0;                     ///< whether a stamp has become ripe
  std::uint64_t ripe[kShort] = {};             ///< the bits of that stamp
};

/// What all blocks of a tick share. Arrays by queue and arrays by timer have one more item, for `idle = hold`.
struct FleetTick {
  bool first = false;                        ///< the first tick: it makes no events
  std::uint32_t stamp = 0, last_stamp = 0;   ///< of this tick and of the one before
  const std::uint32_t* ripe = nullptr;         ///< by queue: stamps below this are ripe
  const std::uint32_t* ripe_before = nullptr;  ///< the same on the last tick
  const std::uint32_t* bits = nullptr;         ///< by queue: bits of a stamp
  const FleetQueue* queues = nullptr;          ///< by queue
  std::uint64_t stamp_bits[32] = {}, last_bits[32] = {};   ///< the bits of `stamp` and of `last_stamp`, each a word of ones or zeros
  std::byte* const* stamps = nullptr;          ///< by timer: the planes of its stamps, `bits` for each block
  /// Called with the robots of a block that need the scalar engine on this tick, while the block's planes of the last tick still exist.
  void (*fall_back)(void* fleet, const FleetBlock& block, std::uint32_t first_word, const std::uint64_t* robots,
                    std::uint32_t words) = nullptr;
  void* fleet = nullptr;
};

/// One tick of a block.
using FleetKernel = void (*)(const FleetTick& tick, const FleetBlock& block);

/// The kernels for one width of words.
struct FleetKernels {
  std::uint32_t bits;          ///< robots at once
  FleetKernel plain, traced;
  FleetKernel resting;         ///< as `plain`, where all planes that can rest do, also in `now`, and are not written; or nullptr
};

/// How many of the widths 64, 256, 512 this processor supports.
[[nodiscard]] inline std::uint32_t fleet_widths() {
#ifdef MTS_FLEET_X86
  return __builtin_cpu_supports("avx512f") != 0 ? 3 : __builtin_cpu_supports("avx2") != 0 ? 2 : 1;
#else
  return 1;
#endif
}

/// What `kbc compile --fleet` specialises for a knowledge base `K`: `kAbi`, `static const FleetTables& tables()`, and
/// `static const FleetKernels& kernels(most_bits)`, the widest that the processor can run and that is no wider.
template <class K>
struct FleetForm;

}  // namespace mts
