// A mind whose knowledge comes from images and can be exchanged while it runs. Freestanding; the caller owns all memory.
//
//   alignas(8) std::byte memory[2][8192];      // for the mind that runs and for its successor
//   mts::ImageMind mind;
//   mts::SwapReport report;
//   std::uint32_t line = 0;
//   const auto take = [&](const void* image, std::size_t length) {   // the image must stay where it is
//     std::byte* const free = mind.block() == memory[0] ? memory[1] : memory[0];
//     const auto status = mind.take(image, length, free, sizeof memory[0], report, log);
//     if (status == mts::ImageStatus::kOk) line = mind.find(mts::ImageKind::kFact, "Line");   // another image has other numbers
//     return status == mts::ImageStatus::kOk;
//   };
//   if (!take(bytes, size)) ...
//   for (;;) {
//     mind.set_fact(line, sensor());
//     mind.tick(mts::milliseconds(20));
//     if (mind.drives()) run(mind.strategy_name());
//     if (news && !take(new_bytes, new_size)) ...                // between two ticks; the mind goes on as before
//   }
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "image.h"
#include "image_list.h"
#include "mind.h"
#include "swap.h"

namespace mts {

/// Part of the state is in the block, part in the object. The object cannot be copied, and must not be used after it was moved from. On a
/// 32-bit machine it has about 1,000 bytes (a SmallImageMind about 500), all zero at first, so a static one takes no flash. The size of the
/// block depends on the image; `kbc dump image` prints it. For one thread at a time.
///
/// Functions that Mind and Decision have too mean the same here. For a number that `find` returned for an unknown name, the value is 0 and
/// the name `?`. Before the first image, call only `take`, `has_image` and `block`.
///
/// With `kWide` it takes every image, but all code that reads tables exists twice. Without, it refuses images with indexes of 4 bytes
/// (ImageStatus::kOtherWidth), which only knowledge bases with tens of thousands of rules need.
template <bool kWide>
class BasicImageMind {
  template <class Ix>
  struct Half {
    Image<Ix> image;
    DynamicState<Ix> state;
    /// All zero until an image is taken.
    constexpr Half() {
      image.tables.abi = 0;
      image.tables.firing = 0.0f;
      state.status = state.driving = Status{};
    }
    Engine<DynamicState<Ix>, DynamicTables<Ix>> engine() { return {DynamicTables<Ix>(image.tables), state}; }
  };
  struct NoHalf {};
  using Numbers = ImageList<std::uint16_t, std::uint32_t, kWide>;
  using Changes = ImageList<Change<std::uint16_t>, Change<std::uint32_t>, kWide>;
  using Conflicts = ImageList<Conflict<std::uint16_t>, Conflict<std::uint32_t>, kWide>;

  template <class Self, class F>
  static decltype(auto) visit(Self& self, F&& f) {
    if constexpr (kWide) return self.narrow_ ? f(self.half16_) : f(self.half32_);
    else return f(self.half16_);
  }
  template <class F>
  decltype(auto) visit(F&& f) { return visit(*this, f); }
  template <class F>
  decltype(auto) visit(F&& f) const { return visit(*this, f); }

 public:
  BasicImageMind() = default;
  BasicImageMind(const BasicImageMind&) = delete;
  BasicImageMind& operator=(const BasicImageMind&) = delete;
  BasicImageMind(BasicImageMind&&) = default;
  BasicImageMind& operator=(BasicImageMind&&) = default;
  ~BasicImageMind() = default;

