// Two knowledge bases of one file name in a program, one of them in a namespace within another.
#include "bumper_mind.kb/bumper.kb.h"
#include "other_mind.kb/bumper.kb.fleet.h"

int main() {
  bumper::Mind mind;
  bumper::Facts facts;
  acme::bumper::Mind other;
  acme::bumper::Facts other_facts;
  acme::bumper::Fleet fleet(70);
  fleet.tick(mts::milliseconds(20));
  const bool drives = mind.tick(facts, mts::milliseconds(20)).drives() || other.tick(other_facts, mts::milliseconds(20)).drives() || fleet.drives(69);
  return drives ? 1 : 0;
}
