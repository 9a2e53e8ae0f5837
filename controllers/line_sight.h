// What the row of line sensors sees: a line to follow, one with an arm to a side, or one across.
#pragma once

#include "angles.h"
#include "body.h"

namespace mts {

struct LineSight {
  bool seen = false;        ///< there is paint under the row
  bool across = false;      ///< nearly all of the row is on paint: a stop line, or the middle of a cross
  bool left_arm = false;    ///< paint from the middle to the left end: a corner or a branch; `right_arm`: the same to the right
  bool right_arm = false;
  bool left_beside = false; ///< paint under the left end, apart from that in the middle: an arm that comes nearer; `right_beside`: the same at the right
  bool right_beside = false;
  bool forked = false;      ///< paint on both sides of a sensor that sees none: two lines
  float strength = 0.0f;    ///< how many sensors see paint
  float left_m = 0.0f;      ///< how far the middle of the paint lies to the left of the robot's axis; 0 if nothing is seen

  static constexpr float kWide = 2.4f;   ///< a strength that one line along the robot's axis cannot reach
  [[nodiscard]] constexpr bool wide() const noexcept { return strength >= kWide; }
  [[nodiscard]] constexpr bool narrow() const noexcept { return seen && !wide() && !forked; }
};

/// The place of the line is the weighted mean of the sensors' places, y = sum(w_i y_i) / sum(w_i); a weight is 0 up to a darkness of 0.2
/// and 1 from 0.8 on (as Pololu's QTR library reads its arrays). Nothing is seen if the line sensors are silent or the weights sum to less
/// than 0.5.
[[nodiscard]] constexpr LineSight look_at_line(const Senses& senses, const Body& body) noexcept {
  LineSight sight;
  if (!senses.line_known) return sight;
  float weight[kLineSensors] = {};
  float sum = 0.0f, moment = 0.0f;
  for (std::size_t i = 0; i < kLineSensors; ++i) {
    weight[i] = clamped((senses.line[i] - 0.2f) / 0.6f, 0.0f, 1.0f);
    sum += weight[i];
    moment += weight[i] * body.line_sensor_left_m(i);
  }
  sight.strength = sum;
  sight.seen = sum >= 0.5f;
  if (!sight.seen) return sight;
  sight.left_m = moment / sum;
  sight.across = sum >= 3.6f && weight[0] > 0.5f && weight[kLineSensors - 1] > 0.5f;
  const auto arm = [&](std::size_t outer, std::size_t next) {
    return !sight.across && sight.wide() && weight[outer] > 0.5f && weight[next] > 0.5f;
  };
  sight.left_arm = arm(0, 1);
  sight.right_arm = arm(kLineSensors - 1, kLineSensors - 2);
  const auto beside = [&](std::size_t outer, std::size_t next) {
    return weight[outer] > 0.5f && weight[next] < 0.5f && sum - weight[outer] - weight[next] > 0.5f;
  };
  sight.left_beside = beside(0, 1);
  sight.right_beside = beside(kLineSensors - 1, kLineSensors - 2);
  bool gap = false, paint = false;
  for (const float w : weight) {
    sight.forked = sight.forked || (gap && w > 0.5f);
    gap = paint && (gap || w < 0.5f);
    paint = paint || w > 0.5f;
  }
  return sight;
}

}  // namespace mts
