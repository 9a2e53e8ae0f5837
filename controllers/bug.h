// Crosses a hall as a bug does: straight to the goal, along the wall round what it meets, then straight to the goal again.
//
//   bug1      goes round all of it, then leaves from the point nearest to the goal                Lumelsky and Stepanov,
//   bug2      leaves where it crosses the straight line to the goal, nearer to it than where it met the wall         1987
//   modified  leaves where the path to the goal is free and does not meet the robot's own trail from the side on which
//             the obstacle lay                                                         Filimonov and Filimonov, 2019
//
// `bug2` and `modified` leave only at a place nearer to the goal than every place where they met a wall before. If they have gone once round
// without leaving, they too go to the nearest point of the loop, as bug1 does. If the path to the goal is blocked there as well, there is
// none: `plight()` says so, and the robot stands. planners/bug.h has the same three on a grid with exact walls; here, walls are what eight
// range finders have seen lately, and places are reckoned. So a robot may lose a wall, or come to circle elsewhere than where it met it: see
// note [loops that miss the place where they began]. It then tries with the other hand, and says that there is no way after the sixth time.
// The wall is kept as one_wall.h says. Without range finders, odometry, any heading or a hall, it stops.
#pragma once

#include "gain.h"
#include "hall.h"
#include "one_wall.h"
#include "trail.h"

namespace mts {

struct BugGains {
  BugKind kind = BugKind::kModified;
  Side side = Side::kBoth;
  float speed_m_s = 0.25f;
  float distance_m = 0.22f;
  float turn_rad_s = 115.0f * kRadPerDeg;
};

inline constexpr Gain<BugGains> kBugGains[] = {
    kind_gain("kind", &BugGains::kind, "when it leaves an obstacle"),
    side_gain("side", &BugGains::side, "at which hand an obstacle is kept; both: whichever has more room"),
    gain("speed", "m/s", &BugGains::speed_m_s, 0.05f, 0.6f, "on straight pieces"),
    distance_gain("distance", &BugGains::distance_m, 0.15f, 0.5f, "from the robot's centre to the obstacle"),
    angle_gain("turn_speed", "deg/s", &BugGains::turn_rad_s, 20.0f, 240.0f, "the fastest turn"),
};

class Bug : public HallController {
 public:
  BugGains gains;
  Body body;

  void start(const Task& task, const Senses& raw) noexcept {
    hall_.start(task, raw, body, Shut::kBoth);
    points_.forget();
    trail_.start();
    phase_ = Phase::kStraight;
    from_ = {};
    nearest_hit_m_ = kInfinity;
    vain_ = 0;
    plight_ = Plight::kNone;
  }

  [[nodiscard]] Motion step(const Senses& raw, float dt_s) noexcept {
    const float dt = sane_period(dt_s);
    const Senses senses = hall_.hear(raw, dt);
    if (hall_.blind() || !senses.range_known || plight_ != Plight::kNone) return {};
    const HallGains how{gains.speed_m_s, gains.turn_rad_s};
    if (hall_.missed_door()) plight_ = Plight::kTrapped;
    if (!hall_.crosses()) {
      from_ = hall_.at();
      return hall_.through_door(senses, how);
    }
    points_.step_all(senses, hall_.at(), kReach_m, dt);
    trail_.add(hall_.at());
    const float bearing = hall_.bearing(hall_.gate());
    if (phase_ == Phase::kStraight) {
      if (lane_is_free(bearing, body.radius_m + kMeets_m)) {
        return braked(towards(bearing, how), senses, body);
      }
      meet(senses, bearing);
    }
    if (phase_ == Phase::kTurn) {
      const Motion turn = turn_away(dt);
      if (phase_ == Phase::kTurn) return turn;
    }
    const OneWallGains wall{gains.speed_m_s, gains.distance_m, 7.0f, gains.turn_rad_s, kWallReach_m, 1.5f};
    if (wall_.lost(wall) || leaves(bearing)) {
      phase_ = Phase::kStraight;
      trail_.leave_wall();
      return {};
    }
    return braked(wall_.step(senses, hall_.at(), dt, wall, body), senses, body);
  }

 private:
  enum class Phase : std::uint8_t { kStraight, kTurn, kRound, kBackToNearest };

