// Programmed control: a fixed sequence of manoeuvres, worked out beforehand from the map. At the n-th stop line it does the n-th
// turn. Its only reaction is to stand before an obstacle until it is gone. Controllers, speeds and headings are those of the
// knowledge base.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <waymark/controllers/any_controller.h>
#include <waymark/controllers/steady_ranges.h>
#include <waymark/controllers/stop_line.h>
#include "sim/drive/helm.h"
#include "sim/experiment/way.h"
#include "sim/mind/knowledge.h"

namespace kb::sim::experiment {

class Programmed final : public Helm {
 public:
  /// The robot `body` goes from `start` along the road that it stands on to the first crossing of `route`, then along the route.
  /// `labyrinth` must outlive it.
  Programmed(const Labyrinth& labyrinth, const mts::Body& body, const Pose& start, const RoutePlan& route);

  /// The first press begins the mission; later presses do nothing.
  void press(program::CellId /*fact*/, bool /*held*/) override { pressed_ = true; }
  [[nodiscard]] mts::Motion step(std::int64_t now_us, const mts::Senses& raw, const TagHeard& tag, float dt_s) override;
  [[nodiscard]] Judge::Belief belief() const override;
  [[nodiscard]] std::optional<bool> mission() const override { return on_mission(); }
  [[nodiscard]] const std::string& goal() const override { return goal_; }
  [[nodiscard]] std::vector<std::string> reports() const override { return {}; }

 private:
  [[nodiscard]] bool on_mission() const { return at_ < pieces_.size() && pressed_; }
  /// A crossing or a road.
  struct Piece {
    bool crossing = false;
    mts::ControllerId controller{};
    mts::Task task;
    Leg leg;
  };
  void add_crossing(const Labyrinth& labyrinth, const RoutePlan& route, std::size_t i, const Arm& came);
  void add_road(const Labyrinth& labyrinth, RoadId road, std::vector<Spot> course, Leg leg);
  void begin(const mts::Senses& senses);
  [[nodiscard]] bool over(const mts::Senses& senses, float dt_s);

  mts::Body body_;
  std::vector<Piece> pieces_;
  std::size_t at_ = 0;
  std::string goal_;
  mts::SteadyRanges steadied_;
  mts::AnyController controller_;
  mts::StopLine line_;
  Strategy moves_, crosses_;      // what the judge is told
  float way_m_ = 0.0f;            // since the piece began
  bool pressed_ = false, began_ = false, clear_ = true;
};

}  // namespace kb::sim::experiment
