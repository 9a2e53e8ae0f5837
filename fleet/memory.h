// The bits of a fleet: planes by block, and the stamps of timers (fleet/kernel.h says how they are laid out).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include "kernel.h"

namespace mts {

namespace detail {
[[noreturn]] inline void no_memory() {
#ifdef __cpp_exceptions
  throw std::bad_alloc();
#else
  std::abort();
#endif
}

struct FreeAligned {
  std::align_val_t alignment{kPlaneBytes};
  void operator()(std::byte* bytes) const { ::operator delete(bytes, alignment); }
};
}  // namespace detail

/// Zeroed memory aligned to a cache line. Large blocks use large pages if the system has them, since a tick visits planes in no particular
/// order.
class PlaneMemory {
 public:
  PlaneMemory() = default;
  explicit PlaneMemory(std::size_t bytes) : size_(bytes) {
    const std::size_t unit = bytes >= kPage ? kPage : kPlaneBytes;
    const std::size_t whole = (std::max<std::size_t>(bytes, 1) + unit - 1) / unit * unit;
    const std::align_val_t alignment{unit};   // Windows has no std::aligned_alloc
    bytes_ = {static_cast<std::byte*>(::operator new(whole, alignment, std::nothrow)), detail::FreeAligned{alignment}};
    if (bytes_ == nullptr) detail::no_memory();
#ifdef __linux__
    if (unit == kPage) madvise(bytes_.get(), whole, MADV_HUGEPAGE);
#endif
    std::fill_n(bytes_.get(), bytes, std::byte{});
  }
  [[nodiscard]] std::byte* get() const { return bytes_.get(); }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  static constexpr std::size_t kPage = std::size_t{2} << 20;
  std::unique_ptr<std::byte, detail::FreeAligned> bytes_;
  std::size_t size_ = 0;
};

/// The number of blocks for so many robots. If that exceeds 32 bits, reports that memory is exhausted, as it would be.
[[nodiscard]] inline std::uint32_t blocks_for(std::size_t robots) {
  const std::size_t blocks = robots / kBlockRobots + (robots % kBlockRobots != 0 ? 1u : 0u);
  if (blocks > 0xFFFF'FFFFu) detail::no_memory();
  return static_cast<std::uint32_t>(blocks);
}

/// One robot's place in a fleet.
struct FleetPlace {
  std::uint32_t block, lane;
  [[nodiscard]] std::uint32_t word() const { return lane / 64; }
  [[nodiscard]] std::uint64_t bit() const { return std::uint64_t{1} << (lane % 64); }
};

/// Which planes there are, in this order: up to `read_given` those that the host gives the kernel, up to `plain_given` those that it gives
/// for others to read, up to `given` those that it gives only in traced fleets, up to `planes` those that the kernel makes.
struct FleetPlanes {
  std::uint32_t read_given, plain_given, given, planes;
  std::uint32_t busy_given = 0, busy_planes = 0;   ///< from here to `read_given` and to `planes`: those that can rest, see note [resting blocks]
  const std::uint8_t* rest = nullptr;      ///< by plane from `busy_planes` on; nullptr if this fleet never rests
  std::uint32_t first_part = kNoPlane;   ///< the number of parts[0]
  const FleetPart* parts = nullptr;
  bool traced = false;
  [[nodiscard]] bool has(std::uint32_t plane) const { return plane < planes && (plane >= given || plane < stored_given()); }
  [[nodiscard]] std::uint32_t stored_given() const { return traced ? given : plain_given; }
};

/// Owns all planes of a fleet.
class FleetMemory {
 public:
  FleetMemory(std::uint32_t blocks, const FleetPlanes& planes, std::uint32_t timers)
      : blocks_(blocks), planes_(planes), timers_(timers), given_(std::size_t{blocks} * planes.stored_given() * kPlaneBytes),
        made_(std::size_t{blocks} * made_bytes()), now_(blocks), stamps_(timers), stamp_at_(timers),
        oldest_(std::size_t{blocks} * timers * kPlaneWords, 0) {
    for (std::uint32_t b = 0; b < blocks; ++b) now_[b] = made_.get() + b * made_bytes();
  }

  [[nodiscard]] std::uint32_t blocks() const { return blocks_; }
  [[nodiscard]] bool has(std::uint32_t plane) const { return planes_.has(plane); }
  [[nodiscard]] std::byte* given(std::uint32_t block) const { return given_.get() + std::size_t{block} * planes_.stored_given() * kPlaneBytes; }
  [[nodiscard]] std::uint32_t stored_given() const { return planes_.stored_given(); }
  /// The planes that the kernel made most recently.
  [[nodiscard]] std::byte* made(std::uint32_t block) const { return now_[block]; }
  [[nodiscard]] std::uint64_t& word(std::uint32_t block, std::uint32_t plane, std::uint32_t word) const {
    std::byte* const at = plane < planes_.given ? given(block) + std::size_t{plane} * kPlaneBytes
                                                : made(block) + std::size_t{plane - planes_.given} * kPlaneBytes;
    return reinterpret_cast<std::uint64_t*>(at)[word];
  }
  /// A word of a plane or of a part, which is derived; 0 if there is no such plane, and of parts before the first tick is over.
  [[nodiscard]] std::uint64_t read(std::uint32_t block, std::uint32_t plane, std::uint32_t word) const {
    return ticked_ || has(plane) ? read_made(block, plane, word) : 0;
  }
  /// The same for a block that has been ticked already, even during the first tick.
  [[nodiscard]] std::uint64_t read_made(std::uint32_t block, std::uint32_t plane, std::uint32_t word) const {
    if (has(plane)) return this->word(block, plane, word);
    return plane >= planes_.first_part && plane != kNoPlane ? part(block, plane, word) : 0;
  }
  /// To be called after each tick: from then on all blocks have planes from which parts can be derived.
  void note_ticked() { ticked_ = true; }
  /// By timer: see FleetBlock::oldest.
  [[nodiscard]] std::uint32_t* oldest(std::uint32_t block, std::uint32_t word) { return oldest_.data() + (std::size_t{block} * kPlaneWords + word) * timers_; }

  /// Makes sure that each of `parts` threads has places in which it makes the planes of a block: see note [resting blocks].
  void make_room(unsigned parts) {
    while (room_.size() < std::size_t{2} * parts) {
      owned_.emplace_back(made_bytes());
      room_.push_back(owned_.back().get());
      if (room_.size() % 2 == 0 && planes_.rest != nullptr) lay_to_rest(room_.back());
    }
  }
  [[nodiscard]] std::byte* room(unsigned part, bool resting) const { return room_[place(part, resting)]; }
  /// Exchanges the planes of a block with those that thread `part` has just made.
  void change_places(std::uint32_t block, unsigned part, bool resting) { std::swap(now_[block], room_[place(part, resting)]); }

  /// Whether all planes of a block that can rest do, for the robots that there are. If so, those of others are laid to rest as well.
  [[nodiscard]] bool come_to_rest(std::uint32_t block, const std::uint64_t* robots) const {
    const auto is = [&](std::uint32_t plane, bool bit) {
      const std::uint64_t* const words = &word(block, plane, 0);
      std::uint64_t others = 0;
      for (std::uint32_t w = 0; w < kPlaneWords; ++w) others |= (bit ? ~words[w] : words[w]) & robots[w];
      return others == 0;
    };
    for (std::uint32_t p = planes_.busy_planes; p < planes_.planes; ++p) {
      if (!is(p, planes_.rest[p - planes_.busy_planes] != 0)) return false;
    }
    for (std::uint32_t p = planes_.busy_given; p < planes_.read_given; ++p) {
      if (!is(p, false)) return false;
    }
    lay_to_rest(made(block));
    return true;
  }

  /// Whether the block's planes and those in the thread's place are the same.
  [[nodiscard]] bool same(std::uint32_t block, unsigned part, bool resting) const { return std::memcmp(now_[block], room(part, resting), made_bytes()) == 0; }

  /// Prefetches the planes that the host gave a block, without those at rest. Returns those that the kernel made, to be prefetched later.
  [[nodiscard]] FleetAhead prefetch(std::uint32_t block, bool resting) const {
    FleetAhead given{this->given(block), this->given(block) + std::size_t{resting ? planes_.busy_given : planes_.read_given} * kPlaneBytes};
    given.fetch(planes_.read_given);
    return {made(block), made(block) + (resting ? std::size_t{planes_.busy_planes - planes_.given} * kPlaneBytes : made_bytes())};
  }

  /// The bit of one robot in a plane or a part; false if there is no such plane.
  [[nodiscard]] bool test(FleetPlace at, std::uint32_t plane) const { return (read(at.block, plane, at.word()) & at.bit()) != 0; }
  [[nodiscard]] bool test_made(FleetPlace at, std::uint32_t plane) const { return (read_made(at.block, plane, at.word()) & at.bit()) != 0; }
  /// The number whose bits are in `bits` consecutive planes from `plane` on, lowest bit first.
  [[nodiscard]] std::uint32_t code(FleetPlace at, std::uint32_t plane, std::uint32_t bits) const {
    std::uint32_t code = 0;
    for (std::uint32_t b = 0; b < bits; ++b) code |= static_cast<std::uint32_t>(test(at, plane + b)) << b;
    return code;
  }
  /// Sets the bit of one robot in a plane. Does nothing for parts, which are derived.
  void put(FleetPlace at, std::uint32_t plane, bool value) const {
    if (!has(plane)) return;
    std::uint64_t& w = word(at.block, plane, at.word());
    w = value ? w | at.bit() : w & ~at.bit();
  }

  // ---- stamps

  [[nodiscard]] std::byte* const* stamps() const { return stamp_at_.data(); }
  /// The low bits of a robot's stamp.
  [[nodiscard]] std::uint32_t stamp(FleetPlace at, std::uint32_t timer, std::uint32_t bits) const {
    std::uint32_t low = 0;
    for (std::uint32_t b = 0; b < bits; ++b) {
      if ((stamp_word(at, timer, bits, b) & at.bit()) != 0) low |= std::uint32_t{1} << b;
    }
    return low;
  }
  void put_stamp(FleetPlace at, std::uint32_t timer, std::uint32_t bits, std::uint32_t stamp) {
    for (std::uint32_t b = 0; b < bits; ++b) {
      std::uint64_t& w = stamp_word(at, timer, bits, b);
      w = (stamp >> b & 1u) != 0 ? w | at.bit() : w & ~at.bit();
    }
    for (std::uint32_t w = 0; w < kPlaneWords; ++w) {   // all of them, since a wide word uses only the items of its first
      std::uint32_t& oldest = this->oldest(at.block, w)[timer];
      oldest = (std::min)(oldest, stamp);
    }
  }
  /// Gives a timer's stamps more bits. All of them must be from the last 2^from distinct times before `newest`. Cost: reads and writes all
  /// stamps of the timer.
  void widen(std::uint32_t timer, std::uint32_t from, std::uint32_t to, std::uint32_t newest) {
    PlaneMemory wider(std::size_t{blocks_} * to * kPlaneBytes);
    PlaneMemory before = std::move(stamps_[timer]);
    stamps_[timer] = std::move(wider);
    stamp_at_[timer] = stamps_[timer].get();
    const std::uint32_t mask = from == 0 ? 0 : (std::uint32_t{1} << from) - 1u;
    for (std::uint32_t block = 0; block < blocks_; ++block) {
      auto* old = reinterpret_cast<const std::uint64_t*>(before.get() + std::size_t{block} * from * kPlaneBytes);
      auto* now = reinterpret_cast<std::uint64_t*>(stamp_at_[timer] + std::size_t{block} * to * kPlaneBytes);
      for (std::uint32_t w = 0; w < kPlaneWords; ++w) {
        // Stamps whose low bits are larger than those of the newest are from before these wrapped: their higher bits are one less.
        std::uint64_t larger = 0, equal = ~std::uint64_t{0};
        for (std::uint32_t b = from; b-- > 0;) {
          const std::uint64_t plane = old[b * kPlaneWords + w];
          if ((newest >> b & 1u) == 0) larger |= equal & plane;
          equal &= (newest >> b & 1u) != 0 ? plane : ~plane;
        }
        for (std::uint32_t b = 0; b < to; ++b) {
          const std::uint32_t earlier = newest - (mask + 1u);
          now[b * kPlaneWords + w] = b < from ? old[b * kPlaneWords + w]
                                              : ((newest >> b & 1u) != 0 ? ~larger : 0) | ((earlier >> b & 1u) != 0 ? larger : 0);
        }
      }
    }
  }

  /// Stamps have been numbered anew: all of them are `less` less, and those that were less before are forgotten. Planes keep low bits, which stay.
  void renumber(std::uint32_t less) {
    for (std::uint32_t& oldest : oldest_) oldest -= (std::min)(oldest, less);
  }

  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = given_.size() + made_.size() + room_.size() * made_bytes() + oldest_.size() * sizeof(std::uint32_t);
    for (const PlaneMemory& stamps : stamps_) sum += stamps.size();
    return sum;
  }

 private:
  static std::size_t place(unsigned part, bool resting) { return std::size_t{2} * part + (resting ? 1u : 0u); }
  void lay_to_rest(std::byte* made) const {
    for (std::uint32_t p = planes_.busy_planes; p < planes_.planes; ++p) {
      std::memset(made + std::size_t{p - planes_.given} * kPlaneBytes, planes_.rest[p - planes_.busy_planes] != 0 ? 0xFF : 0, kPlaneBytes);
    }
  }

  [[nodiscard]] std::uint64_t part(std::uint32_t block, std::uint32_t number, std::uint32_t word) const {
    const FleetPart& p = planes_.parts[number - planes_.first_part];
    return operand(block, p.a, word) & operand(block, p.b, word);
  }
  [[nodiscard]] std::uint64_t operand(std::uint32_t block, std::uint32_t ref, std::uint32_t word) const {
    const std::uint32_t number = ref >> 1;
    const std::uint64_t bits = number < planes_.first_part ? this->word(block, number, word) : part(block, number, word);
    return (ref & 1u) != 0 ? ~bits : bits;
  }

  [[nodiscard]] std::uint64_t& stamp_word(FleetPlace at, std::uint32_t timer, std::uint32_t bits, std::uint32_t b) const {
    return reinterpret_cast<std::uint64_t*>(stamp_at_[timer] + (std::size_t{at.block} * bits + b) * kPlaneBytes)[at.word()];
  }

  [[nodiscard]] std::size_t made_bytes() const { return std::size_t{planes_.planes - planes_.given} * kPlaneBytes; }

  std::uint32_t blocks_;
  FleetPlanes planes_;
  std::uint32_t timers_;
  bool ticked_ = false;
  PlaneMemory given_, made_;
  std::vector<std::byte*> now_;           // by block, in made_ or owned_
  std::vector<PlaneMemory> owned_;
  std::vector<std::byte*> room_;          // by part, two each, in made_ or owned_
  std::vector<PlaneMemory> stamps_;       // by timer
  std::vector<std::byte*> stamp_at_;      // where they begin
  std::vector<std::uint32_t> oldest_;
};

}  // namespace mts
