// Names, parameters, and the small mathematics that controllers are made of.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <set>
#include <string>

#include <waymark/controllers/any_controller.h>
#include "tests/unit/controllers/drives.h"
#include "tests/unit/whole_file.h"

namespace mts {
namespace {

TEST(Registry, KnowsTheNamesThatControlLinesUse) {
  for (const char* name : {"follow_line", "keep_wall", "hold_heading", "turn_on_line", "turn_by_walls", "turn_by_compass",
                           "round_obstacle", "bug", "potential", "neural_map", "genetic", "turn_round", "look_round", "stand_still", "stand", "stop"}) {
    ASSERT_NE(find_controller(name), nullptr) << name;
    EXPECT_STREQ(find_controller(name)->name, name);
  }
  EXPECT_EQ(find_controller("follow_lin"), nullptr);
  EXPECT_EQ(find_controller("follow_line2"), nullptr);
  EXPECT_EQ(find_controller(""), nullptr);
}

TEST(Registry, EveryDefaultIsInItsRangeAndEveryNameStandsOnce) {
  for (const ControllerEntry& entry : kControllers) {
    std::set<std::string> names;
    for_each_parameter(entry.id, [&](const Parameter& parameter) {
      EXPECT_TRUE(names.insert(parameter.name).second) << entry.name << ' ' << parameter.name;
      EXPECT_LE(parameter.low, parameter.preset) << entry.name << ' ' << parameter.name;
      EXPECT_LE(parameter.preset, parameter.high) << entry.name << ' ' << parameter.name;
      EXPECT_NE(std::string(parameter.about), "") << entry.name << ' ' << parameter.name;
    });
  }
}

/// The row of docs/controllers.md for a parameter.
std::string row_of(const Parameter& p) {
  char middle[80];
  if (p.values == Values::kNumber) {
    std::snprintf(middle, sizeof middle, "| %s | %.4g | %.4g to %.4g |", p.unit, static_cast<double>(p.preset),
                  static_cast<double>(p.low), static_cast<double>(p.high));
  } else if (p.values == Values::kWhole) {
    std::snprintf(middle, sizeof middle, "| | %.0f | %.0f to %.0f, whole |", static_cast<double>(p.preset), static_cast<double>(p.low), static_cast<double>(p.high));
  } else {
    const Words words = words_of(p.values);
    std::string all;
    for (std::size_t k = 0; k < words.count; ++k) all += (k == 0 ? "" : ", ") + std::string(words.first[k]);
    std::snprintf(middle, sizeof middle, "| | %s | %s |", words.first[static_cast<std::size_t>(p.preset)], all.c_str());
  }
  return "| `" + std::string(p.name) + "` " + middle + " " + p.about + " |";
}

TEST(Registry, TheChapterOnControllersHasARowForEachParameter) {
  const std::string chapter = kb::whole_file(KB_PROJECT_ROOT "/docs/controllers.md");
  for (const ControllerEntry& entry : kControllers) {
    EXPECT_NE(chapter.find("`" + std::string(entry.name) + "`"), std::string::npos) << entry.name;
    for_each_parameter(entry.id, [&](const Parameter& parameter) {
      EXPECT_NE(chapter.find(row_of(parameter)), std::string::npos) << "docs/controllers.md lacks: " << row_of(parameter);
    });
  }
}

TEST(Body, TheChapterOnControllersSaysItsDefaults) {
  const std::string chapter = kb::whole_file(KB_PROJECT_ROOT "/docs/controllers.md");
  const Body body;
  const struct { const char* name; float value; } rows[] = {
      {"radius_m", body.radius_m}, {"wheel_base_m", body.wheel_base_m}, {"top_speed_m_s", body.top_speed_m_s},
      {"top_acceleration_m_s2", body.top_acceleration_m_s2}, {"range_latency_s", body.range_latency_s}, {"crawl_m_s", body.crawl_m_s}, {"longest_silence_s", body.longest_silence_s},
      {"line_ahead_m", body.line_ahead_m}, {"line_span_m", body.line_span_m}, {"paint_width_m", body.paint_width_m},
      {"stop_line_width_m", body.stop_line_width_m}, {"road_width_m", body.road_width_m}, {"crossing_m", body.crossing_m},
      {"hall_door_m", body.hall_door_m}};
  for (const auto& row : rows) {
    const std::size_t at = chapter.find("\n| `" + std::string(row.name) + "` | ");
    ASSERT_NE(at, std::string::npos) << row.name;
    EXPECT_FLOAT_EQ(std::stof(chapter.substr(chapter.find(" | ", at) + 3)), row.value) << row.name;
  }
}

TEST(Registry, WordsAreNumbers) {
  const Parameter* side = find_parameter(ControllerId::kKeepWall, "side");
  ASSERT_NE(side, nullptr);
  EXPECT_EQ(number_of_word(*side, "right"), 2.0f);
  EXPECT_EQ(number_of_word(*side, "back"), -1.0f);
  const Parameter* turn = find_parameter(ControllerId::kTurnOnLine, "turn");
  ASSERT_NE(turn, nullptr);
  EXPECT_EQ(number_of_word(*turn, "right"), static_cast<float>(Turn::kRight));
  EXPECT_EQ(number_of_word(*find_parameter(ControllerId::kKeepWall, "speed"), "right"), -1.0f);
}

TEST(AnyController, SetsWhatIsInRangeAndSaysWhatIsNot) {
  AnyController controller;
  const Body body{.has_range_finders = false};
  controller.choose(ControllerId::kFollowLine, body);
  EXPECT_EQ(controller.set("speed", 0.2f), Setting::kSet);
  EXPECT_EQ(controller.set("speed", 2.0f), Setting::kOutside);
  EXPECT_EQ(controller.set("speed", std::nanf("")), Setting::kOutside);
  EXPECT_EQ(controller.set("sped", 0.2f), Setting::kUnknown);
  controller.choose(ControllerId::kKeepWall, body);
  EXPECT_EQ(controller.set("side", 1.5f), Setting::kOutside) << "between two words";
  EXPECT_EQ(controller.set_word("side", "right"), Setting::kSet);
  EXPECT_EQ(controller.set_word("side", ""), Setting::kSet) << "as it was";
  EXPECT_EQ(controller.set_word("side", "back"), Setting::kOutside) << "no word of it";
  EXPECT_EQ(controller.set_word("speed", "right"), Setting::kOutside) << "a number";
  EXPECT_EQ(controller.set_word("sides", "right"), Setting::kUnknown);
  controller.choose(ControllerId::kFollowLine, body);
  EXPECT_EQ(controller.set("speed", 0.2f), Setting::kSet);
  Senses senses;
  senses.line_known = true;
  senses.line[2] = 1.0f;
  controller.start({}, senses);
  EXPECT_FLOAT_EQ(controller.step(senses, 0.01f).speed_m_s, 0.2f);
  controller.choose(ControllerId::kFollowLine, body);   // what was set is forgotten
  controller.start({}, senses);
  EXPECT_FLOAT_EQ(controller.step(senses, 0.01f).speed_m_s, 0.4f);
}

TEST(AnyController, StandsBeforeItsCrossingHasBegun) {
  Senses senses;
  senses.line_known = senses.heading_known = senses.odometry_known = senses.turned_known = true;
  for (const ControllerId id : {ControllerId::kTurnOnLine, ControllerId::kTurnByCompass}) {
    AnyController controller;
    controller.choose(id, {.has_range_finders = false});
    const Motion motion = controller.step(senses, 0.02f);
    EXPECT_EQ(motion.speed_m_s, 0.0f);
    EXPECT_EQ(motion.turn_rad_s, 0.0f);
  }
}

TEST(AnyController, StandsWhereTheClockStands) {
  Senses senses;
  senses.line_known = senses.range_known = senses.heading_known = senses.odometry_known = true;
  for (float& range_m : senses.range_m) range_m = kOutOfRange;
  for (const float dt_s : {0.0f, plant::kNaN, -0.02f}) {
    AnyController drive;
    drive.choose(ControllerId::kHoldHeading);
    drive.start({}, senses);
    EXPECT_GT(drive.step(senses, dt_s).speed_m_s, 0.0f) << "one late reading of the clock is not the end";
    for (int i = 0; i < 60; ++i) static_cast<void>(drive.step(senses, dt_s));
    EXPECT_EQ(drive.step(senses, dt_s).speed_m_s, 0.0f) << dt_s;
    EXPECT_GT(drive.step(senses, 0.02f).speed_m_s, 0.0f) << "it goes on when the clock does";
  }
}

TEST(AnyController, KeepsNoWallInsideTheRobot) {
  const Body broad{.radius_m = 0.2f};
  const struct { ControllerId id; const char* name; } distances[] = {{ControllerId::kKeepWall, "distance"}, {ControllerId::kRoundObstacle, "distance"},
                                                                      {ControllerId::kBug, "distance"}, {ControllerId::kGenetic, "clearance"}};
  for (const auto& one : distances) {
    AnyController controller;
    controller.choose(one.id);
    EXPECT_EQ(controller.set(one.name, 0.15f), Setting::kSet);
    controller.choose(one.id, broad);
    EXPECT_EQ(controller.set(one.name, 0.22f), Setting::kOutside) << "2 cm from its edge";
    EXPECT_EQ(controller.set(one.name, 0.24f), Setting::kSet);
  }
  for_each_parameter(ControllerId::kKeepWall, [&](const Parameter& parameter) {
    EXPECT_EQ(lowest(parameter, broad) == parameter.low, !same_text(parameter.name, "distance")) << parameter.name;
  });
}

// A line somewhat aside, which a robot follows the more slowly the slower it is on straight lines.
TEST(AnyController, DefaultsAreWhatItsBodyAllows) {
  Senses senses;
  senses.line_known = true;
  senses.line[1] = 1.0f;
  const auto speed = [&](float set) {
    AnyController controller;
    controller.choose(ControllerId::kFollowLine, {.top_speed_m_s = 0.2f, .has_range_finders = false});
    EXPECT_EQ(controller.set("speed", set), set > 0.0f ? Setting::kSet : Setting::kOutside);
    controller.start({}, senses);
    return controller.step(senses, 0.01f).speed_m_s;
  };
  EXPECT_FLOAT_EQ(speed(0.0f), speed(0.2f)) << "0.4 m/s, the default, is more than it can drive";
  EXPECT_LT(speed(0.0f), 0.15f);
  const Parameter& distance = *find_parameter(ControllerId::kKeepWall, "distance");
  EXPECT_EQ(lowest(distance, {.radius_m = 5.0f}), distance.high) << "such a robot needs a Similarity";
}

TEST(AnyController, EveryParameterReachesItsController) {
  for (const ControllerEntry& entry : kControllers) {
    for_each_parameter(entry.id, [&](const Parameter& parameter) {
      AnyController controller;
      controller.choose(entry.id);
      EXPECT_EQ(controller.set(parameter.name, parameter.high), Setting::kSet) << entry.name << ' ' << parameter.name;
    });
  }
  KeepWallGains gains;
  for (const auto& one : kKeepWallGains) one.set(gains, one.parameter.high);
  EXPECT_EQ(gains.side, Side::kRight);
  EXPECT_FLOAT_EQ(gains.turn_rad_s, 240.0f * kRadPerDeg);
}

TEST(AnyController, TheTurnOfAControlLineGoesBeforeThatOfTheTask) {
  Senses senses;
  senses.heading_known = senses.odometry_known = true;
  Task task;   // forward
  AnyController controller;
  controller.choose(ControllerId::kTurnByCompass, {.has_range_finders = false});
  EXPECT_EQ(controller.set("turn", static_cast<float>(Turn::kLeft)), Setting::kSet);
  task.exit_known = true;
  task.exit_heading_rad = 0.5f * kPi;
  controller.start(task, senses);
  senses.speed_m_s = 0.25f;
  float most = 0.0f;
  for (int i = 0; i < 300; ++i) most = greatest(most, controller.step(senses, 0.01f).turn_rad_s);
  EXPECT_GT(most, 1.0f);
}

TEST(Angles, AgreeWithTheStandardLibrary) {
  for (int i = -4000; i <= 4000; ++i) {
    const float x = static_cast<float>(i) * 0.01f;
    EXPECT_NEAR(sine(x), std::sin(static_cast<double>(x)), 3e-6) << x;
    EXPECT_NEAR(cosine(x), std::cos(static_cast<double>(x)), 3e-6) << x;
    EXPECT_NEAR(std::remainder(static_cast<double>(wrapped_angle(x)) - static_cast<double>(x), 6.283185307179586), 0.0, 3e-6) << x;
    EXPECT_LE(magnitude(wrapped_angle(x)), kPi) << x;
  }
  for (int i = 0; i < 720; ++i) {
    const double angle = (i - 359.5) * 0.008726646259971648;
    const auto x = static_cast<float>(0.7 * std::cos(angle)), y = static_cast<float>(0.7 * std::sin(angle));
    EXPECT_NEAR(angle_of(x, y), std::atan2(static_cast<double>(y), static_cast<double>(x)), 1e-6) << i;
  }
  EXPECT_EQ(angle_of(0.0f, 0.0f), 0.0f);
  EXPECT_EQ(wrapped_angle(std::nanf("")), 0.0f);
}

TEST(Pid, ItsIntegralStandsStillAtTheLimit) {
  Pid pid{1.0f, 1.0f, 0.0f, 0.0f, 0.5f};
  for (int i = 0; i < 1000; ++i) EXPECT_FLOAT_EQ(pid.step(1.0f, 0.01f), 0.5f);
  EXPECT_LT(pid.step(-0.1f, 0.01f), 0.0f);   // nothing has been wound up
}

TEST(Pid, ItsDerivativeIsFiltered) {
  Pid pid{0.0f, 0.0f, 1.0f, 0.09f, 100.0f};
  pid.step(0.0f, 0.01f);
  EXPECT_NEAR(pid.step(0.1f, 0.01f), 0.1f * 10.0f, 1e-4);   // dt / (tau + dt) = 0.1 of the slope of 10
}

}  // namespace
}  // namespace mts
