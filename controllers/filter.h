// The PID controller and the low-pass filter that the controllers are built of.
#pragma once

#include "angles.h"

namespace mts {

/// The period as controllers may use it: within [0, 0.5] s; 0 for NaN and below a microsecond, since slopes are divided by it.
/// A controller that was not called for longer acts as if half a second had passed.
[[nodiscard]] constexpr float sane_period(float dt_s) noexcept { return dt_s >= 1e-6f ? least(dt_s, 0.5f) : 0.0f; }

/// First-order low-pass filter: y += (u - y) dt / (tau + dt) (the backward Euler form of tau y' = u - y, stable for each dt).
struct LowPass {
  float value = 0.0f;
  bool primed = false;   ///< false: the next sample is taken as it is

  constexpr float step(float sample, float tau_s, float dt_s) noexcept {
    if (!primed) {
      value = sample;
      primed = true;
    } else if (tau_s + dt_s > 0.0f) {
      value += (sample - value) * (dt_s / (tau_s + dt_s));
    }
    return value;
  }
  constexpr void reset() noexcept { *this = LowPass{}; }
};

/// u = kp e + ki * integral(e) + kd * e', with e' filtered by tau and u within +-limit. The integral does not change while u is at
/// its limit and e would drive it farther (conditional integration). Astrom and Hagglund, "PID Controllers", 1995, chapter 3.
/// Units: e in any unit E, u in U; kp U/E, ki U/(E s), kd U s/E.
struct Pid {
  float kp = 0.0f, ki = 0.0f, kd = 0.0f;
  float tau_s = 0.0f;
  float limit = 0.0f;

  constexpr Pid() noexcept = default;
  constexpr Pid(float p, float i, float d, float filter_s, float largest) noexcept
      : kp(p), ki(i), kd(d), tau_s(filter_s), limit(largest) {}

  constexpr float step(float error, float dt_s) noexcept {
    const float raw = known_ && dt_s > 0.0f ? (error - last_) / dt_s : 0.0f;
    const float slope = slope_.step(raw, tau_s, dt_s);
    last_ = error;
    known_ = true;
    const float sum = integral_ + error * dt_s;
    const float free = kp * error + ki * sum + kd * slope;
    const float held = clamped(free, -limit, limit);
    if (free == held || error * free < 0.0f) integral_ = sum;
    return held;
  }
  constexpr void reset() noexcept {
    integral_ = 0.0f;
    known_ = false;
    slope_.reset();
  }

 private:
  float last_ = 0.0f, integral_ = 0.0f;
  LowPass slope_{};
  bool known_ = false;
};

}  // namespace mts
