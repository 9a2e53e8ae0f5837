// What the robot does with its task, and what comes next.
#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/kbc/vda5050/vehicle_state.h"

namespace kb::vda5050 {
namespace {

// Between both it is as before, so that a noisy odometry does not make a message of each line.
constexpr double kMoves_m_s = 0.02, kMoves_rad_s = 0.05;
constexpr double kRests_m_s = 0.005, kRests_rad_s = 0.0125;

double number(double value) { return std::isfinite(value) ? value : 0.0; }

bool blocks(const Node& node) {
  return std::any_of(node.actions.begin(), node.actions.end(), [](const Action& action) { return action.blocking != Blocking::kNone; });
}

}  // namespace

void Vehicle::State::follow(const Progress& now, std::int64_t passed_us) {
  speed_m_s = number(now.speed_m_s);
  turn_rad_s = number(now.turn_rad_s);
  const auto faster = [this](double speed, double turn) { return std::abs(speed_m_s) > speed || std::abs(turn_rad_s) > turn; };
  driving = driving ? faster(kRests_m_s, kRests_rad_s) : faster(kMoves_m_s, kMoves_rad_s);
  here = now.here;
  reports = now.reports;
  helpless_us = driving || reports.empty() || paused ? 0 : helpless_us + passed_us;
  const double before_m = std::exchange(since_m, std::max(number(now.since_m), 0.0));
  if (now.task != stretch.task().number || !stretch.given()) {
    on_mission = false;
    return;
  }
  on_mission = now.on_mission;
  was_on_mission = was_on_mission || on_mission;
  const std::size_t all = stretch.task().way.size(), seen = std::min(now.reached, all);
  if (seen > reached) {
    if (reached > 0) passed_m += before_m;
    reached = seen;
  }
  for (const std::size_t node = stretch.node_at(reached); book.at() < node;) reach_next();
  if (under_way() && on_mission && driving) actions.trigger(Doing::Origin::kEdge, book.edges()[book.at()].sequence);
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
  actions.trigger(Doing::Origin::kNode, book.last_sequence());
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
    const std::size_t end = stretch.last();
    const bool full = stretch.task().way.size() > kMostNodes || end - stretch.first() > kMostNodes;
    if (end < book.base_end() && !blocks(book.nodes()[end]) && !full) stretch.grow(book.nodes(), book.edges(), next_stop(end));
    return;
  }
  while (book.base_left() && !actions.must_stand() && book.edges()[book.at()].way.empty()) reach_next();   // both nodes are at one spot
  if (!book.base_left() || actions.must_stand()) return;
  book.forget_passed();
  stretch.begin(book.nodes(), book.edges(), 0, next_stop(0));
  on_mission = was_on_mission = false;
  reached = 0;
  changed = true;
}

void Vehicle::State::settle() {
  drive();
  actions.begin(stands());
  finish_pause();
  if (cancelling && under_way() && helpless()) {   // 6.6.3 knows no vehicle that cannot come to a node; its master may send help another way
    stretch.close();
    book.cut(0);
  }
  if (!cancelling || !stands() || actions.order_live()) return;
  stretch.close();
  book.drop();
  gave_up = false;
  end_cancel("");
}

/// Where it is, for `agvPosition`; and which node is the last one while no order leads it.
void Vehicle::State::place() {
  const std::vector<Visit>& way = stretch.task().way;
  if (way.size() > 1) {
    const std::size_t last = std::clamp<std::size_t>(reached, 1, way.size() - 1);
    fix = {way[last - 1], way[last].landmark, reached == way.size() ? 1e9 : since_m};
  } else if (!here.empty() && (!fix || fix->to != here)) {
    fix = {{here}, here, 0.0};
  } else if (fix && fix->to == book.last_landmark() && !driving) {
    fix->metres = 1e9;   // it has come there
  }
  if (active() || !stands() || here.empty() || here == book.last_landmark()) return;
  if (std::optional<std::string> node = plant.node_at(here)) book.stand_at(std::move(*node), here);
}

}  // namespace kb::vda5050
