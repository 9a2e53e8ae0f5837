// What a robot on a road of the map perceives: the facts of the standard library, from the senses of a pilot and the signs that are read.
// `Lookout` (lookout.h) hands them to a mind by their names.
//
// note [an obstacle on the track]
// On a road, whatever stands ahead is an obstacle. While the robot goes round it, it faces elsewhere: then whatever stands on the track is an
// obstacle, wherever the robot faces.
//
// note [an order begins at the line]
// A robot that brakes at a stop line comes to rest with the line just behind its sensors. If its mission ends there, and the next one begins
// there, the mind must be told of the line: else it would drive across as on a road. And if a mission ends just out of a crossing, the line
// out may lie under its sensors: that is no line to stop at.
//
// note [an obstacle behind the way out]
// The robot meets an obstacle that stands just behind the line out of a crossing before it meets that line. It goes round it as on the road of its
// exit. As it turns, its row sweeps over the line out and over others: so on the way round, the line out counts as passed only when the robot
// itself is well behind it. If it finds no way round, it is still in the crossing.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lifted.h"
#include "liveness.h"
#include "obstacle_sight.h"
#include "pilot.h"
#include "sign_read.h"
#include "stop_line.h"

namespace mts {

/// Takes no heap. One object belongs to one thread at a time; it may be copied.
class RoadWatch {
 public:
  /// How near it is to the sign that it read last.
  enum class At : std::uint8_t { kNowhere, kApproach, kCrossing, kLeaving };

  /// `body`: the pilot's. `notices_carried`: the rules want to know whether the robot was carried.
  explicit RoadWatch(const Body& body, bool notices_carried) noexcept : as_(body), body_(as_.in(body)), line_(body_), notices_carried_(notices_carried) {}
  /// Whether the robot is never carried between two missions: then it keeps its place.
  void keep_place(bool keeps) noexcept { keeps_place_ = keeps; }
  /// The robot may be anywhere: only the sign that it reads now still counts, by the compass of now.
  void forget(Pilot& pilot) noexcept {
    forget_place(pilot);
    if (unread_s_ >= kReadingLasts_s) forget_sign();
  }

  /// Each period, after the pilot's `step`. `sign`: what is read now; null: nothing. A robot that was carried, or that has rested for two
  /// seconds, has its pilot forget the place.
  void step(Pilot& pilot, const SignRead* sign, float dt_s, bool measured = false) noexcept {
    const float dt = sane_period(as_.in(dt_s, "s"));
    look_at_pilot(pilot);
    alive_.step(senses_, measured, way_m_ + body_.line_ahead_m * magnitude(turned_rad_), dt);
    if (pilot.line() != line_driven_) begin(pilot);
    since_m_ += way_m_;
    if (moves_) beside_m_ = greatest(beside_m_ - way_m_, 0.0f);
    touched_ = touched_ || senses_.touched;
    hear_carried(pilot, dt);
    hear_crossing();
    hear_sign(pilot, sign, dt);
    guided_ = guided_ || (moves_ && road_ == nullptr && (id_ == ControllerId::kFollowLine || id_ == ControllerId::kKeepWall));
    given_up_ = given_up_ || (moves_ && id_ == ControllerId::kHoldHeading && pilot.lost());
    line_.step(senses_, dt, rounds_to_end());
    hear_line_out();
    met_line_ = at_ == At::kApproach && (met_line_ || line_.now());
    line_seen_ = line_seen_ || (line_.now() && line_counts());
    hear_range(pilot, dt);
    without_line_m_ = line_.now() || at_ != At::kApproach ? 0.0f : without_line_m_ + (moves_ && !in_hall() ? way_m_ : 0.0f);
    rest(pilot, dt);
    set_down_ = pilot.is_set_down();
  }

