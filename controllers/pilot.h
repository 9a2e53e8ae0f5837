// The controllers bound to a mind: which of them drives, with which parameters and which task, from one decision to the next.
//
//   mts::Pilot pilot(body);
//   for (;;) {                                                    // each period, 5 to 20 ms
//     const auto decision = mind.tick(facts, dt);
//     pilot.choose(errand::control_line(decision), errand::road_of_leg(mind));
//     wheels(pilot.step(senses, dt_s));
//   }
//
// `control_line` is in the generated header, `road_of_leg` in that of `kbc compile --map`; without a map the second argument is left out.
//
// note [what a strategy begins with]
// A controller starts where its strategy begins to run. A manoeuvre that was interrupted (the robot stood, or went round something) is continued: it
// reckons meanwhile, but does not look at the line, over which another controller may turn the robot. So is a way round something or through a
// hall that a halt interrupted. All are forgotten where the leg changes, and where another controller follows a road: the manoeuvre after 30 cm,
// since strategies may waver.
// A road begins where a controller follows on a manoeuvre: until then the robot is on the road before, even if the leg has changed, as it
// does where a sign is read. So what begins in the middle of a road is told the rest of it, and a robot that has come about is told the
// way back, if the leg leads there.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../runtime/control_line.h"
#include "any_controller.h"
#include "bind_line.h"
#include "line_seeker.h"
#include "liveness.h"
#include "on_road.h"
#include "road_map.h"
#include "similarity.h"
#include "steady_ranges.h"

namespace mts {

/// Takes at most 15,000 bytes, no heap, and up to 4 KB of stack; on a small microcontroller use the controllers themselves. One object belongs to one thread at a time; it
/// may be copied.
class Pilot {
  using Id = ControllerId;

 public:
  /// `body`: the robot's own, in its own metres, whatever its size. `host`: see AnyController::choose.
  explicit Pilot(const Body& body = {}, const Host& host = {}) noexcept : as_(body), sees_(Similarity::of_brakes(body)), seen_(as_.after(sees_)), body_(as_.in(body)), host_(host), place_(body) {}

  /// Whether it can drive by this line. kUnknown: there is no such controller, or it has no such parameter; kOutside: no body of this size can
  /// have that value, the word is none of the parameter's, or the unit is another. To be asked of each strategy before the robot drives.
  /// Needs 7 KB of stack.
  [[nodiscard]] Setting fits(const ControlLine& line) const noexcept {
    AnyController trial;
    return bind_line(trial, line, as_, body_, host_);
  }

  /// What the mind has decided: to be called after each of its ticks. `line`: null if nothing drives; one that does not fit lets the robot stand,
  /// and `drives` says so. `road`: of the present leg; null if unknown. `limit_m_s`: besides the limits of the roads, for instance what
  /// `speed_limit_m_per_s(mind)` says, which knows the lowest of all roads while none is known; NaN and below 0 are 0.
  void choose(const ControlLine* line, const MapRoad* road = nullptr, float limit_m_s = kInfinity) noexcept {
    if (road != roads_.road()) {
      suspended_line_ = nullptr;
      changed_ = true;
    }
    roads_.follow(road);
    line_ = line;
    limit_m_s_ = limit_m_s > 0.0f ? limit_m_s : 0.0f;
  }

  /// What the wheels are to do until the next period. Takes one sample of the sensors, raw and in metres of the robot; `dt_s`: see AnyController::step.
  [[nodiscard]] Motion step(const Senses& senses, float dt_s) noexcept {
    const float dt = as_.in(dt_s, "s");
    heard_ = mts::heard(seen_.in(steady_.step(sees_.in(senses), sees_.in(dt_s, "s"))), body_);
    guides_.step(heard_, body_.longest_silence_s, sane_period(dt));
    const Senses& steady = heard_;
    place_.step(steady, sane_period(dt));
    if (!in_crossing()) place_.settle(steady, sane_period(dt));
    const bool found = seeker_.step(steady, place_, controller_.id(), follows_, in_crossing());
    if (line_ != running_) begin(steady);
    else if (found || learnt_ || knows_no_more()) start(steady);
    learnt_ = false;
    if (follows_ && place_.travelled_m() - followed_m_ > kForgets_m * size()) suspended_line_ = nullptr;
    if (follows_) {
      came_rad_ = place_.heading_rad();
      came_m_ = place_.travelled_m();
      beside_m_ = greatest(beside_m_ - place_.way_m(), 0.0f);
    }
    if (suspended_line_ != nullptr) {
      Senses reckons = steady;
      reckons.line_known = false;
      static_cast<void>(suspended_.step(reckons, dt));
    }
    return slowed(as_.out(controller_.step(steady, dt)), limit_m_s());
  }

