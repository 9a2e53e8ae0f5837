// Whether a sensor still sees, or gives the same reading for ever.
//
// note [a sense that is stuck]
// A sensor that gives the same bits while the wheels turn is stuck. That holds only for sensors known to have noise: those whose values
// kept changing while the robot stood. A sensor without noise may see the same for metres, such as a floor without paint.
#pragma once

#include <cstddef>

namespace mts {

template <std::size_t kElements>
class Liveness {
 public:
  /// One control period. `way_m`: how far the sensor has moved, by driving or turning. `tells`: the values could have been others, as those of
  /// range finders of which some see something.
  constexpr void step(bool known, const float (&elements)[kElements], bool tells, float way_m, float dt_s) noexcept {
    known_ = known;
    if (!known || !tells || !same(elements)) {
      const bool stood = same_m_ + way_m < kStands_m_s * (same_s_ + dt_s), lively = known && same_s_ + dt_s < kLively_s;
      noise_s_ = !lively ? 0.0f : stood ? noise_s_ + same_s_ + dt_s : noise_s_;
      noisy_ = noisy_ || noise_s_ > kNoise_s;
      same_m_ = same_s_ = 0.0f;
      for (std::size_t i = 0; i < kElements; ++i) last_[i] = elements[i];
      return;
    }
    same_m_ += way_m;
    same_s_ += dt_s;
  }
  [[nodiscard]] constexpr bool stuck() const noexcept { return noisy_ && same_m_ > kStuck_m && same_s_ > kStuck_s; }
  [[nodiscard]] constexpr bool sees() const noexcept { return known_ && !stuck(); }

 private:
  [[nodiscard]] constexpr bool same(const float (&elements)[kElements]) const noexcept {
    for (std::size_t i = 0; i < kElements; ++i) {
      if (!(last_[i] == elements[i])) return false;
    }
    return true;
  }

  static constexpr float kStands_m_s = 0.05f, kLively_s = 0.2f, kNoise_s = 0.4f;   // samples come every 0.01 to 0.05 s
  static constexpr float kStuck_m = 0.05f, kStuck_s = 0.2f;
  float last_[kElements] = {};
  bool known_ = false, noisy_ = false;
  float noise_s_ = 0.0f;                       // how long its values have kept changing
  float same_m_ = 0.0f, same_s_ = 0.0f;        // since its values last changed
};

}  // namespace mts
