#include "runtime/bits.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace mts::bits {
namespace {

TEST(Bits, NextFindsEveryMemberInOrder) {
  constexpr std::uint32_t kSize = 5'000;
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    Word words[Shape::words_for(kSize)] = {};
    Word sums[Shape::words_for(Shape::words_for(kSize))] = {};
    std::set<std::uint32_t> members;
    for (int i = 0; i < round * 3; ++i) members.insert(static_cast<std::uint32_t>(random() % kSize));
    for (const std::uint32_t m : members) {
      set(words, m);
      set(sums, m / kWordBits);
    }
    const auto from = static_cast<std::uint32_t>(random() % kSize);
    const auto end = from + static_cast<std::uint32_t>(random() % (kSize - from));
    std::set<std::uint32_t> plain, summed;
    for (std::uint32_t i = next(words, from, end); i < end; i = next(words, i + 1, end)) plain.insert(i);
    for (std::uint32_t i = next(words, sums, from, end); i < end; i = next(words, sums, i + 1, end)) summed.insert(i);
    const std::set<std::uint32_t> expected(members.lower_bound(from), members.lower_bound(end));
    EXPECT_EQ(plain, expected);
    EXPECT_EQ(summed, expected);
  }
}

TEST(Bits, AnEmptyRangeHasNoMember) {
  Word words[1] = {~Word{0}};
  EXPECT_EQ(next(words, 5, 5), 5u);
  EXPECT_EQ(next(words, words, 0, 0), 0u);
}

}  // namespace
}  // namespace mts::bits
