// The planners behind `neural_map` and `genetic`: a way across a hall, by its map and by what was seen beside the map.
#pragma once

#include <memory>
#include <vector>

#include <waymark/controllers/host.h>
#include "planners/problem.h"
#include "sim/world/hall_map.h"

namespace kb::sim {

// note [what the map does not show]
// A range finder measures how far away something is within 12 degrees to each side. If that is nearer than anything on the map within a
// somewhat broader cone, by more than the possible error of the robot's place, then it is not on the map: its point on the axis is
// blocked, with a circle round it. Beyond 0.8 m the cone is too broad to locate anything. Points are kept while the strategy runs. If
// they leave no way, they are forgotten once and looked for again, as some may have moved on.
class HallPlanner {
 public:
  enum class Method : std::uint8_t { kNeuralMap, kGenetic };
  explicit HallPlanner(Method method) : method_(method) {}

  /// The strategy begins in this hall, whose course begins at `begins` on the map; null: in no hall.
  void enter(std::shared_ptr<const HallMap> map, Spot begins);
  /// mts::Host::look.
  [[nodiscard]] mts::WayNews look(const mts::WayQuestion& question, mts::Way& way);

 private:
  [[nodiscard]] bool notice(const mts::WayQuestion& question, Spot at);
  [[nodiscard]] bool blocked(Spot at) const;
  [[nodiscard]] mts::WayNews plan(const mts::WayQuestion& question, Spot at, Spot goal);
  [[nodiscard]] planners::Result ask(const planners::Problem& problem, const mts::PlanGains& gains) const;
  void make_grid(const mts::PlanGains& gains);
  [[nodiscard]] bool sees(Spot from, Spot to) const;
  void tell(Spot at, mts::Way& way);

  Method method_;
  std::shared_ptr<const HallMap> map_;
  Spot begins_;
  std::vector<Spot> seen_;           // what is not on the map
  planners::Grid grid_;
  std::vector<Spot> way_;            // to the gate, corners only
  std::size_t told_ = 0;             // its corners that the controller has
  int looks_ = 0;                    // since the last plan
  bool forgot_ = false;
};

}  // namespace kb::sim
