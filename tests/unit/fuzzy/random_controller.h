// Fuzzy controllers at random: every kind of shape, operator, hedge, nest, output, of order zero and one.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/fuzzy/controller.h"

namespace kb::fuzzy::testing {

/// What a controller may use. FLL knows less than the language.
struct Repertoire {
  bool circles = true;      ///< circular inputs and outputs
  bool nests = true;
  bool reach = true;        ///< `within`, `winner`
  bool negations = true;    ///< `not` over a whole condition, singletons, one-sided Gaussians
};

/// The same seed gives the same controller, on every machine.
[[nodiscard]] Controller random_controller(std::uint64_t seed, const Repertoire& repertoire = {});

/// One with a row of `given`s that differ in their words only, as in a planner with one for each direction: what
/// tables::lay_out makes a loop of.
[[nodiscard]] Controller random_row_of_nests(std::uint64_t seed);

/// Inputs by slot: mostly in range, often at corners of shapes; with `wild` also outside, infinite and NaN.
[[nodiscard]] std::vector<double> random_inputs(const Controller& controller, std::uint64_t seed, bool wild = false);

}  // namespace kb::fuzzy::testing
