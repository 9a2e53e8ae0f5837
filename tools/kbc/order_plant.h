// The roads of a knowledge base, as a fleet's master names them.
//
// note [names of nodes and edges]
// A node has the name of its landmark. An id that is no name of the language means the landmark that `kbc import` would name after it: `7`
// is `LM7`, `dock-1` is `dock_1`. An edge is a road from its first node to its last. If several roads lead there, the id tells which: the
// exit by which the road leaves (`Mill.E`) or the simulator's name (`Mill.E--Barn.W`). If only one does, the id may be anything.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/world/labyrinth.h"
#include "tools/kbc/vda5050/plant.h"

namespace kb::cli {

class RoadPlant final : public vda5050::Plant {
 public:
  /// `labyrinth`, which must outlive it, is the floor of the knowledge base. `map_id`: the map of positions. `turns`: whether the robot
  /// can turn round on a road. `prefix`: put before ids that are no names.
  RoadPlant(const sim::Labyrinth& labyrinth, std::string map_id, bool turns, std::string prefix = "LM");

  [[nodiscard]] std::optional<std::string> landmark_of(std::string_view node) const override;
  [[nodiscard]] std::optional<std::string> node_at(std::string_view landmark) const override;
  [[nodiscard]] std::optional<vda5050::Pose> place_of(std::string_view node) const override;
  [[nodiscard]] std::optional<std::vector<vda5050::Visit>> way(std::string_view edge, std::string_view from, std::string_view to) const override;
  [[nodiscard]] std::optional<vda5050::Pose> pose(const vda5050::Whereabouts& where) const override;
  [[nodiscard]] std::optional<vda5050::Standing> standing_at(const vda5050::Pose& pose) const override;
  [[nodiscard]] bool leads_back(const vda5050::Visit& road) const override;
  [[nodiscard]] std::string map_id() const override { return map_id_; }

  /// Whether a road leaves that landmark by that exit, and leads to the landmark `to`.
  [[nodiscard]] bool leads(const vda5050::Visit& from, std::string_view to) const;

 private:
  [[nodiscard]] sim::CrossingId crossing_of(std::string_view node) const;
  /// The arms of a landmark by which a road leads to another one.
  [[nodiscard]] std::vector<const sim::Arm*> arms_to(sim::CrossingId from, sim::CrossingId to) const;

  const sim::Labyrinth& labyrinth_;
  std::string map_id_, prefix_;
  bool turns_;
};

}  // namespace kb::cli
