// A compact mind of a thousand rules: many.kb beside this file. Most of the test is that C++ compilers get through its tables.
#include <waymark/runtime/compact_mind.h>

#include <gtest/gtest.h>

#include "many.kb.h"

namespace many {
namespace {

static_assert(Knowledge::kShape.rules > 1000);

template <class E>
E nth(E first, std::uint32_t i) { return static_cast<E>(static_cast<std::uint32_t>(first) + i); }

// The first pair, the last, and one from between.
TEST(CompactMind, KnowsEachOfAThousandRules) {
  for (const std::uint32_t a : {0u, 3u, 31u}) {
    for (const std::uint32_t b : {0u, 4u, 31u}) {
      Mind mind;
      mind.give(nth(Fact::Seen_n0, a), 1.0f);
      mind.give(nth(Fact::Wanted_n0, b), 1.0f);
      mind.tick(mts::milliseconds(20));
      for (std::uint32_t i = 0; i < 32; ++i) {
        EXPECT_EQ(mind.high(nth(Satellite::Found_n0, i)), i == a);
        EXPECT_EQ(mind.high(nth(Satellite::Chosen_n0, i)), i == b);
      }
      EXPECT_EQ(mind.high(Satellite::sat_Go), a == 3);
    }
  }
}

}  // namespace
}  // namespace many
