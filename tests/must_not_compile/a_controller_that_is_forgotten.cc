// MUST NOT COMPILE: no controller `drive(const Drive&)`: it drives Drive.ahead, Drive.back
#include "bumper.kb.h"

struct Wheels {
#ifdef FIXED
  void drive(const bumper::Drive& how) { speed = how.speed_m_per_s; }
#endif
  void idle() { speed = 0.0f; }
  float speed = 0.0f;
};

int main() {
  bumper::Mind mind;
  Wheels wheels;
  bumper::drive(mind.decision(), wheels);
  return wheels.speed == 0.0f ? 0 : 1;
}
