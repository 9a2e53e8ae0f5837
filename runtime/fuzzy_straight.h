// The helpers of the code that kbc writes for a fuzzy controller: the same operations in the same order as mts::evaluate on the
// tables (fuzzy.h), hence the same bits, arranged so that the processor need not guess and need not repeat.
//
// note [why straight code is quick]
//   - Inputs are brought into their ranges only if one lies outside: a comparison each tells.
//   - The degrees of a group, `free[8]`, are computed four at a time where the processor can.
//   - Where several `given`s differ only in their words, their rules are one loop, and an index over cells of the input
//     says which of them can hold: two of eight directions.
//   - What rules share at the beginning of their conditions is computed once; if it is 0 they are skipped together.
//   - A rule is entered into a list whether or not it fires, and overwritten by the next one if it does not: no jump depends on it.
//     All outputs read the same list.
#pragma once

#include <bit>
#include <cstdint>

#include "fuzzy.h"

namespace mts {

// ---- inputs

/// Whether x lies in its range already; false if it is no number. No jump.
[[nodiscard]] constexpr bool lies_on_line(float x, float low, float high) noexcept {
  const bool above = x >= low, below = x <= high;
  return above & below;
}
[[nodiscard]] constexpr bool lies_on_circle(float x, float low, float period) noexcept {
  const bool above = x >= low, below = x - low < period;
  return above & below;
}

namespace detail {

// Four numbers at a time, where that is one operation of the processor. On other processors the code would become worse.
#if defined(__SSE__) && defined(__GNUC__)
#define MTS_LANES 1
using Lanes = float __attribute__((vector_size(16)));

[[nodiscard]] inline Lanes load(const float* from) noexcept {
  Lanes lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
inline void store(float* to, Lanes lanes) noexcept { __builtin_memcpy(to, &lanes, sizeof lanes); }
[[nodiscard]] inline Lanes all(float x) noexcept { return Lanes{x, x, x, x}; }
/// Like `least` and `greatest`: of equal numbers the first.
[[nodiscard]] inline Lanes smaller(Lanes a, Lanes b) noexcept { return b < a ? b : a; }
[[nodiscard]] inline Lanes larger(Lanes a, Lanes b) noexcept { return b > a ? b : a; }
[[nodiscard]] inline bool every(Lanes mask) noexcept { return __builtin_ia32_movmskps(mask) == 15; }
[[nodiscard]] inline Lanes to_degree(Lanes x) noexcept { return larger(smaller(x, all(1.0f)), all(0.0f)); }
#endif

}  // namespace detail

/// Whether all inputs of a group lie in their range.
template <std::uint32_t kCount>
[[nodiscard]] inline bool all_lie_on_line(const float* x, float low, float high) noexcept {
  bool inside = true;
  std::uint32_t i = 0;
#ifdef MTS_LANES
  for (; i + 4 <= kCount; i += 4) {
    const detail::Lanes lanes = detail::load(x + i);
    inside = detail::every(reinterpret_cast<detail::Lanes>((lanes >= detail::all(low)) & (lanes <= detail::all(high)))) && inside;
  }
#endif
  for (; i < kCount; ++i) inside = lies_on_line(x[i], low, high) && inside;
  return inside;
}

// ---- degrees of a group in one term; `to` has room for kCount. The same bits as rising_mu, falling_mu, linear_mu, mu.

template <std::uint32_t kCount>
inline void rising_group(const float* x, float low, float rise, float* to) noexcept {
  std::uint32_t i = 0;
#ifdef MTS_LANES
  for (; i + 4 <= kCount; i += 4) detail::store(to + i, detail::to_degree((detail::load(x + i) - detail::all(low)) * detail::all(rise)));
#endif
  for (; i < kCount; ++i) to[i] = rising_mu(x[i], low, rise);
}
template <std::uint32_t kCount>
inline void falling_group(const float* x, float high, float fall, float* to) noexcept {
  std::uint32_t i = 0;
#ifdef MTS_LANES
  for (; i + 4 <= kCount; i += 4) detail::store(to + i, detail::to_degree((detail::all(high) - detail::load(x + i)) * detail::all(fall)));
#endif
  for (; i < kCount; ++i) to[i] = falling_mu(x[i], high, fall);
}
template <std::uint32_t kCount>
inline void group_mu(const float* x, const Membership& term, float* to) noexcept {
  for (std::uint32_t i = 0; i < kCount; ++i) to[i] = mu(term, x[i]);
}

/// In which of `cells` equal parts of its range x lies. x must lie in the range; `per_cell` is cells / length of the range. The result
/// never falls as x grows.
[[nodiscard]] constexpr std::uint32_t cell_of(float x, float low, float per_cell, std::uint32_t cells) noexcept {
  const auto cell = static_cast<std::uint32_t>(static_cast<std::int32_t>((x - low) * per_cell));
  return cell < cells ? cell : cells - 1;
}

// ---- rules that fired

/// What a rule says of an output. `writes`: all bits set, or none if it says nothing.
struct FuzzySaid {
  float value;
  std::uint32_t writes;
};

/// The rules that fired, in the order of the text, each with its strength and number. `fired` has room for one more than there are
/// rules.
struct FuzzyFiring {
  float strength;
  std::uint32_t rule;
};
struct FuzzyFirings {
  FuzzyFiring* fired;
  std::uint32_t count = 0;
  void add(float strength, std::uint32_t rule) noexcept {
    fired[count] = {strength, rule};
    count += strength > 0.0f ? 1u : 0u;
  }
};

/// One output's view of them. What the rules say of it stands kStride apart.
template <std::uint32_t kStride>
struct FuzzyVoices {
  const FuzzyFirings& firings;
  const FuzzySaid* said;

