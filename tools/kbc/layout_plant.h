// A knowledge base whose map was imported from a layout, as a fleet's master names it: by the ids of that layout.
//
// note [nodes that the layout has not]
// A user may have added landmarks to the map that `kbc import` made. These, and edges from and to them, have the names of RoadPlant.
// Landmarks of the layout are named only by its ids, and between them there are only its own edges: an unknown id is a mistake of the
// master, whatever landmark it resembles.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "tools/kbc/layout/edges.h"
#include "tools/kbc/order_plant.h"

namespace kb::cli {

/// Nodes at one spot are one landmark. Edges between the same nodes are distinguished by id; an edge may run over landmarks.
class LayoutPlant final : public vda5050::Plant {
 public:
  /// `labyrinth`, which must outlive it, is the floor of the knowledge base. `map_id`, `turns`, `prefix`: as for RoadPlant.
  LayoutPlant(layout::Map map, const sim::Labyrinth& labyrinth, std::string map_id, bool turns, std::string prefix);
  LayoutPlant(const LayoutPlant&) = delete;   // its parts refer to one another
  LayoutPlant& operator=(const LayoutPlant&) = delete;

  /// Whether the floor has all landmarks and roads of the layout. The first missing one is reported (KB1420). To be called before an order is
  /// driven.
  /// O(layout log layout).
  [[nodiscard]] bool is_on_floor(diagnostics::Diagnostics& diagnostics) const;

  [[nodiscard]] std::optional<std::string> landmark_of(std::string_view node) const override;
  [[nodiscard]] std::optional<std::string> node_at(std::string_view landmark) const override;
  [[nodiscard]] std::optional<vda5050::Pose> place_of(std::string_view node) const override;
  /// Of two edges of one id between the same places, the first is taken. A loop back to its own place is no way: no road was made from it.
  [[nodiscard]] std::optional<std::vector<vda5050::Visit>> way(std::string_view edge, std::string_view from, std::string_view to) const override;
  [[nodiscard]] std::optional<vda5050::Pose> pose(const vda5050::Whereabouts& where) const override { return roads_.pose(where); }
  [[nodiscard]] std::optional<vda5050::Standing> standing_at(const vda5050::Pose& pose) const override { return roads_.standing_at(pose); }
  [[nodiscard]] bool leads_back(const vda5050::Visit& road) const override { return roads_.leads_back(road); }
  [[nodiscard]] std::string map_id() const override { return roads_.map_id(); }

 private:
  [[nodiscard]] vda5050::Visit worded(const layout::Visit& visit) const;

  const layout::Map map_;
  const layout::Edges edges_;   // of map_
  const RoadPlant roads_;
  std::unordered_map<std::string_view, std::uint32_t> places_;   // by landmark; only asked, never walked
};

/// The map (`mapId` of LIF) named by the nodes of the layout; empty if none names one, or they disagree.
[[nodiscard]] std::string map_of(const layout::Layout& layout);

}  // namespace kb::cli
