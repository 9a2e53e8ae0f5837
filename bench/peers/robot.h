// What a robot of Route1 remembers when its mind is written by hand: the state that both hand-written peers share, and how it
// sees landmarks. Only what the decisions need; the words are those of stdlib_rules/std and of examples/01_route1/paper.kb.
#pragma once

#include <cstdint>

#include "paper.kb.h"

namespace peers {

using paper::Fact;
using paper::Strategy;

/// The legs of the route, then those of the detour.
enum class Leg : std::uint8_t { kTo5, kTo2, kTo3, kTo6, kTo7, kTo13, kTo15, kDetourTo11, kDetourTo13, kNone };
enum class Watch : std::uint8_t { kNone, kLooking, kArrived };
/// Awaits the line in, waits at it, awaits the line out.
enum class Line : std::uint8_t { kNone, kIn, kGate, kOut };
enum class Side : std::uint8_t { kN, kE, kS, kW, kNone };
enum class Turn : std::uint8_t { kLeft, kRight, kForward, kBack, kNone };
enum Help : std::uint8_t { kLost = 1, kRefused = 2, kNoTrack = 4, kBlocked = 8, kAstray = 16 };

inline constexpr int kLegs = 9;
inline constexpr std::uint32_t kFacts = paper::Knowledge::kShape.facts;
inline constexpr Strategy kNoStrategy = static_cast<Strategy>(0xFFFF);

struct LegData { Fact to, from; Side exit; Leg next; };
inline constexpr LegData kLegData[kLegs] = {
    {Fact::LM5, Fact::LM5, Side::kNone, Leg::kTo2},    {Fact::LM2, Fact::LM5, Side::kW, Leg::kTo3},
    {Fact::LM3, Fact::LM2, Side::kS, Leg::kTo6},       {Fact::LM6, Fact::LM3, Side::kE, Leg::kTo7},
    {Fact::LM7, Fact::LM6, Side::kS, Leg::kTo13},      {Fact::LM13, Fact::LM7, Side::kE, Leg::kTo15},
    {Fact::LM15, Fact::LM13, Side::kE, Leg::kNone},    {Fact::LM11, Fact::LM7, Side::kS, Leg::kDetourTo13},
    {Fact::LM13, Fact::LM11, Side::kE, Leg::kTo15}};

/// From the road of arrival to the road of exit.
inline constexpr Turn kTurnOf[4][4] = {{Turn::kBack, Turn::kLeft, Turn::kForward, Turn::kRight},
                                       {Turn::kRight, Turn::kBack, Turn::kLeft, Turn::kForward},
                                       {Turn::kForward, Turn::kRight, Turn::kBack, Turn::kLeft},
                                       {Turn::kLeft, Turn::kForward, Turn::kRight, Turn::kBack}};

[[nodiscard]] constexpr std::uint64_t bit(Fact fact) { return std::uint64_t{1} << static_cast<unsigned>(fact); }

/// Since when something holds, in microseconds; looked at once a tick.
class Since {
 public:
  /// Whether `holds` has been true on every tick for `duration_us`.
  bool held(bool holds, std::int64_t now_us, std::int64_t duration_us) {
    if (!holds) {
      from_us_ = kNever;
      return false;
    }
    if (from_us_ == kNever) from_us_ = now_us;
    return now_us - from_us_ >= duration_us;
  }

 private:
  static constexpr std::int64_t kNever = -1;
  std::int64_t from_us_ = kNever;
};

/// What a mission leaves behind; `Mission{}` is the state of start-up.
struct Mission {
  bool route = false;        ///< the route is in hand
  bool listens = true;       ///< to the command
  bool astride = false, driving = false, avoid = false, blocked = false, search = false, astray = false;
  bool asks_marking = false; ///< an obstacle was met; the marking found again is its end
  bool awaits_13 = false;    ///< the landmark that a detour interrupted stays attended
  Leg leg = Leg::kNone;
  Watch watch = Watch::kNone;
  Line line = Line::kNone;
  Side came = Side::kNone, out = Side::kNone;
  Turn turn = Turn::kNone;
  std::uint8_t moves = 0;    ///< methods in use: bits of mark, dist, azimuth
  std::uint8_t asked = 0;    ///< the method that the landmark asked for, as such a bit
  std::uint8_t help = 0;     ///< bits of Help
  std::uint16_t crosses = 0; ///< crossings in hand: bits of the strategies Cross[turn,method]
};

struct Robot {
  Mission m;
  float value[kFacts] = {};
  std::uint64_t high = 0, low = 0;     ///< facts whose value is at least 0.5, at most -0.5
  std::uint64_t seen = 0, events = 0;  ///< facts in view, and those that have come into view on this tick
  bool facts_changed = true;
  std::uint64_t attended = 0;          ///< of the last tick
  std::int64_t now_us = 0;
  bool first = true;
  Strategy ran = kNoStrategy;          ///< what ran on the last tick

