// Exact shortest paths of straight and diagonal moves: the reference that every method is measured against.
//
// note [buckets as wide as the shortest move]
// Dijkstra's order needs no heap here. Let buckets be one cell wide, bucket b holding distances in [b, b + 1). A cell in the
// bucket under work cannot be improved by another of the same bucket, for every move is at least 1 long and leads into a
// later bucket. So a bucket may be worked off in any order and each cell is settled once (Denardo and Fox, Operations
// Research 27, 1979). Moves are at most sqrt(2) long, so three buckets in turn are enough.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "planners/grid.h"

namespace kb::planners {

inline constexpr double kUnreached = std::numeric_limits<double>::infinity();

/// Octile distance from each cell to the nearest source, in cells; `kUnreached` where there is no way. Entries by index.
/// With `stop_at` the field ends when that cell is settled: cells that are farther away may then be wrong or unreached.
/// O(reached cells). See note [buckets as wide as the shortest move].
struct DistanceField {
  std::vector<double> distance;
  std::uint64_t settled = 0;
};
[[nodiscard]] DistanceField distance_field(const Grid& grid, const std::vector<Cell>& sources,
                                           std::optional<Cell> stop_at = std::nullopt);

/// The same from one cell, kept as level = -distance: the activity of the neural map. Returns the cells settled.
std::uint64_t level_field(const Grid& grid, Cell source, std::vector<double>& level, std::optional<Cell> stop_at = std::nullopt);

/// A distance, in cells, that a cell may have.
struct Offer {
  double distance = 0.0;
  CellIndex at = 0;
};
/// Lets shorter distances spread over a field of levels. Only cells that become nearer are touched: O(such cells + offers log
/// offers), whatever the size of the map. An offer that is no better than what its cell has is left out. Returns how many cells
/// became nearer.
std::uint64_t spread(const Grid& grid, std::vector<double>& levels, std::vector<Offer> offers);

/// A shortest path from a cell to the nearest of the cells marked in `marks` (entries by index), both ends included; empty if
/// none can be reached. O(cells nearer than that).
[[nodiscard]] std::vector<Cell> shortest_to_marked(const Grid& grid, Cell from, const std::vector<std::uint8_t>& marks);

/// Goes down a distance field by the move that loses most per length, ties to the lowest direction, until a source. The
/// field must be exact on the way. Empty if `from` is unreached.
[[nodiscard]] std::vector<Cell> descend(const Grid& grid, const std::vector<double>& distance, Cell from);

/// A* with buckets and the octile distance as estimate. Keep one for many questions: its arrays are used again.
class Astar {
 public:
  explicit Astar(const Grid& grid);
  /// The cells of a shortest path, both ends included; empty if there is none. Both ends must be free.
  [[nodiscard]] std::vector<Cell> search(Cell from, Cell to);
  /// Length of the path found last, in cells.
  [[nodiscard]] double length() const { return length_; }
  /// The cells that the last search came to, with their distances from its beginning: exact where expanded, else not below
  /// the exact one.
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
