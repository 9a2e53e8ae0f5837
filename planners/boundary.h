// The world as a robot that feels only contact sees it: walls that it follows exactly, and straight lines to the goal.
//
// The robot is a point. It may be anywhere in the free cells and on their rims. It may not enter a blocked cell, nor slip between two
// blocked cells that touch at a corner: these count as joined, since the obstacles of Lumelsky and Stepanov do not touch. So there is a
// path for the point exactly if there is one for the moves of grid.h.
//
// All coordinates are whole half cells: corners of cells are even, centres odd. A straight line to a goal in the centre of a cell never
// runs along a wall, because a wall lies on even coordinates. This removes the worst special cases. The place where a line meets a wall
// is kept as an exact fraction. Nothing here rounds; only `to_point` does, at the end.
#pragma once

#include <cstdint>
#include <optional>

#include "planners/geometry.h"
#include "planners/grid.h"

namespace kb::planners {

/// A point with whole coordinates, in half cells.
struct Node {
  std::int32_t x = 0, y = 0;
  friend bool operator==(const Node&, const Node&) = default;
};
[[nodiscard]] inline Node centre_node(Cell cell) { return {2 * cell.x + 1, 2 * cell.y + 1}; }

/// The exact place (x / w, y / w) in half cells; w > 0.
struct Place {
  std::int64_t x = 0, y = 0, w = 1;
  friend bool operator==(const Place& a, const Place& b) { return a.x * b.w == b.x * a.w && a.y * b.w == b.y * a.w; }
};
/// For products of coordinates of places, which need up to 100 bits: on a line between nodes w is less than 2^17, and x, y less than 2^34.
__extension__ using Wide = __int128;
[[nodiscard]] inline Place place(Node node) { return {node.x, node.y, 1}; }
[[nodiscard]] Point to_point(const Grid& grid, const Place& place);

/// Whether `a` is nearer to `goal` than `b`. Exact.
[[nodiscard]] bool is_nearer(const Place& a, const Place& b, Node goal);

/// Headings along walls: 0 = +x, 1 = +y, 2 = -x, 3 = -y.
inline constexpr std::array<Node, 4> kHeadings = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// The side on which the robot has the obstacle while it follows a wall. With the left hand it goes counter-clockwise round an obstacle.
enum class Hand : std::int8_t { kLeft, kRight };

/// One side of a cell, with a direction: two half cells from the corner `from`.
struct WallEdge {
  Node from;
  int heading = 0;
  friend bool operator==(const WallEdge&, const WallEdge&) = default;

  [[nodiscard]] Node at(int half_cells) const {
    const Node step = kHeadings[static_cast<std::size_t>(heading)];
    return {from.x + half_cells * step.x, from.y + half_cells * step.y};
  }
  [[nodiscard]] Cell left() const { return beside(heading); }
  [[nodiscard]] Cell right() const { return beside((heading + 3) % 4); }
  [[nodiscard]] WallEdge reversed() const { return {at(2), (heading + 2) % 4}; }

 private:
  [[nodiscard]] Cell beside(int quadrant) const;
};

/// The four cells round a corner: 0 to the upper right, then counter-clockwise.
[[nodiscard]] Cell quadrant_of(Node corner, int quadrant);
inline Cell WallEdge::beside(int quadrant) const { return quadrant_of(from, quadrant); }

// ---- straight lines

/// Where a line passes from one cell to the next: through a side of a cell, or exactly through a corner.
struct LineCrossing {
  Place at;
  Node where;        ///< the corner (both even) or the middle of the side (one odd)
  Cell before, after;
  [[nodiscard]] bool through_corner() const { return where.x % 2 == 0 && where.y % 2 == 0; }
};
/// Whether the line goes through a corner with both cells beside it blocked, where obstacles are joined.
[[nodiscard]] bool is_joint(const Grid& grid, const LineCrossing& crossing);
/// Whether the line is stopped at this crossing.
[[nodiscard]] bool is_hit(const Grid& grid, const LineCrossing& crossing);

/// Walks along the straight line from a node to the centre of a cell.
class LineWalk {
 public:
  /// Both ends must lie in the grid or on its rim.
  LineWalk(Node from, Cell goal);
  /// The cell that the line is in. At first, the cell that it enters from `from`.
  [[nodiscard]] Cell cell() const { return cell_; }
  /// Goes to the next crossing and beyond it, and returns it; nothing once the goal's cell is reached.
  [[nodiscard]] std::optional<LineCrossing> next();

 private:
  Node from_;
  Cell goal_, cell_;
  std::int64_t ax_, ay_;      // extent of the line, not negative
  std::int32_t sx_, sy_;      // its direction: -1, 0, 1
  std::int64_t ox_, oy_;      // how far from `from_` the next column and row of corners are
};

// ---- walls

/// The edge that a robot follows after it has hit a wall at this crossing.
[[nodiscard]] WallEdge edge_after_hit(const Grid& grid, const LineCrossing& hit, Hand hand);
/// The hand with which that edge leads more directly towards a node, computed exactly; the left hand if both lead alike.
[[nodiscard]] Hand hand_towards(const Grid& grid, const LineCrossing& hit, Node to);

/// Goes along a wall from a hit, half a cell at a time, until it is back at the hit.
class WallWalk {
 public:
  WallWalk(const Grid& grid, const Place& hit, const WallEdge& first, Hand hand);

  /// Goes to the next node of the wall, a corner of a cell or the middle of its side. False if it would pass the hit again, by the same
  /// edge in the same direction. (A corner where obstacles are joined is passed twice, by different edges.)
  [[nodiscard]] bool next();

  [[nodiscard]] Node node() const { return edge_.at(offset_); }
  [[nodiscard]] const WallEdge& edge() const { return edge_; }
  /// Whether the node is the first on its edge, which is the time to check what concerns the edge as a whole.
  [[nodiscard]] bool entered_edge() const { return entered_; }
  /// The free cell beside the wall.
  [[nodiscard]] Cell free_cell() const { return hand_ == Hand::kLeft ? edge_.right() : edge_.left(); }
  /// Whether a robot at this node can set out into the cell: it is free and on the robot's side of a joint.
  [[nodiscard]] bool can_enter(Cell cell) const;

 private:
  void turn();
  const Grid* grid_;
  WallEdge first_, edge_;
  Hand hand_;
  std::int64_t hit_along_, hit_w_;   // how far along `first_` the hit lies: hit_along_ / hit_w_ half cells, in [0, 2)
  int offset_ = -1;                  // of the node on the edge; -1 before the first
  bool away_ = false, entered_ = false;
};

/// Length, in cells, of the closed wall to which an edge belongs, seen from its free side.
[[nodiscard]] std::int64_t wall_length(const Grid& grid, const WallEdge& edge, Hand hand);

}  // namespace kb::planners
