#include "planners/well.h"

#include <algorithm>
#include <bitset>
#include <queue>
#include <utility>
#include <vector>

namespace kb::planners {
namespace {

constexpr int kPerCell = 16, kReach = static_cast<int>(WellProbe::kReach_cells * kPerCell), kSide = 2 * kReach + 1;
constexpr double kBalanced = 0.5;   // forces balance if their sum is less than this share of the attraction

}  // namespace

WellProbe::WellProbe(const PotentialField& field, double cell_m, double tolerance_m)
    : field_(&field), cell_m_(cell_m), tolerance_m_(tolerance_m), pause_s_(kFirstPause_s * cell_m) {}

bool WellProbe::add(Point at, double speed, double mass, double time_s) {
  if (time_s < next_s_) return false;
  if (norm(field_->force(at)) > kBalanced * norm(field_->attracting_force(at))) {
    pause_s_ = kFirstPause_s * cell_m_;
    return false;
  }
  next_s_ = time_s + pause_s_;
  pause_s_ = std::min(1.5 * pause_s_, kLongestPause_s * cell_m_);
  return is_closed(at, field_->potential(at) + 0.5 * mass * speed * speed);
}

bool WellProbe::is_closed(Point at, double energy) const {
  const double h = cell_m_ / kPerCell;
  const double lost = 0.25 * h * h * field_->repelling_stiffness(field_->nearest(at).distance_m);
  const double rim = energy + std::max(lost, 0.01 * cell_m_ * norm(field_->attracting_force(at)));
  const auto place = [&](int x, int y) { return at + Point{(x - kReach) * h, (y - kReach) * h}; };
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::bitset<kSide * kSide> seen;
  open.emplace(field_->potential(at), kReach * kSide + kReach);
  seen.set(kReach * kSide + kReach);
  while (!open.empty()) {
    const int x = open.top().second % kSide, y = open.top().second / kSide;
    open.pop();
    if (x == 0 || y == 0 || x == kSide - 1 || y == kSide - 1) return false;
    if (distance(place(x, y), field_->goal()) < tolerance_m_ + h) return false;
    for (const Cell step : kDirections) {
      const int to = (y + step.y) * kSide + x + step.x;
      if (seen.test(static_cast<std::size_t>(to))) continue;
      seen.set(static_cast<std::size_t>(to));
      const Point next = place(x + step.x, y + step.y);
      if (field_->nearest(next).distance_m <= 0.0) continue;
      const double u = field_->potential(next);
      if (u <= rim) open.emplace(u, to);
    }
  }
  return true;
}

}  // namespace kb::planners
