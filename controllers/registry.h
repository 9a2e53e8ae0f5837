// The names by which the `control` lines of a knowledge base call these controllers, and the parameters of each.
//
//   control Avoid = keep_wall(side: right, distance: 0.2 m)
//                   `ControllerEntry::name`, then pairs of `Parameter::name` and a value
// Constants only. The simulator checks control lines against them; a test checks docs/controllers.md.
#pragma once

#include "bug.h"
#include "follow_line.h"
#include "follow_plan.h"
#include "follow_rules.h"
#include "hold_heading.h"
#include "keep_wall.h"
#include "potential.h"
#include "round_obstacle.h"
#include "spot.h"
#include "text.h"
#include "turns.h"

namespace mts {

/// The controllers behind the names; several names may share one.
enum class ControllerId : std::uint8_t {
  kStand, kFollowLine, kKeepWall, kHoldHeading, kTurnOnLine, kTurnByWalls, kTurnByCompass, kRoundObstacle, kTurnRound, kLookRound,
  kBug, kPotential, kFollowRules, kNeuralMap, kGenetic
};

struct ControllerEntry {
  const char* name;          ///< as control lines call it
  ControllerId id;
  const char* about;         ///< one line
  const char* needs;         ///< the senses without which it stops; to drive ahead it also needs range finders, if its body has them
  bool ends;                 ///< it comes to an end, which `done()` reports
};

/// Whether it crosses halls, where no roads lead. Where there is no hall to cross such a controller stands.
[[nodiscard]] constexpr bool crosses_halls(ControllerId id) noexcept {
  using Id = ControllerId;
  return id == Id::kBug || id == Id::kPotential || id == Id::kFollowRules || id == Id::kNeuralMap || id == Id::kGenetic;
}

/// The parameter of manoeuvres that is not a gain: it goes into the task.
inline constexpr Parameter kTurnParameter{"turn", "", 2.0f, 0.0f, 3.0f, "how the crossing is driven; else as the task says",
                                          Values::kTurn};

inline constexpr ControllerEntry kControllers[] = {
    {"follow_line", ControllerId::kFollowLine, "drives along a painted line", "line", false},
    {"keep_wall", ControllerId::kKeepWall, "drives between walls, or with one at a hand", "range finders", false},
    {"hold_heading", ControllerId::kHoldHeading, "drives the course that the map tells", "odometry, compass",
     false},
    {"turn_on_line", ControllerId::kTurnOnLine, "drives over a crossing by its painted lines",
     "line, odometry, a heading", true},
    {"turn_by_walls", ControllerId::kTurnByWalls, "drives over a crossing by the walls",
     "range finders, odometry, a heading", true},
    {"turn_by_compass", ControllerId::kTurnByCompass, "drives over a crossing by reckoning", "odometry, a heading", true},
    {"round_obstacle", ControllerId::kRoundObstacle, "goes round an obstacle, back to the track",
     "range finders, odometry, a heading", true},
    {"turn_round", ControllerId::kTurnRound, "turns on the spot", "a heading", true},
    {"look_round", ControllerId::kLookRound, "turns to and fro on the spot", "a heading", false},
    {"bug", ControllerId::kBug, "crosses a hall: straight to the goal, and round what it meets", "range finders, odometry, a heading", true},
    {"potential", ControllerId::kPotential, "crosses a hall: the goal attracts, what stands there repels",
     "range finders, odometry, a heading", true},
    {"neural_map", ControllerId::kNeuralMap, "crosses a hall on a way that a neural map finds", "odometry, a heading, a planner", true},
    {"genetic", ControllerId::kGenetic, "crosses a hall on a way that is bred", "odometry, a heading, a planner", true},
    {"stand_still", ControllerId::kStand, "stands", "nothing", false},
    {"stand", ControllerId::kStand, "stands", "nothing", false},
    {"stop", ControllerId::kStand, "stands", "nothing", false},
};

/// The entry with this name; null if there is none. O(entries).
[[nodiscard]] constexpr const ControllerEntry* find_controller(const char* name) noexcept {
  for (const ControllerEntry& entry : kControllers) {
    if (same_text(entry.name, name)) return &entry;
  }
  return nullptr;
}

/// Calls `use` with each parameter of a controller, in the order in which they are explained.
template <class Use>
constexpr void for_each_parameter(ControllerId id, Use&& use) {
  const auto each = [&](const auto& gains) {
    for (const auto& one : gains) use(one.parameter);
  };
  switch (id) {
    case ControllerId::kStand: return;
    case ControllerId::kFollowLine: return each(kFollowLineGains);
    case ControllerId::kKeepWall: return each(kKeepWallGains);
    case ControllerId::kHoldHeading: return each(kHoldHeadingGains);
    case ControllerId::kTurnOnLine:
    case ControllerId::kTurnByWalls:
    case ControllerId::kTurnByCompass:
      use(kTurnParameter);
      return each(kCrossingGains);
    case ControllerId::kRoundObstacle: return each(kRoundObstacleGains);
    case ControllerId::kTurnRound: return each(kTurnRoundGains);
    case ControllerId::kLookRound: return each(kLookRoundGains);
    case ControllerId::kBug: return each(kBugGains);
    case ControllerId::kPotential: return each(kPotentialGains);
    case ControllerId::kFollowRules: return;   // a fuzzy block: its arguments fix its inputs
    case ControllerId::kNeuralMap: return each(kNeuralMapGains);
    case ControllerId::kGenetic: return each(kGeneticGains);
  }
}

/// The parameter with this name; null if the controller has none.
[[nodiscard]] constexpr const Parameter* find_parameter(ControllerId id, const char* name) noexcept {
  const Parameter* found = nullptr;
  for_each_parameter(id, [&](const Parameter& parameter) {
    if (same_text(parameter.name, name)) found = &parameter;
  });
  return found;
}

/// The largest allowed value of a parameter for this body: for a speed (unit m/s) the body's top speed, for everything else
/// `Parameter::high`, whatever the body.
[[nodiscard]] constexpr float highest(const Parameter& parameter, const Body& body) noexcept {
  return same_text(parameter.unit, "m/s") ? body.top_speed_m_s : parameter.high;
}

/// The smallest: for a distance from the robot's centre at least the body's radius + 3 cm, since nearer things are not kept at a distance
/// but borne away from (see `braked`); for everything else `Parameter::low`. Never above `highest`.
[[nodiscard]] constexpr float lowest(const Parameter& parameter, const Body& body) noexcept {
  const float low = parameter.from_centre ? greatest(parameter.low, body.radius_m + kNearestBeside_m) : parameter.low;
  return least(low, highest(parameter, body));
}

/// The number that stands for a word; -1 if the parameter has no such word, or takes numbers.
[[nodiscard]] constexpr float number_of_word(const Parameter& parameter, const char* word) noexcept {
  const Words words = words_of(parameter.values);
  for (std::size_t i = 0; i < words.count; ++i) {
    if (same_text(words.first[i], word)) return static_cast<float>(i);
  }
  return -1.0f;
}

}  // namespace mts
