// What goes wrong in a run of the experiment: scenarios, drawn by class of disturbance, as text for read_scenario.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "sim/experiment/way.h"
#include "sim/random.h"

namespace kb::sim::experiment {

/// The paper's three classes of disturbance, and none.
enum class Class : std::uint8_t {
  kNone,
  kRoute,         ///< fragments of the route cannot be reached: closed roads, unsafe crossings
  kBetween,       ///< interruptions between landmarks: obstacles, power lost and back, commands sent twice
  kPlace,         ///< localisation is lost: marking, tags, both; carried away
};
inline constexpr std::array<std::string_view, 4> kClassNames{"none", "1 route", "2 between", "3 place"};

inline constexpr double kStartBefore = 1.2;   ///< m: how far before the first stop line the robot starts

/// One word for each kind of thing that goes wrong, with its class.
struct KindWord { Class what; std::string_view word; };
inline constexpr std::array<KindWord, 13> kKindWords{{{Class::kRoute, "closed"}, {Class::kRoute, "closed_a_while"}, {Class::kRoute, "unsafe"},
                                                      {Class::kBetween, "obstacle"}, {Class::kBetween, "obstacle_stays"}, {Class::kBetween, "walker"},
                                                      {Class::kBetween, "power"}, {Class::kBetween, "twice"}, {Class::kPlace, "worn"},
                                                      {Class::kPlace, "tag_unreadable"}, {Class::kPlace, "tag_wrong"}, {Class::kPlace, "carried_on_road"},
                                                      {Class::kPlace, "carried"}}};
/// Whether a case of this class can have this text for its kinds.
[[nodiscard]] bool are_kinds_of(Class what, std::string_view kinds);

struct Case {
  Class what{};
  std::uint64_t seed = 0;    ///< of all noise
  std::string kinds;         ///< `closed+unsafe`: of kKindWords one for each thing that goes wrong, in order
  std::string scenario;      ///< TOML
  Bans bans;                 ///< what stays closed to the end; the shortest way avoids it
};

/// What a case is drawn for. Whatever is drawn, a way from `start` to the goal remains.
struct CaseGround {
  const Labyrinth& labyrinth;   ///< for a robot of size 1
  const RoutePlan& route;
  Labyrinth::End start;      ///< the robot starts on the road of this arm of the first crossing of the route
  double limit_s = 600.0;
  float size = 1.0f;         ///< of the robot: the same case on a floor enlarged by this factor
};
[[nodiscard]] Case draw_case(const CaseGround& ground, Class what, std::uint64_t seed, Random& random);

}  // namespace kb::sim::experiment
