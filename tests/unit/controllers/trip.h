// A robot with a pilot, for tests: the lines and roads that it drives by.
#pragma once

#include <waymark/controllers/pilot.h>

#include "tests/unit/controllers/plant.h"

namespace mts {

inline constexpr ControlArgument kSlow[] = {{"speed", "", 0.2f, "m/s"}};
inline constexpr ControlArgument kLeft[] = {{"turn", "left", 0.0f, ""}};
inline constexpr ControlArgument kAside[] = {{"side", "right", 0.0f, ""}, {"distance", "", 0.2f, "m"}};
inline constexpr ControlArgument kForward[] = {{"turn", "forward", 0.0f, ""}};
inline constexpr ControlLine kStraight = {"turn_by_compass", kForward, 1};
inline constexpr ControlLine kMove = {"hold_heading", kSlow, 1}, kCross = {"turn_by_compass", kLeft, 1}, kAvoid = {"keep_wall", kAside, 2}, kStop = {"stand", nullptr, 0}, kAbout = {"turn_round", nullptr, 0};
inline constexpr Piece kEast[] = {{0.0f, 3.0f}}, kBend[] = {{0.0f, 3.0f}, {0.5f * kPi, 4.0f}}, kBendBack[] = {{-0.5f * kPi, 4.0f}, {kPi, 3.0f}};
inline constexpr MapRoad kFirst = {"Dock", "E", "Arch", "W", "azimuth", kInfinity, kEast, 1};
inline constexpr Piece kWest[] = {{kPi, 3.0f}};
inline constexpr MapRoad kFirstBack = {"Arch", "W", "Dock", "E", "azimuth", kInfinity, kWest, 1};
inline constexpr Piece kStraightNorth[] = {{0.5f * kPi, 3.0f}};
inline constexpr MapRoad kThird = {"Arch", "N", "Mill", "S", "azimuth", kInfinity, kStraightNorth, 1};
inline constexpr MapRoad kElsewhere = {"Hill", "S", "Arch", "N", "azimuth", kInfinity, kBendBack, 1};
inline constexpr MapRoad kSecond = {"Arch", "E", "Shelf", "S", "azimuth", 0.1f, kBend, 2};
inline constexpr MapRoad kSecondBack = {"Shelf", "S", "Arch", "E", "azimuth", kInfinity, kBendBack, 2};

/// A robot that faces east, with the same period for mind and wheels.
struct Trip {
  explicit Trip(double x, const plant::Floor& floor = {}) : robot(floor, {}, 1) { robot.place(x, 0.0, 0.0); }
  void drive(double time_s) {
    for (double t = 0.0; t < time_s; t += 0.02) {
      last = pilot.step(robot.sense(), 0.02f);
      robot.drive(last, 0.02);
    }
  }
  /// Drives until x, halts for a second, and then goes on.
  void halt_at(double x, const ControlLine& line, const MapRoad& road) {
    for (int i = 0; i < 3000 && robot.x < x; ++i) drive(0.02);
    pilot.choose(&kStop, &road);
    drive(1.0);
    pilot.choose(&line, &road);
    drive(20.0);
  }
  plant::Plant robot;
  Pilot pilot;
  Motion last;
};

}  // namespace mts
