// What a silent compass does to controllers: at first, or all the time.
#include <gtest/gtest.h>

#include <waymark/controllers/any_controller.h>

namespace mts {
namespace {

constexpr float kEvery_s = 0.02f;

/// A robot on an open floor that does what it is told, without noise. Its wheels tell how it turns; its compass speaks from a moment on.
struct Robot {
  float x_m = 0.0f, y_m = 0.0f, heading_rad = 0.0f, turned_rad = 0.0f, speed_m_s = 0.0f;
  int compass_from = 1'000'000;   ///< the sample
  int samples = 0;

  Senses sense() {
    Senses senses;
    senses.odometry_known = senses.turned_known = senses.range_known = true;
    senses.x_m = x_m;
    senses.y_m = y_m;
    senses.speed_m_s = speed_m_s;
    senses.turned_rad = turned_rad;
    senses.heading_known = samples++ >= compass_from;
    senses.heading_rad = senses.heading_known ? wrapped_angle(heading_rad) : 0.0f;
    for (float& range_m : senses.range_m) range_m = kOutOfRange;
    return senses;
  }
  void drive(const Motion& motion) {
    speed_m_s = motion.speed_m_s;
    heading_rad += motion.turn_rad_s * kEvery_s;
    turned_rad += motion.turn_rad_s * kEvery_s;
    x_m += speed_m_s * kEvery_s * cosine(heading_rad);
    y_m += speed_m_s * kEvery_s * sine(heading_rad);
  }
  /// Until the controller is done, for so many samples at most.
  void drive(AnyController& controller, const Task& task, int samples_at_most) {
    controller.start(task, sense());
    for (int i = 0; i < samples_at_most && !controller.done(); ++i) drive(controller.step(sense(), kEvery_s));
  }
};

AnyController chosen(ControllerId id) {
  AnyController controller;
  controller.choose(id);
  return controller;
}

TEST(LateCompass, TurningRoundIsHalfATurnWhenTheCompassComesBackMeanwhile) {
  for (const int from : {5, 10, 30}) {
    Robot robot;
    robot.heading_rad = 2.0f;
    robot.compass_from = from;
    AnyController controller = chosen(ControllerId::kTurnRound);
    robot.drive(controller, {}, 2000);
    EXPECT_TRUE(controller.done());
    EXPECT_NEAR(robot.heading_rad - 2.0f, kPi, 5.0f * kRadPerDeg) << from;
  }
}

TEST(LateCompass, TurningRoundIntoARoadIsHalfATurnWithoutACompass) {
  Robot robot;
  robot.heading_rad = 2.0f;
  Task task;
  task.pieces = 1;
  task.course[0] = {wrapped_angle(2.0f + kPi), 3.0f};
  AnyController controller = chosen(ControllerId::kTurnRound);
  robot.drive(controller, task, 2000);
  EXPECT_NEAR(robot.heading_rad - 2.0f, kPi, 5.0f * kRadPerDeg);
}

TEST(LateCompass, TheHeadingAtTheStartIsHeldWhenTheCompassComesBack) {
  Robot robot;
  robot.heading_rad = 2.0f;
  robot.compass_from = 50;
  AnyController controller = chosen(ControllerId::kHoldHeading);
  robot.drive(controller, {}, 300);
  EXPECT_NEAR(robot.heading_rad, 2.0f, 0.01f);
}

TEST(LateCompass, ItLooksRoundToBothSidesOfWhereItFacedWhenTheCompassComesBack) {
  Robot robot;
  robot.heading_rad = 2.0f;
  robot.compass_from = 20;
  AnyController controller = chosen(ControllerId::kLookRound);
  controller.start({}, robot.sense());
  float left = 2.0f, right = 2.0f;
  for (int i = 0; i < 1000; ++i) {
    robot.drive(controller.step(robot.sense(), kEvery_s));
    left = greatest(left, robot.heading_rad);
    right = least(right, robot.heading_rad);
  }
  EXPECT_NEAR(left, 2.0f + 60.0f * kRadPerDeg, 0.1f);
  EXPECT_NEAR(right, 2.0f - 60.0f * kRadPerDeg, 0.1f);
}

TEST(LateCompass, WithoutACompassAHallIsCrossedInTheDirectionOfItsDoor) {
  for (const ControllerId id : {ControllerId::kBug, ControllerId::kPotential}) {
    Robot robot;
    robot.heading_rad = 0.5f * kPi;
    Task task;
    task.in_hall = true;
    task.in = {0.0f, 0.0f, 0.5f * kPi};
    task.out = {0.0f, 5.0f, 0.5f * kPi};
    AnyController controller = chosen(id);
    robot.drive(controller, task, 500);
    EXPECT_NEAR(robot.x_m, 0.0f, 0.1f);
    EXPECT_GT(robot.y_m, 2.0f);
  }
}

TEST(LateCompass, WithoutACompassItComesBackToItsTrackRoundAnObstacle) {
  Robot robot;
  robot.heading_rad = 0.5f * kPi;
  Task task;
  task.pieces = 1;
  task.course[0] = {0.5f * kPi, 4.0f};
  AnyController controller = chosen(ControllerId::kRoundObstacle);
  robot.drive(controller, task, 1500);
  EXPECT_TRUE(controller.done());
  EXPECT_NEAR(robot.x_m, 0.0f, 0.05f);
  EXPECT_NEAR(robot.heading_rad, 0.5f * kPi, 0.05f);
}

TEST(LateCompass, WithoutACourseItComesBackToWhereItFacedWhenTheCompassComesBack) {
  Robot robot;
  robot.heading_rad = 2.0f;
  robot.compass_from = 5;
  AnyController controller = chosen(ControllerId::kRoundObstacle);
  robot.drive(controller, {}, 1500);
  EXPECT_TRUE(controller.done());
  EXPECT_NEAR(robot.heading_rad, 2.0f, 0.05f);
}

}  // namespace
}  // namespace mts
