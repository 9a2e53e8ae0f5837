// A robot in a room with obstacles: eight feelers, a goal, and the fuzzy planner of the standard library. One tick is one
// step to a neighbouring cell.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "robot.kb.h"

namespace {

constexpr int kGoalX = 28, kGoalY = 2;
constexpr double kDegrees = 57.29577951308232;

/// North is up, so rows are numbered downwards; headings are counted counter-clockwise from the east, in eighths of a turn.
struct Room {
  std::vector<std::string> rows = {
      "################################",
      "#                              #",
      "#              ##              #",
      "#              ##      #       #",
      "#    ####      ##      #       #",
      "#    ####              #       #",
      "#              ####            #",
      "#  R              #      ##    #",
      "#          ##            ##    #",
      "#                              #",
      "################################",
  };
  [[nodiscard]] bool free(int x, int y) const { return rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] != '#'; }
};

constexpr int kDx[] = {1, 1, 0, -1, -1, -1, 0, 1};
constexpr int kDy[] = {0, -1, -1, -1, 0, 1, 1, 1};

/// Its controllers: what is sensed for the fuzzy block, and what is done with its answer.
class Robot {
 public:
  void sense(robot::GoToGoal::Inputs& in) const {
    const double to_goal = std::atan2(y_ - kGoalY, kGoalX - x_) * kDegrees;
    in.bearing_deg = static_cast<float>(std::remainder(to_goal - 45.0 * heading_, 360.0));
    for (int k = 0; k < 8; ++k) in.free[k] = is_free((heading_ + k) % 8) ? 1.0f : 0.0f;
  }

  void GoToGoal(const robot::GoToGoal::Outputs& out) {
    if (out.status == mts::FuzzyStatus::kNoRule) return;   // shut in
    heading_ = (heading_ + 8 + static_cast<int>(std::lround(out.turn_deg / 45.0f))) % 8;
    x_ += kDx[heading_];
    y_ += kDy[heading_];
    room_.rows[static_cast<std::size_t>(y_)][static_cast<std::size_t>(x_)] = '.';
    ++steps_;
  }

  void idle() {}

  [[nodiscard]] bool is_there() const { return x_ == kGoalX && y_ == kGoalY; }
  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] const Room& room() const { return room_; }

 private:
  /// A step between two cells that touch at a corner is no way.
  [[nodiscard]] bool is_free(int direction) const {
    const bool straight = room_.free(x_ + kDx[direction], y_ + kDy[direction]);
    return straight && room_.free(x_ + kDx[direction], y_) && room_.free(x_, y_ + kDy[direction]);
  }

  Room room_;
  int x_ = 3, y_ = 7, heading_ = 2;   // it looks north
  int steps_ = 0;
};

}  // namespace

int main() {
  robot::Mind mind;
  robot::Facts facts;
  Robot robot;
  for (int tick = 0; tick < 100; ++tick) {
    facts.Go = tick == 1 ? 0.9f : 0.0f;
    facts.There = robot.is_there() ? 1.0f : -1.0f;
    robot::drive(mind.tick(facts, mts::milliseconds(100)), robot);
  }
  for (std::string row : robot.room().rows) std::printf("%s\n", row.c_str());
  std::printf("%s after %d steps\n", robot.is_there() ? "there" : "not there", robot.steps());
  return robot.is_there() ? 0 : 1;
}