  // ---- certainties of facts, from -1 to 1; 0: nothing is known
  /// A stop line, since the last `forget_moments`, that is the one to which the robot had to come.
  [[nodiscard]] float line() const noexcept { return !senses_.line_known ? 0.0f : sure(line_seen_ || (waits_at_line_ && met_line_)); }
  /// Something touched it, the same.
  [[nodiscard]] float touched() const noexcept { return sure(touched_); }
  /// Moments are over: a tick has taken them.
  void forget_moments() noexcept { line_seen_ = touched_ = false; }
  [[nodiscard]] float obstacle() const noexcept { return obstacle_; }
  [[nodiscard]] float line_blind() const noexcept { return sure(!alive_.line_sees() || without_line_m_ > kSignToLine_m); }
  [[nodiscard]] float ranges_blind() const noexcept { return sure(body_.has_range_finders && !alive_.ranges_see()); }
  [[nodiscard]] float due() const noexcept { return sure(due_); }
  [[nodiscard]] float carried() const noexcept { return sure(carried_s_ > 0.0f); }
  [[nodiscard]] float turned() const noexcept { return sure(id_ == ControllerId::kTurnRound && come_about()); }
  [[nodiscard]] float trapped() const noexcept { return sure(plight_ == Plight::kTrapped); }
  [[nodiscard]] float no_way() const noexcept { return sure(plight_ == Plight::kNoWay); }
  /// Whether the track of roads driven `by` can be followed here.
  [[nodiscard]] float track(const char* by) const noexcept {
    const bool mark = same_text(by, "mark"), dist = same_text(by, "dist"), azimuth = same_text(by, "azimuth");
    if (in_hall() || !(mark || dist || azimuth)) {
      if (!in_hall() || !same_text(by, road_->by)) return -kSure;
      return senses_.odometry_known && senses_.range_known ? kSure : 0.0f;
    }
    if (elsewhere_) return -kSure;
    if (mark) return !senses_.line_known ? 0.0f : sure(alive_.paint());
    if (dist) return walls_beside(senses_, to_bend_m_ < kBendNear_m);
    return sure(compass_leads());
  }
  /// How the road ahead is driven, by the map; "" if it is not known, or not where the robot is now.
  [[nodiscard]] const char* move_by() const noexcept {
    return leg_ == nullptr || (!crosses_ && leg_ != road_) ? "" : leg_->by;
  }

  /// Whether a controller drives that follows a road.
  [[nodiscard]] bool moves() const noexcept { return moves_; }

  // ---- the sign
  [[nodiscard]] At at() const noexcept { return at_; }
  /// "" if it is at none. Only a sign that was read for a quarter of a second counts.
  [[nodiscard]] const char* landmark() const noexcept { return turned_from_sign_ || (set_down_ && at_ == At::kLeaving) || !believed() ? "" : sign_.landmark; }
  /// What it says; only the last sign that was believed counts.
  [[nodiscard]] const SignRead& sign() const noexcept { return sign_; }
  /// Falls with the way since it was read, or since the crossing was entered or left: `since_sign_m`.
  [[nodiscard]] float landmark_certainty() const noexcept { return greatest(kSure - kFades_1_m * since_m_, 0.0f); }
  [[nodiscard]] float since_sign_m() const noexcept { return as_.out(since_m_, "m"); }
  /// The side on whose road the robot arrives; "" if it does not, or nobody knows.
  [[nodiscard]] const char* arrives_by() const noexcept {
    const bool by_road = due_ && road_ != nullptr;
    if (at_ != At::kApproach) return by_road && notices_carried_ ? road_->approach : "";
    if (by_road && (notices_carried_ || sign_.exit[0] == '\0')) return road_->approach;
    return sign_.exit;
  }

  /// Which way the robot drove when it read the sign. False: it did not drive, or has no heading.
  [[nodiscard]] bool came(float& heading_rad) const noexcept {
    heading_rad = came_rad_;
    return came_known_ && sign_.landmark[0] != '\0';
  }

  static constexpr float kSure = 0.9f;
  [[nodiscard]] static constexpr float sure(bool is) noexcept { return is ? kSure : -kSure; }

