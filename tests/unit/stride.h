// How thoroughly a test goes through its many cases.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace kb::testing {

/// The step of a loop over seeds and other cases: 1, or what KB_TEST_STRIDE says. Sanitizers make code ten times as slow, and
/// what they look for shows in one case out of five as well; what a loop counts is then a fifth.
inline std::uint64_t stride() {
  static const char* const text = std::getenv("KB_TEST_STRIDE");
  static const int value = text == nullptr ? 1 : std::atoi(text);
  return value < 1 ? 1 : static_cast<std::uint64_t>(value);
}

}  // namespace kb::testing
