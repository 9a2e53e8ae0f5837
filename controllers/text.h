// Comparing names without a C library.
#pragma once

namespace mts {

/// Whether two texts are the same; neither is null.
[[nodiscard]] constexpr bool same_text(const char* a, const char* b) noexcept {
  while (*a != '\0' && *a == *b) {
    ++a;
    ++b;
  }
  return *a == *b;
}

}  // namespace mts
