#include "bench/peers/by_switch.h"

#include <bit>

namespace peers {

Strategy SwitchMind::tick(std::uint32_t dt_us) {
  if (!r_.first) r_.now_us += dt_us;
  r_.look();
  r_.first = false;
  const bool obeyed = goal();
  route();
  if (obeyed) set_out(r_.m);
  map();
  turn();
  passage();
  drive();
  return r_.ran = strategy();
}

/// Missions begin, end, and are given up. Says whether one has begun.
bool SwitchMind::goal() {
  Mission& m = r_.m;
  const bool ends = m.leg == Leg::kTo15 && m.route && m.watch == Watch::kLooking && r_.sees(Fact::LM15);
  if (ends || r_.is(Fact::Abort)) {
    m = Mission{};
    return false;
  }
  const bool passed = m.asks_marking && r_.event(Fact::CrossBy_mark);
  const bool met = r_.event(Fact::Obst);
  if (passed) m.asks_marking = false;
  if (met) m.asks_marking = true;
  if (!r_.event(Fact::Start1) || !m.listens || m.route) return false;
  m.route = true;
  return true;
}

void SwitchMind::route() {
  Mission& m = r_.m;
  bool apart[kLegs];
  for (int l = 1; l < kLegs; ++l) {
    apart[l] = r_.two_seen[l].held(!r_.sees(kLegData[l].to) || !r_.sees(kLegData[l].from), r_.now_us, 300'000);
  }
  const auto resumes = [this, &m] {
    return r_.sees(Fact::LM13) && (m.awaits_13 || m.leg == Leg::kTo13 || m.leg == Leg::kDetourTo13);
  };
  const bool resume = resumes(), rises = resume && !r_.resumes;
  const std::size_t l = static_cast<std::size_t>(m.leg);
  switch (m.watch) {
    case Watch::kArrived:
      if (m.leg == Leg::kTo13 && (r_.low & bit(Fact::Safe)) != 0) {
        m.leg = Leg::kDetourTo11;
        m.awaits_13 = true;
      }
      break;
    case Watch::kLooking:
      if (m.leg != Leg::kNone && m.leg != Leg::kTo15 && r_.sees(kLegData[l].to)) arrive(m, kLegData[l].next);
      break;
    case Watch::kNone:
      if (m.leg != Leg::kNone && m.leg != Leg::kTo5 && m.line != Line::kOut && apart[l]) m.watch = Watch::kLooking;
      break;
  }
  if (rises) m.awaits_13 = false;
  r_.resumes = rises ? resumes() : resume;
}

/// Which exit leads to the goal, and where the robot came from; each is asked once a landmark.
void SwitchMind::map() {
  Mission& m = r_.m;
  if (m.watch != Watch::kArrived) {
    r_.road = Robot::kNoRoad;
    r_.came_from = 0;
    return;
  }
  std::uint8_t road = Robot::kNoRoad;
  if (m.leg != Leg::kNone && m.leg != Leg::kTo5) {
    const Side exit = kLegData[static_cast<std::size_t>(m.leg)].exit;
    const bool closed = ((r_.sides(Fact::Closed_N) >> static_cast<unsigned>(exit)) & 1u) != 0;
    road = static_cast<std::uint8_t>(2u * static_cast<unsigned>(m.leg) + (closed ? 1u : 0u));
    if (road != r_.road) {
      m.out = closed ? Side::kNone : exit;
      if (closed) m.turn = Turn::kNone;
    }
  }
  r_.road = road;
  const std::uint8_t in = r_.sides(Fact::In_N), news = static_cast<std::uint8_t>(in & ~r_.came_from);
  if (news != 0) m.came = static_cast<Side>(std::countr_zero(news));
  r_.came_from = in;
}

void SwitchMind::turn() {
  Mission& m = r_.m;
  if (m.came != Side::kNone && m.out != Side::kNone) m.turn = kTurnOf[static_cast<std::size_t>(m.came)][static_cast<std::size_t>(m.out)];
  if (m.line == Line::kIn && !m.astride && r_.sees(Fact::Line)) m.line = Line::kGate;
}

/// Stop line in, manoeuvre, stop line out.
void SwitchMind::passage() {
  Mission& m = r_.m;
  const bool stands = r_.arrived.held(m.watch == Watch::kArrived, r_.now_us, 100'000);
  if (m.help != 0 && !m.astray && (r_.ran_move() || r_.ran_cross())) m.help = 0;
  if (m.watch == Watch::kArrived) m.driving = false;
  const bool turns = m.turn != Turn::kNone;
  switch (m.line) {
    case Line::kGate: {
      const bool may = r_.is(Fact::Safe) || (m.leg == Leg::kDetourTo11 && (r_.low & bit(Fact::Safe)) != 0);
      const std::uint8_t methods = r_.methods(Fact::CrossBy_mark);
      if (stands && may && turns && methods != 0) enter(m, methods);
      break;
    }
    case Line::kOut:
      if (!m.astride && r_.sees(Fact::Line)) leave(m);
      break;
    default:
      break;
  }
  if (turns) m.out = Side::kNone;
}

/// How a road is driven, and what takes over when that fails.
void SwitchMind::drive() {
  Mission& m = r_.m;
  const bool wanting = m.driving && m.moves == 0;
  const bool any_cross = m.crosses != 0;
  if (r_.off_line.held(!r_.sees(Fact::Line), r_.now_us, 200'000)) m.astride = false;
  trouble();
  road(wanting, any_cross);
}

void SwitchMind::road(bool wanting, bool any_cross) {
  Mission& m = r_.m;
  const std::int64_t now = r_.now_us;
  const std::uint8_t before = m.moves, track = r_.methods(Fact::Track_mark), asked = m.asked;
  const bool obstacle = r_.is(Fact::Obst), avoids = r_.ran == Strategy::Avoid;
  const bool patient = r_.wants_method.held(wanting, now, 500'000);
  const std::uint8_t by = r_.methods(Fact::MoveBy_mark);
  if (wanting && by != 0) m.moves = m.asked = by;
  if (wanting && patient) m.moves = static_cast<std::uint8_t>(m.moves | track);
  bool passed = r_.clear.held(!obstacle, now, 300'000) && any_cross;
  std::uint8_t back = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const unsigned method = 1u << k;
    const bool on = (track & method) != 0, moved = r_.ran == static_cast<Strategy>(static_cast<unsigned>(Strategy::Move_mark) + k);
    if (r_.no_track[k].held(moved && !on, now, 300'000)) m.moves = static_cast<std::uint8_t>(m.moves & ~method);
    if (r_.on_track[k].held(on, now, 1'000'000) && (asked & method) != 0 && m.driving && before != 0) back = static_cast<std::uint8_t>(method);
    if (r_.clear_track[k].held(on && !obstacle, now, 300'000) && (before & method) != 0) passed = true;
  }
  if (back != 0) m.moves = back;
  if (!m.driving) m.moves = m.asked = 0;
  if (obstacle && (r_.ran_move() || r_.ran_cross())) m.avoid = true;
  if (avoids && (passed || m.line == Line::kGate)) m.avoid = false;
}

/// What has no end is reported, and the robot stands.
void SwitchMind::trouble() {
  Mission& m = r_.m;
  const std::int64_t now = r_.now_us;
  const bool gate = m.line == Line::kGate, oriented = m.watch == Watch::kArrived && m.came != Side::kNone;
  const bool was_blocked = m.blocked;
  if (m.search && (!gate || oriented)) m.search = false;
  if (r_.unread.held(gate && !oriented, now, 1'000'000)) m.search = true;
  if (r_.searches.held(r_.ran == Strategy::Search, now, 10'000'000)) m.help |= kLost;
  if (r_.refused.held(gate && oriented, now, 30'000'000)) m.help |= kRefused;
  if (r_.stuck.held(m.driving && m.moves == 0 && !gate, now, 10'000'000)) m.help |= kNoTrack;
  if (r_.avoids.held(r_.ran == Strategy::Avoid, now, 20'000'000)) m.blocked = true;
  const bool clear_long = r_.clear_long.held(!r_.is(Fact::Obst), now, 2'000'000);
  if (was_blocked && r_.ran == Strategy::Stop && clear_long) m.blocked = false;
  if (was_blocked) m.help |= kBlocked;
  if (r_.crossing.held(r_.ran_cross(), now, 60'000'000)) {
    m.astray = true;
    m.help |= kAstray;
  }
}

Strategy SwitchMind::strategy() const {
  const Mission& m = r_.m;
  if (m.search) return Strategy::Search;
  if (m.line == Line::kGate || m.blocked || m.astray) return Strategy::Stop;
  if (m.avoid) return Strategy::Avoid;
  if (m.crosses != 0) return static_cast<Strategy>(std::countr_zero(m.crosses));
  if (m.moves != 0) return static_cast<Strategy>(static_cast<unsigned>(Strategy::Move_mark) + static_cast<unsigned>(std::countr_zero(m.moves)));
  return kNoStrategy;
}

}  // namespace peers
