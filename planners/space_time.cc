#include "planners/space_time.h"

#include <algorithm>

namespace kb::planners {
namespace {

constexpr std::uint32_t kNobody = 0xFFFFFFFFu;

struct State {
  CellIndex at;
  std::uint32_t step, before;  // `before`: number of the state it was reached from
};

class SpaceTimeSearch {
 public:
  SpaceTimeSearch(const Grid& grid, const Movers& movers, const TimedQuestion& question,
                  const std::vector<std::uint32_t>& distances)
      : grid_(grid), movers_(movers), question_(question), distances_(distances) {}

  // A*. The estimate is consistent and all steps cost 1, so one bucket for each sum of steps and estimate suffices.
  std::vector<Cell> go() {
    reach(grid_.index(question_.from), 0, kNobody);
    const CellIndex goal = grid_.index(question_.to);
    for (std::size_t sum = 0; sum < buckets_.size(); ++sum) {
      while (!buckets_[sum].empty()) {
        const std::uint32_t number = buckets_[sum].back();
        buckets_[sum].pop_back();
        const State state = states_[number];
        if (state.at == goal && state.step >= question_.earliest_arrival) return way_to(number);
        expand(number, state);
      }
    }
    return {};
  }

 private:
  void expand(std::uint32_t number, const State& state) {
    if (state.step >= question_.horizon) return;
    const Cell here = grid_.cell(state.at);
    reach(state.at, state.step + 1, number);
    for (int k = 0; k < 8; ++k) {
      if (!grid_.can_move(here, k)) continue;
      const Cell to = here + kDirections[static_cast<std::size_t>(k)];
      if (!movers_.swaps(here, to, state.step)) reach(grid_.index(to), state.step + 1, number);
    }
  }

  void reach(CellIndex at, std::uint32_t step, std::uint32_t before) {
    // A robot that would be at the goal too early has to spend the remaining time anyway.
    const std::uint32_t sum = std::max(distances_[at] == kNoWay ? kNoWay : step + distances_[at], question_.earliest_arrival);
    if (sum > question_.horizon || movers_.taken(grid_.cell(at), step)) return;
    if (step >= seen_.size()) seen_.resize(step + 1);
    auto& row = seen_[step];
    if (row.empty()) row.assign(grid_.size() / 64 + 1, 0);
    const std::uint64_t bit = std::uint64_t{1} << (at % 64);
    if ((row[at / 64] & bit) != 0) return;
    row[at / 64] |= bit;
    if (sum >= buckets_.size()) buckets_.resize(sum + 1);
    buckets_[sum].push_back(static_cast<std::uint32_t>(states_.size()));
    states_.push_back({at, step, before});
  }

  [[nodiscard]] std::vector<Cell> way_to(std::uint32_t number) const {
    std::vector<Cell> cells;
    for (; number != kNobody; number = states_[number].before) cells.push_back(grid_.cell(states_[number].at));
    std::reverse(cells.begin(), cells.end());
    return cells;
  }

  const Grid& grid_;
  const Movers& movers_;
  const TimedQuestion& question_;
  const std::vector<std::uint32_t>& distances_;
  std::vector<State> states_;
  std::vector<std::vector<std::uint32_t>> buckets_;
  std::vector<std::vector<std::uint64_t>> seen_;
};

}  // namespace

std::vector<std::uint32_t> steps_to(const Grid& grid, Cell goal) {
  std::vector<std::uint32_t> steps(grid.size(), kNoWay);
  std::vector<CellIndex> open = {grid.index(goal)};
  steps[open[0]] = 0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const CellIndex at = open[i];
    for (std::size_t k = 0; k < 8; ++k) {
      if ((grid.all_moves()[at] >> k & 1) == 0) continue;
      const auto to = grid.neighbour(at, k);
      if (steps[to] != kNoWay) continue;
      steps[to] = steps[at] + 1;
      open.push_back(to);
    }
  }
  return steps;
}

std::vector<Cell> search_space_time(const Grid& grid, const Movers& movers, const TimedQuestion& question,
                                    const std::vector<std::uint32_t>& distances) {
  return SpaceTimeSearch(grid, movers, question, distances).go();
}

}  // namespace kb::planners
