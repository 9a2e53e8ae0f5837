// Constant arrays in as few bytes as their contents need, and the arithmetic of a mind without floats: the parts that
// runtime/compact_tables.h and runtime/compact_state.h are made of.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "bits.h"
#include "table.h"

namespace mts::compact {

/// The smallest type that holds every number up to `kMost`.
template <std::uint32_t kMost>
using Small = std::conditional_t<kMost <= 0xFF, std::uint8_t, std::conditional_t<kMost <= 0xFFFF, std::uint16_t, std::uint32_t>>;

/// kCount numbers that a constant expression makes one by one.
template <std::uint32_t kCount>
struct List {
  std::uint32_t item[kCount + 1] = {};
  std::uint32_t count = 0;
  constexpr void add(std::uint32_t x) { item[count++] = x; }
};

/// kCount numbers, the i-th of which is `Of{}(i)`. Each takes as many bytes as the largest needs.
template <std::uint32_t kCount, class Of>
class Numbers {
  static constexpr std::uint32_t kMost = [] {
    std::uint32_t most = 0;
    for (std::uint32_t i = 0; i < kCount; ++i) most = Of{}(i) > most ? Of{}(i) : most;
    return most;
  }();
  struct Items { Small<kMost> item[kCount == 0 ? 1 : kCount]; };
  static constexpr Items kItems = [] {
    Items items{};
    for (std::uint32_t i = 0; i < kCount; ++i) items.item[i] = static_cast<Small<kMost>>(Of{}(i));
    return items;
  }();

 public:
  static constexpr std::uint32_t most = kMost;
  [[nodiscard]] constexpr std::uint32_t operator[](std::uint32_t i) const {
    if constexpr (kMost == 0) return 0;
    else return kItems.item[i];
  }
};

/// kCount booleans, one bit each.
template <std::uint32_t kCount, class Of>
class Flags {
  struct Items { Word item[Shape::words_for(kCount) + 1]; };
  static constexpr Items kItems = [] {
    Items items{};
    for (std::uint32_t i = 0; i < kCount; ++i) {
      if (Of{}(i)) bits::set(items.item, i);
    }
    return items;
  }();
  static constexpr bool kAny = [] {
    for (const Word w : kItems.item) {
      if (w != 0) return true;
    }
    return false;
  }();

 public:
  [[nodiscard]] constexpr bool operator[](std::uint32_t i) const {
    if constexpr (!kAny) return false;
    else return bits::test(kItems.item, i);
  }
};

/// Literals: `atom << 1 | negated`. Atoms and signs are stored apart, so that 256 atoms need no second byte.
template <std::uint32_t kCount, class Of>
struct Literals {
  struct AtomOf { constexpr std::uint32_t operator()(std::uint32_t i) const { return Of{}(i) >> 1; } };
  struct SignOf { constexpr bool operator()(std::uint32_t i) const { return (Of{}(i) & 1u) != 0; } };
  [[nodiscard]] constexpr std::uint32_t operator[](std::uint32_t i) const {
    return Numbers<kCount, AtomOf>{}[i] << 1 | static_cast<std::uint32_t>(Flags<kCount, SignOf>{}[i]);
  }
};

/// Floats, of which only few are different.
template <std::uint32_t kCount, class Of>
class Floats {
  struct Palette {
    float value[kCount == 0 ? 1 : kCount] = {};
    std::uint32_t size = 0;
    constexpr std::uint32_t find(float x) const {
      std::uint32_t i = 0;
      while (i < size && std::bit_cast<std::uint32_t>(value[i]) != std::bit_cast<std::uint32_t>(x)) ++i;
      return i;
    }
  };
  static constexpr Palette kAll = [] {
    Palette all;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const std::uint32_t at = all.find(Of{}(i));
      all.value[at] = Of{}(i);
      if (at == all.size) ++all.size;
    }
    return all;
  }();
  struct Kept { float value[kAll.size == 0 ? 1 : kAll.size]; };
  static constexpr Kept kKept = [] {
    Kept kept{};
    for (std::uint32_t i = 0; i < kAll.size; ++i) kept.value[i] = kAll.value[i];
    return kept;
  }();
  struct IndexOf { constexpr std::uint32_t operator()(std::uint32_t i) const { return kAll.find(Of{}(i)); } };
  struct FirstOf { constexpr bool operator()(std::uint32_t i) const { return kAll.find(Of{}(i)) == 1; } };

