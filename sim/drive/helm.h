// Somebody else at the wheel than the knowledge base in the simulator: what it is compared with, or a program of somebody's own. Sensors,
// wheels, floor, what a scenario does, and who judges the drive are the same.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <waymark/controllers/senses.h>
#include "sim/drive/judge.h"
#include "sim/robot/sensors.h"

namespace kb::sim {

class Helm {
 public:
  virtual ~Helm() = default;
  /// Somebody presses a button: for two ticks, or until it is released.
  virtual void press(program::CellId fact, bool held) = 0;
  virtual void release(program::CellId /*fact*/) {}
  /// One control period: what the sensors say, as it is read. Pure but for its own memory: nothing is known but what is heard here.
  [[nodiscard]] virtual mts::Motion step(std::int64_t now_us, const mts::Senses& senses, const TagHeard& tag, float dt_s) = 0;
  /// Asked after each tick. A leg or a place: see Judge::Belief.
  [[nodiscard]] virtual Judge::Belief belief() const = 0;
  /// The mission has begun and is not over; nothing: the helm does not say. When it is over the robot believes to be at `goal`.
  [[nodiscard]] virtual std::optional<bool> mission() const = 0;
  [[nodiscard]] virtual const std::string& goal() const = 0;
  /// Why it stands and gives up; none while it does not.
  [[nodiscard]] virtual std::vector<std::string> reports() const = 0;
  /// What a scenario may wait for: a leg that is current, a strategy that runs, a fact that is seen.
  [[nodiscard]] virtual bool high(program::CellId /*cell*/) const { return false; }
  [[nodiscard]] virtual bool seen(program::CellId /*fact*/) const { return false; }
  /// It has a mind that ticks, and tells of a tick in the first period after it. What it believes after a tick is asked then.
  [[nodiscard]] virtual bool ticks_with_next_period() const { return false; }
  /// Nothing will come from it any more: the drive is over when the robot stands.
  [[nodiscard]] virtual bool gone() const { return false; }
};

}  // namespace kb::sim
