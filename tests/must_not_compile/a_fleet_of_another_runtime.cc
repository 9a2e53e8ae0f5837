// MUST NOT COMPILE: this fleet was compiled for another version of the runtime
#include "bumper.kb.fleet.h"

struct Old : bumper::Knowledge {};

template <>
struct mts::FleetForm<Old> : mts::FleetForm<bumper::Knowledge> {
#ifndef FIXED
  static constexpr std::uint32_t kAbi = mts::kFleetAbi + 1;
#endif
};

int main() {
  mts::Fleet<Old> fleet(1);
  return fleet.drives(0) ? 1 : 0;
}
