// MUST NOT COMPILE: this knowledge base was compiled for another version of the runtime
#include "bumper.kb.h"

struct Old : bumper::Knowledge {
#ifndef FIXED
  static constexpr std::uint32_t kAbi = mts::kAbi + 1;
#endif
};

int main() {
  mts::Mind<Old> mind;
  return mind.decision().drives() ? 1 : 0;
}
