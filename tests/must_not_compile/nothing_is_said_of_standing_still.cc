// MUST NOT COMPILE: no `idle()`
#include "bumper.kb.h"

struct Wheels {
  void drive(const bumper::Drive& how) { speed = how.speed_m_per_s; }
#ifdef FIXED
  void idle() { speed = 0.0f; }
#endif
  float speed = 0.0f;
};

int main() {
  bumper::Mind mind;
  Wheels wheels;
  bumper::drive(mind.decision(), wheels);
  return wheels.speed == 0.0f ? 0 : 1;
}
