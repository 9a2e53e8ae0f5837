#include "compiler/program/conditions.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace kb::program {
namespace {

// Thousands share one part that is newer than the others, so that their near slots are soon taken; and the pool grows meanwhile.
TEST(ConditionPool, HoldsEachConditionOnceHoweverManyShareAPart) {
  constexpr std::uint32_t kCount = 5000;
  std::vector<Cond> conds;
  ConditionPool pool(conds);
  std::vector<CondId> cells, made;
  for (std::uint32_t i = 0; i < kCount; ++i) cells.push_back(pool.seen(CellId{i}));
  const CondId newest = pool.is(CellId{kCount});
  for (const CondId cell : cells) made.push_back(pool.all_of(std::array{cell, newest}));
  EXPECT_EQ(conds.size(), 2 * kCount + 1);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    EXPECT_EQ(pool.seen(CellId{i}), cells[i]);
    EXPECT_EQ(pool.all_of(std::array{cells[i], newest}), made[i]);
  }
  EXPECT_EQ(conds.size(), 2 * kCount + 1);
}

TEST(ConditionPool, KnowsWhatWasThereBeforeIt) {
  std::vector<Cond> conds;
  const CondId seen = ConditionPool(conds).seen(CellId{7});
  ConditionPool later(conds, 1000);
  EXPECT_EQ(later.seen(CellId{7}), seen);
  EXPECT_NE(later.event(CellId{7}), seen);
}

}  // namespace
}  // namespace kb::program
