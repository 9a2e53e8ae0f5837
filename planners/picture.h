// What a method can draw besides its path.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planners/problem.h"

namespace kb::planners {

struct Picture {
  std::vector<double> field;              ///< a value for each index of the grid, low near the goal; NaN: no value. Empty: no field
  std::vector<std::uint8_t> basin;        ///< 1 for each index from which the field leads to the goal. Empty: no basin
  std::vector<std::vector<Point>> lines;  ///< lines of force, m
  std::vector<Trap> traps;
  std::vector<std::string> remarks;       ///< lines of text under the picture
};

}  // namespace kb::planners