 private:
  /// What the pilot says of this period.
  void look_at_pilot(const Pilot& pilot) noexcept {
    senses_ = pilot.heard();
    const OnRoad& place = pilot.place();
    const Place before = here_;
    here_ = {in_m(place.at().x_m), in_m(place.at().y_m), place.at().heading_rad};
    way_m_ = in_m(place.way_m());
    turned_rad_ = wrapped_angle(here_.heading_rad - before.heading_rad);
    round_rad_ += turned_rad_;
    if (pilot.in_crossing() != crosses_ || place.road() != road_) given_up_ = false;
    if (place.road() != nullptr) guided_ = false;
    enters_ = pilot.in_crossing() && !crosses_;
    leaves_ = crosses_ && !pilot.in_crossing();
    crosses_ = pilot.in_crossing();
    crossed_m_ = in_m(pilot.crossed_m());
    to_middle_m_ = in_m(pilot.to_middle_m());
    road_ = place.road();
    leg_ = pilot.road_of_leg();
    id_ = pilot.controller();
    moves_ = pilot.line() != nullptr && Pilot::follows(id_);
    plight_ = pilot.plight();
    spot_ = {};
    along_m_ = to_bend_m_ = kInfinity;
    road_turned_rad_ = 0.0f;
    due_ = passed_end_ = false;
    if (road_ == nullptr) return;
    spot_ = place.spot();
    const float line_m = line_out_m(*road_, body_), road_m = in_m(length_m(*road_)) - line_m - line_in_m(*road_, body_);   // from stop line to stop line
    along_m_ = in_m(spot_.along_m) - line_m;
    beside_road_m_ = in_m(magnitude(spot_.left_m));
    to_bend_m_ = in_m(place.to_bend_m(spot_.along_m));
    road_turned_rad_ = place.turned_rad(spot_.along_m);
    const float past_end_m = along_m_ + in_m(spot_.past_m) - road_m, drift_m = kDrift * road_m;
    due_ = !crosses_ && senses_.odometry_known && square_root(past_end_m * past_end_m + beside_road_m_ * beside_road_m_) < kDue_m + drift_m;
    passed_end_ = past_end_m > kPassedEnd_m + drift_m;
  }

  /// Another strategy drives.
  void begin(const Pilot& pilot) noexcept {
    line_driven_ = pilot.line();
    const bool avoids = id_ == ControllerId::kRoundObstacle && line_driven_ != nullptr, avoided = avoids_;
    avoids_ = avoids;
    if (avoids && !avoided) {
      rounding_ = !crosses_;
      if (rounding_) beside_m_ = kBackInMiddle_m;
      track_ = here_;
      if (rounding_ && road_ != nullptr) track_.heading_rad = spot_.heading_rad;
    }
    if (moves_ || (Pilot::is_manoeuvre(id_) && line_driven_ != nullptr)) rounding_ = false;
    if (id_ == ControllerId::kTurnRound) {
      round_rad_ = 0.0f;
      turned_back_ = true;
      met_line_ = waits_at_line_ = false;
      knows_way_back_ = pilot.is_to_face(way_back_rad_);
    }
  }
  [[nodiscard]] bool come_about() const noexcept {
    if (knows_way_back_) return magnitude(wrapped_angle(here_.heading_rad - way_back_rad_)) < kTurnedTo_rad;
    return magnitude(round_rad_) > kHalfTurn_rad;
  }

  void hear_carried(Pilot& pilot, float dt) noexcept {
    carried_s_ = greatest(carried_s_ - dt, 0.0f);
    if (!notices_carried_) return;
    const bool drives = moves_ && !crosses_ && !in_hall() && senses_.odometry_known && senses_.speed_m_s > Lifted::kDrives_m_s;
    lifted_.step(senses_, drives && road_ != nullptr && road_turned_rad_ > kAcross_rad, dt);
    if (!lifted_.now()) return;
    forget_place(pilot);
    pilot.set_down(lifted_.facing_rad());
    forget_sign();
    carried_s_ = kSaysCarried_s;
  }
  void forget_place(Pilot& pilot) noexcept {
    pilot.forget_place();
    lifted_.forget();
    road_ = nullptr;
    rounding_ = guided_ = crosses_ = turned_back_ = met_line_ = begins_on_road_ = awaits_out_ = false;
    beside_m_ = 0.0f;
  }
  void forget_sign() noexcept { sign_ = {}; at_ = At::kNowhere; }
  /// Between two missions somebody may carry the robot to where the next one is to begin, and its wheels do not notice.
  void rest(Pilot& pilot, float dt) noexcept {
    const bool rests = pilot.line() == nullptr && pilot.road_of_leg() == nullptr;
    rest_s_ = rests ? rest_s_ + dt : 0.0f;
    drove_ = drove_ || !rests;
    waits_at_line_ = keeps_place_ && met_line_ && (rests || waits_at_line_);
    begins_on_road_ = keeps_place_ && (rests || begins_on_road_);
    if (rest_s_ < kRests_s || (keeps_place_ && (crosses_ || road_ != nullptr || met_line_))) return;
    if (drove_ || pilot.is_set_down()) forget_place(pilot);
    drove_ = false;
    without_line_m_ = 0.0f;
    obstacle_sight_.rest();
    if (unread_s_ >= kReadingLasts_s) forget_sign();
  }

