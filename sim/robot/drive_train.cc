#include "sim/robot/drive_train.h"

#include <algorithm>
#include <cmath>

namespace kb::sim {
namespace {

constexpr double kGripLasts = 0.2;        // s; after that the wheels stand on other spots of the floor, with another slip
constexpr std::uint64_t kStream = 100, kWheelStream = 101;

double towards(double now, double wanted, double step) { return now + std::clamp(wanted - now, -step, step); }

}  // namespace

DriveTrain::DriveTrain(const DriveLimits& limits, std::uint64_t seed) : limits_(limits), random_(seed, kStream), larger_(limits.wheel_mismatch * static_cast<double>(Random(seed, kWheelStream).bell())) {}

void DriveTrain::drive(mts::Motion wanted, double dt_s) {
  double speed = static_cast<double>(wanted.speed_m_s), turn = static_cast<double>(wanted.turn_rad_s);
  if (!std::isfinite(speed) || !std::isfinite(turn)) speed = turn = 0.0;
  turn = std::clamp(turn, -limits_.turn_rad_s, limits_.turn_rad_s);
  const double difference = std::clamp(0.5 * turn * limits_.wheel_base_m, -limits_.speed_m_s, limits_.speed_m_s);
  // If one wheel could not reach its speed, the path would bend otherwise than asked. So the speed is lowered until the turn can be kept.
  const double room = limits_.speed_m_s - std::abs(difference);
  speed = std::clamp(speed, -room, room);
  const double step = limits_.acceleration_m_s2 * dt_s;
  left_asked_m_s_ = towards(left_asked_m_s_, speed - difference, step);
  right_asked_m_s_ = towards(right_asked_m_s_, speed + difference, step);
  const double behind = limits_.motor_lag_s > 0.0 ? std::exp(-dt_s / limits_.motor_lag_s) : 0.0;
  left_m_s_ = left_asked_m_s_ + behind * (left_m_s_ - left_asked_m_s_);
  right_m_s_ = right_asked_m_s_ + behind * (right_m_s_ - right_asked_m_s_);
  until_new_grip_s_ -= dt_s;
  if (until_new_grip_s_ > 0.0) return;
  until_new_grip_s_ = kGripLasts;
  const double mean = 1.0 - limits_.slip_mean;
  left_grip_ = (mean - limits_.slip * static_cast<double>(random_.bell())) * (1.0 - 0.5 * larger_);
  right_grip_ = (mean - limits_.slip * static_cast<double>(random_.bell())) * (1.0 + 0.5 * larger_);
}

}  // namespace kb::sim
