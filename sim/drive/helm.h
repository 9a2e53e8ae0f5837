// Somebody else at the wheel than a knowledge base: what it is compared with. Sensors, wheels, floor, what a scenario does, and
// who judges the drive are the same.
#pragma once

#include <string>

#include <waymark/controllers/senses.h>
#include "sim/drive/judge.h"
#include "sim/robot/sensors.h"

namespace kb::sim {

class Helm {
 public:
  virtual ~Helm() = default;
  /// Somebody presses a button. The first time that begins the mission; again, it means nothing.
  virtual void press() = 0;
  /// One control period: what the sensors say, as it is read. Pure but for its own memory: nothing is known but what is heard here.
  [[nodiscard]] virtual mts::Motion step(const mts::Senses& senses, const TagHeard& tag, float dt_s) = 0;
  /// Asked after each tick. A leg or a place: see Judge::Belief.
  [[nodiscard]] virtual Judge::Belief belief() const = 0;
  /// The mission has begun and is not over. When it is over the robot believes to be at `goal`.
  [[nodiscard]] virtual bool on_mission() const = 0;
  [[nodiscard]] virtual const std::string& goal() const = 0;
  /// Why it stands and gives up; empty while it does not.
  [[nodiscard]] virtual std::string report() const = 0;
};

}  // namespace kb::sim
