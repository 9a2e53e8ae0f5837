#include "planners/fuzzy_crowd.h"

#include <algorithm>

#include "planners/fuzzy_rules.h"

namespace kb::planners {
namespace {

constexpr std::size_t kBlock = 256;   // robots whose directions are kept between the two passes

}  // namespace

FuzzyCrowd::FuzzyCrowd(const Grid& grid) : grid_(&grid) {
  for (std::size_t k = 0; k < 8; ++k) moves_[k] = {-(kDirections[k].y * 65536 + kDirections[k].x), grid.steps()[k]};
}

void FuzzyCrowd::add(Cell at, Cell goal) {
  to_goal_.push_back(kThere);
  at_.push_back(0);
  place(size() - 1, at, goal);
}

void FuzzyCrowd::place(std::size_t robot, Cell at, Cell goal) {
  to_goal_[robot] = (goal.y - at.y) * 65536 + (goal.x - at.x) + kThere;
  at_[robot] = grid_->index(at);
}

void FuzzyCrowd::step() {
  const std::array<Move, 9> moves = moves_;   // on the stack, so that the compiler sees that no store below can change it
  const std::uint8_t* const open = grid_->all_moves().data();
  std::array<std::uint32_t, kBlock> codes;
  for (std::size_t first = 0; first < size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, size() - first);
    std::int32_t* const to_goal = to_goal_.data() + first;
    CellIndex* const at = at_.data() + first;
    for (std::size_t i = 0; i < count; ++i) codes[i] = fuzzy_code((to_goal[i] & 0xFFFF) - kThere, to_goal[i] >> 16);
    for (std::size_t i = 0; i < count; ++i) {
      const Move move = moves[kFuzzyMoves[codes[i]][open[at[i]]]];
      to_goal[i] += move.to_goal;
      at[i] += static_cast<CellIndex>(move.index);
    }
  }
}

}  // namespace kb::planners
