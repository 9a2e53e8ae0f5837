#include "compiler/tables/compact.h"

#include <gtest/gtest.h>

#include <waymark/runtime/compact_state.h>

namespace kb::tables {
namespace {

template <mts::Shape kShape, mts::CompactShape kBounds>
void expect_size() {
  EXPECT_EQ(compact_state_bytes(kShape, kBounds), sizeof(mts::CompactState<kShape, kBounds>));
}

TEST(CompactState, IsAsLargeAsTheBudgetSays) {
  expect_size<mts::Shape{.facts = 1, .atoms = 2, .levels = 2}, mts::CompactShape{}>();
  expect_size<mts::Shape{.facts = 38, .satellites = 97, .strategies = 18, .atoms = 174, .rules = 141, .words = 7, .nodes = 31,
                         .timers = 28, .queues = 11, .levels = 7, .contested = 50},
              mts::CompactShape{.written = 60, .blends = 9}>();
  expect_size<mts::Shape{.facts = 301, .satellites = 999, .strategies = 5, .atoms = 3001, .rules = 2001, .words = 64, .nodes = 3,
                         .timers = 1, .queues = 1, .levels = 3, .contested = 2},
              mts::CompactShape{.written = 998, .blends = 2}>();
}

TEST(CompactState, HasIndexesThatHoldEveryLevel) {
  constexpr mts::Shape kManyLevels{.facts = 2, .satellites = 1, .atoms = 4, .rules = 2, .words = 1, .levels = 300, .contested = 1};
  static_assert(sizeof(mts::CompactState<kManyLevels, mts::CompactShape{.written = 1, .blends = 1}>::Ix) == 2);
}

}  // namespace
}  // namespace kb::tables
