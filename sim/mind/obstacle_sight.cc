// What of the range finders' readings is an obstacle.
#include <algorithm>
#include <cmath>

#include "sim/mind/perception.h"
#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr float kObstacleNear = 0.40f;       // m, on a road
constexpr float kObstacleCrossing = 0.22f;   // m, where walls may stand ahead
constexpr float kObstacleAside = 0.20f;      // m, ahead to the left and right
constexpr float kObstacleBend = 0.15f;       // m, the same near a bend between walls, and beside the crossing that it leaves
constexpr float kObstacleCorner = 0.17f;     // m, the same before the crossing that it comes to
constexpr double kTrackHalf = 0.20;          // m: the robot's radius, and room
constexpr double kTrackHalfWalled = 0.16;    // m: the walls are at 0.3
constexpr double kBehind = 0.08;             // m
constexpr float kBackInMiddle = 1.0f;        // m of a road that is followed, after what was driven round
constexpr float kHolds = 0.24f;              // m, ahead or at 45 degrees: nearer than that a controller stands rather than grazes it
constexpr float kHeldUp = 1.0f;              // s
constexpr float kStillTurns = 0.05f, kStillDrives = 0.02f;   // rad/s, m/s

}  // namespace

void Perception::hear_range() {
  if (!senses_.range_known) {
    ahead_m_ = mts::kOutOfRange;
    return;
  }
  ahead_m_ += 0.5f * (senses_.range_m[0] - ahead_m_);   // a reading that is alone is none
}

// note [held up]
// A controller stands before what it would graze, also where that is too far aside, or a little too far away, to be an obstacle ahead:
// in a crossing, say, beside whose exits walls may stand. Who is to drive, and stands there, has an obstacle before it, until it moves.
void Perception::hear_held_up(float way_m, float turned_rad, float dt_s) {
  const bool runs = doing_ != nullptr && (doing_->doing == Doing::kMove || doing_->doing == Doing::kCross) && !in_hall();
  const bool still = way_m < kStillDrives * dt_s && std::abs(turned_rad) < kStillTurns * dt_s + 0.002f;
  const float nearest_m = std::min({senses_.range_m[0], senses_.range_m[1], senses_.range_m[7]});
  if (!still || !senses_.range_known || nearest_m > kHolds) held_s_ = 0.0f;
  else if (runs) held_s_ += dt_s;
}

bool Perception::held_up() const { return held_s_ > kHeldUp; }

/// How near something ahead must be to be an obstacle: where walls stand ahead as a matter of course, nearer.
float Perception::obstacle_at() const {
  if (phase_ == Phase::kInside) return kObstacleCrossing;
  return road_.method() == "dist" && road_.progress(reckoning_.at).to_bend_m < kBendNear ? kObstacleCrossing : kObstacleNear;
}

// note [an obstacle on the track]
// On a road an obstacle is what stands ahead. While it is driven round the robot looks elsewhere: then an obstacle is what stands
// on the track, wherever the robot looks.
void Perception::avoid() {
  avoids_ = rounding_ = phase_ != Phase::kInside;
  if (rounding_) beside_m_ = kBackInMiddle;
  avoid_ = reckoning_.at;
  const auto track = avoids_ ? road_.middle(reckoning_.at) : std::nullopt;
  if (!track) return;
  avoid_.heading_rad = track->heading_rad;   // it may have been going round before, and look anywhere
  if (road_.progress(reckoning_.at).aside_m < kRoadOff) avoid_ = *track;
}

/// Something that a range finder sees stands on the track, not far ahead.
bool Perception::on_track() const {
  const Spot along = direction(static_cast<double>(avoid_.heading_rad)), here{static_cast<double>(reckoning_.at.x_m), static_cast<double>(reckoning_.at.y_m)};
  const double reach_m = static_cast<double>(obstacle_at()) + kBehind, half_m = road_.method() == "dist" ? kTrackHalfWalled : kTrackHalf;
  const double from_m = static_cast<double>(road_.progress(reckoning_.at).along_m);
  for (std::size_t i = 0; i < mts::kRangeFinders; ++i) {
    const double range_m = static_cast<double>(senses_.range_m[i]);
    if (range_m > 2.0 * reach_m + half_m + static_cast<double>(kRoadOff)) continue;
    const Spot there = here + range_m * direction(static_cast<double>(reckoning_.at.heading_rad + mts::range_finder_rad(i)));
    if (road_.known()) {
      if (road_.holds(there, from_m, reach_m, half_m)) return true;
      continue;
    }
    const double ahead_m = dot(along, there - here);
    const double aside_m = cross(along, there - Spot{static_cast<double>(avoid_.x_m), static_cast<double>(avoid_.y_m)});
    if (ahead_m > -kBehind && ahead_m < reach_m && std::abs(aside_m) < half_m) return true;
  }
  return false;
}

float Perception::obstacle_certainty() const {
  if (!senses_.range_known) return 0.0f;
  if (held_up()) return kSure;
  if (rounding_) return on_track() ? kSure : -kSure;   // see note [an obstacle on the track]
  const bool corner = phase_ == Phase::kApproach && due();   // of the crossing before it
  const bool between = phase_ == Phase::kLeaving || obstacle_at() < kObstacleNear;
  const float least_m = between ? kObstacleBend : corner ? kObstacleCorner : kObstacleAside;
  const bool aside = phase_ != Phase::kInside && std::min(senses_.range_m[1], senses_.range_m[7]) < least_m;
  const float room_m = ahead_m_ - obstacle_at();
  return aside ? kSure : std::clamp(kSure - 2.0f * kSure * room_m / 0.08f, -kSure, kSure);
}

}  // namespace kb::sim
