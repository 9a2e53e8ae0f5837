// Heuristic control: Bug2 towards the goal's coordinates (Lumelsky and Stepanov, Algorithmica 2, 1987). It knows where it
// started and where the goal lies, and reckons its place from odometry and compass. It senses the world only by range finders and
// bumper. It has no map, reads no tags and sees no paint.
//
// The discrete method is planners/bug2.cc. A robot that is not a point, with a place that drifts, needs tolerances: the line
// from start to goal is a band, "the same place" is a circle; see bug_helm.cc.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <waymark/controllers/any_controller.h>
#include <waymark/controllers/reckoning.h>
#include <waymark/controllers/steady_ranges.h>
#include "sim/drive/helm.h"
#include "sim/mind/knowledge.h"

namespace kb::sim::experiment {

class BugHelm final : public Helm {
 public:
  BugHelm(const mts::Body& body, const Pose& start, std::string goal, Spot at);

  /// The first press begins the mission; later presses do nothing.
  void press(program::CellId /*fact*/, bool /*held*/) override { pressed_ = true; }
  [[nodiscard]] mts::Motion step(std::int64_t now_us, const mts::Senses& raw, const TagHeard& tag, float dt_s) override;
  [[nodiscard]] Judge::Belief belief() const override;
  [[nodiscard]] std::optional<bool> mission() const override { return on_mission(); }
  [[nodiscard]] const std::string& goal() const override { return goal_; }
  /// Gives up after a full round about an obstacle without a place to leave it: the goal is out of reach.
  [[nodiscard]] std::vector<std::string> reports() const override { return gave_up_ ? std::vector<std::string>{"no way"} : std::vector<std::string>{}; }

 private:
  [[nodiscard]] bool on_mission() const { return pressed_ && !arrived_; }
  enum class Phase : std::uint8_t { kToGoal, kAlign, kFollow, kBack };
  [[nodiscard]] Spot place() const { return {static_cast<double>(reckoning_.at.x_m), static_cast<double>(reckoning_.at.y_m)}; }
  [[nodiscard]] double bearing_rad() const;
  [[nodiscard]] float free_towards_goal(const mts::Senses& senses) const;
  [[nodiscard]] mts::Motion to_goal(const mts::Senses& senses);
  [[nodiscard]] mts::Motion align(const mts::Senses& senses);
  [[nodiscard]] mts::Motion follow(const mts::Senses& senses, float dt_s);
  void meet_wall();
  [[nodiscard]] bool may_leave(const mts::Senses& senses) const;

  Pose start_;
  std::string goal_;
  Spot goal_at_, hit_;
  mts::SteadyRanges steadied_;
  mts::Reckoning reckoning_;
  mts::AnyController wall_;
  Phase phase_ = Phase::kToGoal;
  float hit_travelled_m_ = 0.0f, back_s_ = 0.0f, turned_rad_ = 0.0f, last_heading_rad_ = 0.0f;
  double best_m_ = 0.0;           // distance to the goal where the wall was met
  bool pressed_ = false, began_ = false, arrived_ = false, gave_up_ = false, following_ = false;
};

}  // namespace kb::sim::experiment
