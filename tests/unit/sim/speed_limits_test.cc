#include "sim/mind/speed_limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <waymark/controllers/heard.h>

#include "tests/unit/sim/laboratory.h"

namespace kb::sim::testing {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

constexpr std::string_view kErrand = R"(
import std.navigation
import std.retreat
map Works {
    landmark Dock  at (0, 0)
    landmark Arch  at (3, 0)
    landmark Shelf at (6, 0)
    road Dock.E -- Arch.W  by mark at most 0.3 m/s
    road Arch.E -- Shelf.W by mark at most 15 cm/s
}
command Go
route Errand on Works by Go: Dock -> Arch -> Shelf
)";

TEST(SpeedLimits, OfSeveralForOneEndTheLowestCounts) {
  SpeedLimits limits;
  EXPECT_TRUE(limits.empty());
  EXPECT_EQ(limits.lowest(), kNone);
  limits.add({"Dock", "E"}, 0.3f);
  limits.add({"Dock", "E"}, 0.4f);
  limits.add({"Dock", "N"}, 0.2f);
  EXPECT_EQ(limits.at({"Dock", "E"}), 0.3f);
  EXPECT_EQ(limits.at({"Dock", "S"}), kNone);
  EXPECT_EQ(limits.at({"Arch", "E"}), kNone);
  EXPECT_EQ(limits.lowest(), 0.2f);
}

TEST(SpeedLimits, OfARoadHoldAtBothOfItsEndsEvenIfItIsDrivenOneWay) {
  const auto works = Laboratory::of_text(R"(
import std.navigation
map Works {
    landmark Dock at (0, 0)
    landmark Arch at (3, 0)
    road Dock.E -> Arch.W at most 0.3 m/s by mark
}
command Go
route Errand on Works by Go: Dock -> Arch
)");
  EXPECT_EQ(works->knowledge->limits.at({"Dock", "E"}), 0.3f);
  EXPECT_EQ(works->knowledge->limits.at({"Arch", "W"}), 0.3f);
  EXPECT_EQ(works->knowledge->limits.at({"Arch", "E"}), kNone);
}

TEST(SpeedLimits, ASlowedRobotDrivesTheSameCurve) {
  const mts::Motion slow = mts::slowed({0.4f, 1.0f}, 0.1f), back = mts::slowed({-0.4f, 1.0f}, 0.1f), free = mts::slowed({0.4f, 1.0f}, kNone), spin = mts::slowed({0.0f, 2.0f}, 0.1f);
  EXPECT_FLOAT_EQ(slow.speed_m_s, 0.1f);
  EXPECT_FLOAT_EQ(slow.turn_rad_s, 0.25f);
  EXPECT_FLOAT_EQ(back.speed_m_s, -0.1f);
  EXPECT_FLOAT_EQ(back.turn_rad_s, 0.25f);
  EXPECT_EQ(free.speed_m_s, 0.4f);
  EXPECT_EQ(free.turn_rad_s, 1.0f);
  EXPECT_EQ(spin.turn_rad_s, 2.0f);
}

/// The fastest that the robot was between two places on the way east, or since or until a time.
float fastest(const Recording& recording, double from_x_m, double to_x_m, double from_s, double to_s) {
  float fastest = 0.0f;
  for (const Frame& frame : recording.frames) {
    const bool there = frame.pose.x_m >= from_x_m && frame.pose.x_m < to_x_m && frame.t_s >= from_s && frame.t_s < to_s;
    if (there) fastest = std::max(fastest, std::abs(frame.senses.speed_m_s));
  }
  return fastest;
}

TEST(SpeedLimits, AreKeptFromLandmarkToLandmark) {
  constexpr double kNoMatter = 1e9;
  constexpr float kNoise = 1.03f;
  const auto works = Laboratory::of_text(kErrand);
  Recording recording;
  ASSERT_EQ(works->drive(works->plain(), &recording).outcome, Summary::Outcome::kArrived);
  EXPECT_LE(fastest(recording, -kNoMatter, kNoMatter, 0.0, kNoMatter), 0.3f * kNoise);
  EXPECT_GE(fastest(recording, 0.5, 2.5, 10.0, kNoMatter), 0.29f) << "on the first road";
  EXPECT_LE(fastest(recording, 3.0, 6.0, 0.0, kNoMatter), 0.15f * kNoise) << "on the second one, and in the crossing before it";
  EXPECT_GE(fastest(recording, 3.5, 5.0, 0.0, kNoMatter), 0.14f);
  EXPECT_LE(fastest(recording, -kNoMatter, kNoMatter, 0.0, 1.0), 0.15f * kNoise) << "where it does not know on which road it is";
}

TEST(SpeedLimits, ChangeNothingWhereTheRobotIsSlowerAnyway) {
  std::string free(kErrand), fast(kErrand);
  for (std::size_t at; (at = free.find(" at most")) != std::string::npos;) free.erase(at, free.find("m/s", at) + 3 - at);
  for (const std::string_view limit : {"0.3 m/s", "15 cm/s"}) fast.replace(fast.find(limit), limit.size(), "2.5 m/s");
  const auto without = Laboratory::of_text(free), with = Laboratory::of_text(fast);
  EXPECT_EQ(without->trace(without->plain()), with->trace(with->plain()));
}

}  // namespace
}  // namespace kb::sim::testing
