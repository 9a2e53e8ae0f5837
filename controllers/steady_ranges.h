// Steadies noisy range finders. Place one object between a robot's sensors and everything that uses them.
//
// Readings are kept for a while as points on the floor (by reckoning.h), so that earlier ones can be compared with current ones although
// the robot drives and turns. For range finder i, of the last n readings of all range finders, those within 22.5 degrees of where it looks
// now are taken. Let m be their median; the result is the mean of those within 1.5 spreads of m. A single outlier is therefore dropped, and
// an edge stays an edge, since nothing is averaged across it.
//
// The noise, sigma, is estimated from the readings. The second difference a - 2 b + c of three readings of one range finder has the spread
// sqrt(6) sigma, however fast the robot drives at constant speed, so the median of its magnitude is 0.6745 sqrt(6) sigma = 1.652 sigma. That
// median is tracked by small steps up and down, over all range finders and all time; the first steps are larger. Passing edges are few
// and do not move a median.
// Steadying starts at a sigma of 6 cm and ends below 4 cm. Until then readings pass through unchanged, bit for bit, so a robot with range
// finders of 1 or 2 cm loses nothing and gains no delay, and comers.h says who comes. n = (sigma / 3 cm)^2, from 3 to 16: 10 cm of noise
// are reduced to 3 to 4 cm, 20 cm to 5 to 6 cm. At 20 readings a second, n readings are 0.15 to 0.8 s; a thing that was not there before
// shows when it fills half of them.
#pragma once

#include <cstdint>

#include "angles.h"
#include "comers.h"
#include "heard.h"
#include "reckoning.h"

namespace mts {

/// Takes at most 2,168 bytes. Cost of a new reading: storing it and, if the range finders are rough, turning 8 n points and sorting them into eight
/// directions. Between readings: eight comparisons.
class SteadyRanges {
 public:
  static constexpr std::size_t kMost = 16;   ///< readings of all range finders that are kept

  /// Takes one sample and returns the senses as `heard`, with steadied ranges and with `met_m`. Silent range finders stay silent; if all are
  /// silent, earlier readings are forgotten.
  [[nodiscard]] Senses step(const Senses& raw, float dt_s) noexcept {
    Senses senses = heard(raw);
    if (!started_) reckoning_.start_relative(senses);
    started_ = true;
    reckoning_.step(senses, sane_period(dt_s));
    comers_.step(reckoning_, sane_period(dt_s));
    if (!senses.range_known) {
      count_ = 0;
      comers_.forget();
      return senses;
    }
    since_s_ += sane_period(dt_s);
    if (is_new(senses)) {
      if (count_ >= 2) measure(senses);
      keep(senses);
      comers_.take(senses, reckoning_, spread_m());
      rough_ = measured_ >= kEnough && spread_m() > (rough_ ? kSmooth_m : kRough_m);
      if (rough_) steady(senses);
    }
    senses.met_m = rough_ ? kOutOfRange : comers_.met_m();
    if (!rough_) return senses;
    for (std::size_t i = 0; i < kRangeFinders; ++i) senses.range_m[i] = steady_m_[i];
    return senses;
  }

  /// Estimated standard deviation of one reading, assuming a normal distribution.
  [[nodiscard]] float spread_m() const noexcept { return median_m_ / 1.652f; }
  /// Whether ranges are being steadied.
  [[nodiscard]] bool rough() const noexcept { return rough_; }

 private:
  struct Reading {
    float range_m[kRangeFinders] = {};
    float x_m[kRangeFinders] = {}, y_m[kRangeFinders] = {};   ///< what it saw, in the frame of the reckoning
    float heading_rad = 0.0f;
    std::uint8_t unknown = 0;                                 ///< as `Senses::ranges_unknown`
  };

  /// The robot repeats a reading until the next one, so two that are equal bit for bit count as one. But if rough range finders see nothing,
  /// all readings are equal: then one counts as new at the usual interval, or what was seen last would never be forgotten.
  [[nodiscard]] bool is_new(const Senses& senses) const noexcept {
    if (count_ == 0) return true;
    bool same = true, nothing = true;
    for (std::size_t i = 0; i < kRangeFinders; ++i) {
      same = same && !(senses.range_m[i] < before(0).range_m[i]) && !(senses.range_m[i] > before(0).range_m[i]);
      nothing = nothing && !(senses.range_m[i] < kOutOfRange);
    }
    return !same || (nothing && rough_ && since_s_ > kUsual_s);
  }
  [[nodiscard]] const Reading& before(std::size_t readings) const noexcept { return readings_[(next_ + 2 * kMost - 1 - readings) % kMost]; }

  /// Not while the robot turns, since edges pass all the time then.
  void measure(const Senses& senses) noexcept {
    if (magnitude(wrapped_angle(reckoning_.at.heading_rad - before(1).heading_rad)) > kTurns_rad) return;
    for (std::size_t i = 0; i < kRangeFinders; ++i) {
      const float a = senses.range_m[i], b = before(0).range_m[i], c = before(1).range_m[i];
      if (!(greatest(a, greatest(b, c)) < kOutOfRange)) continue;   // a range finder that sees nothing shows no spread
      measured_ = measured_ < kSettled ? measured_ + 1 : kSettled;
      const float step = kStep_m + kFirst_m / static_cast<float>(measured_);
      median_m_ = greatest(median_m_ + (magnitude(a - 2.0f * b + c) > median_m_ ? step : -step), 0.0f);
    }
  }

