// Decides which readings of the range finders are obstacles, and which lines are stop lines that count.
#include <algorithm>
#include <cmath>

#include <waymark/controllers/road_sight.h>
#include "sim/mind/perception.h"
#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr auto kBehind = static_cast<double>(mts::ObstacleSight::kBehind_m);
constexpr float kBackInMiddle = 1.0f;        // m: how far it must follow its road after going round something to be in the middle again
constexpr float kWayOut = 0.2f;              // m before the line out: an obstacle ahead of a robot this near stands on that line or behind it
constexpr float kAlongRoad = 0.5f;           // rad
constexpr float kPassed = 0.05f;             // m: a robot whose centre is this far behind the line out has passed it
constexpr float kPassedRound = 0.3f;         // m, the same on the way round something: from this far on it does not turn back to where it began
constexpr float kLineBehind = 0.3f;          // m: a line nearer than this to the beginning of the road belongs to the crossing that the robot left
constexpr float kLineIn = 0.15f;             // m into a crossing: a line met no farther in is that of the way in
constexpr double kStarReaches = 0.1;         // m behind the middle of a crossing: up to there the lines of several roads lie beside each other;
constexpr double kApart = 0.35;              // m before a stop line that lies farther out they no longer do

}  // namespace

mts::Surroundings Perception::surroundings() const {
  mts::Surroundings where;
  where.crosses = phase_ == Phase::kInside;
  where.walls_bend = road_.method() == "dist" && road_.progress(reckoning_.at).to_bend_m < mts::kBendNear_m;
  where.leaves = phase_ == Phase::kLeaving;
  where.ends = phase_ == Phase::kApproach && due();   // the walls of the crossing ahead
  return where;
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

/// See note [an obstacle on the track].
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
  using Sight = mts::ObstacleSight;
  const double reach_m = static_cast<double>(Sight::reach_m(surroundings())) + kBehind, half_m = static_cast<double>(road_.method() == "dist" ? Sight::kTrackHalfWalled_m : Sight::kTrackHalf_m);
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
  if (obstacle_sight_.held_up()) return kSure;
  if (rounding_) return on_track() || !back_on_road() ? kSure : -kSure;   // see note [an obstacle on the track]
  return obstacle_sight_.ahead(surroundings());
}

}  // namespace kb::sim