  void hear_crossing() noexcept {
    if (enters_) {
      if (at_ != At::kApproach) sign_ = {};   // it crosses without a sign
      at_ = At::kCrossing;
      since_m_ = 0.0f;
      turned_back_ = begins_on_road_ = awaits_out_ = out_told_ = false;
    }
    if (leaves_ && rounding_) awaits_out_ = !out_told_;
    else if (leaves_) beside_m_ = 0.0f;   // it begins in the middle of another road
    if (leaves_ && at_ == At::kCrossing) {
      at_ = At::kLeaving;
      sign_.forget_exit();   // it was read on the way in
      since_m_ = unread_s_ = 0.0f;
    }
  }
  void hear_sign(const Pilot& pilot, const SignRead* sign, float dt) noexcept {
    unread_s_ += dt;
    if (sign != nullptr) read(pilot, *sign, dt);
    const bool passed = (at_ == At::kLeaving && unread_s_ > kReadingLasts_s && since_m_ > kLeft_m) || (at_ == At::kApproach && since_m_ > kApproachLasts_m) ||
                        (at_ == At::kCrossing && since_m_ > kCrossingLasts_m);
    if (passed || at_ == At::kNowhere) forget_sign();
    turned_from_sign_ = turned_back_ && at_ == At::kLeaving;
  }
  void read(const Pilot& pilot, const SignRead& sign, float dt) noexcept {
    const bool same = same_text(sign.landmark, sign_.landmark);
    if (at_ == At::kCrossing) {
      if (same && since_m_ > kFromLine_m) unread_s_ = since_m_ = 0.0f;   // the sign of the way out
      return;
    }
    const bool begins_here = road_ != nullptr && same_text(sign.landmark, road_->from) && (sign.exit[0] == '\0' || same_text(sign.exit, road_->exit));
    if ((rounding_ || in_hall()) && begins_here && !pilot.place().faces_back()) return;   // the sign where its road began may be seen again on the way round something
    if (misreads_begin(pilot, sign)) return;
    const At side = side_of(pilot, sign);
    if (side == At::kNowhere && !same) return;
    if (side == At::kLeaving && rounding_ && at_ == At::kApproach) return;   // it looks away to go round something
    if (side != At::kNowhere) at_ = side;
    sign_s_ = same ? sign_s_ + dt : 0.0f;
    if (unread_s_ > kReadingLasts_s) without_line_m_ = 0.0f;   // the robot comes to the sign anew
    sign_ = sign;
    unread_s_ = since_m_ = 0.0f;
    if (!moves_) return;
    came_rad_ = here_.heading_rad;
    came_known_ = pilot.place().heading_known();
  }
  /// Where its road begins lies the sign of the landmark that it leaves, so one that names another is misread, or a neighbour's.
  [[nodiscard]] bool misreads_begin(const Pilot& pilot, const SignRead& sign) const noexcept {
    if (road_ == nullptr || !senses_.odometry_known || !pilot.place().faces_along() || same_text(sign.landmark, road_->from)) return false;
    return along_m_ < least(kSignReach_m, 0.5f * in_m(length_m(*road_)) - line_out_m(*road_, body_));
  }
  /// Whether the robot comes to the landmark of a sign or leaves it; kNowhere: neither, it looks across.
  [[nodiscard]] At side_of(const Pilot& pilot, const SignRead& sign) const noexcept {
    if (turned_back_ && road_ != nullptr && along_m_ < kSignReach_m && pilot.place().faces_along()) return At::kLeaving;   // that which could not be read before, or was wrong
    if (sign.exit_rad_known && pilot.place().heading_known()) {
      const float outwards = cosine(here_.heading_rad - sign.exit_rad);
      return outwards < -kInOrOut ? At::kApproach : outwards > kInOrOut ? At::kLeaving : At::kNowhere;
    }
    const bool from = road_ != nullptr && same_text(sign.landmark, road_->from), to = road_ != nullptr && same_text(sign.landmark, road_->to);
    return from && !to ? At::kLeaving : At::kApproach;
  }
  /// A sign that was read once may be that of a place from which the robot has just been carried.
  [[nodiscard]] bool believed() const noexcept { return at_ != At::kApproach || (sign_s_ >= kReads_s && !lifted_.suspected()); }