  /// Whether one of the controllers drives by the line that was chosen last. If not, and there is a line, it is the program's own business.
  [[nodiscard]] bool drives() const noexcept { return drives_ && line_ == running_; }
  /// Of the controller that drives: see AnyController.
  [[nodiscard]] bool done() const noexcept { return drives() && controller_.done(); }
  [[nodiscard]] bool lost() const noexcept { return drives() && controller_.lost(); }
  [[nodiscard]] Plight plight() const noexcept { return drives() ? controller_.plight() : Plight::kNone; }

  /// Where it is on its road.
  [[nodiscard]] const OnRoad& place() const noexcept { return place_; }
  /// The road of the present leg, as `choose` was told; null: unknown.
  [[nodiscard]] const MapRoad* road_of_leg() const noexcept { return roads_.road(); }
  /// Whether a manoeuvre has begun since the robot last followed a road, and how far it has driven since. After 60 km without a crossing the way no
  /// longer grows: see reckoning.h.
  [[nodiscard]] bool in_crossing() const noexcept { return crossed_ && !aside_; }
  [[nodiscard]] float crossed_m() const noexcept { return place_.travelled_m() - entered_m_; }
  /// From the stop line by which it entered its last crossing to the middle of that.
  [[nodiscard]] float to_middle_m() const noexcept { return to_middle_m_; }
  /// What drives, from the last `step` on: the line, null if nothing does, and its controller; kStand if that is none of Waymark's.
  [[nodiscard]] const ControlLine* line() const noexcept { return running_; }
  [[nodiscard]] ControllerId controller() const noexcept { return controller_.id(); }
  /// The senses of the last `step` as the controllers had them: steadied, of size 1, and without a compass or odometry that is stuck.
  [[nodiscard]] const Senses& heard() const noexcept { return heard_; }
  /// What a controller is for.
  [[nodiscard]] static constexpr bool is_manoeuvre(ControllerId id) noexcept { return id == Id::kTurnOnLine || id == Id::kTurnByWalls || id == Id::kTurnByCompass; }
  [[nodiscard]] static constexpr bool follows(ControllerId id) noexcept { return !is_manoeuvre(id) && id != Id::kStand && id != Id::kRoundObstacle && id != Id::kTurnRound && id != Id::kLookRound; }
  /// Where a robot is to face that turns round on its road: back along it, or along it if it faces back already and the leg does not lead there.
  /// False: it is in a crossing, on an unknown road, or near a bend and faces neither way.
  [[nodiscard]] bool is_to_face(float& heading_rad) const noexcept {
    if (in_crossing() || place_.road() == nullptr || !(place_.faces_along() || place_.faces_back() || place_.clear_of_bend())) return false;
    const bool turns_back = way_back(back_) != nullptr || !place_.faces_back();
    heading_rad = wrapped_angle(place_.spot().heading_rad + (turns_back ? kPi : 0.0f));
    return true;
  }
  /// Whether the line of its road is somewhere beside it: see note [beside its line].
  [[nodiscard]] bool beside_line() const noexcept { return seeker_.gone(); }
  /// What a sign says of the crossing ahead: the road that leaves it by the side from which the robot comes; null: unknown. It counts where the
  /// robot did not come by the road of its last leg, as at the first crossing of a mission.
  void arrives_from(const MapRoad* road) noexcept { behind_ = road; }
  /// The road that it is on, in the other direction; null: unknown. It counts where the robot turns round and no leg says where that leads.
  void can_turn_back(const MapRoad* road) noexcept { back_ = road; }
  /// For programs with controllers of their own: to be called once, where one of them has driven through a crossing and stands on the line out.
  void leave_crossing() noexcept { crossed_ = left_ = true; }
  /// For robots that begin in the middle of a road, `along_m` from the middle of the crossing where it begins. They need a compass.
  void put(const MapRoad& road, float along_m) noexcept {
    forget_place();
    place_.put(road, along_m);
  }
  /// The robot was carried, and set down on a road in this direction: until it comes to a crossing, hold_heading holds that. See forget_place.
  void set_down(float heading_rad) noexcept {
    forget_place();
    set_down_ = true;
    set_down_rad_ = heading_rad;
  }
  /// It has read the sign where this road begins, and drives away from it. If it did not know its road, now it does, to some 30 cm.
  void learn_road(const MapRoad& road) noexcept {
    if (place_.road() != nullptr || in_crossing()) return;
    place_.put(road, sign_m(road, as_.out(body_)));
    learnt_ = follows_;
  }
  /// Whether it was, and has not entered a crossing since.
  [[nodiscard]] bool is_set_down() const noexcept { return set_down_; }
  /// The robot was carried: it is on an unknown road, and what was interrupted is not continued. The controller that drives begins afresh, so
  /// call it once.
  void forget_place() noexcept {
    set_down_ = false;
    roads_.forget();
    place_.forget();
    seeker_.forget();
    if (crossed_) line_ = nullptr;   // until the mind has decided anew, no manoeuvre begins where it was set down
    suspended_line_ = running_ = nullptr;
    controller_.choose(Id::kStand, body_);   // if nothing is chosen any more, nothing begins either
    crossed_ = left_ = aside_ = drives_ = changed_ = follows_ = false;
    came_m_ = -kInfinity;
    beside_m_ = 0.0f;
    told_m_ = kInfinity;
  }

