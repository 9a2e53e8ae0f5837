// How a controller tells what can be set on it: one table of `Gain`s each, from which the registry, the compiler's checks and
// the documentation are made. A default stands once, in the initialiser of the field.
#pragma once

#include <cstddef>
#include <cstdint>

#include "controllers/angles.h"

namespace mts {

/// At which hand something is kept.
enum class Side : std::uint8_t { kBoth, kLeft, kRight };

/// What values a parameter takes.
enum class Values : std::uint8_t {
  kNumber,   ///< a number in [low, high], in `unit`
  kSide,     ///< one of the words both, left, right; as a number their index
  kTurn,     ///< one of the words back, left, forward, right; as a number their index, which is that of `Turn`
};

/// One parameter as a `control` line names it. All text is static.
struct Parameter {
  const char* name;
  const char* unit;    ///< m, m/s, deg, deg/s, 1/m, ...; "" for a ratio or a word
  float preset;        ///< the default, in `unit`
  float low, high;     ///< inclusive, in `unit`
  const char* about;   ///< one line
  Values values;
};

/// A parameter, and the field of the gains that holds it.
template <class Gains>
struct Gain {
  Parameter parameter{};
  float Gains::* number = nullptr;
  Side Gains::* side = nullptr;
  float per_unit = 1.0f;   ///< what one `unit` is in the field: fields hold radians

  constexpr void set(Gains& gains, float value) const {
    if (number != nullptr) gains.*number = value * per_unit;
    if (side != nullptr) gains.*side = static_cast<Side>(static_cast<int>(value));
  }
};

/// A number whose field has the unit that is written.
template <class Gains>
[[nodiscard]] constexpr Gain<Gains> gain(const char* name, const char* unit, float Gains::* field, float low, float high,
                                         const char* about) {
  return {{name, unit, Gains{}.*field, low, high, about, Values::kNumber}, field, nullptr, 1.0f};
}
/// An angle or a rate of turning: written in degrees, held in radians.
template <class Gains>
[[nodiscard]] constexpr Gain<Gains> angle_gain(const char* name, const char* unit, float Gains::* field, float low, float high,
                                               const char* about) {
  return {{name, unit, Gains{}.*field / kRadPerDeg, low, high, about, Values::kNumber}, field, nullptr, kRadPerDeg};
}
/// A side.
template <class Gains>
[[nodiscard]] constexpr Gain<Gains> side_gain(const char* name, Side Gains::* field, const char* about) {
  return {{name, "", static_cast<float>(Gains{}.*field), 0.0f, 2.0f, about, Values::kSide}, nullptr, field, 1.0f};
}

}  // namespace mts
