#include "planners/boundary.h"

#include <cstdlib>

namespace kb::planners {
namespace {

constexpr std::int32_t sign(std::int64_t value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }
/// The cell next to an even coordinate in a direction (even ones are borders of cells), or the cell in which an odd coordinate lies.
constexpr std::int32_t cell_towards(std::int32_t at, std::int32_t direction) {
  return at % 2 != 0 ? (at - 1) / 2 : at / 2 - (direction < 0 ? 1 : 0);
}
/// From a coordinate to the next even one in a direction.
constexpr std::int64_t to_next_corner(std::int32_t at) { return at % 2 != 0 ? 1 : 2; }

}  // namespace

Point to_point(const Grid& grid, const Place& place) {
  const double half_m = 0.5 * grid.cell_m(), w = static_cast<double>(place.w);
  return {grid.origin_m().x + half_m * (static_cast<double>(place.x) / w),
          grid.origin_m().y + half_m * (static_cast<double>(place.y) / w)};
}

bool is_nearer(const Place& a, const Place& b, Node goal) {
  const auto squared = [goal](const Place& p) {
    const Wide dx = p.x - goal.x * p.w, dy = p.y - goal.y * p.w;
    return dx * dx + dy * dy;
  };
  return squared(a) * b.w * b.w < squared(b) * a.w * a.w;
}

Cell quadrant_of(Node corner, int quadrant) {
  const std::int32_t x = corner.x / 2, y = corner.y / 2;
  switch (quadrant) {
    case 0: return {x, y};
    case 1: return {x - 1, y};
    case 2: return {x - 1, y - 1};
    default: return {x, y - 1};
  }
}

// ---- straight lines

bool is_joint(const Grid& grid, const LineCrossing& crossing) {
  return crossing.through_corner() && grid.blocked({crossing.after.x, crossing.before.y}) &&
         grid.blocked({crossing.before.x, crossing.after.y});
}

bool is_hit(const Grid& grid, const LineCrossing& crossing) {
  return grid.blocked(crossing.after) || is_joint(grid, crossing);
}

LineWalk::LineWalk(Node from, Cell goal) : from_(from), goal_(goal) {
  const Node to = centre_node(goal);
  sx_ = sign(to.x - from.x);
  sy_ = sign(to.y - from.y);
  ax_ = std::abs(to.x - from.x);
  ay_ = std::abs(to.y - from.y);
  ox_ = to_next_corner(from.x);
  oy_ = to_next_corner(from.y);
  cell_ = {cell_towards(from.x, sx_), cell_towards(from.y, sy_)};
}

std::optional<LineCrossing> LineWalk::next() {
  if (cell_ == goal_) return std::nullopt;
  // The next column is reached after ox / ax of the line, the next row after oy / ay.
  const std::int64_t column = sx_ == 0 ? 1 : ox_ * ay_, row = sx_ == 0 ? 0 : sy_ == 0 ? column + 1 : oy_ * ax_;
  const bool by_column = column <= row, by_row = row <= column;
  LineCrossing out;
  out.before = cell_;
  const auto x = static_cast<std::int32_t>(from_.x + sx_ * ox_), y = static_cast<std::int32_t>(from_.y + sy_ * oy_);
  if (by_column) {
    out.at = {x * ax_, from_.y * ax_ + sy_ * ay_ * ox_, ax_};
  } else {
    out.at = {from_.x * ay_ + sx_ * ax_ * oy_, y * ay_, ay_};
  }
  out.where = {by_column ? x : 2 * cell_.x + 1, by_row ? y : 2 * cell_.y + 1};
  if (by_column) {
    cell_.x += sx_;
    ox_ += 2;
  }
  if (by_row) {
    cell_.y += sy_;
    oy_ += 2;
  }
  out.after = cell_;
  return out;
}

// ---- walls

WallEdge edge_after_hit(const Grid& grid, const LineCrossing& hit, Hand hand) {
  const bool left = hand == Hand::kLeft;
  if (!hit.through_corner()) {
    int across = 0;  // the direction in which the line would have gone on
    while (Cell{hit.before.x + kHeadings[static_cast<std::size_t>(across)].x,
                hit.before.y + kHeadings[static_cast<std::size_t>(across)].y} != hit.after) {
      ++across;
    }
    const int heading = (across + (left ? 3 : 1)) % 4;
    const Node step = kHeadings[static_cast<std::size_t>(heading)];
    return {{hit.where.x - step.x, hit.where.y - step.y}, heading};
  }
  // At a corner: the free cells round it that are connected to the one from which the robot comes form a fan. With the
  // obstacle on its left the robot leaves along the fan's counter-clockwise rim.
  int quadrant = 0;
  while (quadrant_of(hit.where, quadrant) != hit.before) ++quadrant;
  const int turn = left ? 1 : 3;
  while (grid.free(quadrant_of(hit.where, (quadrant + turn) % 4))) quadrant = (quadrant + turn) % 4;
  return {hit.where, left ? (quadrant + 1) % 4 : quadrant};
}

Hand hand_towards(const Grid& grid, const LineCrossing& hit, Node to) {
  const auto gain = [&](Hand hand) {   // the dot product of the edge's direction and the line's
    const Node step = kHeadings[static_cast<std::size_t>(edge_after_hit(grid, hit, hand).heading)];
    return step.x * (to.x * hit.at.w - hit.at.x) + step.y * (to.y * hit.at.w - hit.at.y);
  };
  return gain(Hand::kRight) > gain(Hand::kLeft) ? Hand::kRight : Hand::kLeft;
}

WallWalk::WallWalk(const Grid& grid, const Place& hit, const WallEdge& first, Hand hand)
    : grid_(&grid), first_(first), edge_(first), hand_(hand), hit_w_(hit.w) {
  hit_along_ = std::abs(hit.x - first.from.x * hit.w) + std::abs(hit.y - first.from.y * hit.w);
}

bool WallWalk::next() {
  int to = offset_ + 1;
  entered_ = false;
  if (offset_ < 0) {
    to = static_cast<int>(hit_along_ / hit_w_) + 1;
    entered_ = true;
  } else if (offset_ == 2) {
    turn();
    to = 1;
    entered_ = true;
    away_ = true;
  }
  if (away_ && edge_ == first_ && to * hit_w_ >= hit_along_) {
    // The loop is closed only when the robot has walked the part of the first edge before the hit, too.
    offset_ = to - 1;
    return false;
  }
  offset_ = to;
  return true;
}

void WallWalk::turn() {
  const Node corner = edge_.at(2);
  const bool left = hand_ == Hand::kLeft;
  // Of the two cells in front, `far` is the one on the robot's side and `near` the one on the obstacle's side.
  const int on_left = edge_.heading, on_right = (edge_.heading + 3) % 4;
  const Cell far = quadrant_of(corner, left ? on_right : on_left), near = quadrant_of(corner, left ? on_left : on_right);
  const int away = left ? 3 : 1, around = left ? 1 : 3;
  int turned = 0;
  if (grid_->blocked(far)) {
    turned = away;  // even if `near` is free: then two obstacles are joined at the corner
  } else if (grid_->free(near)) {
    turned = around;
  }
  edge_ = {corner, (edge_.heading + turned) % 4};
  offset_ = 0;
}

bool WallWalk::can_enter(Cell cell) const {
  if (grid_->blocked(cell)) return false;
  const Cell own = free_cell();
  if (cell == own || offset_ == 1) return cell == own;
  // At a corner the robot can enter another free cell too, unless that lies across a joint of two obstacles.
  const bool opposite = cell.x != own.x && cell.y != own.y;
  return !opposite || grid_->free({cell.x, own.y}) || grid_->free({own.x, cell.y});
}

std::int64_t wall_length(const Grid& grid, const WallEdge& edge, Hand hand) {
  WallWalk walk(grid, place(edge.from), edge, hand);
  std::int64_t halves = 0;
  while (walk.next()) ++halves;
  return (halves + 1) / 2;  // the walk does not give the last node, the hit itself
}

}  // namespace kb::planners
