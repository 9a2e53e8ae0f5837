#include "planners/trap.h"

#include <array>

namespace kb::planners {

bool TrapDetector::add(Point at, double speed, double pull, double time_s) {
  return at_rest(at, speed, pull, time_s) || in_a_box(at, time_s);
}

bool TrapDetector::at_rest(Point at, double speed, double pull, double time_s) {
  if (!(speed < kSlow * pull)) {
    slow_since_s_ = -1.0;
    return false;
  }
  // A robot that creeps over a saddle is slow too, but gains speed again; one that comes to rest keeps losing speed.
  if (slow_since_s_ < 0.0 || speed > last_speed_ * (1.0 + 1e-9)) {
    slow_since_s_ = time_s;
    speed_then_ = speed;
  }
  last_speed_ = speed;
  const bool sinks = speed <= 0.1 * speed_then_ || speed < 1e-3 * kSlow * pull;
  if (time_s - slow_since_s_ < kHold_s * cell_m_ || !sinks) return false;
  trap_ = {Trap::Kind::kRest, at, time_s};
  return true;
}

// Takes a place into the window, and those out of it that lie more than its length behind. True if the window is full.
bool TrapDetector::remember(Point at) {
  const std::size_t number = first_ + window_.size();
  Sample sample{at, at, 0.0, false};
  if (!window_.empty()) {
    const Point step = at - window_.back().at;
    sample.way_m = window_.back().way_m + norm(step);
    sample.sum = window_.back().sum + at;
    if (window_.size() > 1) sample.turns_back = dot(step, window_.back().at - window_[window_.size() - 2].at) < 0.0;
  }
  window_.push_back(sample);
  turns_ += sample.turns_back ? 1 : 0;
  const std::array<double, 4> keys = {at.x, -at.x, at.y, -at.y};
  for (std::size_t i = 0; i < 4; ++i) {
    while (!extremes_[i].empty() && extremes_[i].back().second <= keys[i]) extremes_[i].pop_back();
    extremes_[i].emplace_back(number, keys[i]);
  }
  bool full = false;
  while (window_.back().way_m - window_.front().way_m > kWindow_cells * cell_m_) {
    full = true;
    turns_ -= window_.front().turns_back ? 1 : 0;
    window_.pop_front();
    ++first_;
  }
  for (auto& extreme : extremes_) {
    while (extreme.front().first < first_) extreme.pop_front();
  }
  return full;
}

// A robot that is pressed against a wall may zigzag along it in small steps and still get on: then the mean of its places
// moves from the first half of the window to the second.
bool TrapDetector::gets_on() const {
  const std::size_t half = window_.size() / 2;
  const Point zero = window_.front().sum, middle = window_[half].sum, all = window_.back().sum;
  const Point early = (1.0 / static_cast<double>(half)) * (middle - zero);
  const Point late = (1.0 / static_cast<double>(window_.size() - 1 - half)) * (all - middle);
  return distance(early, late) > kDrift_cells * cell_m_;
}

Point TrapDetector::middle() const {
  return (1.0 / static_cast<double>(window_.size() - 1)) * (window_.back().sum - window_.front().sum);
}

bool TrapDetector::in_a_box(Point at, double time_s) {
  if (!remember(at)) return false;
  const double w = extremes_[0].front().second + extremes_[1].front().second;
  const double h = extremes_[2].front().second + extremes_[3].front().second;
  if (std::hypot(w, h) >= kBox_cells * cell_m_ || gets_on()) return false;
  const bool chatters = 3 * turns_ > window_.size();
  trap_ = {chatters ? Trap::Kind::kChatter : Trap::Kind::kCycle, at, time_s};
  return true;
}

}  // namespace kb::planners
