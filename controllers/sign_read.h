// What a reader of signs tells of a crossing, in names of a knowledge base.
#pragma once

#include <cstdint>

namespace mts {

/// What a sign says, by names of the knowledge base: static text, "" if unknown.
struct SignRead {
  const char* landmark = "";
  const char* exit = "";            ///< the side of the landmark on whose road the sign lies
  float exit_rad = 0.0f;            ///< direction of that side as seen from the landmark, if it is named after a point of the compass
  bool exit_rad_known = false;
  std::uint32_t fact = 0;           ///< the landmark's, in the numbering of whoever writes facts; so are the bits below
  bool safe = true;
  std::uint64_t closed = 0, cross_by = 0;

  void forget_exit() noexcept {
    exit = "";
    exit_rad_known = false;
  }
};

}  // namespace mts