 private:
  void begin(const Senses& senses) noexcept {
    suspend();
    const MapRoad* const back = drives_ && controller_.id() == Id::kTurnRound ? way_back(back_) : nullptr;
    if (back != nullptr) place_.turn_back(*back);   // whatever it faces: near a bend neither along nor back
    changed_ = follows_ = false;
    running_ = line_;
    if (line_ != nullptr && line_ == suspended_line_) {
      controller_ = suspended_;
      suspended_line_ = nullptr;
      drives_ = true;
      seeker_.begin(controller_.id());
      if (is_manoeuvre(controller_.id())) crossed_ = true;
      follows_ = follows(controller_.id());
      followed_m_ = place_.travelled_m();
      return;
    }
    drives_ = line_ != nullptr && bind_line(controller_, *line_, as_, body_, host_) == Setting::kSet;
    if (line_ != nullptr && !drives_) left_ = false;   // a controller of the program's own may go anywhere
    if (!drives_) return controller_.choose(Id::kStand, body_);
    seeker_.begin(controller_.id());
    if (controller_.id() == Id::kRoundObstacle && at_way_out()) {
      place_.put(*roads_.road(), begin_of_course_m(*roads_.road(), as_.out(body_)) - greatest(to_line_out_m(), 0.0f));
      aside_ = true;
    }
    start(senses);
  }
  /// A manoeuvre that is over is kept as well: the rules may not have noticed, and it is not to be driven again.
  void suspend() noexcept {
    const bool in_hall = follows_ && place_.road() != nullptr && crosses_hall(*place_.road());
    const bool on_its_way = (controller_.id() == Id::kRoundObstacle || in_hall) && suspended_line_ == nullptr && !controller_.done() && !controller_.lost();
    if (drives_ && is_manoeuvre(controller_.id())) left_ = left_ || controller_.done() || past_middle();
    else if (drives_ && controller_.id() != Id::kStand) left_ = false;
    if (changed_ || !drives_ || !(on_its_way || is_manoeuvre(controller_.id()))) return;
    suspended_ = controller_;
    suspended_line_ = running_;
  }
  void start(const Senses& senses) noexcept {
    const Task all = task(senses);
    told_m_ = kInfinity;
    if (all.pieces == kLongestCourse && controller_.id() == Id::kHoldHeading) {
      told_m_ = place_.spot().along_m;
      for (std::size_t i = 0; i + 1 < kLongestCourse; ++i) told_m_ += all.course[i].length_m;   // on the last piece
    }
    Senses reckoned = senses;
    if (!senses.heading_known && place_.road() != nullptr && place_.heading_known()) {
      reckoned.heading_rad = place_.heading_rad();
      reckoned.heading_known = true;
    }
    controller_.start(as_.in(all), reckoned);
  }

