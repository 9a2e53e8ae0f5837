// Part of a program that keeps its knowledge base to itself: compiled twice, with another `twin` each time.
#include "twin.kb.h"

/// What runs when the button is pressed.
const char* TWIN() {
  twin::Mind mind;
  mind.give(twin::Fact::Button, 1.0f);
  return twin::name(mind.tick(mts::milliseconds(20)).strategy());
}
