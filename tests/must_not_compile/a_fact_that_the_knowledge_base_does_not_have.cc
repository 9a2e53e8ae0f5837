// MUST NOT COMPILE: Wal
#include "bumper.kb.h"

int main() {
  bumper::Facts facts;
#ifdef FIXED
  facts.Wall = 0.9f;
#else
  facts.Wal = 0.9f;
#endif
  return 0;
}
