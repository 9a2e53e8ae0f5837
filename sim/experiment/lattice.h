// Crossings on a lattice with roads to the four sides; both kinds of labyrinths are made from it. Not for users.
#pragma once

#include <array>
#include <vector>

#include "sim/experiment/sketch.h"

namespace kb::sim::experiment {

/// Sides in the order north, east, south, west.
class Lattice {
 public:
  Lattice(int columns, int rows) : columns_(columns), rows_(rows), roads_(static_cast<std::size_t>(columns * rows)) {}

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int size() const { return columns_ * rows_; }
  [[nodiscard]] int node(int column, int row) const { return row * columns_ + column; }
  /// The neighbour on a side, whether a road leads there or not; -1 beyond the edge.
  [[nodiscard]] int beside(int node, int side) const;
  [[nodiscard]] bool road(int node, int side) const { return roads_[static_cast<std::size_t>(node)][static_cast<std::size_t>(side)]; }
  void set_road(int node, int side, bool there);
  [[nodiscard]] int degree(int node) const;
  /// The nodes connected with this one by roads, ascending.
  [[nodiscard]] std::vector<int> part_of(int node) const;
  /// Whether two roads of a node lie opposite each other.
  [[nodiscard]] bool straight(int node) const { return (road(node, 0) && road(node, 2)) || (road(node, 1) && road(node, 3)); }

 private:
  int columns_, rows_;
  std::vector<std::array<bool, 4>> roads_;
};

/// Rules for the labyrinth of the part connected with `hub`. Nodes of `plain` get no landmark if two roads meet there: they become
/// bends, or disappear. `place` says where a node lies, `method` how a road is driven.
struct SketchRules {
  std::vector<bool> plain;                  ///< by node
  std::vector<Spot> place;                  ///< by node
  std::vector<std::string> methods;         ///< drawn from, with equal chances
};
[[nodiscard]] Sketch sketch_of(const Lattice& lattice, int hub, const SketchRules& rules, Random& random);

}  // namespace kb::sim::experiment