 public:
  [[nodiscard]] constexpr float operator[](std::uint32_t i) const {
    if constexpr (kAll.size <= 1) return kKept.value[0];
    else if constexpr (kAll.size == 2) return Flags<kCount, FirstOf>{}[i] ? kAll.value[1] : kAll.value[0];
    else return kKept.value[Numbers<kCount, IndexOf>{}[i]];
  }
};

/// Numbers that never fall, such as the beginnings of lists. Each is stored as the difference from a base that 16 numbers share, for which
/// a byte mostly suffices.
template <std::uint32_t kCount, class Of>
class Rising {
  struct BaseOf { constexpr std::uint32_t operator()(std::uint32_t i) const { return Of{}(16 * i); } };
  struct StepOf { constexpr std::uint32_t operator()(std::uint32_t i) const { return Of{}(i) - Of{}(i / 16 * 16); } };

 public:
  [[nodiscard]] constexpr std::uint32_t operator[](std::uint32_t i) const {
    if constexpr (kCount == 0) return 0;
    else if constexpr (Of{}(kCount == 0 ? 0 : kCount - 1) <= 0xFF) return Numbers<kCount, Of>{}[i];
    else return Numbers<(kCount + 15) / 16, BaseOf>{}[i / 16] + Numbers<kCount, StepOf>{}[i];
  }
};

/// How many bytes of the word are not 0.
[[nodiscard]] constexpr std::uint32_t bytes_of(Word mask) {
  std::uint32_t n = 0;
  for (; mask != 0; mask >>= 8) n += (mask & 0xFFu) != 0 ? 1u : 0u;
  return n;
}

/// Numbers in the order of the floats they stand for; neither NaN nor -0.
[[nodiscard]] constexpr std::int32_t ordered(float x) {
  const auto word = std::bit_cast<std::int32_t>(x);
  return word ^ ((word >> 31) & 0x7FFF'FFFF);
}

/// x * 2^24 for x in [1/2, 1], which is whole.
[[nodiscard]] constexpr std::int64_t in_2_to_minus_24(float x) {
  const auto word = std::bit_cast<std::uint32_t>(x);
  return word == 0x3F80'0000u ? 0x0100'0000 : static_cast<std::int64_t>((word & 0x007F'FFFFu) | 0x0080'0000u);
}

/// sum / weight, rounded like a quotient of two doubles that is then converted to float: first to 53 bits, then to 24, both times to
/// the nearest, ties to even. |sum| <= weight, 0 < weight < 2^52. Cost: 54 steps of integers.
[[nodiscard]] constexpr float whole_ratio(std::int64_t sum, std::int64_t weight) {
  if (sum == 0) return 0.0f;
  const bool negative = sum < 0;
  std::int64_t rest = negative ? -sum : sum;
  if (rest == weight) return negative ? -1.0f : 1.0f;
  std::uint32_t exponent = 127;
  for (; rest < weight; rest <<= 1) --exponent;  // the quotient is now in [1, 2)
  std::uint64_t digits = 0;
  for (int i = 0; i < 53; ++i) {
    const bool one = rest >= weight;
    digits = digits << 1 | static_cast<std::uint64_t>(one);
    if (one) rest -= weight;
    rest <<= 1;
  }
  if (rest > weight || (rest == weight && (digits & 1u) != 0)) ++digits;
  constexpr std::uint64_t kTail = (std::uint64_t{1} << 29) - 1, kHalf = std::uint64_t{1} << 28;
  const std::uint64_t tail = digits & kTail;
  auto word = static_cast<std::uint32_t>(digits >> 29);
  if (tail > kHalf || (tail == kHalf && (word & 1u) != 0)) ++word;
  word += (exponent - 1u) << 23;  // a carry out of the digits adds one to the exponent, as it should
  return std::bit_cast<float>(negative ? word | 0x8000'0000u : word);
}

/// A part of an array.
struct Range { std::uint32_t begin, end; };

}  // namespace mts::compact
