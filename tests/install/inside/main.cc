#include "bumper.kb.h"

int main() {
  bumper::Mind mind;
  bumper::Facts facts;
  return mind.tick(facts, mts::milliseconds(20)).drives() ? 1 : 0;
}
