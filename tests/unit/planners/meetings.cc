#include "tests/unit/planners/meetings.h"

#include <algorithm>

namespace kb::planners::testing {

std::uint64_t Meetings::between(const std::vector<Cell>& before, const std::vector<Cell>& now) {
  std::uint64_t meetings = 0;
  const auto holder = [this](Cell cell) -> std::uint32_t& { return holders_[grid_->index(cell)]; };
  for (std::size_t i = 0; i < before.size(); ++i) holder(before[i]) = static_cast<std::uint32_t>(i + 1);
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Cell from = before[i], to = now[i];
    if (from == to) continue;
    const auto somebody_goes = [&](Cell a, Cell b) {
      const std::uint32_t other = holder(a);
      return other != 0 && other != i + 1 && now[other - 1] == b;
    };
    const Cell one{from.x, to.y}, two{to.x, from.y};
    const bool diagonal = from.x != to.x && from.y != to.y;
    meetings += somebody_goes(to, from) || (diagonal && (somebody_goes(one, two) || somebody_goes(two, one))) ? 1 : 0;
  }
  for (const Cell cell : before) holder(cell) = 0;
  for (const Cell cell : now) meetings += grid_->blocked(cell) || holder(cell)++ != 0 ? 1 : 0;
  for (const Cell cell : now) holder(cell) = 0;
  return meetings;
}

std::uint64_t count_conflicts(const Grid& grid, const std::vector<std::vector<Cell>>& walks) {
  std::size_t steps = 0;
  for (const auto& walk : walks) steps = std::max(steps, walk.size());
  Meetings meetings(grid);
  std::uint64_t conflicts = 0;
  std::vector<Cell> before, now;
  for (std::size_t t = 0; t < steps; ++t) {
    before.swap(now);
    now.clear();
    for (const auto& walk : walks) {
      if (!walk.empty()) now.push_back(walk[std::min(t, walk.size() - 1)]);
    }
    conflicts += meetings.between(t == 0 ? now : before, now);
  }
  return conflicts;
}

}  // namespace kb::planners::testing
