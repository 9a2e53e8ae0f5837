// How fast the roads of a map may be driven.
//
// note [where a limit holds]
// A limit holds from landmark to landmark, whatever strategy drives. Once the robot drives through a crossing, the lower one holds of the road
// by which it came and of that by which it leaves. A robot that does not know on which road it is keeps to the lowest limit of all. If it takes
// another knowledge base, such as the next part of an order, the limit of its present road stays until it has left that road.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "compiler/model/model.h"

namespace kb::sim {

/// An end of a road; a landmark has one road at each of its sides.
struct RoadEnd { std::string_view landmark, side; };

class SpeedLimits {
 public:
  /// Adds a limit, in m/s, above 0. Of several for the same end the lowest counts.
  void add(const RoadEnd& end, float limit_m_s);
  [[nodiscard]] bool empty() const { return by_landmark_.empty(); }
  /// The limit of that road; infinity if it has none.
  [[nodiscard]] float at(const RoadEnd& end) const;
  /// The lowest of all; infinity if there are none.
  [[nodiscard]] float lowest() const { return lowest_; }

 private:
  std::map<std::string, std::map<std::string, float, std::less<>>, std::less<>> by_landmark_;   // then by side
  float lowest_ = std::numeric_limits<float>::infinity();
};

/// The limits that the maps give (`at most`).
[[nodiscard]] SpeedLimits limits_of(const model::Model& model);

}  // namespace kb::sim
