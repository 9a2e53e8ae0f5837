// The robot's present task: see note [a way in stretches].
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

  /// Begins another task: from node `first` to node `last`, by index.
  void begin(const std::vector<Node>& nodes, const std::vector<Edge>& edges, std::size_t first, std::size_t last, Start start);
  /// Forgets the first `nodes` nodes, and the way before the last of the `visits` that are reached. Nodes are then counted from there.
  void forget_passed(std::size_t nodes, std::size_t visits);
  /// Extends the task to node `last`.
  void grow(const std::vector<Node>& nodes, const std::vector<Edge>& edges, std::size_t last);
  /// Shortens the task to end at node `last`.
  void cut(std::size_t last);
  /// Leaves nothing to drive.
  void close();

  [[nodiscard]] bool given() const { return !task_.way.empty(); }
  [[nodiscard]] std::size_t last() const { return last_; }
  /// The last node reached after so many visits of the way, at least one.
  [[nodiscard]] std::size_t node_at(std::size_t visits) const;
  /// Whether the way ended after so many visits before it grew: a robot may have stopped there before it heard of the extension.
  [[nodiscard]] bool ended_at(std::size_t visits) const;

 private:
  void append(const std::vector<Node>& nodes, const std::vector<Edge>& edges, std::size_t last);

  Task task_;
  std::size_t first_ = 0, last_ = 0;
  std::vector<std::size_t> marks_;   // node first_ + 1 + i is at this visit, counted from the task's first one
  std::vector<std::size_t> ends_;    // in visits: where the way ended before it grew
};

}  // namespace kb::vda5050
