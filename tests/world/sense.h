// What the robot senses, as certainty factors; 0 is "no data".
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "tests/world/world.h"

namespace kb::world {

inline constexpr float kSure = 0.9f;
inline constexpr float kSureNot = -0.9f;

/// The senses of one tick. A disturbance changes them before the mind gets them.
struct Readings {
  std::vector<float> landmark;                 ///< by LandmarkId: its sign is in view
  float line = -1.0f, obstacle = -1.0f, turned = -1.0f, safe = 0.0f;
  std::array<float, 4> in{}, closed{};         ///< by Direction
  std::array<float, 3> track{}, cross_by{}, move_by{};  ///< by Method
  std::vector<std::pair<std::string, float>> host;      ///< buttons and other facts of the host program, by name

  void set(std::string_view fact, float value) { host.emplace_back(fact, value); }

  /// Calls `visit(value, is_landmark)` for every sensor reading (not for the host's facts), always in the same order.
  template <class Visit>
  void each(Visit visit) { each_of(*this, visit); }
  template <class Visit>
  void each(Visit visit) const { each_of(*this, visit); }

 private:
  template <class Self, class Visit>
  static void each_of(Self& self, Visit& visit) {
    for (auto& v : self.landmark) visit(v, true);
    for (auto* v : {&self.line, &self.obstacle, &self.turned, &self.safe}) visit(*v, false);
    for (auto& v : self.in) visit(v, false);
    for (auto& v : self.closed) visit(v, false);
    for (auto& v : self.track) visit(v, false);
    for (auto& v : self.cross_by) visit(v, false);
    for (auto& v : self.move_by) visit(v, false);
  }
};

/// What the sensors of a faultless robot say in this world. Pure.
[[nodiscard]] Readings sense(const World& world);

}  // namespace kb::world
