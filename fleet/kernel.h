// The contract between a fleet (fleet.h) and the kernel that `kbc compile --fleet` emits for a knowledge base: where bits
// stand, and what a tick is given. Hosted C++20, for g++ and clang.
//
// note [blocks of planes]
// 512 robots are a block. A *plane* of a block is 64 bytes: one bit for each of its robots. All planes of a block stand next
// to each other, so a tick goes through memory once, from block to block, and blocks have nothing in common: threads may
// tick different ones at the same time. Planes that the host gives stay where they are; those that the kernel makes are made in another
// place than the last tick's, and the places change their roles from block to block. So the last tick's are there until all is
// decided, for robots that fall back, and what is made is stored at once and read again from there. A kernel works on *words* of a plane as wide as the processor's registers: 64, 256 or
// 512 bits; the layout is the same for all.
//
// note [stamps]
// All robots of a fleet share a clock. A *stamp* counts its different times. A timer that begins to wait in a robot is stamped
// there: the low bits of the number, a plane for each. Times that are too long ago are known for each duration (`ripe`), and
// a timer is over where its stamp is ripe. How many bits a timer has grows with the ticks that its duration takes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../runtime/table.h"

#if defined(__x86_64__)
#define KB_FLEET_X86 1   // kernels of 256 and 512 bits are there as well
#endif

namespace mts {

/// Number of this contract, with what fleet.h and kernel_code.h ask of emitted files. It is raised with every change of it; that of the
/// tables is kAbi.
inline constexpr std::uint32_t kFleetAbi = 1;
// check_abi: 1 e35dacb05826

inline constexpr std::uint32_t kBlockRobots = 512;
inline constexpr std::uint32_t kPlaneBytes = kBlockRobots / 8;
inline constexpr std::uint32_t kPlaneWords = kBlockRobots / 64;   ///< of 64 bits
inline constexpr std::uint32_t kNoPlane = 0xFFFF'FFFFu;

/// Where a fact's bits stand; kNoPlane where nobody asks. Thresholds are those of the knowledge base's tables.
struct FleetFact {
  std::uint32_t high, low, zero;         ///< terms
  std::uint32_t plain, attended, seen;   ///< sightings
  std::uint32_t bad;                     ///< given as NaN or out of range
  std::uint32_t event, lost;             ///< traced fleets: on the last tick
  std::uint32_t weight;                  ///< its place among the facts whose certainty is kept, or kNoPlane
};

/// A satellite's value is one of a few: `values[code]`, the code's bits in planes from `plane` on.
struct FleetSatellite {
  std::uint32_t plane, before;   ///< `before`: traced fleets, the code before the last tick
  std::uint32_t bits;
  std::uint32_t values, count;   ///< into FleetTables::values, ascending
};

/// What is not kept, because planes say it: the bits of `a & b`. Each is a plane, or a part before this one (its number after those of
/// all planes), as `number << 1 | negated`. Rows below may have a part wherever a plane that the kernel makes can stand.
/// Before the first tick all are 0.
struct FleetPart { std::uint32_t a, b; };

struct FleetStrategy { std::uint32_t active, runs, held; };
struct FleetRule { std::uint32_t done, fired; };   ///< `fired`: traced fleets
struct FleetTimer { std::uint32_t on, over; };

/// How a knowledge base's state is laid out in planes. All arrays are of static storage.
struct FleetTables {
  std::uint32_t read_given;              ///< planes that the host gives come first, and first of all those that a kernel reads
  std::uint32_t plain_given, given;      ///< all that the host gives; the second with those of traced fleets
  std::uint32_t planes, traced_planes;   ///< of a block, with those that are given; the second with those of traced fleets
  std::uint32_t several;                 ///< plane: several strategies are active; kNoPlane if that cannot be
  std::uint32_t weights;                 ///< facts whose certainty is kept as a number
  const FleetPart* parts;                ///< numbered from traced_planes on
  const FleetFact* facts;
  const FleetSatellite* satellites;
  const FleetStrategy* strategies;
  const FleetRule* rules;
  const FleetTimer* timers;              ///< one more than there are: the last is `idle = hold`
  const float* values;
  const std::uint32_t* group_begin;      ///< groups + 1: satellites of which at most one is ever high
  const std::uint32_t* groups;
  std::uint32_t group_count;
};

/// Planes of the next block, which are asked for while this one is ticked: a part at each level, since a processor that has
/// asked for some dozens of lines waits until they come.
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
  std::byte* now;           ///< the same, to be made: all of them
  std::uint32_t index;
  std::uint32_t* oldest;    ///< by timer, then by 64-bit word: no waiting robot has an older stamp. A wide word uses its first
  FleetAhead* ahead;
};

/// What is the same for all blocks of a tick. Arrays by queue hold one item more, for `idle = hold`; so do those by timer.
struct FleetTick {
  bool first = false;                        ///< nothing is noticed yet
  std::uint32_t stamp = 0, last_stamp = 0;   ///< of this tick and of the one before
  const std::uint32_t* ripe = nullptr;         ///< by queue: older stamps are over
  const std::uint32_t* ripe_before = nullptr;  ///< the same on the last tick
  const std::uint32_t* bits = nullptr;         ///< by queue: of a stamp
  std::byte* const* stamps = nullptr;          ///< by timer: planes, `bits` for each block
  /// Called while a block's planes before this tick are still known, with the robots that need the scalar engine on it.
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
};

/// How many of the widths 64, 256, 512 this processor can do.
[[nodiscard]] inline std::uint32_t fleet_widths() {
#ifdef KB_FLEET_X86
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