  /// Takes the first image or swaps to another one, between two ticks. Image and block must stay where they are while the mind runs on
  /// them. The block must be aligned to 8, hold `ImageInfo::state_bytes` bytes (peek_image), and overlap neither the block in use nor
  /// either image (else kNoMemory). Any result but kOk leaves the running mind as it was. `lost(const SwapLoss&)` is called for what could
  /// not be carried over. After kOk all numbers are those of the new image: call `find` again. What is said of the last tick must be read before:
  /// until the next one, the new image has no fired rules, changes and conflicts to tell of. The first image leaves `report` as it was.
  /// Cost: verification, linear in the size of the image.
  template <class F>
  [[nodiscard]] ImageStatus take(const void* bytes, std::size_t size, std::byte* block, std::size_t block_bytes, SwapReport& report, F&& lost) {
    ImageInfo info;
    if (const ImageStatus status = peek_image(bytes, size, info); status != ImageStatus::kOk) return status;
    const Stretch state = stretch(block, info.state_bytes), image = stretch(bytes, size);
    if (block == nullptr || state.begin % 8 != 0 || block_bytes < info.state_bytes || overlap(state, image)) return ImageStatus::kNoMemory;
    if (has_image() && (overlap(state, state_) || overlap(state, image_))) return ImageStatus::kNoMemory;
    ImageStatus status = ImageStatus::kOtherWidth;
    if (info.index_bytes == 2) status = take_as(half16_, bytes, size, block, block_bytes, report, lost);
    else if constexpr (kWide) status = take_as(half32_, bytes, size, block, block_bytes, report, lost);
    if (status != ImageStatus::kOk) return status;
    narrow_ = info.index_bytes == 2;
    block_ = block;
    state_ = state;
    image_ = image;
    return status;
  }
  /// Whether an image has been taken.
  [[nodiscard]] bool has_image() const { return block_ != nullptr; }
  /// The block that the mind runs in. The other one is free.
  [[nodiscard]] const std::byte* block() const { return block_; }

  /// The number of the thing with this name, or the count of the kind if there is none.
  [[nodiscard]] std::uint32_t find(ImageKind kind, const char* name) const {
    return visit([&](const auto& half) { return half.image.find(kind, name); });
  }
  [[nodiscard]] std::uint32_t count(ImageKind kind) const {
    return visit([&](const auto& half) { return half.image.range(kind).count; });
  }
  [[nodiscard]] const char* name(ImageKind kind, std::uint32_t i) const {
    return visit([&](const auto& half) { return i < half.image.range(kind).count ? half.image.name(kind, i) : "?"; });
  }

  /// Gives a fact, from the next tick on and until it is given again; see Engine::take_fact. A number that is not a fact's is ignored.
  void set_fact(std::uint32_t fact, float value) {
    visit([&](auto& half) {
      if (fact < half.image.tables.shape.facts) half.engine().take_fact(fact, value);
    });
  }
  void tick(Duration since_last) {
    visit([&](auto& half) { half.engine().advance(since_last.us); });
  }
  /// Returns to the state at start-up; keeps the image.
  void reset() {
    visit([](auto& half) { half.engine().reset(); });
  }

