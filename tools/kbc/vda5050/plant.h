// A vehicle's view of the roads that its orders name.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kb::vda5050 {

/// A landmark on a way, and the road by which the robot goes on.
struct Visit {
  std::string landmark;
  std::string exit = {};   ///< `E`; empty at the end of a way, and if only one road leads to the next
  double limit_m_s = 0.0;  ///< how fast an order lets it drive that road; 0: as fast as the road allows

  [[nodiscard]] bool is_on(const Visit& road) const { return landmark == road.landmark && exit == road.exit; }
  friend bool operator==(const Visit&, const Visit&) = default;
};

/// A place on the floor.
struct Whereabouts {
  Visit road;                ///< the road that leaves that landmark by that exit; without an exit: at the landmark, facing an unknown way
  double along_m = 0.0;      ///< from the landmark
  bool outwards = true;      ///< it faces away from the landmark
};

/// The place of a robot that stands facing along the road.
struct Standing {
  Whereabouts on;            ///< outwards
  std::string ahead;         ///< the landmark that it comes to
};

/// In metres of the map, radians counter-clockwise from its x axis.
struct Pose { double x_m = 0.0, y_m = 0.0, theta_rad = 0.0; };

/// Maps the master's nodes and edges to landmarks and roads of the knowledge base. Each call is cheap: O(log plant + pieces of the edge).
class Plant {
 public:
  virtual ~Plant() = default;
  /// The landmark of a node; nothing if there is no such node.
  [[nodiscard]] virtual std::optional<std::string> landmark_of(std::string_view node) const = 0;
  /// The first node at a landmark; nothing if there is none.
  [[nodiscard]] virtual std::optional<std::string> node_at(std::string_view landmark) const = 0;
  /// Where a node lies, whose heading is not told; nothing if there is no such node.
  [[nodiscard]] virtual std::optional<Pose> place_of(std::string_view node) const = 0;
  /// How an edge is driven: the landmark of `from` and those that it runs over, without that of `to`. Empty if both are at one spot;
  /// nothing if there is no such edge, or it does not lead from `from` to `to`.
  [[nodiscard]] virtual std::optional<std::vector<Visit>> way(std::string_view edge, std::string_view from, std::string_view to) const = 0;
  /// The pose of a place; nothing if there is no such landmark.
  [[nodiscard]] virtual std::optional<Pose> pose(const Whereabouts& where) const = 0;
  /// The road on which a robot with that pose stands, facing along it in a direction that may be driven; nothing in a crossing, beside all
  /// roads, or facing across.
  [[nodiscard]] virtual std::optional<Standing> standing_at(const Pose& pose) const = 0;
  /// Whether the robot can turn round on that road and drive back to where it began.
  [[nodiscard]] virtual bool leads_back(const Visit& road) const = 0;
  /// The id of the map that positions are on.
  [[nodiscard]] virtual std::string map_id() const = 0;
};

}  // namespace kb::vda5050
