// What a component that is loaded while a program runs would have: a mind and a fleet.
#include "bumper.kb.fleet.h"

bool stands_at_first();   // in main.cc as well

bool stands_at_first() {
  bumper::Mind mind;
  bumper::Facts facts;
  bumper::Fleet fleet(70);
  fleet.tick(mts::milliseconds(20));
  return !mind.tick(facts, mts::milliseconds(20)).drives() && !fleet.drives(69);
}
