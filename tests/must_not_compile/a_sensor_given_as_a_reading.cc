// MUST NOT COMPILE: deleted
#include <waymark/runtime/readings.h>

// As kbc emits it.
using Store = mts::ReadingStore<2>;
union Readings {
  Readings() : store() {}
  Store store;
  mts::NumberArray<Store, 0, 2> range;
};

int main() {
  Readings readings;
#ifdef FIXED
  readings.range[1] = {0.31f, mts::Instant{20}};
#else
  readings.range[1] = readings.range[0];
#endif
  return 0;
}
