// What the bug methods share: the path under construction, the limits, and the record of what was followed.
#pragma once

#include <optional>
#include <vector>

#include "planners/boundary.h"
#include "planners/bug.h"
#include "planners/problem.h"

namespace kb::planners {

/// The stretches of wall that have been followed, which is all that the sign rule needs of the path. See note [the sign rule].
class FollowedWalls {
 public:
  explicit FollowedWalls(const Grid& grid);
  /// Notes that the part of an edge between two places on it has been followed.
  void add(const WallEdge& edge, const Place& from, const Place& to);
  void add_whole(const WallEdge& edge) { whole_[index(edge)] = 1; }
  /// Whether a place on an edge, which is given by its middle, has been followed.
  [[nodiscard]] bool contains(Node middle, const Place& at) const;
  [[nodiscard]] bool contains_whole(const WallEdge& edge) const { return whole_[index(edge)] != 0; }

 private:
  struct Part {
    std::size_t edge;
    Place from, to;
  };
  [[nodiscard]] std::size_t index(Node middle) const {
    return static_cast<std::size_t>(middle.y) * stride_ + static_cast<std::size_t>(middle.x);
  }
  [[nodiscard]] std::size_t index(const WallEdge& edge) const { return index(edge.at(1)); }
  std::size_t stride_;
  std::vector<std::uint8_t> whole_;  // by the middle of the edge
  std::vector<Part> parts_;          // at most two a hit
};

/// Whether the line from a node to the goal runs into a wall that has been followed, so that the sign rule forbids leaving there.
[[nodiscard]] bool runs_into_followed_wall(const Grid& grid, const FollowedWalls& followed, Node from, Cell goal);

class BugRun {
 public:
  BugRun(const Problem& problem, const RunOptions& run, const BugOptions& options);

  [[nodiscard]] const Grid& grid() const { return *problem_.grid; }
  [[nodiscard]] Cell goal() const { return goal_; }
  [[nodiscard]] Node goal_node() const { return centre_node(goal_); }

  /// Goes straight towards the goal. Returns the hit, or nothing if the goal is reached.
  [[nodiscard]] std::optional<LineCrossing> go_straight(Node from);
  /// Notes a hit and chooses the hand.
  [[nodiscard]] Hand take_hit(const LineCrossing& hit);
  /// The hand for a hit, by the rules that need no memory of walls.
  [[nodiscard]] Hand hand_at(const LineCrossing& hit) const;

  /// Goes on to a place on a wall or a line. Collinear points are joined.
  void go_to(const Place& place);
  void count_followed(double cells) { followed_cells_ += cells; }
  void count_loop() { ++loops_; }
  [[nodiscard]] std::uint64_t hits() const { return hits_; }

  /// Counts one more half cell of wall. True if the run has to end.
  [[nodiscard]] bool exhausted();

  /// Adds to the length that the bound grants this run, such as 1.5 times the wall of one phase.
  void grant(double cells) { granted_cells_ += cells; }

  static constexpr double kNoBound = 1e300;  ///< granted if there is no bound

  /// The result. A path longer than what was granted would be a bug in this code, so it becomes kNumeric.
  [[nodiscard]] Result finish(Outcome outcome);

 private:
  const Problem& problem_;
  const BugOptions& options_;
  Watch watch_;
  Cell goal_;
  std::vector<Place> path_;
  double followed_cells_ = 0.0, granted_cells_ = 0.0;
  std::uint64_t hits_ = 0, loops_ = 0, halves_ = 0;
  bool out_of_steps_ = false;
};

/// The nodes of a wall in the order in which they were passed after a hit, and the way back to one of them.
struct PassedLoop {
  Place hit;
  std::vector<Node> nodes;

  /// Goes from the hit to nodes[i] by the shorter way round. The loop must be closed.
  void return_to(std::size_t i, BugRun& run) const;
  /// Length of the closed loop, in cells.
  [[nodiscard]] double length() const;

 private:
  [[nodiscard]] double first_piece() const;  // from the hit to nodes[0], half cells
  [[nodiscard]] double last_piece() const;   // from the last node to the hit
};

/// Finds the node of a loop from which to leave it for good: the one nearest to the goal.
class NearestNode {
 public:
  explicit NearestNode(Node goal) : goal_(goal) {}
  /// Of equally near nodes, the first from which the path to the goal begins free.
  void offer(std::size_t i, Node node, bool way_free);
  [[nodiscard]] std::optional<std::size_t> index() const { return index_; }
  [[nodiscard]] Node node() const { return node_; }
  [[nodiscard]] bool way_free() const { return way_free_; }

 private:
  Node goal_, node_;
  std::optional<std::size_t> index_;
  bool way_free_ = false;
};

/// Whether the straight line from the walk's node to the goal begins in free space.
[[nodiscard]] bool way_is_free(const WallWalk& walk, Cell goal);

}  // namespace kb::planners
