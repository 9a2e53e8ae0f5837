// Drives the bumper robot past a wall with no robot at hand: six ticks of half a second.
#include <cstdio>

#include "bumper.kb.h"
#include "controllers/any_controller.h"
#include "route1.kb.h"

static_assert(mts::find_controller("keep_wall") != nullptr, "the controllers are part of the package");

namespace {

struct Wheels {
  float speed_m_per_s = 0.0f;
  void drive(const bumper::Drive& how) { speed_m_per_s = how.speed_m_per_s; }
  void idle() { speed_m_per_s = 0.0f; }
};

}  // namespace

int main() {
  constexpr struct { float button, wall, speed; } kTicks[] = {
      {0.0f, -1.0f, 0.0f},  {0.9f, -1.0f, 0.4f}, {0.0f, -1.0f, 0.4f},
      {0.0f, 0.9f, -0.2f},  {0.0f, 0.2f, -0.2f}, {0.0f, -1.0f, -0.2f}, {0.0f, -1.0f, 0.4f},
  };
  bumper::Mind mind;
  bumper::Facts facts;
  Wheels wheels;
  for (const auto& now : kTicks) {
    facts.Button = now.button;
    facts.Wall = now.wall;
    const auto decision = mind.tick(facts, mts::milliseconds(500));
    bumper::drive(decision, wheels);
    std::printf("%llu %s %.1f m/s\n", static_cast<unsigned long long>(decision.tick()), mts::text(decision.status()),
                static_cast<double>(wheels.speed_m_per_s));
    if (wheels.speed_m_per_s != now.speed) return 1;
  }
  route1::Mind navigator;
  route1::Facts view;
  return navigator.tick(view, mts::milliseconds(500)).drives() ? 1 : 0;
}
