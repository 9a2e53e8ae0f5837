// Pictures of a fuzzy controller, as SVG: printing only; the values come from the exact interpreter.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiler/fuzzy/controller.h"

namespace kb::emit {

struct FuzzyPicture {
  std::uint32_t x = 0;                     ///< slot along the horizontal axis
  std::uint32_t y = fuzzy::kNone;          ///< slot along the vertical axis; none: a curve instead of a surface
  std::uint32_t output = 0;
  std::vector<double> at;                  ///< a value for every slot; those of x and y are ignored
};

/// The membership functions of all inputs, and one output over one or two inputs. Same controller, same bytes.
[[nodiscard]] std::string print_fuzzy_svg(const fuzzy::Controller& controller, const FuzzyPicture& picture);

}  // namespace kb::emit
