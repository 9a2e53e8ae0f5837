// The task that the robot has: see note [a way in stretches].
#pragma once

#include <cstddef>
#include <vector>

#include "tools/kbc/vda5050/order.h"
#include "tools/kbc/vda5050/vehicle.h"

namespace kb::vda5050 {

class Stretch {
 public:
  [[nodiscard]] const Task& task() const { return task_; }
  void pause(bool on) { task_.paused = on; }

  /// Another task: from node `first` to node `last`, by index.
  void begin(const std::vector<Node>& nodes, const std::vector<Edge>& edges, std::size_t first, std::size_t last, Start start);
  /// The first `nodes` nodes are forgotten, and what of the way lies before the last of `visits` that are reached. Nodes count from there.
  void forget_passed(std::size_t nodes, std::size_t visits);
  /// The same one goes on to node `last`.
  void grow(const std::vector<Node>& nodes, const std::vector<Edge>& edges, std::size_t last);
  /// It ends at node `last` already.
  void cut(std::size_t last);
  /// Nothing to drive.
  void close();

  [[nodiscard]] bool given() const { return !task_.way.empty(); }
  [[nodiscard]] std::size_t last() const { return last_; }
  /// The last node that is reached when so many visits of the way are; one visit at least.
  [[nodiscard]] std::size_t node_at(std::size_t visits) const;
  /// Whether the way ended after so many visits before it grew. A robot may have stopped there before it heard that it goes on.
  [[nodiscard]] bool ended_at(std::size_t visits) const;

 private:
  void append(const std::vector<Node>& nodes, const std::vector<Edge>& edges, std::size_t last);

  Task task_;
  std::size_t first_ = 0, last_ = 0;
  std::vector<std::size_t> marks_;   // node first_ + 1 + i is at this visit, counted from the first one that there was
  std::vector<std::size_t> ends_;    // as visits: where the way ended before it grew
};

}  // namespace kb::vda5050