  /// In metres of the robot.
  [[nodiscard]] Task task(const Senses& senses) noexcept {
    const Id id = controller_.id();
    if (is_manoeuvre(id)) return across(senses);
    if (id == Id::kTurnRound) return turned_round();
    if (id == Id::kRoundObstacle) {
      if (in_crossing() || place_.road() == nullptr) return {};
      turn_back_if_leg_does();
      beside_m_ = kBackInMiddle_m * size();
      if (same_text(place_.road()->by, "dist")) return {};   // walls show where the road bends
      return place_.faces_back() ? Task{} : place_.task(place_.far_off() ? OnRoad::Back::kToMiddle : OnRoad::Back::kNever);
    }
    if (!follows(id)) return {};
    follow_road(senses);
    if (place_.road() == nullptr && set_down_ && id == Id::kHoldHeading) {
      Task task;
      task.course[task.pieces++] = {set_down_rad_, kEndless_m};
      return task;
    }
    if (place_.road() == nullptr || (place_.faces_back() && !crosses_hall(*place_.road()))) return {};   // in a hall it may face anywhere
    if (id == Id::kHoldHeading) shorten_overrun();
    if (id != Id::kHoldHeading) return place_.task(OnRoad::Back::kNever);
    return place_.task(seeker_.seeks(place_) ? OnRoad::Back::kToLine : OnRoad::Back::kToMiddle);
  }
  [[nodiscard]] Task across(const Senses& senses) noexcept {
    suspended_line_ = nullptr;
    crossed_ = true;
    set_down_ = left_ = aside_ = false;
    entered_m_ = place_.travelled_m();
    const Body body = as_.out(body_);
    const Arrival arrival = arrives(senses, body);
    to_middle_m_ = arrival.line_m;
    const float in_rad = arrival.heading_known ? arrival.heading_rad : place_.heading_rad(), left_m = beside_m_ > 0.0f ? place_.left_of_end_m(in_rad) : 0.0f;
    place_.enter_crossing(in_rad, arrival.line_m, left_m);
    Task task = task_across(arrival, roads_.road(), body);
    task.entry_left_m = left_m;
    return task;
  }
  /// By the road of its last leg; by that which the sign says, if it did not come by the other, whatever carried it here; or as it last drove, since it
  /// may have looked round.
  [[nodiscard]] Arrival arrives(const Senses& senses, const Body& body) const noexcept {
    const auto fits = [&](float heading_rad) { return !senses.heading_known || magnitude(wrapped_angle(senses.heading_rad - heading_rad)) <= kElsewhere_rad; };
    const Arrival by_leg = arrival_by(roads_.came(), body);
    if (by_leg.heading_known && fits(by_leg.heading_rad)) return by_leg;
    const MapRoad* const next = roads_.road();
    if (behind_ != nullptr && next != nullptr && same_text(behind_->from, next->from)) {
      const float heading_rad = wrapped_angle(behind_->course[0].heading_rad + kPi);
      if (fits(heading_rad)) return {heading_rad, true, line_out_m(*behind_, body)};
    }
    Arrival unknown = arrival_by(nullptr, body);
    if (senses.heading_known && entered_m_ - came_m_ < kForgets_m * size()) {
      unknown.heading_rad = came_rad_;
      unknown.heading_known = true;
    }
    return unknown;
  }
  /// To face back along the road, or along it if the robot faces back already; near a bend, and if the line gives another angle, by the angle.
  [[nodiscard]] Task turned_round() const noexcept {
    Task task;
    const ControlArgument* angle = find_argument(*running_, "angle");
    if (angle != nullptr && angle->number != 180.0f) return task;
    Piece faced{0.0f, 1.0f};
    if (is_to_face(faced.heading_rad)) task.course[task.pieces++] = faced;
    return task;
  }
  void follow_road(const Senses& senses) noexcept {
    const bool manoeuvre = suspended_line_ != nullptr && is_manoeuvre(suspended_.id());
    const bool went_through = left_ || !manoeuvre || past_middle();   // otherwise a strategy wavers
    const MapRoad* road = roads_.road();
    if (crossed_ && went_through) {
      const bool knows_frame = senses.heading_known || place_.road() != nullptr;
      const bool on_it = aside_ && road != nullptr && place_.road() == road;
      if (!on_it && (left_ || road == nullptr || !knows_frame)) place_.enter(road, senses);
      else if (!on_it) place_.enter_aside(*road);
      entered_m_ = -kInfinity;   // it is through
      if (!on_it) beside_m_ = 0.0f;
    } else {
      turn_back_if_leg_does();
    }
    if (suspended_line_ != nullptr && !manoeuvre) suspended_line_ = nullptr;
    crossed_ = left_ = aside_ = false;
    follows_ = true;
    followed_m_ = place_.travelled_m();
  }
  /// The road that the robot is on in the other direction, if the leg leads there or has just led there, or if it is `told`; null: neither, or that is
  /// the road of the leg.
  [[nodiscard]] const MapRoad* way_back(const MapRoad* told = nullptr) const noexcept {
    if (place_.road() == nullptr || roads_.road() == place_.road()) return nullptr;
    for (const MapRoad* road : {roads_.road(), roads_.came(), told}) {   // the leg may lead on already: the sign ahead was read before the robot moved
      if (road != nullptr && is_way_back(*road, *place_.road())) return road;
    }
    return nullptr;
  }
  void turn_back_if_leg_does() noexcept {
    const MapRoad* const back = way_back();
    if (back != nullptr && place_.faces_back()) place_.turn_back(*back);
  }
  /// By as much as the robot is past the end of its road already: each start has a whole one.
  void shorten_overrun() noexcept {
    const OnRoad::Spot here = place_.spot();
    const float past_m = as_.in(here.along_m - end_of_course_m(*place_.road(), as_.out(body_)) + here.past_m, "m");
    if (!(past_m > 0.0f)) return;
    const ControlArgument* written = find_argument(*running_, "overrun");
    const float overrun_m = written != nullptr ? as_.in(written->number, "m") : find_parameter(Id::kHoldHeading, "overrun")->preset;
    static_cast<void>(controller_.set("overrun", greatest(overrun_m - past_m, 0.0f)));
  }

