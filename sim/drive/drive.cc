#include "sim/drive/drive.h"

#include <algorithm>
#include <cmath>

#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr std::uint64_t kStepsPerControl = kControlUs / kStepUs;
constexpr double kRunsOn = 1.0;             // s, after the end of the last mission
constexpr double kPatience = 60.0;          // s: a robot that has stood this long, with no event still to come, stands for good
constexpr double kStandsBelow = 0.01;       // m/s
constexpr double kTurnsFrom = 0.05;         // rad/s
constexpr double kStandsAtGoal = 1.0;       // s
constexpr double kGoneFor = 2.5;            // s: a robot whose driver has gone and that has stood this long will not drive again

}  // namespace

Drive::Drive(const Labyrinth& labyrinth, const Knowledge& knowledge, const Scenario& scenario, DriveOptions options)
    : labyrinth_(labyrinth),
      knowledge_(knowledge),
      scenario_(scenario),
      options_(std::move(options)),
      arena_(labyrinth, scenario.start, static_cast<double>(scenario.body.radius_m)),
      floor_(labyrinth),
      wheels_(scenario.drive, scenario.seed),
      sensors_(scenario.sensors, scenario.seed, scenario.body),
      driver_(knowledge, labyrinth, as_driven(scenario.body, scenario.sensors.range, scenario.drive)),
      judge_(labyrinth),
      state_(scenario.events.size()) {
  for (const CrossingMethods& crossing : scenario.crossings) floor_.set_methods(crossing.crossing, crossing.methods);
  if (options_.recording != nullptr) begin_recording();
}

/// The first half of a step, before the wheels turn: samples the sensors, and in each control period asks the driver for a motion.
void Drive::begin_step() {
  const double dt_s = static_cast<double>(kStepUs) / 1e6;
  now_us_ += kStepUs;
  if (!powered_) return;
  sensors_.sample(now_us_, arena_, floor_, wheels_, dt_s);
  if (steps_ % kStepsPerControl != 0) return;
  sensors_.hear(now_us_, senses_);
  sensors_.hear_tag(now_us_, tag_);
  const auto period_s = static_cast<float>(dt_s * kStepsPerControl);
  wanted_ = options_.helm != nullptr ? options_.helm->step(now_us_, senses_, tag_, period_s) : driver_.hear(senses_, tag_, period_s);
}

void Drive::move() {
  const double dt_s = static_cast<double>(kStepUs) / 1e6;
  const auto steps = static_cast<int>(options_.dt_us / kStepUs);
  for (int i = 0; i < steps; ++i) {
    if (ahead_) now_us_ += kStepUs;
    else begin_step();
    ahead_ = false;
    ++steps_;
    wheels_.drive(powered_ && !waits_ ? wanted_ : mts::Motion{}, dt_s);
    if (!moving_.empty()) move_obstacles(dt_s);
    arena_.push(wheels_.speed_m_s(), wheels_.turn_rad_s(), dt_s);
    for (const Hit& hit : arena_.take_hits()) judge_.hit(hit, time_s(), std::abs(wheels_.wheel_speed_m_s()) < kStandsBelow);
    judge_.feel(arena_, time_s(), dt_s);
  }
}

Judge::Belief Drive::belief() const {
  Judge::Belief belief;
  if (options_.helm != nullptr) {
    belief = options_.helm->belief();
    if (powered_ && !waits_) return belief;
    belief.driving = false;
    belief.strategy = nullptr;
    return belief;
  }
  belief.leg = driver_.leg();
  if (powered_ && !waits_) belief.strategy = driver_.strategy();
  belief.driving = belief.strategy != nullptr && belief.strategy->drives();
  belief.reports = driver_.reports_any();
  return belief;
}

bool Drive::on_mission() const { return options_.helm != nullptr ? options_.helm->mission().value_or(untold_ != nullptr) : driver_.on_mission(); }

bool Drive::is_there(const std::string& landmark) const {
  const CrossingId crossing = labyrinth_.crossing(landmark);
  const Pose pose = arena_.pose();
  return crossing != CrossingId::kNone && is_at(labyrinth_, crossing, {pose.x_m, pose.y_m});
}

// note [a mission that nobody tells]
// A helm may not report its mission. The drive then assumes one: it begins when a command is pressed, and it is over when `Abort` is
// pressed, or when the robot, having been elsewhere since, has stood for a second at the landmark where the route of that command ends.
void Drive::follow_untold_mission() {
  if (untold_ == nullptr || options_.helm->mission()) return;
  const bool there = is_there(untold_->goal);
  left_goal_ = left_goal_ || !there;
  last_landmark_ = untold_->goal;
  if (abort_pressed_ || (there && left_goal_ && stands_s_ >= kStandsAtGoal)) untold_ = nullptr;
}

/// Whether a mission that ends in this tick has ended as one does that has come to its goal: on its last leg, where the landmark is seen or,
/// if its sign cannot be read, the end of the road (std.recover). If rules end it anywhere else, they give it up.
bool Drive::claims_arrival() const {
  const auto sees = [&](program::CellId fact) { return fact != program::CellId::kNone && driver_.mind().seen(fact); };
  return last_leg_ == nullptr || (last_leg_->last && (sees(last_leg_->sight) || sees(knowledge_.find("Due"))));
}

/// How the mission that ends in this tick has ended. Of a helm it is known only that it set `Abort` itself, as it does for an order that is
/// cancelled.
Summary::Outcome Drive::mission_end() const {
  using Outcome = Summary::Outcome;
  if (abort_pressed_ || (options_.helm != nullptr && options_.helm->seen(knowledge_.find("Abort")))) return Outcome::kAborted;
  if (options_.helm == nullptr && !claims_arrival()) return Outcome::kGivenUp;
  return is_there(last_landmark_) ? Outcome::kArrived : Outcome::kAstray;
}

