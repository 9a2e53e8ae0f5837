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
constexpr float kWayOut = 0.2f;              // m before the line out: what stands ahead there stands on that line, or behind it
constexpr float kAlongRoad = 0.5f;           // rad
constexpr float kPassed = 0.05f;             // m behind the line out: the robot's centre
constexpr float kPassedRound = 0.3f;         // m, the same on the way round something: from there it does not come back to where it began
constexpr float kLineBehind = 0.3f;          // m: nearer to the beginning of its road a line is that of the crossing that it left
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
  const bool runs = doing_ != nullptr && doing_->drives() && !in_hall();
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

// note [an obstacle behind the line out]
// What stands just behind the line out of a crossing is met before that line is. It stands on the road: the robot goes round it as on
// a road, that of its exit, of which it knows where it begins by the way that it drove in the crossing. As it turns, the row of line
// sensors sweeps over the line out, and over others of the crossing: on the way round the line is passed when the robot itself is well behind it, and
// none that is so near behind is the next stop line. Who finds no way round is still in the crossing.
bool Perception::at_way_out() const {
  if (memory_ == nullptr || exit_ == kNoExit || out_awaited_) return false;
  const bool inside = phase_ == Phase::kInside || (phase_ == Phase::kLeaving && arm_ == exit_);   // its sign may be read already
  const double off_rad = wrap(static_cast<double>(reckoning_.at.heading_rad) - memory_->exits[exit_].heading_rad);
  return inside && std::abs(off_rad) < static_cast<double>(kAlongRoad) && to_line_out_m_ < kWayOut;
}

void Perception::leave_for_road() {
  const double begins_m = static_cast<double>(body_.line_ahead_m + std::max(to_line_out_m_, 0.0f));
  road_.enter(memory_, exit_, reckoning_.at, -begins_m * direction(memory_->exits[exit_].heading_rad));
  arm_ = exit_;
  phase_ = Phase::kLeaving;
  since_m_ = unread_s_ = 0.0f;
  out_awaited_ = !out_told_;
}

/// The robot itself is behind the line out, by its way; or, as it drives on in the crossing, the line lies below the sensors.
bool Perception::passes_line_out() const {
  const float along_m = road_.progress(reckoning_.at).along_m;
  return rounding_ ? along_m > kPassedRound : along_m > kPassed || line_.now() || line_seen_;
}

bool Perception::near_line_behind() const {
  const bool goes_round = rounding_ || beside_m_ > 0.0f;
  return goes_round && out_told_ && phase_ != Phase::kInside && road_.known() && !road_.turned_back() && road_.progress(reckoning_.at).along_m < kLineBehind;
}

/// On the way out of a crossing nothing but this ends the way round: what is followed along the road says it elsewhere.
bool Perception::back_on_road() const {
  const Progress now = road_.progress(reckoning_.at);
  return !out_awaited_ || (now.aside_m < kAside && now.turned_rad < kAlongRoad);
}

/// A stop line lies below the sensors, and is one that it has come to.
bool Perception::line_counts() const {
  if (out_awaited_) return passes_line_out();
  return (line_.now() || line_seen_) && !before_middle() && !near_line_behind();
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
  if (rounding_) return on_track() || !back_on_road() ? kSure : -kSure;   // see note [an obstacle on the track]
  const bool corner = phase_ == Phase::kApproach && due();   // of the crossing before it
  const bool between = phase_ == Phase::kLeaving || obstacle_at() < kObstacleNear;
  const float least_m = between ? kObstacleBend : corner ? kObstacleCorner : kObstacleAside;
  const bool aside = phase_ != Phase::kInside && std::min(senses_.range_m[1], senses_.range_m[7]) < least_m;
  const float room_m = ahead_m_ - obstacle_at();
  return aside ? kSure : std::clamp(kSure - 2.0f * kSure * room_m / 0.08f, -kSure, kSure);
}

}  // namespace kb::sim
