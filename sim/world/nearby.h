// Finds which of many things on a floor come near another one.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/world/geometry.h"

namespace kb::sim {

/// From one corner to the other, along the axes of the floor. Metres.
struct Bounds { Spot low, high; };

/// The bounds of a spot, a piece, a chain (not empty).
[[nodiscard]] Bounds bounds_of(Spot spot);
[[nodiscard]] Bounds bounds_of(Spot from, Spot to);
[[nodiscard]] Bounds bounds_of(const std::vector<Spot>& chain);
/// `bounds` enlarged to contain the spot.
[[nodiscard]] Bounds grown(const Bounds& bounds, Spot spot);

/// An R-tree, so that a floor is laid out in n log n: distances are computed only for pairs that may be near each other.
class Nearby {
 public:
  /// Things are identified by their index.
  explicit Nearby(const std::vector<Bounds>& things);
  /// `bounds(thing)` gives the bounds of one.
  template <class Thing, class BoundsOf>
  Nearby(const std::vector<Thing>& things, BoundsOf bounds) : Nearby(all_of(things, bounds)) {}
  ~Nearby();
  Nearby(const Nearby&) = delete;
  Nearby& operator=(const Nearby&) = delete;

  /// All that come within `within_m` of a thing, and perhaps a few that do not; in ascending order. O(log n, and the answer).
  [[nodiscard]] std::vector<std::uint32_t> near(const Bounds& bounds, double within_m) const;

 private:
  template <class Thing, class BoundsOf>
  [[nodiscard]] static std::vector<Bounds> all_of(const std::vector<Thing>& things, BoundsOf bounds) {
    std::vector<Bounds> all;
    for (const Thing& thing : things) all.push_back(bounds(thing));
    return all;
  }

  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace kb::sim
