#include <algorithm>
#include <limits>

#include "planners/group.h"
#include "planners/space_time.h"

namespace kb::planners {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();
constexpr std::uint8_t kNone = 255, kWait = 8;

// The layers of all steps up to a horizon. A layer is computed only for cells where the robot can be at step t and from which it can reach
// the goal in time.
class TimedField {
 public:
  TimedField(const Grid& grid, const Movers& movers, const TimedQuestion& question, std::uint32_t horizon)
      : grid_(grid), movers_(movers), question_(question), horizon_(horizon),
        choices_(static_cast<std::size_t>(horizon) * grid.size(), kNone) {}

  std::vector<Cell> walk(const std::vector<std::uint32_t>& from_start, const std::vector<std::uint32_t>& to_goal) {
    std::vector<CellIndex> near;
    for (CellIndex i = 0; i < grid_.size(); ++i) {
      if (from_start[i] != kNoWay && to_goal[i] != kNoWay && from_start[i] + to_goal[i] <= horizon_) near.push_back(i);
    }
    const CellIndex goal = grid_.index(question_.to);
    std::vector<float> now(grid_.size(), kNever), later(grid_.size(), kNever);
    if (!taken(goal, horizon_)) later[goal] = 0.0F;
    for (std::uint32_t t = horizon_; t-- > 0;) {
      for (const CellIndex at : near) {
        now[at] = from_start[at] > t || to_goal[at] > horizon_ - t ? kNever : best(at, t, later, goal);
      }
      now.swap(later);
    }
    if (later[grid_.index(question_.from)] == kNever) return {};
    return follow(goal);
  }

 private:
  [[nodiscard]] bool taken(CellIndex at, std::uint32_t t) const { return movers_.taken(grid_.cell(at), t); }

  float best(CellIndex at, std::uint32_t t, const std::vector<float>& later, CellIndex goal) {
    if (taken(at, t)) return kNever;
    if (at == goal && t >= question_.earliest_arrival) return 0.0F;
    float least = later[at] + 1.0F;
    std::uint8_t choice = least == kNever ? kNone : kWait;
    const Cell here = grid_.cell(at);
    for (int k = 0; k < 8; ++k) {
      if (!grid_.can_move(here, k)) continue;
      const auto kk = static_cast<std::size_t>(k);
      const auto to = grid_.neighbour(at, kk);
      const float length = later[to] + static_cast<float>(kMoveLengths[kk]);
      if (length >= least || movers_.swaps(here, here + kDirections[kk], t)) continue;
      least = length;
      choice = static_cast<std::uint8_t>(k);
    }
    choices_[static_cast<std::size_t>(t) * grid_.size() + at] = choice;
    return least;
  }

  [[nodiscard]] std::vector<Cell> follow(CellIndex goal) const {
    std::vector<Cell> cells = {question_.from};
    for (std::uint32_t t = 0; t < horizon_; ++t) {
      const CellIndex at = grid_.index(cells.back());
      if (at == goal && t >= question_.earliest_arrival) break;
      const std::uint8_t choice = choices_[static_cast<std::size_t>(t) * grid_.size() + at];
      cells.push_back(choice == kWait ? cells.back() : cells.back() + kDirections[choice]);
    }
    return cells;
  }

  const Grid& grid_;
  const Movers& movers_;
  const TimedQuestion& question_;
  std::uint32_t horizon_;
  std::vector<std::uint8_t> choices_;
};

}  // namespace

std::vector<Cell> plan_timed_field(const Grid& grid, const Movers& movers, const TimedQuestion& question,
                                   const std::vector<std::uint32_t>& to_goal) {
  const auto from_start = steps_to(grid, question.from);
  const std::uint32_t least = to_goal[grid.index(question.from)];
  if (least == kNoWay || std::max(least, question.earliest_arrival) > question.horizon) return {};
  // For most robots a short horizon is enough. A longer one might hold a shorter walk that takes more steps, but it costs more time.
  for (std::uint32_t slack = 8;; slack *= 4) {
    const std::uint32_t horizon = std::min(question.horizon, std::max(least, question.earliest_arrival) + slack);
    auto cells = TimedField(grid, movers, question, horizon).walk(from_start, to_goal);
    if (!cells.empty() || horizon == question.horizon) return cells;
  }
}

}  // namespace kb::planners
