// Exact shortest paths of straight and diagonal moves: the reference against which every method is measured.
//
// note [buckets as wide as the shortest move]
// Dijkstra's order needs no heap here. Let buckets be one cell wide, so that bucket b holds distances in [b, b + 1). A cell cannot be
// improved by another of the same bucket, since every move is at least 1 long and leads into a later bucket. So the cells of a bucket may
// be taken in any order, and each cell is settled once (Denardo and Fox, Operations Research 27, 1979). Moves are at most sqrt(2) long,
// so three buckets used in turn are enough.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "planners/grid.h"
#include "planners/problem.h"

namespace kb::planners {

inline constexpr double kUnreached = std::numeric_limits<double>::infinity();

/// Octile distance from each cell to the nearest source, in cells; `kUnreached` if there is no path. Entries by index. With `stop_at`
/// the computation ends when that cell is settled; cells farther away may then be wrong or unreached.
/// O(reached cells). See note [buckets as wide as the shortest move]. A `watch` that says stop ends any of the computations of this file,
/// and then what they return is no answer; without one they run to their end.
struct DistanceField {
  std::vector<double> distance;
  std::uint64_t settled = 0;
};
[[nodiscard]] DistanceField distance_field(const Grid& grid, const std::vector<Cell>& sources,
                                           std::optional<Cell> stop_at = std::nullopt, Watch* watch = nullptr);

/// The same from one cell, stored as level = -distance, the activity of the neural map. Returns how many cells were settled.
std::uint64_t level_field(const Grid& grid, Cell source, std::vector<double>& level, std::optional<Cell> stop_at = std::nullopt,
                          Watch* watch = nullptr);

/// A distance, in cells, that is offered to a cell.
struct Offer {
  double distance = 0.0;
  CellIndex at = 0;
};
/// Spreads shorter distances over a field of levels. Touches only cells that become nearer: O(such cells + offers log offers), whatever the
/// size of the map. An offer that does not improve its cell is ignored. Returns how many cells became nearer.
std::uint64_t spread(const Grid& grid, std::vector<double>& levels, std::vector<Offer> offers);

/// A path from a cell to the first cell on it from which the rest of the way is known, such that path and rest together are shortest.
/// `rest`: by index, the length from there on in cells; infinite where it is not known. Includes both ends; empty if no such cell can be
/// reached. O(cells nearer than path and rest).
[[nodiscard]] std::vector<Cell> shortest_to_entry(const Grid& grid, Cell from, const std::vector<float>& rest, Watch* watch);

/// Descends a distance field to a source. Each move is the one with the largest drop per length, ties to the lowest direction. The field
/// must be exact along the path. Empty if `from` is unreached.
[[nodiscard]] std::vector<Cell> descend(const Grid& grid, const std::vector<double>& distance, Cell from);

/// A* with buckets and the octile distance as estimate. Keep one for many questions, since it reuses its arrays.
class Astar {
 public:
  explicit Astar(const Grid& grid);
  /// The cells of a shortest path, including both ends; empty if there is none. Both ends must be free.
  [[nodiscard]] std::vector<Cell> search(Cell from, Cell to, Watch* watch = nullptr);
  /// Length of the last path found, in cells.
  [[nodiscard]] double length() const { return length_; }
  /// The cells that the last search reached. `distance` gives their distances from its start: exact if the cell was expanded, else not
  /// below the exact one.
  [[nodiscard]] const std::vector<CellIndex>& touched() const { return touched_; }
  [[nodiscard]] double distance(CellIndex at) const {
    return nodes_[at].search == search_ ? nodes_[at].distance : kUnreached;
  }
  /// Cells expanded in the last search.
  [[nodiscard]] std::uint64_t expanded() const { return expanded_; }

 private:
  struct Node {
    double distance;
    std::uint32_t search;   // in which search it was reached
    std::uint8_t by;        // the direction by which it was reached
  };
  struct Entry {
    CellIndex at;
    double distance;
  };
  void push(CellIndex at, double distance, double total);
  void expand(const Entry& entry, Cell to);
  const Grid* grid_;
  std::vector<Node> nodes_;
  std::vector<std::vector<Entry>> buckets_;
  std::vector<CellIndex> touched_;
  double first_ = 0.0;
  std::size_t current_ = 0;
  std::uint32_t search_ = 0;
  std::uint64_t expanded_ = 0;
  double length_ = 0.0;
};

}  // namespace kb::planners
