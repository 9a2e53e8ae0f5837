// Drives along an unmarked road by the headings and lengths of its pieces, with compass and odometry.
//
// The place is reckoned (reckoning.h) from where the strategy begins, which is taken as the middle of the road; the course is driven as
// course.h says. If the task has no pieces, the robot holds its heading at the start for a distance of `reach`, since an unmarked floor
// looks like a road everywhere. Past the end of the course, or of `reach`, it goes on for `overrun`, then stops. Without odometry or any
// heading it stops; without the compass it drives at most `blind`.
#pragma once

#include "course.h"
#include "gain.h"
#include "heard.h"

namespace mts {

struct HoldHeadingGains {
  float speed_m_s = 0.3f;
  float convergence_1_m = 6.0f;
  float turn_rad_s = 115.0f * kRadPerDeg;
  float bend_radius_m = 0.15f;
  float overrun_m = 0.6f;
  float blind_m = 0.5f;
  float reach_m = 4.0f;
};

inline constexpr Gain<HoldHeadingGains> kHoldHeadingGains[] = {
    gain("speed", "m/s", &HoldHeadingGains::speed_m_s, 0.05f, 0.6f, "on straight pieces"),
    gain("convergence", "1/m", &HoldHeadingGains::convergence_1_m, 2.0f, 15.0f, "lambda: how quickly errors decay over the way"),
    angle_gain("turn_speed", "deg/s", &HoldHeadingGains::turn_rad_s, 20.0f, 240.0f, "the fastest turn"),
    gain("bend_radius", "m", &HoldHeadingGains::bend_radius_m, 0.0f, 1.0f, "how bends are rounded; 0: on the spot"),
    gain("overrun", "m", &HoldHeadingGains::overrun_m, 0.0f, 5.0f, "how far it goes on past the end of the course"),
    gain("blind", "m", &HoldHeadingGains::blind_m, 0.0f, 5.0f, "how far it goes on without the compass"),
    gain("reach", "m", &HoldHeadingGains::reach_m, 0.0f, 1000.0f, "how far it goes where nobody tells a course"),
};

class HoldHeading {
 public:
  HoldHeadingGains gains;
  Body body;

  void start(const Task& task, const Senses& raw) noexcept {
    const Senses senses = heard(raw, body);
    const bool untold = task.pieces == 0;
    reckoning_.start_along(senses, task);
    const Piece ahead{reckoning_.at.heading_rad, gains.reach_m};
    course_.start(untold ? &ahead : task.course, untold ? 1u : task.pieces, gains.bend_radius_m, {});
    over_ = false;
  }

  [[nodiscard]] Motion step(const Senses& raw, float dt_s) noexcept {
    const Senses senses = heard(raw, body);
    reckoning_.step(senses, sane_period(dt_s));
    if (!reckoning_.heading_known() || !reckoning_.distance_known()) return {};
    if (!senses.heading_known && reckoning_.compass_silent_m() >= gains.blind_m) return {};
    const OnCourse on = course_.at(reckoning_.at);
    over_ = course_.on_last() && on.along_m > course_.current().length_m + gains.overrun_m;
    if (over_) return {};
    const CourseGains how{gains.speed_m_s, gains.convergence_1_m, gains.turn_rad_s, 0.6f};
    return braked(along_course(on, how), senses, body);
  }

  [[nodiscard]] bool done() const noexcept { return false; }
  /// Whether the course is over while the strategy still runs; the robot then stands.
  [[nodiscard]] bool lost() const noexcept { return over_; }

 private:
  Reckoning reckoning_{};
  Course course_{};
  bool over_ = false;
};

}  // namespace mts
