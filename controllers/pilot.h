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
// reckons meanwhile, but does not look at the line, over which another controller may turn the robot. It is forgotten when the leg
// changes. A road begins where a controller follows on a manoeuvre: until then the robot is on the road before, even if the leg has
// changed, as it does where a sign is read. So what begins in the middle of a road, after something in the way, is told the rest of
// it, and a robot that has come about is told the way back, if the leg leads there.
#pragma once

#include "../runtime/control_line.h"
#include "any_controller.h"
#include "on_road.h"
#include "road_map.h"
#include "similarity.h"
#include "steady_ranges.h"

namespace mts {

/// Takes at most 15,000 bytes, no heap; on a small microcontroller use the controllers themselves. One object belongs to one thread at a time; it
/// may be copied.
class Pilot {
 public:
  /// `body`: the robot's own, in its own metres, whatever its size. `host`: see AnyController::choose.
  explicit Pilot(const Body& body = {}, const Host& host = {}) noexcept : as_(body.size), body_(as_.in(body)), host_(host), place_(body) {}

  /// Whether it can drive by this line. kUnknown: there is no such controller, or it has no such parameter; kOutside: no body of this size can
  /// have that value, the word is none of the parameter's, or the unit is another. To be asked of each strategy before the robot drives.
  /// Needs 6 KB of stack.
  [[nodiscard]] Setting fits(const ControlLine& line) const noexcept {
    AnyController trial;
    return bind(trial, line);
  }

  /// What the mind has decided: to be called after each of its ticks. `line`: null if nothing drives; one that does not fit lets the robot stand,
  /// and `drives` says so. `road`: of the present leg; null if unknown. `limit_m_s`: besides the limits of the roads, for instance what
  /// `speed_limit_m_per_s(mind)` says, which knows the lowest of all roads while none is known.
  void choose(const ControlLine* line, const MapRoad* road = nullptr, float limit_m_s = kInfinity) noexcept {
    if (road != roads_.road()) suspended_line_ = nullptr, changed_ = true;
    roads_.follow(road);
    line_ = line;
    limit_m_s_ = limit_m_s;
  }

