// The controllers of the strategies as `mts::Pilot` wants them: what a generated header has as `control_line`.
#pragma once

#include <vector>

#include <waymark/runtime/control_line.h>
#include "sim/mind/knowledge.h"

namespace kb::sim {

class ControlLines {
 public:
  /// `knowledge` must outlive it. A strategy without a line of its own has that of its preset controller.
  explicit ControlLines(const Knowledge& knowledge);
  ControlLines(const ControlLines&) = delete;   // lines point into it

  /// By the knowledge's order of strategies; -1: null.
  [[nodiscard]] const mts::ControlLine* of(int strategy) const { return strategy < 0 ? nullptr : &lines_[static_cast<std::size_t>(strategy)]; }

 private:
  std::vector<std::vector<mts::ControlArgument>> arguments_;
  std::vector<mts::ControlLine> lines_;
};

}  // namespace kb::sim