  Since two_seen[kLegs];               ///< a leg's two landmarks are not both in view
  Since arrived, off_line, wants_method, no_track[3], on_track[3], clear_track[3], clear, clear_long, avoids, unread, searches, refused, stuck, crossing;
  bool resumes = false;                ///< the condition of `paper_resume` on the last tick
  std::uint8_t came_from = 0;          ///< sides of `In` while arrived, on the last tick
  std::uint8_t road = kNoRoad;         ///< leg and whether its exit is closed, while arrived, on the last tick

  static constexpr std::uint8_t kNoRoad = 0xFF;

  void set(Fact fact, float v) {
    value[static_cast<std::size_t>(fact)] = v;
    const std::uint64_t b = bit(fact);
    high = v >= 0.5f ? high | b : high & ~b;
    low = v <= -0.5f ? low | b : low & ~b;
    facts_changed = true;
  }
  [[nodiscard]] bool is(Fact fact) const { return (high & bit(fact)) != 0; }
  [[nodiscard]] bool sees(Fact fact) const { return (seen & bit(fact)) != 0; }
  [[nodiscard]] bool event(Fact fact) const { return (events & bit(fact)) != 0; }
  /// Three bits from `first` on: the facts of the methods, or four: of the sides.
  [[nodiscard]] std::uint8_t methods(Fact first_fact) const { return static_cast<std::uint8_t>((high >> static_cast<unsigned>(first_fact)) & 7u); }
  [[nodiscard]] std::uint8_t sides(Fact first_fact) const { return static_cast<std::uint8_t>((high >> static_cast<unsigned>(first_fact)) & 15u); }
  [[nodiscard]] bool ran_move() const { return ran >= Strategy::Move_mark && ran <= Strategy::Move_azimuth; }
  [[nodiscard]] bool ran_cross() const { return ran <= Strategy::Cross_back_azimuth; }

  /// Which of the facts that are looked out for are in view: above 0.75, or 0.5 if they are attended or were in view.
  void look() {
    events = 0;
    const std::uint64_t wanted = attention();
    if (!facts_changed && wanted == attended) return;
    const std::uint64_t lower = wanted | seen;
    std::uint64_t now = 0;
    for (const Fact fact : kSights) {
      const float threshold = (lower & bit(fact)) != 0 ? 0.5f : 0.75f;
      if (value[static_cast<std::size_t>(fact)] > threshold) now |= bit(fact);
    }
    if (!first) events = now & ~seen;
    seen = now;
    facts_changed = false;
    attended = wanted;
  }

  [[nodiscard]] std::uint64_t attention() const {
    std::uint64_t facts = bit(Fact::Obst);
    if (m.listens) facts |= bit(Fact::Start1);
    if (m.asks_marking) facts |= bit(Fact::CrossBy_mark);
    if (m.awaits_13) facts |= bit(Fact::LM13);
    if (m.line == Line::kIn || m.line == Line::kOut) facts |= bit(Fact::Line);
    if (m.leg != Leg::kNone) facts |= bit(kLegData[static_cast<std::size_t>(m.leg)].to);
    return facts;
  }

 private:
  static constexpr Fact kSights[] = {Fact::Line, Fact::CrossBy_mark, Fact::Obst, Fact::LM2, Fact::LM5, Fact::LM3,
                                     Fact::LM6, Fact::LM7, Fact::LM11, Fact::LM13, Fact::LM15, Fact::Start1};
};

// What both minds do when something has been decided.
inline void set_out(Mission& m) {
  m.leg = Leg::kTo5;
  m.watch = Watch::kLooking;
  m.line = Line::kIn;
  m.driving = true;
  m.listens = false;
}
inline void arrive(Mission& m, Leg next) {
  m.leg = next;
  m.watch = Watch::kArrived;
}
/// `methods`: how the crossing can be driven; one bit as a rule.
inline void enter(Mission& m, std::uint8_t methods) {
  m.crosses = static_cast<std::uint16_t>(m.crosses | (methods << (3u * static_cast<unsigned>(m.turn))));
  m.line = Line::kOut;
  m.watch = Watch::kNone;
  m.astride = true;
  m.driving = false;
  m.came = m.out = Side::kNone;
  m.turn = Turn::kNone;
}
inline void leave(Mission& m) {
  m.line = Line::kIn;
  m.astride = m.driving = true;
  m.crosses = 0;
}

}  // namespace peers
