#include "compiler/tables/planes.h"

#include <algorithm>
#include <bit>
#include <map>

#include "compiler/tables/lists.h"

namespace kb::tables {
namespace {

using mts::Word;

class PlaneBuilder {
 public:
  explicit PlaneBuilder(const Tables& tables) : t_(tables) {}

  PlaneForm build() && {
    form_.first.push_back(0);
    for (I w = 0; w < t_.shape.words; ++w) {
      I most = 1;
      for (I r = t_.word_rule[w]; r < end_of(w); ++r) most = std::max(most, t_.rules[r + 1].conditions - t_.rules[r].conditions);
      if (form_.first.back() + most > mts::kMostPlanes) return {};
      form_.first.push_back(static_cast<std::uint16_t>(form_.first.back() + most));
    }
    form_.at_start.resize(form_.planes());
    readers_.resize(t_.shape.atoms);
    for (I w = 0; w < t_.shape.words; ++w) lay_out(w);
    form_.begin.push_back(0);
    for (const auto& rows : readers_) {
      for (const auto& [plane, rules] : rows) form_.rows.push_back({plane, rules});
      form_.begin.push_back(static_cast<std::uint16_t>(form_.rows.size()));
    }
    return std::move(form_);
  }

 private:
  [[nodiscard]] I end_of(I word) const { return word + 1 < t_.shape.words ? t_.word_rule[word + 1] : t_.shape.rules; }

  void lay_out(I word) {
    const I base = t_.word_rule[word], rules = end_of(word) - base;
    const Word all = ~Word{0} >> (mts::kWordBits - rules);
    std::vector<Word> free(form_.planes(), all);
    std::map<I, std::vector<I>> asked;   // by atom: literals and rules, as they stand
    for (I r = 0; r < rules; ++r) {
      for (I c = t_.rules[base + r].conditions; c < t_.rules[base + r + 1].conditions; ++c) asked[t_.conditions[c] >> 1].push_back(c);
    }
    std::vector<std::pair<I, const std::vector<I>*>> order;
    for (const auto& [atom, conditions] : asked) order.emplace_back(atom, &conditions);
    std::ranges::stable_sort(order, [](const auto& a, const auto& b) { return a.second->size() > b.second->size(); });
    for (I p = form_.first[word]; p < form_.first[word + 1]; ++p) form_.at_start[p] = all;
    for (const auto& [atom, conditions] : order) place(word, atom, *conditions, free);
  }

  /// Chooses planes for the conditions that ask for one atom. A rule that asks for it and for its opposite needs two.
  void place(I word, I atom, std::vector<I> conditions, std::vector<Word>& free) {
    const bool truth = test_bit(t_.initial_truth, atom);
    while (!conditions.empty()) {
      Word wanted = 0;
      for (const I c : conditions) wanted |= bit_of(word, c);
      const auto fits = [&](Word rules) { return std::popcount(rules & wanted); };
      const auto begin = free.begin() + form_.first[word], end = free.begin() + form_.first[word + 1];
      const auto best = std::ranges::max_element(begin, end, {}, fits);
      const auto plane = static_cast<std::uint16_t>(best - free.begin());
      std::erase_if(conditions, [&](I c) {
        const Word bit = bit_of(word, c);
        if ((*best & bit) == 0) return false;
        *best &= ~bit;
        readers_[atom][plane] |= bit;
        if (truth == ((t_.conditions[c] & 1u) != 0)) form_.at_start[plane] &= ~bit;
        return true;
      });
    }
  }

  /// The bit of the rule of a condition.
  [[nodiscard]] Word bit_of(I word, I condition) const {
    const auto after = std::ranges::upper_bound(t_.rules.begin() + t_.word_rule[word], t_.rules.begin() + end_of(word), condition, {}, &mts::Rule<I>::conditions);
    return Word{1} << (after - t_.rules.begin() - 1 - t_.word_rule[word]);
  }

  const Tables& t_;
  PlaneForm form_;
  std::vector<std::map<std::uint16_t, Word>> readers_;   // by atom: the rules of each plane that read it
};

}  // namespace

PlaneForm build_planes(const Tables& tables) {
  if (tables.shape.rules == 0 || !mts::fits_masks(tables.shape)) return {};
  return PlaneBuilder(tables).build();
}

}  // namespace kb::tables
