// A `control` line as data, as generated headers hold it: which controller drives while a strategy runs, and what it is asked for.
//
//   control Avoid = keep_wall(side: right, distance: 0.2 m)
//                   {"keep_wall", {{"side", "right", 0, ""}, {"distance", "", 0.2, "m"}}, 2}
//
// `mts::Pilot` (controllers/pilot.h) drives by it. The generated `drive` hands the same to functions of the program, by type.
#pragma once

#include <cstdint>

namespace mts {

/// An argument: a word, or a number. Static text.
struct ControlArgument {
  const char* name;
  const char* word;   ///< "" if it is a number
  float number;       ///< 0 if it is a word
  const char* unit;   ///< of the number: "m/s"; "" if it has none
};

/// Static data; each strategy that has a line has one of its own, so its address tells which strategy it is.
struct ControlLine {
  const char* controller;
  const ControlArgument* arguments;   ///< in the order in which they are written; null if there are none
  std::uint32_t count;
};

}  // namespace mts
