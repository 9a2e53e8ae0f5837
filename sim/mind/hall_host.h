// What the controllers of halls ask of the program: a planner over the map of the hall, or the rules of a fuzzy controller.
#pragma once

#include <memory>
#include <vector>

#include <waymark/controllers/host.h>
#include <waymark/controllers/pilot.h>
#include "sim/mind/hall_planner.h"
#include "sim/mind/hall_rules.h"
#include "sim/mind/knowledge.h"
#include "sim/mind/map_roads.h"

namespace kb::sim {

class HallHost {
 public:
  /// All must outlive it; the pilot is asked on which road the robot is.
  HallHost(const Knowledge& knowledge, const Labyrinth& labyrinth, const MapRoads& roads, const mts::Pilot& pilot);
  HallHost(const HallHost&) = delete;   // the pilot points to it

  /// Another strategy drives, or none: -1.
  void choose(int strategy);
  [[nodiscard]] mts::Host host();

 private:
  [[nodiscard]] mts::WayNews look(const mts::WayQuestion& question, mts::Way& way);
  void enter(HallPlanner& planner);

  const Labyrinth& labyrinth_;
  const MapRoads& roads_;
  const mts::Pilot& pilot_;
  std::vector<std::unique_ptr<HallPlanner>> planners_;   // by strategy; null: it needs none
  std::vector<std::unique_ptr<HallRules>> rules_;        // the same
  std::vector<std::shared_ptr<const HallMap>> maps_;     // by road, of a robot of size 1; empty until one is asked for
  HallPlanner* planner_ = nullptr;                       // of the strategy that had one last
  HallRules* rule_ = nullptr;                            // the same
  bool enters_ = false;
};

}  // namespace kb::sim
