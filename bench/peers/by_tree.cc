#include "bench/peers/by_tree.h"

#include <bit>

namespace peers {

using tree::act;
using tree::all;
using tree::fallback;
using tree::NodePtr;
using tree::sequence;
using tree::when;

TreeMind::TreeMind() {
  root_ = all(act([this] { r_.look(); }), goal(), route(), map(), turn(), passage(), drive(), strategy());
}

/// Missions begin, end, and are given up.
NodePtr TreeMind::goal() {
  Mission& m = r_.m;
  NodePtr ends = sequence(when([&m] { return m.leg == Leg::kTo15; }), when([&m] { return m.route; }),
                          when([&m] { return m.watch == Watch::kLooking; }), when([this] { return r_.sees(Fact::LM15); }));
  NodePtr given_up = when([this] { return r_.is(Fact::Abort); });
  NodePtr obstacle = all(sequence(when([&m] { return m.asks_marking; }), when([this] { return r_.event(Fact::CrossBy_mark); }),
                                  act([&m] { m.asks_marking = false; })),
                         sequence(when([this] { return r_.event(Fact::Obst); }), act([&m] { m.asks_marking = true; })));
  NodePtr obey = sequence(when([this] { return r_.event(Fact::Start1); }), when([&m] { return m.listens; }),
                          when([&m] { return !m.route; }), act([this, &m] { m.route = obeyed_ = true; }));
  return all(act([this] { obeyed_ = false; }), fallback(sequence(fallback(std::move(ends), std::move(given_up)), act([&m] { m = Mission{}; })),
                                                        all(std::move(obstacle), std::move(obey))));
}

NodePtr TreeMind::route() {
  Mission& m = r_.m;
  const auto resumes = [this, &m] {
    return r_.sees(Fact::LM13) && (m.awaits_13 || m.leg == Leg::kTo13 || m.leg == Leg::kDetourTo13);
  };
  NodePtr clocks = act([this] {
    for (int l = 1; l < kLegs; ++l) {
      c_.apart[l] = r_.two_seen[l].held(!r_.sees(kLegData[l].to) || !r_.sees(kLegData[l].from), r_.now_us, 300'000);
    }
    before_ = r_.m;
  });
  NodePtr detour = sequence(when([&m] { return m.watch == Watch::kArrived; }), when([&m] { return m.leg == Leg::kTo13; }),
                            when([this] { return (r_.low & bit(Fact::Safe)) != 0; }), act([&m] {
                              m.leg = Leg::kDetourTo11;
                              m.awaits_13 = true;
                            }));
  NodePtr come = sequence(when([&m] { return m.watch == Watch::kLooking; }),
                          when([&m] { return m.leg != Leg::kNone && m.leg != Leg::kTo15; }),
                          when([this, &m] { return r_.sees(kLegData[static_cast<std::size_t>(m.leg)].to); }),
                          act([&m] { arrive(m, kLegData[static_cast<std::size_t>(m.leg)].next); }));
  NodePtr look_out = sequence(when([&m] { return m.watch == Watch::kNone; }), when([&m] { return m.line != Line::kOut; }),
                              when([&m] { return m.leg != Leg::kNone && m.leg != Leg::kTo5; }),
                              when([this, &m] { return c_.apart[static_cast<std::size_t>(m.leg)]; }),
                              act([&m] { m.watch = Watch::kLooking; }));
  NodePtr found = fallback(sequence(when([this] { return !r_.resumes; }), when([this] { return c_.apart[0]; }), act([this, &m, resumes] {
                                      m.awaits_13 = false;
                                      r_.resumes = resumes();
                                    })),
                           act([this] { r_.resumes = c_.apart[0]; }));
  return all(std::move(clocks), act([this, resumes] { c_.apart[0] = resumes(); }), fallback(std::move(detour), std::move(come), std::move(look_out)),
             std::move(found), sequence(when([this] { return obeyed_; }), act([&m] { peers::set_out(m); })));
}

/// The exit of the current leg, asked once a landmark.
void TreeMind::note_road() {
  Mission& m = r_.m;
  const Side exit = kLegData[static_cast<std::size_t>(m.leg)].exit;
  const bool closed = ((r_.sides(Fact::Closed_N) >> static_cast<unsigned>(exit)) & 1u) != 0;
  const auto road = static_cast<std::uint8_t>(2u * static_cast<unsigned>(m.leg) + (closed ? 1u : 0u));
  if (road != r_.road) {
    m.out = closed ? Side::kNone : exit;
    if (closed) m.turn = Turn::kNone;
  }
  r_.road = road;
}

NodePtr TreeMind::map() {
  Mission& m = r_.m;
  NodePtr road = fallback(sequence(when([&m] { return m.leg != Leg::kNone && m.leg != Leg::kTo5; }), act([this] { note_road(); })),
                          act([this] { r_.road = Robot::kNoRoad; }));
  NodePtr came = act([this, &m] {
    const std::uint8_t in = r_.sides(Fact::In_N), news = static_cast<std::uint8_t>(in & ~r_.came_from);
    if (news != 0) m.came = static_cast<Side>(std::countr_zero(news));
    r_.came_from = in;
  });
  return fallback(sequence(when([&m] { return m.watch == Watch::kArrived; }), all(std::move(road), std::move(came))), act([this] {
                    r_.road = Robot::kNoRoad;
                    r_.came_from = 0;
                  }));
}

NodePtr TreeMind::turn() {
  Mission& m = r_.m;
  return all(sequence(when([&m] { return m.came != Side::kNone; }), when([&m] { return m.out != Side::kNone; }),
                      act([&m] { m.turn = kTurnOf[static_cast<std::size_t>(m.came)][static_cast<std::size_t>(m.out)]; })),
             sequence(when([&m] { return m.line == Line::kIn; }), when([&m] { return !m.astride; }),
                      when([this] { return r_.sees(Fact::Line); }), act([&m] { m.line = Line::kGate; })));
}

/// Stop line in, manoeuvre, stop line out.
NodePtr TreeMind::passage() {
  Mission& m = r_.m;
  NodePtr clock = act([this, &m] {
    before_ = m;
    c_.patient = r_.arrived.held(m.watch == Watch::kArrived, r_.now_us, 100'000);
  });
  NodePtr relieve = sequence(when([&m] { return m.help != 0; }), when([&m] { return !m.astray; }),
                             when([this] { return r_.ran_move() || r_.ran_cross(); }), act([&m] { m.help = 0; }));
  NodePtr may = fallback(when([this] { return r_.is(Fact::Safe); }),
                         sequence(when([&m] { return m.leg == Leg::kDetourTo11; }), when([this] { return (r_.low & bit(Fact::Safe)) != 0; })));
  NodePtr go_in = sequence(when([&m] { return m.line == Line::kGate; }), when([this] { return c_.patient; }), std::move(may),
                           when([&m] { return m.turn != Turn::kNone; }), when([this] { return r_.methods(Fact::CrossBy_mark) != 0; }),
                           act([this, &m] { enter(m, r_.methods(Fact::CrossBy_mark)); }));
  NodePtr go_out = sequence(when([&m] { return m.line == Line::kOut; }), when([&m] { return !m.astride; }),
                            when([this] { return r_.sees(Fact::Line); }), act([&m] { leave(m); }));
  NodePtr stop_driving = sequence(when([&m] { return m.watch == Watch::kArrived; }), act([&m] { m.driving = false; }));
  NodePtr spend = sequence(when([this] { return before_.turn != Turn::kNone; }), act([&m] { m.out = Side::kNone; }));
  return all(std::move(clock), std::move(relieve), std::move(stop_driving), fallback(std::move(go_out), std::move(go_in)), std::move(spend));
}

void TreeMind::look_at_clocks() {
  const Mission& m = before_ = r_.m;
  const std::int64_t now = r_.now_us;
  const std::uint8_t track = r_.methods(Fact::Track_mark);
  const bool obstacle = r_.is(Fact::Obst), gate = m.line == Line::kGate, oriented = m.watch == Watch::kArrived && m.came != Side::kNone;
  for (unsigned k = 0; k < 3; ++k) {
    const bool on = (track >> k & 1u) != 0;
    const bool moved = r_.ran == static_cast<Strategy>(static_cast<unsigned>(Strategy::Move_mark) + k);
    c_.no_track[k] = r_.no_track[k].held(moved && !on, now, 300'000);
    c_.on_track[k] = r_.on_track[k].held(on, now, 1'000'000);
    c_.clear_track[k] = r_.clear_track[k].held(on && !obstacle, now, 300'000);
  }
  c_.patient = r_.wants_method.held(m.driving && m.moves == 0, now, 500'000);
  c_.clear = r_.clear.held(!obstacle, now, 300'000);
  c_.clear_long = r_.clear_long.held(!obstacle, now, 2'000'000);
  c_.off_line = r_.off_line.held(!r_.sees(Fact::Line), now, 200'000);
  c_.unread = r_.unread.held(gate && !oriented, now, 1'000'000);
  c_.searches = r_.searches.held(r_.ran == Strategy::Search, now, 10'000'000);
  c_.refused = r_.refused.held(gate && oriented, now, 30'000'000);
  c_.stuck = r_.stuck.held(m.driving && m.moves == 0 && !gate, now, 10'000'000);
  c_.avoids = r_.avoids.held(r_.ran == Strategy::Avoid, now, 20'000'000);
  c_.crossing = r_.crossing.held(r_.ran_cross(), now, 60'000'000);
}

/// One method of driving along a road: lost, back again, or its obstacle passed.
NodePtr TreeMind::method(unsigned k) {
  Mission& m = r_.m;
  const std::uint8_t method = static_cast<std::uint8_t>(1u << k);
  NodePtr lost = sequence(when([this, k] { return c_.no_track[k]; }), act([&m, method] { m.moves = static_cast<std::uint8_t>(m.moves & ~method); }));
  NodePtr back = sequence(when([this, k] { return c_.on_track[k]; }), when([this, method] { return (before_.asked & method) != 0; }),
                          when([&m] { return m.driving; }), when([this] { return before_.moves != 0; }),
                          act([&m, method] { m.moves = method; }));
  NodePtr passed = sequence(when([this] { return r_.ran == Strategy::Avoid; }), when([this, method] { return (before_.moves & method) != 0; }),
                            when([this, k] { return c_.clear_track[k]; }), act([&m] { m.avoid = false; }));
  return all(fallback(std::move(lost), std::move(back)), std::move(passed));
}

/// How a road is driven, and what takes over when that fails.
NodePtr TreeMind::drive() {
  Mission& m = r_.m;
  NodePtr clear_of_line = sequence(when([this] { return c_.off_line; }), act([&m] { m.astride = false; }));
  NodePtr choose = sequence(when([&m] { return m.driving; }), when([&m] { return m.moves == 0; }),
                            all(sequence(when([this] { return r_.methods(Fact::MoveBy_mark) != 0; }),
                                         act([this, &m] { m.moves = m.asked = r_.methods(Fact::MoveBy_mark); })),
                                sequence(when([this] { return c_.patient; }),
                                         act([this, &m] { m.moves = static_cast<std::uint8_t>(m.moves | r_.methods(Fact::Track_mark)); }))));
  NodePtr leave_road = sequence(when([&m] { return !m.driving; }), act([&m] { m.moves = m.asked = 0; }));
  NodePtr meet = sequence(when([this] { return r_.is(Fact::Obst); }), when([this] { return r_.ran_move() || r_.ran_cross(); }),
                          act([&m] { m.avoid = true; }));
  NodePtr pass = sequence(when([this] { return r_.ran == Strategy::Avoid; }),
                          fallback(when([&m] { return m.line == Line::kGate; }),
                                   sequence(when([&m] { return m.crosses != 0; }), when([this] { return c_.clear; }))),
                          act([&m] { m.avoid = false; }));
  return all(act([this] { look_at_clocks(); }), std::move(clear_of_line), trouble(), std::move(choose), method(0), method(1), method(2),
             std::move(leave_road), std::move(meet), std::move(pass));
}

/// What has no end is reported, and the robot stands.
NodePtr TreeMind::trouble() {
  Mission& m = r_.m;
  const auto report = [&m](Help help) { return act([&m, help] { m.help = static_cast<std::uint8_t>(m.help | help); }); };
  NodePtr found = sequence(when([&m] { return m.search; }),
                           fallback(when([&m] { return m.line != Line::kGate; }),
                                    sequence(when([&m] { return m.watch == Watch::kArrived; }), when([&m] { return m.came != Side::kNone; }))),
                           act([&m] { m.search = false; }));
  NodePtr go_on = sequence(when([this] { return before_.blocked; }), when([this] { return r_.ran == Strategy::Stop; }),
                           when([this] { return c_.clear_long; }), act([&m] { m.blocked = false; }));
  return all(std::move(found), sequence(when([this] { return c_.unread; }), act([&m] { m.search = true; })),
             sequence(when([this] { return c_.searches; }), report(kLost)), sequence(when([this] { return c_.refused; }), report(kRefused)),
             sequence(when([this] { return c_.stuck; }), report(kNoTrack)), sequence(when([this] { return c_.avoids; }), act([&m] { m.blocked = true; })),
             std::move(go_on), sequence(when([this] { return before_.blocked; }), report(kBlocked)),
             sequence(when([this] { return c_.crossing; }), act([&m] { m.astray = true; }), report(kAstray)));
}

NodePtr TreeMind::run(Strategy strategy, bool (*wanted)(const Mission&)) {
  return sequence(when([this, wanted] { return wanted(r_.m); }), act([this, strategy] { next_ = strategy; }));
}

NodePtr TreeMind::strategy() {
  NodePtr crosses = sequence(when([this] { return r_.m.crosses != 0; }), act([this] { next_ = static_cast<Strategy>(std::countr_zero(r_.m.crosses)); }));
  return fallback(run(Strategy::Search, [](const Mission& m) { return m.search; }),
                  run(Strategy::Stop, [](const Mission& m) { return m.line == Line::kGate || m.blocked || m.astray; }),
                  run(Strategy::Avoid, [](const Mission& m) { return m.avoid; }), std::move(crosses),
                  run(Strategy::Move_mark, [](const Mission& m) { return (m.moves & 1u) != 0; }),
                  run(Strategy::Move_dist, [](const Mission& m) { return (m.moves & 2u) != 0; }),
                  run(Strategy::Move_azimuth, [](const Mission& m) { return (m.moves & 4u) != 0; }),
                  act([this] { next_ = kNoStrategy; }));
}

}  // namespace peers
