// Two wheels and their motors: turns a wanted motion into the real one, after inertia, limits and slip.
#pragma once

#include <waymark/controllers/senses.h>
#include "sim/random.h"
#include "sim/robot_body.h"

namespace kb::sim {

struct DriveLimits {
  double wheel_base_m = static_cast<double>(kRobot.wheel_base_m);
  double speed_m_s = static_cast<double>(kRobot.top_speed_m_s);           ///< of a wheel
  double acceleration_m_s2 = static_cast<double>(kRobot.top_acceleration_m_s2);   ///< of a wheel
  double turn_rad_s = static_cast<double>(kRobot.top_turn_rad_s);          ///< of the body; on the spot its wheels alone could do 2 speed / wheel_base
  double slip = 0.01;               ///< spread of the share of a wheel's way lost to slip
  double slip_mean = 0.0;           ///< the mean of that share
  double wheel_mismatch = 0.0;      ///< spread, from drive to drive, of how much larger the right wheel is than the left one
  double motor_lag_s = 0.0;         ///< time constant with which a wheel follows its command
};

/// The limits of a body; the other values are the defaults.
[[nodiscard]] inline DriveLimits limits_of(const mts::Body& body) {
  return {.wheel_base_m = static_cast<double>(body.wheel_base_m),
          .speed_m_s = static_cast<double>(body.top_speed_m_s),
          .acceleration_m_s2 = static_cast<double>(body.top_acceleration_m_s2),
          .turn_rad_s = static_cast<double>(body.top_turn_rad_s)};
}

class DriveTrain {
 public:
  DriveTrain(const DriveLimits& limits, std::uint64_t seed);

  /// Brings the wheels towards the wanted motion, for `dt_s`. Values that are not finite are ignored.
  void drive(mts::Motion wanted, double dt_s);
  /// Stands still at once: the robot has been put elsewhere.
  void halt() { left_m_s_ = right_m_s_ = left_asked_m_s_ = right_asked_m_s_ = 0.0; }

  // What the body does, and what the wheels (and so odometry) believe.
  [[nodiscard]] double speed_m_s() const { return 0.5 * (left_m_s_ * left_grip_ + right_m_s_ * right_grip_); }
  [[nodiscard]] double turn_rad_s() const { return (right_m_s_ * right_grip_ - left_m_s_ * left_grip_) / limits_.wheel_base_m; }
  [[nodiscard]] double wheel_speed_m_s() const { return 0.5 * (left_m_s_ + right_m_s_); }
  [[nodiscard]] double wheel_turn_rad_s() const { return (right_m_s_ - left_m_s_) / limits_.wheel_base_m; }

 private:
  DriveLimits limits_;
  Random random_;
  double left_m_s_ = 0.0, right_m_s_ = 0.0;
  double left_asked_m_s_ = 0.0, right_asked_m_s_ = 0.0;   // the commands reached so far at the acceleration limit
  double larger_;                                         // how much larger the right wheel is than the left one, as a share
  double left_grip_ = 1.0, right_grip_ = 1.0;
  double until_new_grip_s_ = 0.0;
};

}  // namespace kb::sim
