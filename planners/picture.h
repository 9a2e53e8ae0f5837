// What a method can show of itself besides its path, for drawing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planners/problem.h"

namespace kb::planners {

struct Picture {
  std::vector<double> field;              ///< a value for each index of the grid, low near the goal; NaN: none. Empty: no field
  std::vector<std::uint8_t> basin;        ///< 1 for each index that leads to the goal by itself. Empty: none
  std::vector<std::vector<Point>> lines;  ///< force lines, m
  std::vector<Trap> traps;
  std::vector<std::string> remarks;       ///< lines of text under the picture
};

}  // namespace kb::planners
