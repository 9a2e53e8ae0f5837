// The channel from a sensor to its readers: sampled at a rate, heard after a latency, and sometimes faulty.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace kb::sim {

/// What is wrong with a sensor.
enum class Fault : std::uint8_t {
  kNone,
  kDead,      ///< says nothing
  kStuck,     ///< repeats its last value for ever, also after power was lost
  kNoisy,     ///< its noise is `amount` times as large
  kDelayed,   ///< is heard `amount` seconds later
  kOffset,    ///< its values are `amount` too large
  kDrift,     ///< its values grow too large, by `amount` a second
  kSpikes,    ///< range: a share `amount` of its readings are false echoes, nearer than anything there
};

/// How a sensor is built. A rate of 0 is a sensor that the robot does not have.
struct SensorBuild {
  double rate_hz = 0.0;
  double latency_s = 0.0;
  double noise = 0.0;     ///< spread of the noise of a sample, in the sensor's unit
  double bias = 0.0;      ///< spread of an error that stays the same for a whole drive
};

/// Keeps the last samples of type `Sample`: enough for a latency of 1 s and a delay of 2 s at 100 Hz, the most that a scenario can ask
/// for. Nothing is allocated. A delay of more than kKept - 2 periods is cut to that.
template <class Sample>
class Channel {
 public:
  static constexpr std::size_t kKept = 304;

  explicit Channel(const SensorBuild& build)
      : period_us_(build.rate_hz > 0.0 ? static_cast<std::int64_t>(std::min(1e6 / build.rate_hz, kLongestUs)) : 0),
        latency_us_(static_cast<std::int64_t>(build.latency_s * 1e6)) {}

  /// Whether a sample is due at this time. A sensor that is dead or stuck takes none.
  [[nodiscard]] bool due(std::int64_t now_us) const {
    return period_us_ > 0 && now_us >= next_us_ && fault_ != Fault::kDead && fault_ != Fault::kStuck;
  }
  /// Takes a sample of this time.
  void take(std::int64_t now_us, const Sample& sample) {
    samples_[taken_ % kKept] = sample;
    ++taken_;
    last_us_ = now_us;
    next_us_ = now_us >= next_us_ + period_us_ ? now_us + period_us_ : next_us_ + period_us_;   // keeps in step, except after a pause
  }
  /// The newest sample that can have been heard by now; null if there is none, or the sensor is dead.
  [[nodiscard]] const Sample* heard(std::int64_t now_us) const {
    if (taken_ == 0 || fault_ == Fault::kDead) return nullptr;
    const std::int64_t behind_us = latency_us_ + delay_us_ - (now_us - last_us_);
    const std::int64_t behind = behind_us <= 0 ? 0 : (behind_us + period_us_ - 1) / period_us_;
    const auto back = std::min<std::uint64_t>(static_cast<std::uint64_t>(behind), kKept - 2);
    return back < taken_ ? &samples_[(taken_ - 1 - back) % kKept] : nullptr;
  }

  void set_fault(Fault fault, double amount) {
    fault_ = fault;
    noise_factor_ = fault == Fault::kNoisy ? static_cast<float>(amount) : 1.0f;
    delay_us_ = fault == Fault::kDelayed ? static_cast<std::int64_t>(amount * 1e6) : 0;
  }
  [[nodiscard]] float noise_factor() const { return noise_factor_; }
  /// Forgets all samples, as when power is lost. A stuck sensor takes no others, so it keeps the last one.
  void clear() {
    if (fault_ != Fault::kStuck || taken_ == 0) {
      taken_ = 0;
      return;
    }
    samples_[0] = samples_[(taken_ - 1) % kKept];
    taken_ = 1;
  }

 private:
  static constexpr double kLongestUs = 1e15;   // some 30 years; a sensor with a longer period samples once
  std::int64_t period_us_, latency_us_, delay_us_ = 0;
  std::int64_t next_us_ = 0, last_us_ = 0;
  std::uint64_t taken_ = 0;
  float noise_factor_ = 1.0f;
  Fault fault_ = Fault::kNone;
  std::array<Sample, kKept> samples_{};
};

}  // namespace kb::sim
