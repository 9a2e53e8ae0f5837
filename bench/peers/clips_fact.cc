#include "bench/peers/clips_fact.h"

extern "C" {
#include <clips/clips.h>
}

namespace peers {

void ClipsFact::stand(void* environment, bool now) {
  if ((fact != nullptr) == now) return;
  if (now) {
    fact = EnvAssert(environment, EnvCreateFact(environment, of_template));
  } else {
    EnvRetract(environment, fact);
    fact = nullptr;
  }
}

}  // namespace peers
