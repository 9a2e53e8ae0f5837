// Decides which readings of the range finders are obstacles, and which lines are stop lines that count.
#include <algorithm>
#include <cmath>

#include "sim/mind/perception.h"
#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr float kObstacleNear = 0.40f;       // m, on a road
constexpr float kObstacleCrossing = 0.22f;   // m, where walls may stand ahead
constexpr float kObstacleAside = 0.20f;      // m, ahead to the left and right
constexpr float kObstacleBend = 0.15f;       // m, the same near a bend between walls, and on the way out of a crossing
constexpr float kObstacleCorner = 0.17f;     // m, the same before the crossing at the end of its road
constexpr double kTrackHalf = 0.20;          // m: the robot's radius, and room
constexpr double kTrackHalfWalled = 0.16;    // m: the walls are at 0.3
constexpr double kBehind = 0.08;             // m
constexpr float kBackInMiddle = 1.0f;        // m: how far it must follow its road after going round something to be in the middle again
constexpr float kWayOut = 0.2f;              // m before the line out: an obstacle ahead of a robot this near stands on that line or behind it
constexpr float kAlongRoad = 0.5f;           // rad
constexpr float kPassed = 0.05f;             // m: a robot whose centre is this far behind the line out has passed it
constexpr float kPassedRound = 0.3f;         // m, the same on the way round something: from this far on it does not turn back to where it began
constexpr float kLineBehind = 0.3f;          // m: a line nearer than this to the beginning of the road belongs to the crossing that the robot left
constexpr float kHolds = 0.24f;              // m, ahead or at 45 degrees: a controller stands rather than graze something that is nearer
constexpr float kHeldUp = 1.0f;              // s
constexpr float kStillTurns = 0.05f, kStillDrives = 0.02f;   // rad/s, m/s
constexpr float kLineIn = 0.15f;             // m into a crossing: a line met no farther in is that of the way in
constexpr double kStarReaches = 0.1;         // m behind the middle of a crossing: up to there the lines of several roads lie beside each other;
constexpr double kApart = 0.35;              // m before a stop line that lies farther out they no longer do

}  // namespace

void Perception::hear_range() {
  if (!senses_.range_known) {
    ahead_m_ = mts::kOutOfRange;
    return;
  }
  ahead_m_ += 0.5f * (senses_.range_m[0] - ahead_m_);   // smoothed: a single near reading is no obstacle
}

// note [held up]
// A controller stands before a thing that it would graze, even if that is too far aside, or a little too far away, to count as an obstacle
// ahead: in a crossing, for instance, where walls may stand beside the exits. So a robot that should drive but stands before something
// near has an obstacle before it, until it moves.
void Perception::hear_held_up(float way_m, float turned_rad, float dt_s) {
  const bool runs = doing_ != nullptr && doing_->drives() && !in_hall();
  const bool still = way_m < kStillDrives * dt_s && std::abs(turned_rad) < kStillTurns * dt_s + 0.002f;
  const float nearest_m = std::min({senses_.range_m[0], senses_.range_m[1], senses_.range_m[7]});
  if (!still || !senses_.range_known || nearest_m > kHolds) held_s_ = 0.0f;
  else if (runs) held_s_ += dt_s;
}

bool Perception::held_up() const { return held_s_ > kHeldUp; }

/// How near something ahead must be to be an obstacle. Where walls regularly stand ahead, in crossings and near bends, it must be nearer.
float Perception::obstacle_at() const {
  if (phase_ == Phase::kInside) return kObstacleCrossing;
  return road_.method() == "dist" && road_.progress(reckoning_.at).to_bend_m < kBendNear ? kObstacleCrossing : kObstacleNear;
}