  void meet(const Senses& senses, float bearing) noexcept {
    const float room_left = least(senses.range_m[1], senses.range_m[2]), room_right = least(senses.range_m[7], senses.range_m[6]);
    // An obstacle kept at the right hand is passed on the left.
    const float for_left = bearing < 0.0f ? room_right + 0.2f : room_right - 0.2f;   // the side towards the goal counts as 20 cm more room
    left_ = gains.side == Side::kLeft || (gains.side == Side::kBoth && room_left < for_left);
    if (hall_.to_gate() < nearest_hit_m_ - 0.5f * kNearer_m) vain_ = 0;
    else count_vain();
    nearest_hit_m_ = least(nearest_hit_m_, hall_.to_gate());
    go_round();
  }
  void go_round() noexcept {
    take_hand(Phase::kRound);
    met_ = nearest_ = hall_.at();
    met_at_m_ = nearest_at_m_ = hall_.travelled_m();
    nearest_m_ = kInfinity;
    far_m_ = 0.0f;
    aside_m_ = 0.0f;
    mark_at_m_ = 0.5f * kLeastLoop_m;
    any_lap_ = false;
    trail_.begin_wall(left_);
  }

  /// Begins to turn until the wall is at the robot's hand; then goes on with `then`.
  void take_hand(Phase then) noexcept {
    wall_.start(left_);
    phase_ = Phase::kTurn;
    then_ = then;
    turned_rad_ = 0.0f;
  }
  /// Turns on the spot until the way ahead is free and the wall is at the robot's hand, by at most three quarters of a turn.
  [[nodiscard]] Motion turn_away(float dt) noexcept {
    const NearPoints::Nearest wall = points_.nearest_of_all(hall_.at());
    const float to_hand = left_ ? wall.bearing_rad : -wall.bearing_rad;
    const bool beside = !wall.found || wall.distance_m > gains.distance_m + kWallReach_m || (to_hand > kBeside_rad && to_hand < kPi - kBeside_rad);
    const bool free = !(points_.room(hall_.at(), 0.0f, kLaneHalf_m, kReach_m) < body.radius_m + kMeets_m);
    turned_rad_ += dt * gains.turn_rad_s;
    if ((beside && free) || turned_rad_ > 1.5f * kPi) phase_ = then_;
    return {0.0f, left_ ? -gains.turn_rad_s : gains.turn_rad_s};
  }

  /// Whether nothing stands on the way to the goal within `reach_m`.
  [[nodiscard]] bool lane_is_free(float bearing, float reach_m) const noexcept {
    const float reach = least(reach_m, hall_.to_gate());
    return !(points_.room(hall_.at(), bearing, kLaneHalf_m, reach) < reach);
  }

  /// The robot tries from before to behind the nearest point, as far as reckoning may be off: where it once saw the way free, it may see
  /// that only a little farther on now.
  [[nodiscard]] bool leaves_nearest(float passed_m, float bearing) noexcept {
    const bool there = hall_.distance_to(nearest_) < kSamePlace_m && (any_lap_ || passed_m > nearest_at_m_ - kLate_m);
    const bool past = passed_m >= nearest_at_m_ + kLate_m;
    if ((there || past) && lane_is_free(bearing, kLooks_m)) return true;
    if (past) give_up();
    return false;
  }

  /// Whether the robot leaves the wall here. If it has gone once round, it goes on to the nearest point, or finds that there is no way.
  [[nodiscard]] bool leaves(float bearing) noexcept {
    const float passed = hall_.travelled_m() - met_at_m_;
    if (phase_ == Phase::kBackToNearest) return leaves_nearest(passed, bearing);
    far_m_ = greatest(far_m_, hall_.distance_to(met_));
    const bool free = lane_is_free(bearing, kLooks_m);
    if (free && hall_.to_gate() < nearest_m_) {
      nearest_m_ = hall_.to_gate();
      nearest_ = hall_.at();
      nearest_at_m_ = passed;
    }
    if (far_m_ > 2.0f * kSamePlace_m && hall_.distance_to(met_) < kSamePlace_m) return once_round(passed);
    if (circles(passed)) return once_more(passed - mark_at_m_);
    if (gains.kind == BugKind::kBug1 || !free || passed < kSamePlace_m) {
      aside_m_ = beside_line();
      return false;
    }
    const bool nearer = hall_.to_gate() < nearest_hit_m_ - kNearer_m;
    if (gains.kind == BugKind::kModified) return nearer && !trail_.forbids(hall_.at(), hall_.gate());
    const float before = aside_m_;
    aside_m_ = beside_line();
    return nearer && (magnitude(aside_m_) < kOnLine_m || before * aside_m_ < 0.0f);
  }