  /// What the wheels are to do until the next period. Takes one sample of the sensors, raw and in metres of the robot; `dt_s`: see AnyController::step.
  [[nodiscard]] Motion step(const Senses& senses, float dt_s) noexcept {
    const float dt = as_.in(dt_s, "s");
    const Senses steady = heard(steady_.step(as_.in(senses), dt), body_);
    place_.step(steady, sane_period(dt));
    if (line_ != running_) begin(steady);
    else if (knows_no_more()) start(steady);
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

  /// Where it is on its road. Programs need it if a controller of their own drives through crossings: `leave_crossing` says that it has.
  [[nodiscard]] const OnRoad& place() const noexcept { return place_; }
  void leave_crossing() noexcept { crossed_ = true; }
  /// The robot was carried: it is on an unknown road, and what was interrupted is not continued. The controller that drives begins afresh.
  void forget_place() noexcept {
    roads_.forget();
    place_ = OnRoad(as_.out(body_));
    suspended_line_ = running_ = nullptr;
    crossed_ = drives_ = changed_ = false;
    told_m_ = kInfinity;
  }

 private:
  using Id = ControllerId;
  [[nodiscard]] static constexpr bool is_manoeuvre(Id id) noexcept { return id == Id::kTurnOnLine || id == Id::kTurnByWalls || id == Id::kTurnByCompass; }
  [[nodiscard]] static constexpr bool follows(Id id) noexcept { return !is_manoeuvre(id) && id != Id::kStand && id != Id::kRoundObstacle && id != Id::kTurnRound && id != Id::kLookRound; }

  [[nodiscard]] Setting bind(AnyController& controller, const ControlLine& line) const noexcept {
    const ControllerEntry* entry = find_controller(line.controller);
    if (entry == nullptr) return Setting::kUnknown;
    controller.choose(entry->id, body_, host_);
    for (std::uint32_t i = 0; i < line.count; ++i) {
      const Setting set = set_argument(controller, line.arguments[i]);
      if (set != Setting::kSet) return set;
    }
    return Setting::kSet;
  }
  /// A value that bodies of this size may have, but not this one, as it is slower or broader, becomes the nearest that it can.
  [[nodiscard]] Setting set_argument(AnyController& controller, const ControlArgument& argument) const noexcept {
    if (argument.word[0] != '\0') return controller.set_word(argument.name, argument.word);
    const Parameter* parameter = find_parameter(controller.id(), argument.name);
    if (parameter == nullptr) return Setting::kUnknown;
    const float value = as_.in(argument.number, parameter->unit);
    const bool possible = value >= parameter->low && value <= greatest(parameter->high, highest(*parameter, body_));
    if (!possible || (argument.unit[0] != '\0' && !same_text(argument.unit, parameter->unit)) || words_of(parameter->values).count > 0) return Setting::kOutside;
    return controller.set(argument.name, clamped(value, lowest(*parameter, body_), highest(*parameter, body_)));
  }

  void begin(const Senses& senses) noexcept {
    const bool unfinished = drives_ && is_manoeuvre(controller_.id()) && !controller_.done() && !controller_.lost();
    if (unfinished && !changed_) suspended_ = controller_, suspended_line_ = running_;
    changed_ = false;
    running_ = line_;
    if (line_ != nullptr && line_ == suspended_line_) {
      controller_ = suspended_;
      suspended_line_ = nullptr;
      drives_ = true;
      return;
    }
    drives_ = line_ != nullptr && bind(controller_, *line_) == Setting::kSet;
    if (!drives_) return controller_.choose(Id::kStand, body_);
    start(senses);
  }
  void start(const Senses& senses) noexcept {
    const Task all = task(senses);
    told_m_ = kInfinity;
    if (all.pieces == kLongestCourse && controller_.id() == Id::kHoldHeading) {
      told_m_ = place_.spot().along_m;
      for (std::size_t i = 0; i + 1 < kLongestCourse; ++i) told_m_ += all.course[i].length_m;   // on the last piece
    }
    controller_.start(as_.in(all), senses);
  }

  /// In metres of the robot.
  [[nodiscard]] Task task(const Senses& senses) noexcept {
    const Id id = controller_.id();
    if (is_manoeuvre(id)) {
      suspended_line_ = nullptr;
      crossed_ = true;
      Task across = task_across(roads_);
      if (across.entry_known && senses.heading_known && magnitude(wrapped_angle(senses.heading_rad - across.entry_heading_rad)) > kElsewhere_rad) {
        across.entry_known = false;   // it did not come by the road of its last leg, whatever carried it here
      }
      return across;
    }
    if (id == Id::kTurnRound && place_.road() != nullptr && !crossed_) {
      Task back;
      back.course[back.pieces++] = {wrapped_angle(place_.spot().heading_rad + kPi), 1.0f};
      return back;
    }
    if (id == Id::kRoundObstacle) return crossed_ || (place_.road() != nullptr && same_text(place_.road()->by, "dist")) ? Task{} : place_.task(false);   // walls show where the road bends
    if (!follows(id)) return {};
    const MapRoad* road = roads_.road();
    if (crossed_) place_.enter(road, senses);
    else if (place_.faces_back() && road != nullptr && is_way_back(*road, *place_.road())) place_.turn_back(*road);
    crossed_ = false;
    return place_.faces_back() ? Task{} : place_.task(id == Id::kHoldHeading);
  }

  [[nodiscard]] float limit_m_s() const noexcept {
    float limit = limit_m_s_;
    for (const MapRoad* road : {place_.road(), roads_.road()}) {
      if (road != nullptr) limit = least(limit, road->limit_m_per_s);
    }
    return limit;
  }

  /// Whether the controller comes to the end of what it was told of a road with more bends than a task has room for.
  [[nodiscard]] bool knows_no_more() const noexcept { return place_.road() != nullptr && told_m_ < kInfinity && place_.spot().along_m > told_m_; }

  static constexpr float kElsewhere_rad = 70.0f * kRadPerDeg;

  Similarity as_;
  Body body_;                                 // of size 1, as the controllers know it
  Host host_;
  SteadyRanges steady_;
  AnyController controller_, suspended_;      // the second: an interrupted manoeuvre, if `suspended_line_` is one
  const ControlLine *line_ = nullptr, *running_ = nullptr, *suspended_line_ = nullptr;
  RoadsDriven roads_;
  OnRoad place_;
  float limit_m_s_ = kInfinity;
  float told_m_ = kInfinity;                  // how far along its road the robot gets without being told more
  bool drives_ = false;
  bool crossed_ = false;                      // a manoeuvre has run since the robot last followed a road
  bool changed_ = false;                      // the leg has, since the controller began
};
static_assert(sizeof(Pilot) <= 15000);

}  // namespace mts
