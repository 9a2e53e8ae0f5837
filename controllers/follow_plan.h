// Crosses a hall on a path that a planner finds. `neural_map` and `genetic` differ only in the planner, which the program supplies
// (host.h; the simulator supplies those of planners/, with the map of the hall). In each period the planner gets what the range finders
// see; if that blocks the path, the planner gives another one. The path is driven as course.h says, its bends on arcs of 10 cm. Until it has
// a path, the robot stands.
// Held up for 4 s, the robot asks for another path; held up for 8 s, it is trapped. If it is trapped or there is no path, `plight()` says
// so, and it stands. Without odometry, any heading or a hall, it stops. A robot without range finders sees nothing new.
#pragma once

#include "gain.h"
#include "hall.h"
#include "host.h"

namespace mts {

inline constexpr Gain<PlanGains> kNeuralMapGains[] = {
    gain("speed", "m/s", &PlanGains::speed_m_s, 0.05f, 0.6f, "on straight pieces"),
    angle_gain("turn_speed", "deg/s", &PlanGains::turn_rad_s, 20.0f, 240.0f, "the fastest turn"),
    distance_gain("clearance", &PlanGains::clearance_m, 0.15f, 0.5f, "from the robot's centre to what stands there, at least"),
    gain("cell", "m", &PlanGains::cell_m, 0.05f, 0.3f, "side of a cell of the map"),
};
inline constexpr Gain<PlanGains> kGeneticGains[] = {
    kNeuralMapGains[0],
    kNeuralMapGains[1],
    kNeuralMapGains[2],
    kNeuralMapGains[3],
    whole_gain("population", &PlanGains::population, 2.0f, 500.0f, "walks that are bred at once"),
    whole_gain("generations", &PlanGains::generations, 1.0f, 2000.0f, "at most"),
    whole_gain("seed", &PlanGains::seed, 0.0f, 1e6f, "of the dice"),
};

class FollowPlan : public HallController {
 public:
  PlanGains gains;
  Body body;
  Host host;

  void start(const Task& task, const Senses& raw) noexcept {
    hall_.start(task, raw, body, Shut::kNone);
    course_ = {};
    in_ = task.in;
    first_ = true;
    idle_s_ = 0.0f;
    plight_ = Plight::kNone;
  }

  [[nodiscard]] Motion step(const Senses& raw, float dt_s) noexcept {
    const Senses senses = hall_.hear(raw, dt_s);
    const bool stood = idle_s_ < kIdle_s;
    const bool still = magnitude(senses.speed_m_s) < 0.02f && magnitude(wrapped_angle(hall_.at().heading_rad - last_rad_)) < 0.002f;
    idle_s_ = still && !hall_.blind() && hall_.sees(senses) ? idle_s_ + sane_period(dt_s) : 0.0f;
    last_rad_ = hall_.at().heading_rad;
    if (hall_.blind() || plight_ != Plight::kNone) return {};
    if (hall_.missed_door()) plight_ = Plight::kTrapped;
    if (!hall_.crosses()) return hall_.through_door(senses, {gains.speed_m_s, gains.turn_rad_s});
    Way way;
    const WayQuestion question{hall_.at(), hall_.gate(), in_, &senses, &gains, first_};
    const WayNews news = host.look == nullptr ? WayNews::kNoWay : host.look(host.self, question, way);
    if (news == WayNews::kNoWay) plight_ = Plight::kNoWay;
    if (news == WayNews::kFailed) plight_ = Plight::kTrapped;
    if (idle_s_ > 2.0f * kIdle_s) plight_ = Plight::kTrapped;
    if (plight_ != Plight::kNone) return {};
    if (news == WayNews::kNew) course_.start(way.pieces, way.count, kBend_m, hall_.at());
    first_ = course_.empty() || (stood && idle_s_ >= kIdle_s);   // held up, it asks for another path from there
    if (course_.empty()) return {};
    const OnCourse on = course_.at(hall_.at());
    const CourseGains how{gains.speed_m_s, 7.0f, gains.turn_rad_s, 0.6f};
    return braked(along_course(on, how), senses, body, 0.03f);
  }

 private:
  static constexpr float kBend_m = 0.1f, kIdle_s = 4.0f;
  Course course_{};
  Door in_{};
  float idle_s_ = 0.0f, last_rad_ = 0.0f;
  bool first_ = true;
};

}  // namespace mts
