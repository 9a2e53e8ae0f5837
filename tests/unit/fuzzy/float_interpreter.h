// The interpreter of compiler/fuzzy in float, over the runtime's membership functions: the evaluator must give the same bits.
#pragma once

#include <cstdint>
#include <vector>

#include <waymark/runtime/fuzzy.h>
#include "compiler/fuzzy/interpret.h"
#include "compiler/tables/fuzzy.h"

namespace kb::fuzzy::testing {

struct RowDegrees {
  const tables::FuzzyForm& form;
  float operator()(std::uint32_t degree, float x) const { return mts::mu(form.terms[form.term_of_degree[degree]], x); }
};

[[nodiscard]] inline Outcome<float> interpret_float(const Controller& controller, const tables::FuzzyForm& form, const std::vector<float>& x) {
  using Wrap = float (*)(float, float, float);
  using Root = float (*)(float);
  const Wrap wrap = [](float value, float low, float period) { return mts::wrapped(value, low, period); };
  const Root root = [](float value) { return mts::square_root(value); };
  Interpreter<float, RowDegrees, Wrap, Root> run(controller, {form}, wrap, root);
  return run(x);
}

}  // namespace kb::fuzzy::testing