  [[nodiscard]] bool drives() const {
    return visit([](const auto& half) { return half.state.strategy != 0; });
  }
  /// The strategy whose controller is to drive: its number among the strategies, and its name. Call them only if `drives()`; otherwise the
  /// name is `?`.
  [[nodiscard]] std::uint32_t strategy() const {
    return visit([](const auto& half) { return half.state.strategy - 1u; });
  }
  [[nodiscard]] const char* strategy_name() const {
    return visit([](const auto& half) {
      return half.state.strategy == 0 ? "?" : half.image.name(ImageKind::kStrategy, half.state.strategy - 1u);
    });
  }
  [[nodiscard]] Status status() const {
    return visit([this](const auto& half) { return has_image() ? half.state.status : Status::kNoStrategy; });
  }
  /// As in Decision: unlike `status()`, they are not hidden by a bad fact or a conflict.
  [[nodiscard]] bool holding() const {
    return visit([](const auto& half) { return half.state.driving == Status::kHolding; });
  }
  [[nodiscard]] bool hold_expired() const {
    return visit([](const auto& half) { return half.state.driving == Status::kHoldExpired; });
  }
  [[nodiscard]] std::uint64_t ticks() const {
    return visit([](const auto& half) { return half.state.ticks; });
  }
  /// Time since the first tick, in microseconds.
  [[nodiscard]] std::int64_t time_us() const {
    return visit([](const auto& half) { return half.state.now_us; });
  }
  /// How many facts were NaN or outside [-1, 1] on the last tick.
  [[nodiscard]] std::uint32_t bad_facts() const {
    return visit([](const auto& half) { return half.state.bad_facts; });
  }
  /// The certainty of a fact, satellite or strategy, by its number within its kind.
  [[nodiscard]] float value(ImageKind kind, std::uint32_t i) const {
    return visit([&](const auto& half) {
      const auto range = half.image.range(kind);
      return i < range.count && kind < ImageKind::kRule ? half.state.cf[range.first + i] : 0.0f;
    });
  }
  [[nodiscard]] bool high(std::uint32_t satellite) const {
    return visit([&](const auto& half) {
      const auto range = half.image.range(ImageKind::kSatellite);
      return satellite < range.count && half.state.cf[range.first + satellite] >= half.image.tables.firing;
    });
  }
  /// Whether rules ran the strategy on the last tick. False of one that only goes on because it is held, or named by `idle`: see Mind::ran.
  [[nodiscard]] bool ran(std::uint32_t strategy) const { return value(ImageKind::kStrategy, strategy) > 0.0f; }
  /// Whether some satellite of the fact is high.
  [[nodiscard]] bool attended(std::uint32_t fact) const {
    return visit([&](const auto& half) { return fact < half.image.tables.shape.facts && half.state.attended[fact] != 0; });
  }
  /// The numbers of the rules that fired on the last tick, from the highest level to the lowest.
  [[nodiscard]] Numbers fired() const {
    return visit([](const auto& half) { return Numbers(half.state.fired_list, half.state.fired); });
  }
  /// Facts that came into view, and that went out of view, on the last tick. In no particular order.
  [[nodiscard]] Numbers events() const {
    return visit([](const auto& half) { return Numbers(half.state.event_list, half.state.events); });
  }
  [[nodiscard]] Numbers lost() const {
    return visit([](const auto& half) { return Numbers(half.state.lost_list, half.state.lost); });
  }
  /// Satellites whose value differs from that before the tick, in no particular order; and cells about which rules of one level
  /// contradicted each other. `cell` counts facts first: the satellite is `cell - count(ImageKind::kFact)`.
  [[nodiscard]] Changes changed() const {
    return visit([](const auto& half) { return Changes(half.state.changes, half.state.changed); });
  }
  [[nodiscard]] Conflicts conflicts() const {
    return visit([](const auto& half) { return Conflicts(half.state.conflict_list, half.state.conflicts); });
  }
  /// All strategies active on the last tick, by priority. More than one is a fault (Status::kTwoStrategies).
  [[nodiscard]] Numbers active() const {
    return visit([](const auto& half) { return Numbers(half.state.active_list, half.state.active); });
  }

 private:
  struct Stretch { std::uint64_t begin = 0, end = 0; };   // of memory
  [[nodiscard]] static Stretch stretch(const void* at, std::uint64_t bytes) {
    const std::uint64_t begin = reinterpret_cast<std::uintptr_t>(at);
    return {begin, begin + bytes};
  }
  [[nodiscard]] static bool overlap(Stretch a, Stretch b) { return a.begin < b.end && b.begin < a.end; }

  template <class Ix, class F>
  ImageStatus take_as(Half<Ix>& to, const void* bytes, std::size_t size, std::byte* block, std::size_t block_bytes, SwapReport& report,
                      F& lost) {
    Half<Ix> made;
    const ImageStatus status = open_image(bytes, size, static_cast<Word*>(static_cast<void*>(block)), block_bytes / sizeof(Word), made.image);
    if (status != ImageStatus::kOk) return status;
    made.state.attach(made.image.tables.shape, block);
    if (!has_image()) made.engine().reset();
    else visit([&](const auto& half) { report = carry_over(half.image, half.state, made.image, made.state, lost); });
    to = made;
    return status;
  }

  Half<std::uint16_t> half16_;
  [[no_unique_address]] std::conditional_t<kWide, Half<std::uint32_t>, NoHalf> half32_;
  std::byte* block_ = nullptr;
  Stretch state_, image_;   // in use
  bool narrow_ = false;
};

using ImageMind = BasicImageMind<true>;
/// For microcontrollers: takes half as much flash as an ImageMind.
using SmallImageMind = BasicImageMind<false>;

}  // namespace mts
