#include "planners/genetic_walks.h"

#include <algorithm>
#include <cstdlib>

namespace kb::planners {
namespace {

constexpr std::size_t kStraightenReach = 40, kMutateReach = 30;
constexpr std::uint32_t kRerouteCap = 400;
constexpr double kRerouteGreed = 0.5;

void splice(Walk& walk, std::size_t i, std::size_t j, const Walk& stretch) {
  const auto at = walk.begin() + static_cast<std::ptrdiff_t>(i);
  const std::size_t old = j - i + 1;
  const std::size_t same = std::min(old, stretch.size());
  std::copy_n(stretch.begin(), same, at);
  const auto rest = at + static_cast<std::ptrdiff_t>(same);
  if (old > same) {
    walk.erase(rest, at + static_cast<std::ptrdiff_t>(old));
  } else {
    walk.insert(rest, stretch.begin() + static_cast<std::ptrdiff_t>(same), stretch.end());
  }
}

}  // namespace

WalkOperators::WalkOperators(const Grid& grid, bool waits)
    : grid_(&grid), waits_(waits), stride_(grid.steps()[2]), mark_(grid.size(), 0), place_(grid.size(), 0) {}

void WalkOperators::new_stamp() {
  if (++stamp_ != 0) return;
  std::fill(mark_.begin(), mark_.end(), 0u);
  stamp_ = 1;
}

void WalkOperators::mark(const Walk& walk) {
  new_stamp();
  for (std::size_t i = 0; i < walk.size(); ++i) {
    mark_[walk[i]] = stamp_;
    place_[walk[i]] = static_cast<std::uint32_t>(i);
  }
}

int WalkOperators::direction(CellIndex from, CellIndex to) const {
  const std::int32_t step = static_cast<std::int32_t>(to) - static_cast<std::int32_t>(from);
  const std::int32_t dy = step > 1 ? 1 : step < -1 ? -1 : 0, dx = step - dy * stride_;
  constexpr std::array<int, 9> kByStep = {5, 6, 7, 4, 8, 0, 3, 2, 1};
  return kByStep[static_cast<std::size_t>(3 * (dy + 1) + dx + 1)];
}

bool WalkOperators::walk(CellIndex from, CellIndex to, double greed, std::uint32_t cap, Dice& dice, Walk& out) {
  new_stamp();
  out.assign(1, from);
  mark_[from] = stamp_;
  const Cell goal = grid_->cell(to);
  for (std::uint32_t steps = 0; out.back() != to; ++steps) {
    if (steps >= cap) return false;
    const CellIndex at = out.back();
    std::array<CellIndex, 8> open{};
    std::size_t n = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      if ((grid_->all_moves()[at] >> k & 1) == 0) continue;
      const auto next = grid_->neighbour(at, k);
      if (!marked(next)) open[n++] = next;
    }
    if (n == 0) {
      out.pop_back();
      if (out.empty()) return false;
      continue;
    }
    CellIndex chosen = open[n == 1 ? 0 : dice.below(n)];
    if (n > 1 && dice.chance(greed)) {
      double best = 1e300;
      for (std::size_t i = 0; i < n; ++i) {
        const Cell cell = grid_->cell(open[i]);
        const double dx = cell.x - goal.x, dy = cell.y - goal.y, d = dx * dx + dy * dy;
        if (d < best) {
          best = d;
          chosen = open[i];
        }
      }
    }
    mark_[chosen] = stamp_;
    out.push_back(chosen);
  }
  return true;
}

bool WalkOperators::erase_loops(Walk& walk) {
  mark(walk);
  scratch_.clear();
  const std::size_t last = walk.size() - 1;
  std::size_t i = place_[walk[0]];
  scratch_.push_back(walk[i]);
  while (i < last) {
    std::size_t next = i + 1;
    const CellIndex at = walk[i];
    for (std::size_t k = 0; k < 8; ++k) {
      if ((grid_->all_moves()[at] >> k & 1) == 0) continue;
      const auto to = grid_->neighbour(at, k);
      if (marked(to) && place_[to] > next) next = place_[to];
    }
    i = next == i + 1 ? place_[walk[next]] : next;
    scratch_.push_back(walk[i]);
  }
  if (scratch_.size() == walk.size()) return false;
  walk.swap(scratch_);
  return true;
}

// A line whose moves are, by `order`, diagonals first, straight moves first, or both spread evenly: all are equally short.
bool WalkOperators::line(CellIndex from, CellIndex to, std::uint32_t order, Walk& out) const {
  const Cell a = grid_->cell(from), b = grid_->cell(to);
  const std::int32_t dx = std::abs(b.x - a.x), dy = std::abs(b.y - a.y), both = std::min(dx, dy), all = std::max(dx, dy);
  const std::int32_t sx = b.x > a.x ? 1 : b.x < a.x ? -1 : 0, sy = b.y > a.y ? 1 : b.y < a.y ? -1 : 0;
  const std::int32_t straight = dx > dy ? sx : sy * stride_, diagonal = sx + sy * stride_;
  const int straight_k = direction(from, static_cast<CellIndex>(static_cast<std::int32_t>(from) + straight));
  const int diagonal_k = direction(from, static_cast<CellIndex>(static_cast<std::int32_t>(from) + diagonal));
  out.assign(1, from);
  auto at = static_cast<std::int32_t>(from);
  for (std::int32_t i = 0; i < all; ++i) {
    bool is_diagonal = false;
    switch (order) {
      case 0: is_diagonal = i < both; break;
      case 1: is_diagonal = i >= all - both; break;
      default: is_diagonal = (i + 1) * both / all != i * both / all; break;
    }
    if ((grid_->all_moves()[static_cast<std::size_t>(at)] >> (is_diagonal ? diagonal_k : straight_k) & 1) == 0) return false;
    at += is_diagonal ? diagonal : straight;
    out.push_back(static_cast<CellIndex>(at));
  }
  return true;
}

