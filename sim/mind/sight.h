// Whether a sense still sees.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace kb::sim {

// note [a sense that is stuck]
// Who says bit by bit the same while the wheels turn says nothing. That holds only for what is known to have noise: it said something
// else all the time while the robot stood. What has none may see the same for metres, as a floor without paint.
template <std::size_t kElements>
class Sight {
 public:
  using Sample = std::array<float, kElements>;

  /// One control period. `tells`: what it says could be something else, as of range finders that do not all see nothing.
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
  float noise_s_ = 0.0f;                       // so long it said something else all the time
  float same_m_ = 0.0f, same_s_ = 0.0f;        // since it said something else
};

}  // namespace kb::sim
