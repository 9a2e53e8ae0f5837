#include "planners/movers.h"

#include <algorithm>

namespace kb::planners {

Movers::Movers(const Grid& grid, std::uint32_t period) : grid_(&grid), period_(std::max(period, 1u)) {
  planes_.assign((static_cast<std::size_t>(period_) * grid.size() + 63) / 64, 0);
  moves_.resize(period_);
}

void Movers::add(const std::vector<Cell>& route) {
  if (route.empty()) return;
  const auto place = [&](std::uint32_t t) { return route[t % period_ % route.size()]; };
  for (std::uint32_t t = 0; t < period_; ++t) {
    const Cell here = place(t), next = place(t + 1);
    if (!grid_->contains(here)) continue;
    const std::uint64_t i = static_cast<std::uint64_t>(t) * grid_->size() + grid_->index(here);
    planes_[static_cast<std::size_t>(i / 64)] |= std::uint64_t{1} << (i % 64);
    if (!grid_->contains(next) || here == next) continue;
    const Step step{grid_->index(here), grid_->index(next)};
    auto& steps = moves_[t];
    const auto before = [](const Step& a, const Step& b) { return a.from != b.from ? a.from < b.from : a.to < b.to; };
    steps.insert(std::upper_bound(steps.begin(), steps.end(), step, before), step);
  }
}

bool Movers::swaps(Cell from, Cell to, std::uint64_t t) const {
  if (!grid_->contains(from) || !grid_->contains(to) || from == to) return false;
  const auto goes = [&](Cell a, Cell b) {
    const CellIndex start = grid_->index(a), end = grid_->index(b);
    const auto& steps = moves_[static_cast<std::size_t>(t % period_)];
    auto at = std::lower_bound(steps.begin(), steps.end(), start, [](const Step& s, CellIndex i) { return s.from < i; });
    for (; at != steps.end() && at->from == start; ++at) {
      if (at->to == end) return true;
    }
    return false;
  };
  if (goes(to, from)) return true;
  if (from.x == to.x || from.y == to.y) return false;
  const Cell one{from.x, to.y}, other{to.x, from.y};
  return goes(one, other) || goes(other, one);
}

}  // namespace kb::planners