  void keep(const Senses& senses) noexcept {
    Reading& reading = readings_[next_];
    reading.heading_rad = reckoning_.at.heading_rad;
    reading.unknown = senses.ranges_unknown;
    for (std::size_t i = 0; i < kRangeFinders; ++i) {
      const float range = senses.range_m[i], direction = reckoning_.at.heading_rad + range_finder_rad(i);
      const float to = range < kOutOfRange ? range : kNothing_m;
      reading.range_m[i] = range;
      reading.x_m[i] = reckoning_.at.x_m + to * cosine(direction);
      reading.y_m[i] = reckoning_.at.y_m + to * sine(direction);
    }
    since_s_ = 0.0f;
    next_ = (next_ + 1) % kMost;
    count_ = count_ < kMost ? count_ + 1 : kMost;
  }

  [[nodiscard]] std::size_t wanted() const noexcept {
    const float n = clamped(kReadings_m2 * spread_m() * spread_m(), 3.0f, static_cast<float>(kMost));
    const auto whole = static_cast<std::size_t>(n);
    return whole < count_ ? whole : count_;
  }

  void steady(const Senses& now) noexcept {
    float ranges[kRangeFinders][kMost];
    std::size_t counts[kRangeFinders] = {};
    const std::size_t readings = wanted();
    for (std::size_t k = 0; k < readings; ++k) {
      const Reading& reading = before(k);
      for (std::size_t i = 0; i < kRangeFinders; ++i) {
        if ((reading.unknown >> i & 1u) != 0) continue;
        const float dx = reading.x_m[i] - reckoning_.at.x_m, dy = reading.y_m[i] - reckoning_.at.y_m;
        const std::size_t to = k == 0 ? i : looks_to(dx, dy);   // the newest reading belongs to its own range finder
        if (counts[to] < kMost) insert(ranges[to], counts[to], least(square_root(dx * dx + dy * dy), kOutOfRange));
      }
    }
    for (std::size_t i = 0; i < kRangeFinders; ++i) steady_m_[i] = counts[i] > 0 ? middle(ranges[i], counts[i]) : now.range_m[i];
  }
  [[nodiscard]] std::size_t looks_to(float dx, float dy) const noexcept {
    const float bearing = wrapped_angle(angle_of(dx, dy) - reckoning_.at.heading_rad) + 2.0f * kPi;
    return static_cast<std::size_t>(bearing / range_finder_rad(1) + 0.5f) % kRangeFinders;
  }
  /// Inserts a range in ascending order.
  static void insert(float (&ranges)[kMost], std::size_t& count, float range) noexcept {
    std::size_t at = count++;
    for (; at > 0 && ranges[at - 1] > range; --at) ranges[at] = ranges[at - 1];
    ranges[at] = range;
  }
  /// The mean of the ranges near the median. Of two middle values the nearer one counts: half of the readings say that something is there.
  [[nodiscard]] float middle(const float (&ranges)[kMost], std::size_t count) const noexcept {
    const float median = ranges[(count - 1) / 2];
    if (!(median < kOutOfRange)) return kOutOfRange;
    float sum = 0.0f, of = 0.0f;
    for (std::size_t k = 0; k < count; ++k) {
      if (magnitude(ranges[k] - median) > kFits * spread_m()) continue;
      sum += ranges[k];
      of += 1.0f;
    }
    return sum / of;
  }

  static constexpr float kRough_m = 0.06f, kSmooth_m = 0.04f;
  static constexpr float kStep_m = 0.003f;         ///< of the median: 6 to 48 cm/s at 20 readings a second, depending on how many range finders see something
  static constexpr float kFirst_m = 0.12f;         ///< divided by how many readings have been measured: how much larger a step is at first
  static constexpr std::uint32_t kEnough = 24;     ///< readings of single range finders needed before the estimate counts
  static constexpr std::uint32_t kSettled = 10'000;
  static constexpr float kReadings_m2 = 1111.0f;   ///< (1 / 3 cm)^2
  static constexpr float kUsual_s = 0.049f;        ///< from one reading to the next
  static constexpr float kTurns_rad = 0.05f;       ///< over three readings
  static constexpr float kFits = 1.5f;             ///< spreads from the median
  static constexpr float kNothing_m = 100.0f;      ///< where a point out of range is put: its direction hardly changes when the robot moves
  Reckoning reckoning_{};
  Comers comers_{};
  Reading readings_[kMost] = {};
  float steady_m_[kRangeFinders] = {};
  std::size_t next_ = 0, count_ = 0;
  std::uint32_t measured_ = 0;
  float median_m_ = 0.0f, since_s_ = 0.0f;         ///< since_s_: time since the last reading that was kept
  bool started_ = false, rough_ = false;
};
static_assert(sizeof(SteadyRanges) <= 2168);

}  // namespace mts