  /// Takes the shorter way back to the nearest point from which the way to the goal was free; without one there is no way.
  [[nodiscard]] bool once_round(float loop_m) noexcept {
    if (!(nearest_m_ < nearest_hit_m_ + kNearer_m)) {
      give_up();
      return false;
    }
    phase_ = Phase::kBackToNearest;
    met_at_m_ = hall_.travelled_m();
    if (nearest_at_m_ > 0.5f * loop_m) {
      nearest_at_m_ = loop_m - nearest_at_m_;
      left_ = !left_;
      trail_.begin_wall(left_);
      take_hand(Phase::kBackToNearest);
    }
    return false;
  }

  // note [loops that miss the place where they began]
  // What the robot follows need not be the rim of one obstacle. It drives through a gap in one direction and takes it for closed in the other,
  // and then circles for ever where it never met the wall. So a loop is closed too if the robot comes back to a mark in the same direction.
  // The mark is set anew after 1 m, 2 m, 4 m... of wall, so it comes to lie in the loop, when the loop is shorter than the way to the mark
  // (R. P. Brent, BIT 20, 1980). Such a loop does not say that there is no way: from the other side the gap may be open.

  /// Whether the robot has come back to the mark. Sets the next one.
  [[nodiscard]] bool circles(float passed_m) noexcept {
    if (passed_m >= 2.0f * mark_at_m_) {
      mark_ = hall_.at();
      mark_at_m_ = passed_m;
    }
    return passed_m - mark_at_m_ > kLeastLoop_m && hall_.distance_to(mark_) < kSamePlace_m &&
           magnitude(wrapped_angle(hall_.at().heading_rad - mark_.heading_rad)) < kSameWay_rad;
  }

  /// Goes round such a loop once more if the way to the goal was free somewhere on the wall, which may be there.
  [[nodiscard]] bool once_more(float loop_m) noexcept {
    if (!(nearest_m_ < nearest_hit_m_ + kNearer_m)) {
      try_other_hand();
      return false;
    }
    phase_ = Phase::kBackToNearest;
    met_at_m_ = hall_.travelled_m();
    nearest_at_m_ = loop_m;
    any_lap_ = true;
    return false;
  }

  void give_up() noexcept {
    if (vain_ == 0 && !any_lap_) plight_ = Plight::kNoWay;
    else try_other_hand();
  }
  void try_other_hand() noexcept {
    count_vain();
    left_ = !left_;
    go_round();
  }
  void count_vain() noexcept {
    if (++vain_ >= kMostInVain) plight_ = Plight::kNoWay;
  }

  /// How far the robot is to the left of the straight line from where it set out to the goal.
  [[nodiscard]] float beside_line() const noexcept {
    const float x = hall_.gate().x_m - from_.x_m, y = hall_.gate().y_m - from_.y_m;
    const float length = greatest(square_root(x * x + y * y), 0.01f);
    return (x * (hall_.at().y_m - from_.y_m) - y * (hall_.at().x_m - from_.x_m)) / length;
  }

  static constexpr float kWallReach_m = 0.35f;   ///< so far beyond the wanted distance a wall is still the one that is followed
  static constexpr float kReach_m = 0.8f, kMeets_m = 0.14f, kLooks_m = 0.5f;
  static constexpr float kLaneHalf_m = 0.165f;   ///< the robot's radius and 45 mm: less than its distance from walls
  static constexpr float kSamePlace_m = 0.25f, kLate_m = 0.6f;   ///< reckoning may be off by as much after a loop
  static constexpr float kNearer_m = 0.1f, kOnLine_m = 0.03f, kLeastLoop_m = 1.0f;
  static constexpr float kBeside_rad = 40.0f * kRadPerDeg, kSameWay_rad = 45.0f * kRadPerDeg;
  static constexpr std::uint8_t kMostInVain = 6;
  OneWall wall_{};
  NearPoints points_{};
  Trail trail_{};
  Place from_{}, met_{}, nearest_{}, mark_{};
  Phase phase_ = Phase::kStraight, then_ = Phase::kRound;
  float nearest_hit_m_ = 0.0f;                        ///< distance to the goal of the place nearest to it where a wall was met so far
  float met_at_m_ = 0.0f, far_m_ = 0.0f;              ///< distance driven when it met this wall; the farthest that it has been from that place since
  float nearest_m_ = 0.0f, nearest_at_m_ = 0.0f;      ///< the point of this wall nearest to the goal: its distance to the goal, and the way round to it
  float mark_at_m_ = 0.0f;                            ///< how much of this wall the robot had followed at the mark
  float aside_m_ = 0.0f, turned_rad_ = 0.0f;
  std::uint8_t vain_ = 0;                             ///< walls met no nearer to the goal than one before, and loops that told nothing
  bool left_ = false;
  bool any_lap_ = false;                              ///< the way round to the nearest point is not known
};

}  // namespace mts