void WalkOperators::straighten(Walk& walk, Dice& dice) {
  if (walk.size() < 3) return;
  const std::size_t i = dice.below(walk.size() - 2);
  const std::size_t reach = std::min(walk.size() - 1 - i, kStraightenReach);
  const std::size_t j = i + 2 + dice.below(reach - 1);
  double length = 0.0;
  for (std::size_t k = i; k < j; ++k) {
    const int direction_of = direction(walk[k], walk[k + 1]);
    length += direction_of == 8 ? 0.0 : kMoveLengths[static_cast<std::size_t>(direction_of)];
  }
  const double least = octile_distance(grid_->cell(walk[i]), grid_->cell(walk[j]));
  const bool shorter = least < length - 1e-9;
  if (!shorter && (waits_ || dice.below(4) != 0)) return;  // sometimes another way of the same length is tried
  if (!line(walk[i], walk[j], dice.below(3), scratch_)) return;
  splice(walk, i, j, scratch_);
}

std::size_t WalkOperators::shortest_cut(const Walk& head, const Walk& tail) {
  const auto lengths = [this](const Walk& walk, std::vector<double>& out) {
    out.assign(walk.size(), 0.0);
    for (std::size_t i = 1; i < walk.size(); ++i) {
      const int k = direction(walk[i - 1], walk[i]);
      out[i] = out[i - 1] + (waits_ ? 1.0 : kMoveLengths[static_cast<std::size_t>(k & 7)]);
    }
  };
  lengths(head, head_length_);
  lengths(tail, tail_length_);
  std::size_t best = common_.front();
  double least = 1e300;
  for (const std::size_t i : common_) {
    const double length = head_length_[place_[tail[i]]] + tail_length_.back() - tail_length_[i];
    if (length < least) {
      least = length;
      best = i;
    }
  }
  return best;
}

void WalkOperators::cross(const Walk& head, const Walk& tail, Dice& dice, Walk& child) {
  mark(head);
  common_.clear();
  for (std::size_t i = 1; i + 1 < tail.size(); ++i) {
    if (marked(tail[i])) common_.push_back(i);
  }
  if (common_.empty()) {
    if (!join_nearby(head, tail, dice, child)) child = head;
    return;
  }
  const bool any = dice.below(2) == 0;
  const std::size_t cut = any ? common_[dice.below(common_.size())] : shortest_cut(head, tail);
  child.assign(head.begin(), head.begin() + place_[tail[cut]] + 1);
  child.insert(child.end(), tail.begin() + static_cast<std::ptrdiff_t>(cut) + 1, tail.end());
}

bool WalkOperators::join_nearby(const Walk& head, const Walk& tail, Dice& dice, Walk& child) {
  const std::size_t first = dice.below(tail.size());
  for (std::size_t n = 0; n < tail.size(); ++n) {
    const std::size_t i = (first + n) % tail.size();
    const Cell at = grid_->cell(tail[i]);
    for (std::int32_t y = at.y - 3; y <= at.y + 3; ++y) {
      for (std::int32_t x = at.x - 3; x <= at.x + 3; ++x) {
        if (!grid_->contains(Cell{x, y}) || !marked(grid_->index({x, y}))) continue;
        const CellIndex from = grid_->index({x, y});
        if (!line(from, tail[i], 2, scratch_)) continue;
        child.assign(head.begin(), head.begin() + place_[from]);
        child.insert(child.end(), scratch_.begin(), scratch_.end());
        child.insert(child.end(), tail.begin() + static_cast<std::ptrdiff_t>(i) + 1, tail.end());
        return true;
      }
    }
  }
  return false;
}

bool WalkOperators::reroute(Walk& walk, std::size_t i, std::size_t j, Dice& dice) {
  if (!this->walk(walk[i], walk[j], kRerouteGreed, kRerouteCap, dice, other_)) return false;
  splice(walk, i, j, other_);
  return true;
}

void WalkOperators::step_aside(Walk& walk, std::size_t i, std::size_t steps, Dice& dice) {
  const CellIndex at = walk[i];
  const std::uint8_t moves = grid_->all_moves()[at];
  if (moves == 0) return;
  std::size_t k = dice.below(8);
  while ((moves >> k & 1) == 0) k = (k + 1) % 8;
  other_.assign(1, at);
  other_.insert(other_.end(), steps, grid_->neighbour(at, k));
  other_.push_back(at);
  splice(walk, i, i, other_);
}

void WalkOperators::mutate(Walk& walk, Dice& dice) {
  if (walk.size() < 3) return;
  if (waits_ && dice.below(2) == 0) {
    const std::size_t i = dice.below(walk.size() - 1);
    const auto at = walk.begin() + static_cast<std::ptrdiff_t>(i);
    if (walk[i] == walk[i + 1]) {
      walk.erase(at);
    } else {
      walk.insert(at, walk[i]);
    }
    return;
  }
  const std::size_t i = dice.below(walk.size() - 2);
  const std::size_t j = i + 2 + dice.below(std::min(walk.size() - 1 - i, kMutateReach) - 1);
  static_cast<void>(reroute(walk, i, j, dice));   // if no walk is found, it stays as it is
}

}  // namespace kb::planners
