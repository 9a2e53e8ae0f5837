// MUST NOT COMPILE: deleted
#include <waymark/runtime/readings.h>

// As kbc emits it.
struct Texts {
  static constexpr const char* kTexts[] = {"exit"};
  static constexpr std::uint32_t kCount = 1;
};
using Store = mts::ReadingStore<2>;
union Readings {
  Readings() : store() {}
  Store store;
  mts::TextSlot<Store, 0, 2, Texts> sign;
};

int main() {
  Readings readings;
#ifdef FIXED
  readings.sign[1] = {"exit", mts::Instant{20}};
#else
  readings.sign[1] = readings.sign[0];
#endif
  return 0;
}
