// All planners by name, and `plan`, the one way to run them.
#pragma once

#include <span>
#include <string_view>

#include "planners/check.h"
#include "planners/picture.h"
#include "planners/problem.h"

namespace kb::planners {

/// What a method knows of the world. Do not compare figures of methods that know different things.
enum class Knowledge : std::uint8_t {
  kFullMap,     ///< the whole map
  kLocalRange,  ///< its own place, the goal's, and what is within a sensor's range
  kContact,     ///< its own place, the goal's, and what it touches
};
/// "full map", "local range", "contact".
[[nodiscard]] std::string_view name(Knowledge knowledge);

using Plan = Result (*)(const Problem&, const RunOptions&);
using Draw = Picture (*)(const Problem&, const Result&);

struct Method {
  std::string_view name;        ///< as on the command line
  Knowledge knowledge;
  Touch touch;                  ///< how near to obstacles its paths may come
  bool moving;                  ///< takes moving obstacles into account
  bool random;                  ///< depends on the seed
  Plan run;                     ///< the bare method; call `plan` instead, which checks before and after
  Draw draw;                    ///< what to show besides the path; may be null
  std::string_view summary;     ///< one line for people
};

/// In the order of methods.def.
[[nodiscard]] std::span<const Method> methods();
/// Null if no method has this name.
[[nodiscard]] const Method* find_method(std::string_view name);

/// Checks the problem, runs the method, and checks the path. A result of `kReached` has passed `check_path` and, if obstacles move,
/// `check_walk`; one that fails becomes `kNumeric`, with the objection in `refused`.
[[nodiscard]] Result plan(const Method& method, const Problem& problem, const RunOptions& run = {});

}  // namespace kb::planners
