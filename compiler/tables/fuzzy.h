// A fuzzy controller packed into the constants of runtime/fuzzy.h.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <waymark/runtime/fuzzy.h>
#include "compiler/fuzzy/controller.h"

namespace kb::tables {

struct FuzzyForm {
  std::vector<mts::FuzzyInput> inputs;         ///< by slot
  std::vector<mts::Membership> terms;          ///< by input, by term; a group shares them
  std::vector<std::uint16_t> slot_of_degree, term_of_degree;
  std::vector<std::uint16_t> code;
  std::vector<mts::FuzzyStep> steps;
  std::vector<std::uint32_t> origins;          ///< by step: the rule, or for a `given` the nest
  std::vector<mts::FuzzyConsequent> consequents;
  std::vector<mts::FuzzyPart> parts;
  std::vector<mts::FuzzyOutput> outputs;
  std::vector<std::uint32_t> writers;          ///< by output: how many rules write it
  std::uint32_t fired = 0;                     ///< how much room lists of fired rules need
  bool product = false, sum = false;
};

/// The row of a shape, rounded to float.
[[nodiscard]] mts::Membership row(const fuzzy::Shape& shape);

/// Pure; O(controller).
[[nodiscard]] FuzzyForm pack(const fuzzy::Controller& controller);

/// The form as the evaluator reads it; valid for as long as `form` is neither moved nor changed.
[[nodiscard]] mts::FuzzyTables view(const FuzzyForm& form);

/// The runtime's evaluator on the form. `x` by slot.
struct FuzzyAnswer {
  std::vector<float> outputs;
  mts::FuzzyStatus status = mts::FuzzyStatus::kOk;
};
[[nodiscard]] FuzzyAnswer evaluate(const FuzzyForm& form, std::span<const float> x);

/// Size of the constants in bytes.
[[nodiscard]] std::size_t bytes(const FuzzyForm& form);

/// One item a line: for `kbc dump tables`.
[[nodiscard]] std::string print(const fuzzy::Controller& controller, const FuzzyForm& form);

}  // namespace kb::tables