  [[nodiscard]] bool in_hall() const noexcept { return road_ != nullptr && !crosses_ && crosses_hall(*road_); }
  /// Whether the robot, going round something, has come to the end of the road in its middle: from beside the road a crossing cannot be entered.
  [[nodiscard]] bool rounds_to_end() const noexcept { return rounding_ && due_ && beside_road_m_ < kAside_m && road_turned_rad_ < 0.25f * kPi; }
  /// Around the middle of a crossing the lines of several roads can be as dark as a stop line; and on the way round something its row may
  /// sweep over the line behind which its road began.
  [[nodiscard]] bool line_counts() const noexcept {
    if (awaits_out_) return false;
    if (crosses_) return crossed_m_ > to_middle_m_ + greatest(kStarReaches_m, stop_line_m(leg_ != nullptr ? leg_->begins_apart_rad : kPi, body_) - kApart_m);
    return !((rounding_ || beside_m_ > 0.0f || begins_on_road_) && road_ != nullptr && !turned_back_ && along_m_ < kLineBehind_m);
  }

  /// See note [an obstacle behind the way out].
  void hear_line_out() noexcept {
    const bool passes = awaits_out_ && (rounding_ ? along_m_ > kPassedRound_m : along_m_ > kPassed_m || line_.now());
    line_seen_ = line_seen_ || passes;
    out_told_ = out_told_ || passes || (at_ != At::kApproach && line_.now() && line_counts());
    awaits_out_ = awaits_out_ && !passes;
  }
  /// Nothing else ends the way round there; elsewhere the track that the robot follows along the road ends it.
  [[nodiscard]] bool back_on_road() const noexcept { return !awaits_out_ || (beside_road_m_ < kAside_m && road_turned_rad_ < kAlongRoad_rad); }

  [[nodiscard]] Surroundings surroundings() const noexcept {
    return {crosses_, driven_by("dist") && to_bend_m_ < kBendNear_m, at_ == At::kLeaving, at_ == At::kApproach && due_};
  }
  void hear_range(const Pilot& pilot, float dt) noexcept {
    obstacle_sight_.step(senses_, (moves_ || Pilot::is_manoeuvre(id_)) && line_driven_ != nullptr && !in_hall(), way_m_, turned_rad_, dt);
    const bool blocked = rounding_ && on_track(pilot.place());
    clear_s_ = blocked ? 0.0f : clear_s_ + dt;
    obstacle_ = !senses_.range_known ? 0.0f : obstacle_sight_.held_up() ? kSure : rounding_ ? sure(blocked || !back_on_road()) : obstacle_sight_.ahead(surroundings());
    look_at_track(pilot);
  }
  /// Whether something that a range finder sees stands on the track, not far ahead.
  [[nodiscard]] bool on_track(const OnRoad& place) const noexcept {
    const float reach_m = ObstacleSight::reach_m(surroundings()) + kBehind_m;
    const float half_m = driven_by("dist") ? ObstacleSight::kTrackHalfWalled_m : ObstacleSight::kTrackHalf_m;
    const float ux = cosine(track_.heading_rad), uy = sine(track_.heading_rad), from_m = in_m(spot_.along_m), size = as_.out(1.0f, "m");
    for (std::size_t i = 0; i < kRangeFinders; ++i) {
      const float range_m = senses_.range_m[i], direction_rad = here_.heading_rad + range_finder_rad(i);
      if (range_m > 2.0f * reach_m + half_m + kRoadOff_m) continue;
      const float dx = range_m * cosine(direction_rad), dy = range_m * sine(direction_rad);
      float ahead_m = dx * ux + dy * uy;
      float aside_m = (here_.y_m + dy - track_.y_m) * ux - (here_.x_m + dx - track_.x_m) * uy;
      if (road_ != nullptr) {
        const OnRoad::Spot there = place.spot_of(dx * size, dy * size);
        const float off_x_m = in_m(there.x_m), off_y_m = in_m(there.y_m);
        ahead_m = in_m(there.along_m) - from_m;
        aside_m = square_root(off_x_m * off_x_m + off_y_m * off_y_m);
      }
      if (ahead_m > -kBehind_m && ahead_m < reach_m && magnitude(aside_m) < half_m) return true;
    }
    return false;
  }