void Drive::watch_mission(const Judge::Belief& belief) {
  follow_untold_mission();
  const bool on = on_mission();
  if (on && !mission_) {
    began_s_ = time_s();
    length_at_start_m_ = judge_.summary.length_m;
    ended_ = abort_pressed_ = false;
  }
  if (belief.leg != nullptr) last_leg_ = belief.leg;
  if (options_.helm != nullptr && !options_.helm->goal().empty()) last_landmark_ = options_.helm->goal();
  else if (belief.leg != nullptr) last_landmark_ = belief.leg->to;
  else if (untold_ != nullptr && on) last_landmark_ = untold_->goal;   // it tells of its mission, but not where that leads
  if (!on && mission_) {
    ended_ = true;
    ended_s_ = time_s();
    judge_.summary.landmark = last_landmark_;
    judge_.summary.length_m -= length_at_start_m_;
    length_at_start_m_ = 0.0;
    judge_.summary.outcome = mission_end();
  }
  mission_ = on;
  stands_s_ = std::abs(wheels_.wheel_speed_m_s()) < kStandsBelow ? stands_s_ + static_cast<double>(options_.dt_us) / 1e6 : 0.0;
  if (std::abs(wheels_.wheel_turn_rad_s()) >= kTurnsFrom) turned_at_s_ = time_s();
  moved_at_s_ = stands_s_ > 0.0 ? std::max(moved_at_s_, turned_at_s_) : time_s();
  over_ = options_.helm != nullptr && options_.helm->gone() && stands_s_ >= kGoneFor;
  const bool more = std::any_of(pending_.begin(), pending_.end(), [](const Pending& p) { return p.event != nullptr; }) ||
                    std::any_of(scenario_.events.begin(), scenario_.events.end(), [&](const Event& event) {
                      return event.when.kind == Trigger::Kind::kTime && !state_[static_cast<std::size_t>(&event - scenario_.events.data())].triggered;
                    });
  if (more || scenario_.open_end) return;
  over_ = over_ || (ended_ && !mission_ && time_s() - ended_s_ >= kRunsOn) || stands_s_ >= kPatience;
}

void Drive::think() {
  if (options_.helm == nullptr || !options_.helm->ticks_with_next_period()) return judge();
  mts::Senses other = senses_;
  begin_step();   // the helm reports this tick in the next period, so that period is begun early; nothing moves meanwhile
  std::swap(senses_, other);
  ahead_ = true;
  now_us_ -= kStepUs;
  judge();
  senses_ = other;   // only now: the tick just judged is recorded with the readings of its own period
}

void Drive::judge() {
  static const program::Tick kNothing;
  const bool thinks = options_.helm == nullptr && powered_ && !waits_;
  const program::Tick& tick = thinks ? driver_.tick(now_us_, options_.dt_us) : kNothing;
  const Judge::Belief now = belief();
  judge_.look(arena_.pose(), floor_, now, static_cast<double>(options_.dt_us) / 1e6);
  watch_mission(now);
  if (thinks && options_.on_tick) options_.on_tick(tick);
  if (options_.recording != nullptr) record(tick, now);
}

bool Drive::step() {
  if (over_ || time_s() >= scenario_.limit_s) {
    finish();
    return false;
  }
  move();
  run_events();
  think();
  return true;
}

const Summary& Drive::run() {
  while (step()) {
  }
  return judge_.summary;
}

std::vector<std::string> Drive::reports() const {
  std::vector<std::string> reports = options_.helm != nullptr ? options_.helm->reports() : driver_.reports();
  const bool told = std::find(reports.begin(), reports.end(), "Help.power") != reports.end();
  const bool rests = !powered_ || waits_;
  if (rests && !told) reports.insert(reports.begin(), "Help.power");   // the mind rests until something is pressed, so only its host can report that
  return reports;
}

void Drive::finish() {
  Summary& summary = judge_.summary;
  summary.reports = reports();
  if (options_.helm == nullptr) summary.outputs = driver_.outputs();
  if (const Judge::Belief now = belief(); now.strategy != nullptr) summary.running = now.strategy->name;
  summary.time_s = (ended_ && !mission_ ? ended_s_ : time_s()) - began_s_;
  summary.last_moved_s = std::clamp(moved_at_s_ - began_s_, 0.0, summary.time_s);   // from an end to the end of the drive it may still roll
  if (mission_) {
    summary.length_m -= length_at_start_m_;
    length_at_start_m_ = 0.0;
    const bool stands = stands_s_ > 2.0;
    const bool still = stands_s_ >= kPatience || (stands && time_s() - turned_at_s_ > 2.0);   // a robot that is turning on the spot when the time is up still drives
    summary.outcome = !summary.reports.empty() && stands ? Summary::Outcome::kStopped : still ? Summary::Outcome::kStuck : Summary::Outcome::kTimeUp;
  }
  summary.missed.clear();
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const Event& event = scenario_.events[i];
    if (state_[i].happened) continue;
    const char* const occupied = event.action.kind == Action::Kind::kKidnap ? ", where something stood" : ", where the robot was";
    summary.missed.push_back({event.text + (state_[i].no_room ? occupied : ""), event.at});
  }
  if (options_.recording != nullptr) options_.recording->outcome = describe(summary);
}

}  // namespace kb::sim
