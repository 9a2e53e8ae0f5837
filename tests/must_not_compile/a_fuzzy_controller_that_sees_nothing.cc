// MUST NOT COMPILE: no `sense(GoToGoal::Inputs&)`: what `GoToGoal` is to look at
#include "robot.kb.h"

struct Wheels {
#ifdef FIXED
  void sense(robot::GoToGoal::Inputs& in) { in.bearing_deg = 0.0f; }
#endif
  void GoToGoal(const robot::GoToGoal::Outputs& out) { turn = out.turn_deg; }
  void idle() { turn = 0.0f; }
  float turn = 0.0f;
};

int main() {
  robot::Mind mind;
  Wheels wheels;
  robot::drive(mind.decision(), wheels);
  return wheels.turn == 0.0f ? 0 : 1;
}
