#include <waymark/runtime/bits.h>

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

namespace mts::bits {
namespace {

/// A set and its summary. 40,000 members have three layers of summary.
struct Set {
  explicit Set(std::uint32_t size) : words(Shape::words_for(size)), summary(Shape::summary_for(Shape::words_for(size))) {}
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(words.size()); }
  void put(std::uint32_t member, bool in) {
    if (in) set(words.data(), member);
    else clear(words.data(), member);
    note(summary.data(), member / kWordBits, count(), words[member / kWordBits] != 0);
  }
  std::vector<Word> words, summary;
};

TEST(Bits, NextFindsEveryMemberInOrder) {
  std::mt19937 random(7);
  for (const std::uint32_t size : {1u, 33u, 5'000u, 40'000u}) {
    Set tested(size);
    std::set<std::uint32_t> members;
    for (int round = 0; round < 50; ++round) {
      for (int i = 0; i < 20; ++i) {   // some come, some go
        const auto m = static_cast<std::uint32_t>(random() % size);
        tested.put(m, random() % 3 != 0);
        if (test(tested.words.data(), m)) members.insert(m);
        else members.erase(m);
      }
      const auto from = static_cast<std::uint32_t>(random() % size);
      const auto end = from + static_cast<std::uint32_t>(random() % (size - from));
      std::set<std::uint32_t> plain, summed;
      const Word *words = tested.words.data(), *summary = tested.summary.data();
      for (std::uint32_t i = next(words, from, end); i < end; i = next(words, i + 1, end)) plain.insert(i);
      EXPECT_EQ(plain, std::set<std::uint32_t>(members.lower_bound(from), members.lower_bound(end)));
      for (std::uint32_t i = next(words, summary, from, size); i < size; i = next(words, summary, i + 1, size)) summed.insert(i);
      EXPECT_EQ(summed, std::set<std::uint32_t>(members.lower_bound(from), members.end()));
      std::set<std::uint32_t> full, expected;
      for (std::uint32_t w = next_full(summary, from / kWordBits, end / kWordBits, tested.count()); w < end / kWordBits;
           w = next_full(summary, w + 1, end / kWordBits, tested.count())) {
        full.insert(w);
      }
      for (const std::uint32_t m : members) {
        if (m / kWordBits >= from / kWordBits && m / kWordBits < end / kWordBits) expected.insert(m / kWordBits);
      }
      EXPECT_EQ(full, expected);
    }
  }
}

TEST(Bits, AnEmptiedSetHasAnEmptySummary) {
  Set tested(2'000'000);
  EXPECT_EQ(tested.summary.size(), 1'954u + 62u + 2u + 1u);
  for (const std::uint32_t m : {0u, 31u, 1'999'999u}) tested.put(m, true);
  EXPECT_EQ(next(tested.words.data(), tested.summary.data(), 32, 2'000'000), 1'999'999u);
  for (const std::uint32_t m : {0u, 31u, 1'999'999u}) tested.put(m, false);
  EXPECT_EQ(tested.summary, std::vector<Word>(tested.summary.size()));
}

TEST(Bits, AnEmptyRangeHasNoMember) {
  Word words[1] = {~Word{0}};
  EXPECT_EQ(next(words, 5, 5), 5u);
  EXPECT_EQ(next(words, words, 0, 0), 0u);
  EXPECT_EQ(next_full(words, 5, 5, 32), 5u);
}

}  // namespace
}  // namespace mts::bits