  [[nodiscard]] float value(std::uint32_t i) const noexcept { return said[kStride * firings.fired[i].rule].value; }
  /// 0 if the rule does not write the output.
  [[nodiscard]] std::uint32_t strength_bits(std::uint32_t i) const noexcept {
    return std::bit_cast<std::uint32_t>(firings.fired[i].strength) & said[kStride * firings.fired[i].rule].writes;
  }
  /// Strengths are not negative, so their bits are in the same order as they are: no jump.
  [[nodiscard]] FuzzyStrongest strongest() const noexcept {
    std::uint32_t most = 0, value_bits = 0;
    for (std::uint32_t i = 0; i < firings.count; ++i) {
      const std::uint32_t bits = strength_bits(i), stronger = 0u - static_cast<std::uint32_t>(bits > most);
      most ^= (most ^ bits) & stronger;
      value_bits ^= (value_bits ^ std::bit_cast<std::uint32_t>(value(i))) & stronger;
    }
    return {std::bit_cast<float>(most), std::bit_cast<float>(value_bits)};
  }
  /// The sums over the values that are at most `within` from `centre`, taken as differences from it.
  [[nodiscard]] FuzzySums sums_about(float centre, const FuzzyOutput& output) const noexcept {
    FuzzySums sums;
    for (std::uint32_t i = 0; i < firings.count; ++i) {
      const float d = output.period > 0.0f ? shortest_difference(value(i), centre, output.period) : value(i) - centre;
      const bool below = d <= output.within, above = d >= -output.within;
      const std::uint32_t chosen = 0u - static_cast<std::uint32_t>(below & above);
      sums.add(std::bit_cast<float>(strength_bits(i) & chosen), d);
    }
    return sums;
  }
  [[nodiscard]] FuzzySums sums() const noexcept {
    FuzzySums sums;
    for (std::uint32_t i = 0; i < firings.count; ++i) sums.add(std::bit_cast<float>(strength_bits(i)), value(i));
    return sums;
  }
};

template <std::uint32_t kStride>
[[nodiscard]] inline float conclude(const FuzzyVoices<kStride>& voices, const FuzzyOutput& output, FuzzyStatus& status) noexcept {
  if (output.combine == FuzzyCombine::kAverage || output.combine == FuzzyCombine::kSum) return conclude(voices.sums(), output, status);
  FuzzyStrongest strongest = voices.strongest();
  if (output.combine == FuzzyCombine::kAverageAbout && strongest.strength > 0.0f) {
    const FuzzySums sums = voices.sums_about(strongest.value, output);
    strongest.value = strongest.value + sums.sum / sums.weight;
  }
  return conclude(strongest, output, status);
}

}  // namespace mts

#undef MTS_LANES
