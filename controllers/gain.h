// How a controller declares its parameters: one table of `Gain`s each, from which the registry, the compiler's checks and the
// documentation are made. Each default is written only once, in the initialiser of the field.
#pragma once

#include <cstddef>
#include <cstdint>

#include "angles.h"

namespace mts {

/// On which hand something is kept.
enum class Side : std::uint8_t { kBoth, kLeft, kRight };

/// How the bug leaves an obstacle that it follows, and how the goal attracts: see bug.h and potential.h.
enum class BugKind : std::uint8_t { kBug1, kBug2, kModified };
enum class FieldKind : std::uint8_t { kParabolic, kConic, kCombined };

/// What values a parameter takes: a number, or one of a list of words. The number of a word is its index in the list, which equals the
/// value of its enumerator.
enum class Values : std::uint8_t {
  kNumber,   ///< in [low, high], in `unit`
  kWhole,    ///< a whole number in [low, high]
  kSide,     ///< `Side`
  kTurn,     ///< `Turn`
  kBug,      ///< `BugKind`
  kField,    ///< `FieldKind`
};

/// Some words, static text.
struct Words {
  const char* const* first = nullptr;
  std::size_t count = 0;
};
inline constexpr const char* kSideWords[] = {"both", "left", "right"};
inline constexpr const char* kTurnWords[] = {"back", "left", "forward", "right"};
inline constexpr const char* kBugWords[] = {"bug1", "bug2", "modified"};
inline constexpr const char* kFieldWords[] = {"parabolic", "conic", "combined"};

/// The words that a parameter takes; none if it takes numbers.
[[nodiscard]] constexpr Words words_of(Values values) noexcept {
  switch (values) {
    case Values::kNumber:
    case Values::kWhole: return {};
    case Values::kSide: return {kSideWords, 3};
    case Values::kTurn: return {kTurnWords, 4};
    case Values::kBug: return {kBugWords, 3};
    case Values::kField: return {kFieldWords, 3};
  }
  return {};
}

/// One parameter as a `control` line names it. All text is static.
struct Parameter {
  const char* name;
  const char* unit;    ///< m, m/s, deg, deg/s, 1/m, ...; "" for a ratio or a word
  float preset;        ///< the default, in `unit`
  float low, high;     ///< inclusive, in `unit`; `lowest` and `highest` in registry.h say what a body leaves of it
  const char* about;   ///< one line
  Values values;
  bool from_centre = false;   ///< a distance from the robot's centre to what stands beside it
};

/// A parameter, and the field of the gains that holds it.
template <class Gains>
struct Gain {
  Parameter parameter{};
  float Gains::* number = nullptr;
  Side Gains::* side = nullptr;
  float per_unit = 1.0f;   ///< what one `unit` is in the field: fields hold radians
  BugKind Gains::* bug = nullptr;
  FieldKind Gains::* field = nullptr;

  constexpr void set(Gains& gains, float value) const {
    if (number != nullptr) gains.*number = value * per_unit;
    if (side != nullptr) gains.*side = static_cast<Side>(static_cast<int>(value));
    if (bug != nullptr) gains.*bug = static_cast<BugKind>(static_cast<int>(value));
    if (field != nullptr) gains.*field = static_cast<FieldKind>(static_cast<int>(value));
  }
};

/// A number whose field has the unit that is written.
template <class Gains>
[[nodiscard]] constexpr Gain<Gains> gain(const char* name, const char* unit, float Gains::* field, float low, float high,
                                         const char* about) {
  return {{name, unit, Gains{}.*field, low, high, about, Values::kNumber}, field, nullptr, 1.0f, nullptr, nullptr};
}
/// A distance from the robot's centre to what stands beside it.
template <class Gains>
[[nodiscard]] constexpr Gain<Gains> distance_gain(const char* name, float Gains::* field, float low, float high, const char* about) {
  Gain<Gains> made = gain(name, "m", field, low, high, about);
  made.parameter.from_centre = true;
  return made;
}
/// A whole number.
template <class Gains>
[[nodiscard]] constexpr Gain<Gains> whole_gain(const char* name, float Gains::* field, float low, float high, const char* about) {
  return {{name, "", Gains{}.*field, low, high, about, Values::kWhole}, field, nullptr, 1.0f, nullptr, nullptr};
}
/// An angle or a rate of turning: written in degrees, held in radians.
template <class Gains>
[[nodiscard]] constexpr Gain<Gains> angle_gain(const char* name, const char* unit, float Gains::* field, float low, float high,
                                               const char* about) {
  return {{name, unit, Gains{}.*field / kRadPerDeg, low, high, about, Values::kNumber}, field, nullptr, kRadPerDeg, nullptr, nullptr};
}
/// A side.
template <class Gains>
[[nodiscard]] constexpr Gain<Gains> side_gain(const char* name, Side Gains::* field, const char* about) {
  return {{name, "", static_cast<float>(Gains{}.*field), 0.0f, 2.0f, about, Values::kSide}, nullptr, field, 1.0f, nullptr, nullptr};
}
/// A kind of bug, a kind of field.
template <class Gains>
[[nodiscard]] constexpr Gain<Gains> kind_gain(const char* name, BugKind Gains::* field, const char* about) {
  return {{name, "", static_cast<float>(Gains{}.*field), 0.0f, 2.0f, about, Values::kBug}, nullptr, nullptr, 1.0f, field, nullptr};
}
template <class Gains>
[[nodiscard]] constexpr Gain<Gains> kind_gain(const char* name, FieldKind Gains::* field, const char* about) {
  return {{name, "", static_cast<float>(Gains{}.*field), 0.0f, 2.0f, about, Values::kField}, nullptr, nullptr, 1.0f, nullptr, field};
}

}  // namespace mts
