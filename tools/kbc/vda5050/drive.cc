// Follows the robot's progress on its task, and decides what it does next.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/kbc/vda5050/vehicle_state.h"

namespace kb::vda5050 {
namespace {

// It drives above the first pair and stands below the second. In between nothing changes, so that noise of the odometry does not cause
// messages.
constexpr double kMoves_m_s = 0.02, kMoves_rad_s = 0.05;
constexpr double kRests_m_s = 0.005, kRests_rad_s = 0.0125;

double number(double value) { return std::isfinite(value) ? value : 0.0; }

bool blocks(const Node& node) {
  return std::any_of(node.actions.begin(), node.actions.end(), [](const Action& action) { return action.blocking != Blocking::kNone; });
}

}  // namespace

/// Takes over what the robot is like now, whatever its task.
void Vehicle::State::sense(const Progress& now, std::int64_t passed_us) {
  speed_m_s = number(now.speed_m_s);
  turn_rad_s = number(now.turn_rad_s);
  const auto faster = [this](double speed, double turn) { return std::abs(speed_m_s) > speed || std::abs(turn_rad_s) > turn; };
  driving = driving ? faster(kRests_m_s, kRests_rad_s) : faster(kMoves_m_s, kMoves_rad_s);
  here = now.here;
  at = now.at;
  if (!at) on_road.reset();
  else if (!at->road.exit.empty()) on_road = at;
  const bool turned_away = at && came_by && at->outwards && !came_by->outwards;
  if (!at || !came_by || at->road != came_by->road || turned_away) came_by.reset();
  if (at && !at->outwards && at->road.landmark == here) came_by = at;   // at the node that it faces, though no order has led it there
  reports = now.reports;
  held = now.held;
  waits = now.waits;
  stopped = now.stopped;
  in_crossing = now.in_crossing;
  silent = now.silent;
  if (std::exchange(own_mission, now.own_mission) != now.own_mission && !own_mission.empty()) {
    Complaint complaint{"ownMission", fmt::format("the robot has begun `{}` by itself, and is stopped: its ways are the master's", own_mission)};
    if (!book.id().empty()) complaint.references = {{"orderId", book.id()}};
    complain(std::move(complaint));
  }
  const bool comes_on = std::abs(speed_m_s) > kMoves_m_s;   // a robot that turns on the spot is looking for its way
  stood_us = comes_on || paused ? 0 : stood_us + passed_us;
  helpless_us = stood_us == 0 || (reports.empty() && !silent) ? 0 : helpless_us + passed_us;
}

/// See note [where an order is believed to begin]. Before a sign that the mission does not expect, the robot would only look round, and its master
/// would not learn why.
void Vehicle::State::check_first_sign() {
  if (in_crossing) set_down = believed = false;
  const bool expects_next = stretch.given() && stretch.task().start == Start::kBeyond;
  const bool behind = came_by && came_by->outwards && here == came_by->road.landmark;   // it faces the first node from the road that begins there
  if (!believed || expects_next || behind || here.empty() || book.nodes().empty() || here == book.nodes().front().landmark) return;
  believed = false;
  const Node& first = book.nodes().front();
  const std::string node = plant.node_at(here).value_or(here);
  complain({"orderError", fmt::format("the order begins at node `{}`; the sign that the vehicle reads is that of `{}`", first.id, node), {{"orderId", book.id()}, {"orderUpdateId", std::to_string(book.update())}, {"nodeId", first.id}}});
  gave_up = active();   // an order of one node is over already
  stretch.close();
  on_mission = was_on_mission = false;
}

/// What is known of its place is what it reads.
void Vehicle::State::forget_place() {
  set_down = true;
  believed = false;
  came_by.reset();
  if (at && at->road.exit.empty()) on_road.reset();
  if (here.empty() && !at) book.stand_at({}, {});
}

void Vehicle::State::follow(const Progress& now, std::int64_t passed_us) {
  sense(now, passed_us);
  check_first_sign();
  const double before_m = std::exchange(since_m, std::max(number(now.since_m), 0.0));
  if (now.task != stretch.task().number || !stretch.given()) {
    on_mission = false;
    return;
  }
  on_mission = now.on_mission;
  was_on_mission = was_on_mission || on_mission;
  const std::size_t all = stretch.task().visits(), seen = std::min(now.reached, all);
  if (seen > reached) {
    if (reached > 0) passed_m += before_m;
    reached = seen;
  }
  if (reached > 0 && book.goes_back()) book.come_back(), arrive();
  for (const std::size_t node = stretch.node_at(reached); book.at() < node; believed = false) reach_next();
  const bool left_first = reached > 0;   // until its sign is read, the first edge is not entered (6.10.2)
  if (under_way() && left_first && !book.goes_back() && on_mission && driving) actions.trigger(ActionState::Origin::kEdge, book.edges()[book.at()].sequence);
  if (on_mission || paused) return;
  if (reached == all || (was_on_mission && stretch.ended_at(reached))) {
    stretch.close();
  } else if (was_on_mission) {
    stretch.close();
    gave_up = changed = true;
  }
}

void Vehicle::State::reach_next() {
  actions.leave_edge(book.edges()[book.at()].sequence);
  book.reach_next();
  arrive();
}

void Vehicle::State::arrive() {
  if (at) came_by = at;
  actions.trigger(ActionState::Origin::kNode, book.last_sequence());
  passed_m = 0.0;
  changed = true;
}

/// See note [a way in stretches].
std::size_t Vehicle::State::next_stop(std::size_t from) const {
  std::size_t stop = from;
  while (stop < book.base_end()) {
    if (blocks(book.nodes()[++stop])) break;
  }
  return stop;
}

void Vehicle::State::drive() {
  if (cancelling || gave_up || paused) return;
  if (under_way()) {
    if (stretch.last() == book.base_end() || blocks(book.nodes()[stretch.last()])) return;
    stretch.forget_passed(book.at(), reached);   // else each update of an endless order would cost more than the one before
    book.forget_passed();
    const std::size_t end = stretch.last();
    if (stretch.task().way.size() <= kMostNodes) stretch.grow(book.nodes(), book.edges(), next_stop(end));
    return;
  }
  const auto at_one_spot = [this] { return beyond() == nullptr && !book.goes_back() && book.base_left() && book.edges()[book.at()].way.empty(); };
  while (!actions.must_stand() && at_one_spot()) reach_next();
  if (book.base_left() && !actions.must_stand()) begin_stretch();
}

/// The landmark at which the robot is, or the one that lies behind it.
std::string Vehicle::State::where() const {
  if (!here.empty()) return here;
  return left_node() ? at->road.landmark : book.last_landmark();
}

const Whereabouts* Vehicle::State::beyond() const { return left_node() && at->road.landmark == where() ? &*at : nullptr; }

/// See note [beyond a node].
void Vehicle::State::begin_stretch() {
  book.forget_passed();
  const Whereabouts* where_on = beyond();
  const bool goes_on = where_on != nullptr && !book.goes_back() && leads_on({}, &book.edges().front(), *where_on);
  if (where_on != nullptr && !goes_on) book.go_back();
  const bool turns = where_on != nullptr && !goes_on && where_on->outwards;
  if (turns && !plant.leads_back(where_on->road)) {   // only an update comes here: a new order would have been refused
    gave_up = changed = true;
    return;
  }
  const Start start = goes_on ? Start::kBeyond : turns ? Start::kBack : Start::kBefore;
  stretch.begin(book.nodes(), book.edges(), 0, book.goes_back() && blocks(book.nodes().front()) ? 0 : next_stop(0), start);
  on_mission = was_on_mission = false;
  reached = 0;
  changed = true;
}

void Vehicle::State::settle() {
  drive();
  actions.begin(stands());
  finish_pause();
  // 6.6.3 does not say what a vehicle does that cannot come to the next node. It ends the order, so that its master can send another.
  if (cancelling && stretch.given() && (helpless() || rests_in_pause())) {
    stretch.close();
    book.cut(0);
  }
  if (!cancelling || !stands() || actions.order_live()) return;
  stretch.close();
  book.drop();
  gave_up = false;
  end_cancel("");
}

/// Without an order, the last node is the one at which the robot was moved to stand.
void Vehicle::State::stand() {
  if (active() || !stands()) return;
  if (!here.empty() && at && at->road.landmark != here) came_by = at;   // remembers the road, as the sign of the landmark may be out of sight at times
  if (where() == book.last_landmark()) return;
  if (std::optional<std::string> node = plant.node_at(where())) book.stand_at(std::move(*node), where());
}

}  // namespace kb::vda5050
