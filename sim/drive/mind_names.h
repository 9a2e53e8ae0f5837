// A program and its ticks in the form of a recording: what pages know of the mind.
#pragma once

#include <cstddef>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/program/tick.h"
#include "sim/recording.h"

namespace kb::sim {

/// All cells, rules and conditions. O(program).
[[nodiscard]] MindNames names_of(const program::Program& program);

/// What changes from frame to frame.
class CellChanges {
 public:
  /// All cells are as at start-up.
  explicit CellChanges(const MindNames& names);
  /// The cell has this value now; `frame` tells if that is another one.
  void put(std::size_t cell, float value, Frame& frame);
  [[nodiscard]] std::size_t cells() const { return values_.size(); }

 private:
  std::vector<float> values_;   // as the last frame has them
};

/// Puts into `frame` what the mind noticed and did at this tick: events, rules, and a note for each conflict. Values and strategy are left alone.
void tell(const program::Tick& tick, const program::Program& program, Frame& frame);

}  // namespace kb::sim
