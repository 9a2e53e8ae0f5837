// The controllers, bound to the strategies: what the wheels do while a strategy runs.
#pragma once

#include <memory>
#include <vector>

#include <waymark/controllers/any_controller.h>
#include <waymark/controllers/similarity.h>
#include "sim/mind/hall_planner.h"
#include "sim/mind/hall_rules.h"
#include "sim/mind/knowledge.h"
#include "sim/mind/perception.h"
#include "sim/robot_body.h"

namespace kb::sim {

class Pilot {
 public:
  /// `knowledge` must outlive it. `body` is the robot that its controllers drive. If its size is not 1, the controllers are given
  /// it scaled to size 1; the senses passed in below must be scaled too, and the results are.
  explicit Pilot(const Knowledge& knowledge, const mts::Body& body = kRobot);

  /// Takes another strategy (an index into the knowledge's strategies), or none: -1. Informs the perception. A new strategy starts its
  /// controller afresh, except that a manoeuvre interrupted by an obstacle continues.
  void choose(int strategy, Perception& perception, const mts::Senses& senses);
  [[nodiscard]] mts::Motion step(const mts::Senses& senses, float dt_s);
  [[nodiscard]] int strategy() const { return strategy_; }
  /// Why the controller does not get across its hall.
  [[nodiscard]] mts::Plight plight() const;
  /// Whether the controller has lost what it follows, or has driven all of it, and stands.
  [[nodiscard]] bool lost() const;

 private:
  [[nodiscard]] mts::Host lend(const Strategy& strategy);

  const Knowledge& knowledge_;
  std::vector<mts::AnyController> controllers_;   // by strategy, their parameters set
  std::vector<std::unique_ptr<HallPlanner>> planners_;   // by strategy; null: it needs none
  std::vector<std::unique_ptr<HallRules>> rules_;        // the same
  int strategy_ = -1;
  int suspended_ = -1;   // a manoeuvre that keeps reckoning while the robot goes round an obstacle
};

}  // namespace kb::sim