// note [an obstacle behind the line out]
// The robot meets an obstacle that stands just behind the line out of a crossing before it meets that line. The obstacle stands on the
// road, so the robot goes round it as on the road of its exit; where that road begins, it knows by the way driven in the crossing. As it
// turns, its row of line sensors sweeps over the line out and over other lines of the crossing. So on the way round, the line out counts as
// passed only when the robot itself is well behind it, and no line this near behind it is the next stop line. If the robot finds no way
// round, it is still in the crossing.
bool Perception::at_way_out() const {
  if (memory_ == nullptr || exit_ == kNoExit || out_awaited_) return false;
  const bool inside = phase_ == Phase::kInside || (phase_ == Phase::kLeaving && arm_ == exit_);   // the sign of the exit may have been read already
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

/// Whether the robot has passed the line out: by the way driven it is behind that line; or, if it is not going round something, the line
/// lies below its sensors.
bool Perception::passes_line_out() const {
  const float along_m = road_.progress(reckoning_.at).along_m;
  return rounding_ ? along_m > kPassedRound : along_m > kPassed || line_.now() || line_seen_;
}

/// Whether a line below the sensors is that behind which the robot's road began: also of a mission that began on that road, see note
/// [an order begins at the line].
bool Perception::near_line_behind() const {
  const bool goes_round = rounding_ || beside_m_ > 0.0f || begins_on_road_;
  return goes_round && out_told_ && phase_ != Phase::kInside && road_.known() && !road_.turned_back() && road_.progress(reckoning_.at).along_m < kLineBehind;
}

/// Whether the robot is back on the road after going round something on the way out of a crossing; nothing else ends the way round there.
/// True elsewhere, where the track that it follows along the road ends it.
bool Perception::back_on_road() const {
  const Progress now = road_.progress(reckoning_.at);
  return !out_awaited_ || (now.aside_m < kAside && now.turned_rad < kAlongRoad);
}

/// Whether a line below the sensors cannot be the line out yet. Around the middle of a crossing, the lines of five roads can be as dark as
/// a stop line, so only a line behind it counts. The smaller the angle between two roads, the longer their lines lie together, and the
/// farther out their stop lines are.
bool Perception::before_middle() const {
  if (phase_ != Phase::kInside) return false;
  double reach_m = 0.0;
  if (memory_ != nullptr) {
    const double star_m = exit_ == kNoExit ? 0.0 : memory_->exits[exit_].stop_m - kApart;
    reach_m = memory_->exits[arm_].stop_m + std::max(kStarReaches, star_m);
  }
  return since_m_ < std::max(kLineIn, static_cast<float>(reach_m));   // a robot that waited at the line in drives over that line now
}

/// Whether a stop line lies below the sensors, or just behind them (see note [an order begins at the line]), and is the one that the robot had to come to.
bool Perception::line_counts() const {
  if (out_awaited_) return passes_line_out();
  if (waits_at_line_) return true;
  return (line_.now() || line_seen_) && !before_middle() && !near_line_behind();
}

// note [an obstacle on the track]
// On a road, whatever stands ahead is an obstacle. While the robot goes round it, it faces elsewhere: then whatever stands on the track is an
// obstacle, wherever the robot faces.
void Perception::avoid() {
  avoids_ = rounding_ = phase_ != Phase::kInside;
  if (rounding_) beside_m_ = kBackInMiddle;
  avoid_ = reckoning_.at;
  const auto track = avoids_ ? road_.middle(reckoning_.at) : std::nullopt;
  if (!track) return;
  avoid_.heading_rad = track->heading_rad;   // it may have been going round something before, and face anywhere
  if (road_.progress(reckoning_.at).aside_m < kRoadOff) avoid_ = *track;
}

/// Whether something that a range finder sees stands on the track, not far ahead.
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
  const bool corner = phase_ == Phase::kApproach && due();   // the walls of the crossing ahead
  const bool between = phase_ == Phase::kLeaving || obstacle_at() < kObstacleNear;
  const float least_m = between ? kObstacleBend : corner ? kObstacleCorner : kObstacleAside;
  const bool aside = phase_ != Phase::kInside && std::min(senses_.range_m[1], senses_.range_m[7]) < least_m;
  const float room_m = ahead_m_ - obstacle_at();
  return aside ? kSure : std::clamp(kSure - 2.0f * kSure * room_m / 0.08f, -kSure, kSure);
}

}  // namespace kb::sim
