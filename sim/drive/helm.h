// Something other than the simulator's knowledge base at the wheel: a method that it is compared with, or a user's own program. Sensors,
// wheels, floor, the scenario's events and the judge of the drive are the same.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <waymark/controllers/senses.h>
#include "sim/drive/judge.h"
#include "sim/robot/sensors.h"

namespace kb::sim {

inline constexpr std::int64_t kStepUs = 10'000;   ///< of the simulator's physics
inline constexpr int kPressTicks = 2;             ///< how long a press in a scenario lasts: a finger holds a button longer than one tick

class Helm {
 public:
  virtual ~Helm() = default;
  /// A button is pressed: for two ticks, or, if `held`, until it is released.
  virtual void press(program::CellId fact, bool held) = 0;
  virtual void release(program::CellId /*fact*/) {}
  /// One control period: takes what the sensors say and returns the motion. It may use only its own memory and what it is told here.
  [[nodiscard]] virtual mts::Motion step(std::int64_t now_us, const mts::Senses& senses, const TagHeard& tag, float dt_s) = 0;
  /// Asked after each tick. A leg or a place: see Judge::Belief.
  [[nodiscard]] virtual Judge::Belief belief() const = 0;
  /// Whether the mission has begun and is not over; nothing: the helm does not say. When it is over, the robot believes it is at `goal`.
  [[nodiscard]] virtual std::optional<bool> mission() const = 0;
  [[nodiscard]] virtual const std::string& goal() const = 0;
  /// Why it has given up and stands; empty otherwise.
  [[nodiscard]] virtual std::vector<std::string> reports() const = 0;
  /// Whether something that a scenario may wait for is so: the leg is current, the strategy runs, the fact is seen.
  [[nodiscard]] virtual bool high(program::CellId /*cell*/) const { return false; }
  [[nodiscard]] virtual bool seen(program::CellId /*fact*/) const { return false; }
  /// Whether it has a mind that ticks and reports a tick only in the first period after it; its belief is asked for then.
  [[nodiscard]] virtual bool ticks_with_next_period() const { return false; }
  /// Whether nothing more will come from it; the drive is then over as soon as the robot stands.
  [[nodiscard]] virtual bool gone() const { return false; }
};

}  // namespace kb::sim
