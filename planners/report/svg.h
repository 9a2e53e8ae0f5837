// Pictures of maps, fields and paths, as SVG.
#pragma once

#include <string>
#include <vector>

#include "planners/method.h"

namespace kb::planners {

/// One map, with what a method did on it.
struct Panel {
  std::string title;        ///< over the map, such as "a) neural"
  std::string caption;      ///< under the map, such as "reached, 54.2 m"
  const Problem* problem = nullptr;
  const Result* result = nullptr;
  Picture picture;          ///< may be empty
  const Grid* obstacles = nullptr;   ///< the map before the robot's radius was added to its obstacles; else null
};

/// The panels side by side, `columns` in a row. The same bytes for the same panels.
[[nodiscard]] std::string draw_svg(const std::vector<Panel>& panels, std::size_t columns);

}  // namespace kb::planners
