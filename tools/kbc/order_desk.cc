#include "tools/kbc/order_desk.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "sim/world/geometry.h"
#include "tools/kbc/wire/fields.h"

namespace kb::cli {
namespace {

constexpr std::int64_t kPressAgainUs = 500'000;   // a button without effect is pressed again: the mind had no tick yet, or something kept the robot from setting out
constexpr std::int64_t kLostUs = 5'000'000;         // a robot that has lost what it follows for so long does not find it again by itself
constexpr std::int64_t kStopsUs = 3'000'000;        // at a stop line; when nothing is wrong it takes half a second
constexpr std::size_t kMostActionBytes = wire::kLongestLine / 2;   // half of an answer; the other half is for the rest of it
constexpr float kTurnTau_s = 0.2f;
constexpr std::int64_t kSilentUs = 1'000'000;       // a robot that has been silent for so long has stopped, since its base has a watchdog

}  // namespace

OrderDesk::OrderDesk(const OrderMissions& missions, const sim::Knowledge& idle, wire::Exchange& exchange, vda5050::Vehicle& vehicle, vda5050::Link& link)
    : missions_(missions), idle_(idle), exchange_(exchange), vehicle_(vehicle), link_(link), start_(idle.find(missions.command())), turn_(idle.find(missions.turn_command())), abort_(idle.find("Abort")), pause_(idle.find("Pause")), route_(idle.find(missions.route())) {
  exchange_.keep_place(true);   // nobody carries it between two missions without saying so
}

void OrderDesk::step() {
  silent_ = false;
  hear_line(*exchange_.line());
  follow_mission();
  deal(t_us_);
}

void OrderDesk::wait(std::int64_t silent_us) {
  silent_ = silent_us >= kSilentUs;
  if (silent_) stand();
  deal(t_us_ + silent_us);
}

void OrderDesk::leave() {
  stand();
  vehicle_.observe(progress(), condition_, {}, {link_.utc_us(dealt_us_), dealt_us_});
  send();
  link_.send(vehicle_.farewell(link_.utc_us(dealt_us_)), dealt_us_);
}

void OrderDesk::send() {
  for (const vda5050::Message& message : vehicle_.take_messages()) link_.send(message, dealt_us_);
}

void OrderDesk::hear_line(const wire::Line& line) {
  const float dt_s = exchange_.period_s();
  t_us_ = exchange_.now_us();
  here_ = line.tag ? line.tag->landmark.text : std::string();
  wire::put(line.vehicle, condition_);
  action_states_.insert(action_states_.end(), line.actions.begin(), line.actions.end());
  hear_turn(line.senses, dt_s);
  speed_m_s_ = static_cast<double>(line.senses.odometry_known ? line.senses.speed_m_s : exchange_.wheels().speed_m_s);
  if (!line.senses.odometry_known) return;
  since_m_ += static_cast<double>(odometer_.way_m(line.senses, dt_s));
  odometer_.take(line.senses);
}

/// The rate of turn is taken from odometry, else from the command to the wheels; a compass is too noisy for it.
void OrderDesk::hear_turn(const mts::Senses& senses, float dt_s) {
  if (!senses.turned_known) {
    turn_rad_s_.value = exchange_.wheels().turn_rad_s;
    turned_rad_.reset();
    return;
  }
  const auto turned_rad = static_cast<float>(sim::wrap(static_cast<double>(senses.turned_rad - turned_rad_.value_or(senses.turned_rad))));
  if (dt_s > 0.0f) turn_rad_s_.step(turned_rad / dt_s, kTurnTau_s, dt_s);
  turned_rad_ = senses.turned_rad;
}

void OrderDesk::follow_mission() {
  const sim::Driver& driver = exchange_.driver();
  const std::size_t before = reached_;
  if (phase_ == Phase::kRefused) phase_ = Phase::kOver;
  if (phase_ == Phase::kStarting && on_order()) phase_ = Phase::kDriving;
  if (phase_ == Phase::kDriving && on_order()) {
    const sim::Leg* leg = driver.leg();
    const auto visit = leg != nullptr ? missions_.visit_of(leg->name, task_.start) : std::nullopt;
    if (visit) reached_ = std::max(reached_, *visit);
  } else if (phase_ == Phase::kDriving) {
    const bool at_last = !driver.on_mission() && reached_ + 1 == task_.visits() && driver.mind().seen(knowledge().find(task_.way.back().landmark));
    if (at_last) ++reached_;
    phase_ = Phase::kOver;
  }
  if (reached_ != before) since_m_ = 0.0;
  const auto keep_since = [this](bool holds, std::optional<std::int64_t>& since_us) { since_us = holds ? since_us.value_or(t_us_) : std::optional<std::int64_t>(); };
  const bool says_nothing = phase_ == Phase::kDriving && !driver.reports_any();
  keep_since(says_nothing && driver.lost() && !exchange_.waits() && !vehicle_.task().paused, lost_us_);
  keep_since(says_nothing && driver.strategy() != nullptr && driver.strategy()->name == "Stop" && !driver.in_crossing(), stopped_us_);
}

vda5050::Progress OrderDesk::progress() const {
  vda5050::Progress progress;
  progress.task = task_.number;
  progress.reached = reached_;
  progress.on_mission = phase_ == Phase::kDriving || phase_ == Phase::kRefused;
  if (on_its_own()) progress.own_mission = knowledge().program->cells[program::index(exchange_.driver().mission())].name;
  const sim::Strategy* strategy = exchange_.driver().strategy();
  progress.held = pause_ != program::CellId::kNone && exchange_.driver().mind().seen(pause_);
  progress.waits = !progress.held && strategy != nullptr && strategy->name == "Hold";
  progress.stopped = stopped_us_ && t_us_ - *stopped_us_ >= kStopsUs && !exchange_.waits() && !vehicle_.task().paused;
  progress.speed_m_s = speed_m_s_;
  progress.turn_rad_s = static_cast<double>(turn_rad_s_.value);
  progress.since_m = since_m_;
  progress.here = here_;
  if (auto at = exchange_.driver().place()) progress.at = {{std::move(at->landmark), std::move(at->exit)}, at->along_m, at->outwards};
  progress.silent = silent_;
  progress.in_crossing = exchange_.driver().in_crossing();
  progress.reports = exchange_.driver().reports();
  if (lost_us_ && t_us_ - *lost_us_ >= kLostUs) progress.reports.emplace_back("Help.lost");   // reported here, because no rule watches this strategy
  if (exchange_.waits()) progress.reports.insert(progress.reports.begin(), "Help.power");
  return progress;
}

// See note [order of a desk].
void OrderDesk::deal(std::int64_t t_us) {
  t_us = dealt_us_ = std::max(dealt_us_, t_us);
  const std::int64_t utc_us = link_.utc_us(t_us);
  if (link_.connected_anew()) vehicle_.tell_again(utc_us);
  vehicle_.observe(progress(), condition_, action_states_, {utc_us, t_us});
  action_states_.clear();
  while (const auto message = link_.next(t_us)) vehicle_.hear(*message, utc_us);
  if (const auto place = vehicle_.take_place()) exchange_.put(place->road.landmark, place->road.exit, place->along_m);
  const bool on_a_mission_by_hand = exchange_.driver().on_mission() && !on_order();
  if (vehicle_.in_hand() && !on_a_mission_by_hand) exchange_.forget_place();
  set_task();
  give_actions();
  send();
}

/// Gives the host as many actions as fit into a line. It gets the others when these are done.
void OrderDesk::give_actions() {
  constexpr std::size_t kAround = 96, kEscaped = 6;   // `"id":"",...,"cancel":true`; a byte as `\u0001`
  std::vector<vda5050::HostAction> actions = vehicle_.host_actions();
  std::size_t bytes = 0;
  const auto rest = std::find_if(actions.begin(), actions.end(), [&](const vda5050::HostAction& action) {
    bytes += kAround + kEscaped * (action.id.size() + action.type.size()) + action.parameters.size();
    return bytes > kMostActionBytes;
  });
  actions.erase(rest, actions.end());
  exchange_.set_actions(std::move(actions));
}

void OrderDesk::set_task() {
  const vda5050::Task& task = vehicle_.task();
  if (on_its_own()) return give_up();
  exchange_.hold(task.paused && vehicle_.obeys());   // a robot that is driven by hand has no task
  if (task.number != task_.number || task.way.empty()) {
    if (exchange_.driver().on_mission()) return give_up();   // the mission that is being driven has to end first
    task_ = task;
    reached_ = task.start == vda5050::Start::kBeyond ? 1 : 0;
    phase_ = task.way.empty() ? Phase::kResting : take_way(task) ? Phase::kStarting : Phase::kRefused;
    if (phase_ == Phase::kStarting) press_start();
  } else if (task.passed != task_.passed || task.way != task_.way) {
    task_ = task;
    static_cast<void>(take_way(task));   // if the new way cannot be compiled, the present one ends as it would have
  } else if (phase_ == Phase::kStarting && t_us_ - pressed_us_ >= kPressAgainUs) {
    press_start();
  }
}

// A user's own library may have no such button. Then the robot at least stands.
void OrderDesk::give_up() {
  if (abort_ != program::CellId::kNone) exchange_.press(abort_);
  else exchange_.hold(true);
}

bool OrderDesk::take_way(const vda5050::Task& task) {
  auto mission = missions_.make(task);
  if (mission == nullptr) return false;
  if (!sim::can_take(idle_, mission->knowledge)) throw std::logic_error("a route has changed the facts or strategies of its knowledge base");
  exchange_.take(mission->knowledge);
  mission_ = std::move(mission);   // the one before is no longer needed
  route_ = knowledge().find(missions_.route());
  return true;
}

void OrderDesk::press_start() {
  exchange_.press(start_);
  if (task_.start == vda5050::Start::kBack && turn_ != program::CellId::kNone) exchange_.press(turn_);
  pressed_us_ = t_us_;
}

}  // namespace kb::cli
