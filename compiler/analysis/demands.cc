// What a condition demands, as far as the Satisfier knows it without trying alternatives.
#include <algorithm>

#include "compiler/analysis/satisfier.h"

namespace kb::analysis {

Demands Satisfier::demands(program::CondId condition, std::uint32_t level, std::size_t most_parts) {
  begin(level);
  Demands demands;
  std::size_t branch = 0;
  most_parts_ = most_parts;
  demands.possible = assume({condition, true}) && settle(branch);
  most_parts_ = kAllParts;
  for (const Change change : trail_) {
    if (change.place < values_.size()) {
      demands.each.push_back({change.place, values_[change.place]});
    } else if (change.place < values_.size() + holder_.size()) {
      const auto choice = static_cast<std::uint32_t>(change.place - values_.size());
      demands.holders.push_back({choice, holder_[choice]});
    }
  }
  const auto by_variable = [](const Restriction& a, const Restriction& b) { return a.variable < b.variable; };
  std::sort(demands.each.begin(), demands.each.end(), by_variable);
  demands.each.erase(std::unique(demands.each.begin(), demands.each.end()), demands.each.end());
  std::sort(demands.holders.begin(), demands.holders.end(),
            [](const Holder& a, const Holder& b) { return a.choice < b.choice; });
  return demands;
}

namespace {

/// Whether two lists allow each variable some common value. A long list beside a short one is searched, not read: `no G` restricts all members.
bool allow_common(const std::vector<Restriction>& few, const std::vector<Restriction>& many) {
  if (few.size() > many.size()) return allow_common(many, few);
  const auto by_variable = [](const Restriction& one, const Restriction& other) { return one.variable < other.variable; };
  auto from = many.begin();
  for (const Restriction& x : few) {
    from = std::lower_bound(from, many.end(), x, by_variable);
    if (from != many.end() && from->variable == x.variable && (from->allowed & x.allowed) == 0) return false;
  }
  return true;
}

}  // namespace

bool compatible(const Demands& a, const Demands& b) {
  for (std::size_t i = 0, j = 0; i < a.holders.size() && j < b.holders.size();) {
    const Holder& x = a.holders[i];
    const Holder& y = b.holders[j];
    if (x.choice == y.choice && x.variable != y.variable) return false;
    i += x.choice <= y.choice ? 1 : 0;
    j += y.choice <= x.choice ? 1 : 0;
  }
  return a.possible && b.possible && allow_common(a.each, b.each);
}

}  // namespace kb::analysis
