// The words of the toy world: four compass points, four turns, three ways to follow a track.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string_view>

namespace kb::world {

enum class Direction : std::uint8_t { kN, kE, kS, kW };
/// In the order of the exits clockwise from the road of arrival.
enum class Turn : std::uint8_t { kBack, kLeft, kForward, kRight };
enum class Method : std::uint8_t { kMark, kDist, kAzimuth };

inline constexpr std::array<Direction, 4> kDirections{Direction::kN, Direction::kE, Direction::kS, Direction::kW};
inline constexpr std::array<Method, 3> kMethods{Method::kMark, Method::kDist, Method::kAzimuth};
inline constexpr std::array<std::string_view, 4> kDirectionNames{"N", "E", "S", "W"};
inline constexpr std::array<std::string_view, 4> kTurnNames{"back", "left", "forward", "right"};
inline constexpr std::array<std::string_view, 3> kMethodNames{"mark", "dist", "azimuth"};

template <class Enum>
[[nodiscard]] constexpr std::size_t index(Enum value) { return static_cast<std::size_t>(value); }

[[nodiscard]] constexpr std::string_view name(Direction d) { return kDirectionNames[index(d)]; }
[[nodiscard]] constexpr std::string_view name(Method m) { return kMethodNames[index(m)]; }

/// The member of `Enum` that `names` calls `word`, if there is one.
template <class Enum, std::size_t N>
[[nodiscard]] constexpr std::optional<Enum> find(const std::array<std::string_view, N>& names, std::string_view word) {
  for (std::size_t i = 0; i < N; ++i) {
    if (names[i] == word) return static_cast<Enum>(i);
  }
  return std::nullopt;
}

/// The road by which a crossing is left, if it is entered on the road `arrival` and driven with `turn`.
[[nodiscard]] constexpr Direction exit_after(Direction arrival, Turn turn) {
  return static_cast<Direction>((index(arrival) + index(turn)) % 4);
}
[[nodiscard]] constexpr Direction opposite(Direction d) { return exit_after(d, Turn::kForward); }

/// A set of methods: what can be followed on a road, how a crossing can be driven.
class MethodSet {
 public:
  constexpr MethodSet() = default;
  constexpr MethodSet(std::initializer_list<Method> methods) {
    for (Method m : methods) bits_ = static_cast<std::uint8_t>(bits_ | (1u << index(m)));
  }
  [[nodiscard]] constexpr bool contains(Method m) const { return (bits_ >> index(m) & 1u) != 0; }
  friend constexpr bool operator==(MethodSet, MethodSet) = default;

 private:
  std::uint8_t bits_ = 0;
};

}  // namespace kb::world
