// Two knowledge bases of one file name in a program, one of them in a namespace within another; and a mind without an image.
struct Row {};   // a name that a table may have anywhere

#include <waymark/runtime/image_mind.h>
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
  mts::ImageMind image;
  mts::SwapReport report;
  const bool taken = image.take(nullptr, 0, nullptr, 0, report, [](const mts::SwapLoss&) {}) == mts::ImageStatus::kOk;
  return drives || taken ? 1 : 0;
}
