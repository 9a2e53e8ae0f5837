// The kinds of things that several phases speak of, and the language's words for them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace kb {

enum class CellKind : std::uint8_t { kFact, kSatellite, kStrategy };
/// `fact`, `satellite`, `strategy`.
[[nodiscard]] constexpr std::string_view word(CellKind kind) {
  constexpr std::array<std::string_view, 3> kWords{"fact", "satellite", "strategy"};
  return kWords[static_cast<std::size_t>(kind)];
}

enum class Term : std::uint8_t { kLow, kZero, kHigh };
/// The words for terms, in that order.
inline constexpr std::array<std::string_view, 3> kTermWords{"low", "zero", "high"};
[[nodiscard]] constexpr std::string_view word(Term term) { return kTermWords[static_cast<std::size_t>(term)]; }

/// An `or` of more parts (`any Leg`) is not written out within other conditions: it is one node that all rules share.
inline constexpr std::size_t kSmallOr = 32;

/// What runs while no strategy is wanted.
enum class Idle : std::uint8_t { kStop, kHold, kStrategy };

/// A part of what defines a fact: a reading like a prototype, a reading that is a text, another fact, or parts put together.
enum class PerceptOp : std::uint8_t { kFits, kReads, kFact, kNot, kAnd, kOr };

}  // namespace kb
