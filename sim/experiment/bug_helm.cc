#include "sim/experiment/bug_helm.h"

#include <algorithm>
#include <cmath>

#include "sim/world/geometry.h"

namespace kb::sim::experiment {
namespace {

constexpr double kArrived = 0.30;         // m
constexpr double kOnLine = 0.10;          // m, from the line from start to goal
constexpr double kNearer = 0.20;          // m nearer to the goal than where the wall was met
constexpr double kSamePlace = 0.30;       // m
constexpr float kRound = 2.0f;            // m: only after this way can it be back where it met the wall
constexpr float kMeets = 0.30f;           // m ahead
constexpr float kMeetsAside = 0.20f;      // m ahead to the left and right
constexpr float kClear = 0.42f;           // m ahead
constexpr float kWall = 0.20f;            // m, kept from the wall: with more the robot passes openings by, with less it scrapes
constexpr float kSpeed = 0.3f;            // m/s
constexpr float kTurn = 1.5f;             // rad/s

}  // namespace

BugHelm::BugHelm(const mts::Body& body, const Pose& start, std::string goal, Spot at) : start_(start), goal_(std::move(goal)), goal_at_(at) {
  wall_.choose(mts::ControllerId::kKeepWall, body);
  static_cast<void>(wall_.set("side", mts::number_of_word(*mts::find_parameter(mts::ControllerId::kKeepWall, "side"), "left")));
  static_cast<void>(wall_.set("distance", kWall));
  static_cast<void>(wall_.set("speed", kSpeed));
}

double BugHelm::bearing_rad() const { return wrap(heading(goal_at_ - place()) - static_cast<double>(reckoning_.at.heading_rad)); }

float BugHelm::free_towards_goal(const mts::Senses& senses) const {
  const auto count = static_cast<long>(mts::kRangeFinders);
  const long index = std::lround(bearing_rad() / (kPi / 4.0));
  return senses.range_m[static_cast<std::size_t>((index + count) % count)];
}

void BugHelm::meet_wall() {
  if (!following_) {
    following_ = true;
    hit_ = place();
    best_m_ = distance(hit_, goal_at_);
    hit_travelled_m_ = reckoning_.travelled_m();
  }
  phase_ = Phase::kAlign;
  turned_rad_ = 0.0f;
}

mts::Motion BugHelm::to_goal(const mts::Senses& senses) {
  const float aside = std::min(senses.range_m[1], senses.range_m[7]);
  const auto off = static_cast<float>(bearing_rad());
  if (std::abs(off) < 0.6f && (senses.range_m[0] < kMeets || aside < kMeetsAside)) {
    meet_wall();
    return {};
  }
  const float turn = std::clamp(2.5f * off, -kTurn, kTurn);
  return std::abs(off) > 0.5f ? mts::Motion{0.0f, turn} : mts::Motion{kSpeed * (1.0f - std::abs(off)), turn};
}

/// Turns to the right on the spot until what the robot met lies on its left.
mts::Motion BugHelm::align(const mts::Senses& senses) {
  if (senses.range_m[0] > kClear && senses.range_m[1] > kMeets && (turned_rad_ < -0.2f)) {
    phase_ = Phase::kFollow;
    wall_.start({}, senses);
    return {};
  }
  return {0.0f, turned_rad_ > -2.0f * static_cast<float>(kPi) ? -kTurn : 0.0f};
}

/// Whether the robot is on the line from start to goal, nearer to the goal than where it met the wall, and free to drive towards the goal.
bool BugHelm::may_leave(const mts::Senses& senses) const {
  const Spot begin{start_.x_m, start_.y_m};
  return nearest_on(begin, goal_at_, place()).distance_m < kOnLine && distance(place(), goal_at_) < best_m_ - kNearer &&
         free_towards_goal(senses) > kClear;
}

mts::Motion BugHelm::follow(const mts::Senses& senses, float dt_s) {
  if (may_leave(senses)) {
    following_ = false;
    phase_ = Phase::kToGoal;
    return {};
  }
  if (reckoning_.travelled_m() - hit_travelled_m_ > kRound && distance(place(), hit_) < kSamePlace) {
    gave_up_ = true;
    return {};
  }
  if (senses.range_m[0] < kMeets) {
    phase_ = Phase::kAlign;
    turned_rad_ = 0.0f;
    return {};
  }
  const mts::Motion motion = wall_.step(senses, dt_s);
  if (!wall_.lost()) return motion;
  following_ = false;   // the wall is lost: what the robot followed has gone
  phase_ = Phase::kToGoal;
  return {};
}

mts::Motion BugHelm::step(std::int64_t /*now_us*/, const mts::Senses& raw, const TagHeard& /*tag*/, float dt_s) {
  const mts::Senses senses = steadied_.step(raw, dt_s);
  if (!began_ && senses.odometry_known && senses.heading_known) {
    reckoning_.start(senses, {static_cast<float>(start_.x_m), static_cast<float>(start_.y_m), senses.heading_rad});
    last_heading_rad_ = reckoning_.at.heading_rad;
    began_ = true;
  }
  if (!began_) return {};
  reckoning_.step(senses, dt_s);
  turned_rad_ += static_cast<float>(wrap(static_cast<double>(reckoning_.at.heading_rad - last_heading_rad_)));
  last_heading_rad_ = reckoning_.at.heading_rad;
  if (!on_mission() || gave_up_ || !senses.range_known) return {};
  if (distance(place(), goal_at_) < kArrived) {
    arrived_ = true;
    return {};
  }
  if (senses.touched && phase_ != Phase::kBack) {
    meet_wall();
    phase_ = Phase::kBack;
    back_s_ = 0.6f;
  }
  switch (phase_) {
    case Phase::kToGoal: return to_goal(senses);
    case Phase::kAlign: return align(senses);
    case Phase::kFollow: return follow(senses, dt_s);
    case Phase::kBack: break;
  }
  back_s_ -= dt_s;
  if (back_s_ <= 0.0f) phase_ = Phase::kAlign;
  return {-0.15f, 0.0f};
}

Judge::Belief BugHelm::belief() const {
  Judge::Belief belief;
  belief.driving = on_mission() && !gave_up_;
  belief.reports = gave_up_;
  belief.place = place();
  return belief;
}

}  // namespace kb::sim::experiment
