// The program of the robot: the sensors' facts in, one controller out, at every tick.
//
// Without a robot at hand it rehearses the first seconds of the mission, and prints what would be driven.
#include <cstdio>

#include "@NAME@.kb.h"

namespace {

// What turns the wheels: a function for each controller that @NAME@.kb names. Forgetting one does not compile.
struct Controllers {
  void follow_line(const @NAME@::FollowLine& how) { say("follow the painted line", how.speed_m_per_s); }
  void keep_wall(const @NAME@::KeepWall& how) { say("drive between the walls", how.speed_m_per_s); }
  void hold_heading(const @NAME@::HoldHeading& how) { say("drive by the compass", how.speed_m_per_s); }
  void turn_on_line(const @NAME@::TurnOnLine& how) { say("cross on the line", how.speed_m_per_s); }
  void turn_by_walls(const @NAME@::TurnByWalls& how) { say("cross by the walls", how.speed_m_per_s); }
  void turn_by_compass(const @NAME@::TurnByCompass& how) { say("cross by the compass", how.speed_m_per_s); }
  void round_obstacle(const @NAME@::RoundObstacle& how) { say("go round the obstacle", how.speed_m_per_s); }
  void look_round(const @NAME@::LookRound&) { say("look round for a sign", 0.0f); }
  void stand(const @NAME@::Stand&) { say("stand", 0.0f); }
  void idle() { say("stand", 0.0f); }   // no strategy runs

  void say(const char* what, float speed) {
    doing = what;
    speed_m_per_s = speed;
  }
  const char* doing = "";
  float speed_m_per_s = 0.0f;
};

// In place of sensors. A fact is how certain it is: 1 surely so, -1 surely not, 0 nothing known.
void sense(int tick, @NAME@::Facts& facts) {
  const bool sign = tick >= 7 && tick < 12;          // the dock's sign is in view
  const bool line = tick >= 10 && tick < 12;         // its stop line is under the robot
  facts.Fetch = tick == 2 ? 1.0f : 0.0f;             // the button is pressed for a moment
  facts.Track.mark = 0.9f;                           // the painted line can be followed
  facts.Dock = sign ? 0.9f : 0.0f;
  facts.In.S = sign ? 0.8f : 0.0f;                   // it comes from the south
  facts.CrossBy.mark = sign ? 0.9f : 0.0f;           // the crossing has a painted line too
  facts.Safe = sign ? 0.9f : 0.0f;
  facts.Line = line ? 0.9f : 0.0f;
}

}  // namespace

int main() {
  @NAME@::Mind mind;
  @NAME@::Facts facts;
  Controllers controllers;
  for (int tick = 0; tick < 14; ++tick) {
    sense(tick, facts);
    const auto decision = mind.tick(facts, mts::milliseconds(200));
    @NAME@::drive(decision, controllers);
    std::printf("%4.1f s  %-24s %.1f m/s\n", 0.2 * tick, controllers.doing, static_cast<double>(controllers.speed_m_per_s));
  }
  return mind.decision().strategy() == @NAME@::Strategy::Cross_right_mark ? 0 : 1;
}
