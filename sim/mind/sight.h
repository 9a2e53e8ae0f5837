// Whether a sense still sees.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace kb::sim {

// note [a sense that is stuck]
// A sensor that gives the same bits while the wheels turn is stuck. That holds only for sensors known to have noise: those whose values
// kept changing while the robot stood. A sensor without noise may see the same for metres, such as a floor without paint.
template <std::size_t kElements>
class Sight {
 public:
  using Sample = std::array<float, kElements>;

  /// One control period. `tells`: its values could have been others, as with range finders of which some see something.
  void hear(bool known, const float (&elements)[kElements], bool tells, float way_m, float dt_s) {
    known_ = known;
    const bool same = std::equal(last_.begin(), last_.end(), elements);
    if (!known || !tells || !same) {
      const bool stood = same_m_ + way_m < kStands_m, lively = known && same_s_ + dt_s < kLively_s;
      noise_s_ = !lively ? 0.0f : stood ? noise_s_ + same_s_ + dt_s : noise_s_;
      noisy_ = noisy_ || noise_s_ > kNoise_s;
      same_m_ = same_s_ = 0.0f;
      std::copy(elements, elements + kElements, last_.begin());
      return;
    }
    same_m_ += way_m;
    same_s_ += dt_s;
  }
  /// See note [a sense that is stuck].
  [[nodiscard]] bool stuck() const { return noisy_ && same_m_ > kStuck_m && same_s_ > kStuck_s; }
  [[nodiscard]] bool sees() const { return known_ && !stuck(); }

 private:
  static constexpr float kStands_m = 0.001f, kLively_s = 0.2f, kNoise_s = 0.4f;   // samples come every 0.01 to 0.05 s
  static constexpr float kStuck_m = 0.05f, kStuck_s = 0.2f;
  Sample last_{};
  bool known_ = false, noisy_ = false;
  float noise_s_ = 0.0f;                       // how long its values have kept changing
  float same_m_ = 0.0f, same_s_ = 0.0f;        // since its values last changed
};

}  // namespace kb::sim
