// Runs an emitted fuzzy controller beside the interpreters: the straight code, the walk of the tables and the float
// interpreter give the same bits (the issue asks for 1 ulp), and all are near the exact interpreter.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <vector>

#include "compiler/tables/fuzzy.h"
#include "tests/unit/fuzzy/float_interpreter.h"
#include "tests/unit/fuzzy/random_controller.h"

namespace kb::emitted {

/// Every third has `given`s that become one loop.
inline bool has_row_of_nests(std::uint64_t seed) { return seed % 3 == 0; }
inline fuzzy::Controller controller_of(std::uint64_t seed) {
  return has_row_of_nests(seed) ? fuzzy::testing::random_row_of_nests(seed) : fuzzy::testing::random_controller(seed);
}

/// All fields of Inputs and Outputs are floats, in the order of the slots and of the outputs.
template <class F>
typename F::Inputs inputs(const std::vector<float>& x) {
  typename F::Inputs in;
  static_assert(sizeof(in) % sizeof(float) == 0);
  std::memcpy(static_cast<void*>(&in), x.data(), std::min(sizeof(in), x.size() * sizeof(float)));
  return in;
}
template <class F>
std::vector<float> outputs(const typename F::Outputs& out, std::size_t count) {
  std::vector<float> y(count);
  std::memcpy(y.data(), static_cast<const void*>(&out), count * sizeof(float));
  return y;
}

inline bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](float x, float y) { return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y); });
}

template <class F>
bool agrees(std::uint64_t seed) {
  const fuzzy::Controller controller = controller_of(seed);
  const tables::FuzzyForm form = tables::pack(controller);
  const std::size_t count = controller.outputs.size();
  for (std::uint64_t n = 0; n < 500; ++n) {
    const std::vector<double> exact = fuzzy::testing::random_inputs(controller, seed * 1'000 + n, n % 2 == 1);
    const std::vector<float> x(exact.begin(), exact.end());
    const auto straight = F::evaluate(inputs<F>(x));
    const auto walked = F::evaluate_tables(inputs<F>(x));
    const auto expected = fuzzy::testing::interpret_float(controller, form, x);
    const bool status = straight.status == walked.status && static_cast<int>(straight.status) == static_cast<int>(expected.status);
    if (status && same_bits(outputs<F>(straight, count), expected.outputs) && same_bits(outputs<F>(walked, count), expected.outputs)) continue;
    std::printf("seed %llu, point %llu: status %d %d %d\n", static_cast<unsigned long long>(seed), static_cast<unsigned long long>(n),
                static_cast<int>(straight.status), static_cast<int>(walked.status), static_cast<int>(expected.status));
    for (std::size_t o = 0; o < count; ++o) {
      std::printf("  out%zu straight %.9g walked %.9g interpreted %.9g\n", o, static_cast<double>(outputs<F>(straight, count)[o]),
                  static_cast<double>(outputs<F>(walked, count)[o]), static_cast<double>(expected.outputs[o]));
    }
    return false;
  }
  return true;
}

}  // namespace kb::emitted