  /// Whether what the robot sees now cannot be its road, and whether it is too far beside the road for the compass to lead it.
  void look_at_track(const Pilot& pilot) noexcept {
    const bool enters = !crosses_ && (rounding_ || beside_m_ > 0.0f) && passed_end_;   // beside the road, past its stop line: in a crossing that it may not enter
    const float off_rad = avoids_ && road_ != nullptr && !driven_by("dist") ? magnitude(wrapped_angle(here_.heading_rad - spot_.heading_rad)) : road_turned_rad_;
    const bool on_road = !crosses_ && road_ != nullptr && (rounding_ || at_ == At::kNowhere);
    elsewhere_ = enters || (on_road && off_rad > (avoids_ ? kAlong_rad : kAcross_rad));
    const bool rounds = rounding_ && clear_s_ < kClear_s;   // the obstacle may still be between it and the road
    const bool seeks = pilot.beside_line() && clear_s_ >= kClear_s;   // see note [beside its line]
    beside_ = on_road && beside_road_m_ > (rounds ? kAside_m : seeks ? kComesBack_m : kRoadOff_m);
  }
  /// A compass says where east is, not where the road lies. It can lead the robot along a road of the map, in the direction in which a robot
  /// that was carried was set down, and, as long as there was nothing else to follow, in that in which it was put at the start.
  [[nodiscard]] bool compass_leads() const noexcept {
    return senses_.heading_known && senses_.odometry_known && !given_up_ && !beside_ && (road_ != nullptr || set_down_ || !guided_);
  }
  [[nodiscard]] bool driven_by(const char* by) const noexcept { return road_ != nullptr && same_text(road_->by, by); }
  [[nodiscard]] float in_m(float length_m) const noexcept { return as_.in(length_m, "m"); }

  static constexpr float kBehind_m = ObstacleSight::kBehind_m;
  static constexpr float kRoadOff_m = 0.35f, kComesBack_m = 0.8f, kAside_m = 0.12f, kBackInMiddle_m = 1.0f, kLineBehind_m = 0.3f;
  static constexpr float kPassedRound_m = 0.3f, kPassed_m = 0.05f, kAlongRoad_rad = 0.5f;
  static constexpr float kStarReaches_m = 0.1f, kApart_m = 0.35f, kDue_m = 0.35f, kPassedEnd_m = 0.12f, kDrift = 0.03f;
  static constexpr float kAlong_rad = 0.7f, kAcross_rad = 1.3f, kTurnedTo_rad = 0.17f, kHalfTurn_rad = 2.96f, kClear_s = 4.0f;
  static constexpr float kInOrOut = 0.35f, kReads_s = 0.25f, kReadingLasts_s = 0.25f, kApproachLasts_m = 0.8f, kCrossingLasts_m = 3.0f;
  static constexpr float kLeft_m = 0.05f, kFromLine_m = 0.2f, kSignReach_m = 0.6f, kSignToLine_m = 0.7f, kFades_1_m = 0.15f;
  static constexpr float kSaysCarried_s = 0.5f, kRests_s = 2.0f;

  Similarity as_;
  Body body_;
  Senses senses_;
  StopLine line_;
  LiveSenses alive_;
  ObstacleSight obstacle_sight_;
  Lifted lifted_;
  SignRead sign_;
  Place here_{}, track_{};
  OnRoad::Spot spot_{};                        // in metres of the robot
  const MapRoad *road_ = nullptr, *leg_ = nullptr;
  const ControlLine* line_driven_ = nullptr;
  float along_m_ = kInfinity, to_bend_m_ = kInfinity, beside_road_m_ = 0.0f, road_turned_rad_ = 0.0f;
  float way_m_ = 0.0f, turned_rad_ = 0.0f, crossed_m_ = 0.0f, to_middle_m_ = 0.0f;
  float since_m_ = 0.0f, unread_s_ = kInfinity, sign_s_ = 0.0f, without_line_m_ = 0.0f;
  float clear_s_ = 0.0f, beside_m_ = 0.0f, obstacle_ = 0.0f, carried_s_ = 0.0f, rest_s_ = 0.0f;
  float round_rad_ = 0.0f, way_back_rad_ = 0.0f, came_rad_ = 0.0f;
  ControllerId id_ = ControllerId::kStand;
  Plight plight_ = Plight::kNone;
  At at_ = At::kNowhere;
  bool notices_carried_, keeps_place_ = false;
  bool drove_ = false;                         // since the place was forgotten; a place that was put is kept until the robot drives
  bool crosses_ = false, enters_ = false, leaves_ = false, moves_ = false, avoids_ = false, rounding_ = false;
  bool due_ = false, passed_end_ = false, elsewhere_ = false, beside_ = false;
  bool line_seen_ = false, touched_ = false, guided_ = false, given_up_ = false, set_down_ = false, came_known_ = false;
  bool turned_back_ = false, turned_from_sign_ = false, knows_way_back_ = false, met_line_ = false, waits_at_line_ = false, begins_on_road_ = false;
  bool awaits_out_ = false, out_told_ = true;  // the line out of its last crossing: it has yet to pass that, going round something; it has seen it
};

}  // namespace mts