  [[nodiscard]] float limit_m_s() const noexcept {
    float limit = limit_m_s_;
    for (const MapRoad* road : {place_.road(), roads_.road()}) {
      if (road != nullptr) limit = least(limit, road->limit_m_per_s);
    }
    return limit;
  }

  /// Whether the robot has driven so far since the last manoeuvre began that it must have been through the middle of its crossing.
  [[nodiscard]] bool past_middle() const noexcept { return crossed_m() > to_middle_m_; }

  /// By the way driven in the crossing, from the row of line sensors to the line out.
  [[nodiscard]] float to_line_out_m() const noexcept { return to_middle_m_ + line_out_m(*roads_.road(), as_.out(body_)) - crossed_m(); }
  /// Whether what stands ahead stands on the line out of the crossing, or behind it: see note [an obstacle behind the way out].
  [[nodiscard]] bool at_way_out() const noexcept {
    if (!in_crossing() || suspended_line_ == nullptr || !is_manoeuvre(suspended_.id()) || roads_.road() == nullptr) return false;
    return to_line_out_m() < kWayOut_m * size() && magnitude(wrapped_angle(place_.heading_rad() - roads_.road()->course[0].heading_rad)) < kAlong_rad;
  }

  /// Whether the controller comes to the end of what it was told of a road with more bends than a task has room for.
  [[nodiscard]] bool knows_no_more() const noexcept { return place_.road() != nullptr && told_m_ < kInfinity && place_.spot().along_m > told_m_; }

  [[nodiscard]] float size() const noexcept { return as_.out(1.0f, "m"); }

  static constexpr float kElsewhere_rad = 70.0f * kRadPerDeg, kForgets_m = 0.3f, kEndless_m = 1e3f, kBackInMiddle_m = 1.0f, kWayOut_m = 0.2f, kAlong_rad = 0.5f;

  Similarity as_, sees_, seen_;               // all; the part that range finders are steadied in, see Similarity::of_brakes; the rest
  Body body_;                                 // of size 1, as the controllers know it
  Host host_;
  SteadyRanges steady_;
  LiveGuides guides_;
  Senses heard_;
  AnyController controller_, suspended_;      // the second: what was interrupted and is to be continued, if `suspended_line_` is not null
  const ControlLine *line_ = nullptr, *running_ = nullptr, *suspended_line_ = nullptr;
  RoadsDriven roads_;
  const MapRoad *behind_ = nullptr, *back_ = nullptr;   // see arrives_from, can_turn_back
  OnRoad place_;
  LineSeeker seeker_;
  float limit_m_s_ = kInfinity;
  float told_m_ = kInfinity;                  // how far along its road the robot gets without being told more
  bool drives_ = false;
  bool learnt_ = false;                       // see learn_road; the controller is to begin anew
  bool set_down_ = false;                     // facing so, and it has not entered a crossing since
  float set_down_rad_ = 0.0f;
  float entered_m_ = 0.0f, followed_m_ = 0.0f;   // what it had travelled when the last manoeuvre began, and when it last began to follow a road
  float to_middle_m_ = 0.0f;
  float beside_m_ = 0.0f;                     // how far it has yet to follow its road to be in its middle again, after going round something
  float came_rad_ = 0.0f, came_m_ = -kInfinity;   // its heading when it last followed a road, and what it had travelled then
  bool follows_ = false;                      // the controller follows a road
  bool crossed_ = false;                      // a manoeuvre has run since the robot last followed a road
  bool left_ = false;                         // and nothing has moved the robot since it ended
  bool aside_ = false;                        // but it goes round something at the way out, as on the road of its exit
  bool changed_ = false;                      // the leg has, since the controller began
};
static_assert(sizeof(Pilot) <= 15000);

}  // namespace mts
