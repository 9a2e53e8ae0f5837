// A knowledge base for many robots at once: which planes of bits it needs, and what a tick does with them (fleet/kernel.h).
//
// note [a fleet's kernel]
// A plane has one bit for each robot: whether a fact lies above a threshold, whether a satellite is high, whether a rule is
// disarmed. A tick is one list of bit operations on planes, the same for all robots, so a machine word decides for as many robots
// as it has bits. Rules of a level read the planes as they were when the level began. Commits compute new planes, each stored as
// soon as it is made, beside the planes of the last tick. If rules that disagree about a cell fire together and a strength is
// needed, the list only marks the robots concerned; the ordinary engine ticks them, from the planes of the last tick.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/tables/fleet_logic.h"
#include "compiler/tables/form.h"

namespace kb::tables {

/// What the bits of a plane stand for.
struct FleetPlane {
  enum class Kind : std::uint8_t {
    kHigh, kLow, kZero,        ///< of fact `of`: the term holds
    kPlain, kAttended, kSeen,  ///< of fact `of`: above the threshold; seen on the last tick
    kBad,                      ///< of fact `of`: it was given as NaN or out of range
    kCode,                     ///< of satellite `of`: bit `bit` of which of its values it has
    kActive,                   ///< strategy `of` was active on the last tick
    kRuns,                     ///< strategy `of` was dispatched, if that differs from kActive
    kHeld,                     ///< strategy `of` was the last that was active (idle = hold)
    kSeveral,                  ///< several strategies were active
    kDone,                     ///< `when` rule `of` has fired and is disarmed
    kTimerOn, kTimerOver,      ///< timer `of`: its condition held at its level's last evaluation; it held for long enough
    kHoldOn, kHoldOver,        ///< no strategy is active and one is held; for longer than it may be
    kFired, kEvent, kLost, kBefore,   ///< traced fleets: what happened on the last tick (kBefore as kCode)
  };
  Kind kind;
  std::uint32_t of = 0, bit = 0;
};

using PlaneKey = std::tuple<FleetPlane::Kind, std::uint32_t, std::uint32_t>;   ///< kind, of, bit
[[nodiscard]] inline PlaneKey key_of(const FleetPlane& plane) { return {plane.kind, plane.of, plane.bit}; }

/// Planes that are the same for all robots most of the time, and the bit that they have then: see note [planes at rest].
using FleetRest = std::map<PlaneKey, bool>;

/// `a & b`, where each operand is a plane or another part, written as `number << 1 | negated`: a plane has its own number, a part
/// its number plus the number of planes. See note [derived planes].
struct FleetPart { std::uint32_t a = 0, b = 0; };

/// A plane that is not kept.
struct FleetDerived {
  FleetPlane plane;
  std::uint32_t part = 0;
};

/// The values that a satellite can have in the planes, ascending; a satellite's code is its value's index here.
struct FleetCode {
  std::uint32_t first_plane = 0, bits = 0;   ///< no planes if it has one value only
  std::vector<float> values;
};

struct FleetForm {
  std::vector<FleetPlane> planes;     ///< first those that the host gives, then those that the kernel makes
  std::uint32_t read_given = 0;               ///< how many of the host's planes a kernel reads; the others follow
  std::uint32_t plain_given = 0, given = 0;   ///< how many the host gives; `plain_given` leaves out those of traced fleets, which follow
  std::uint32_t plain_planes = 0;     ///< how many planes come before those that the kernel of traced fleets makes
  std::vector<FleetCode> satellites;
  std::vector<FleetStep> steps;       ///< the tick
  std::uint32_t busy_given = 0, busy_planes = 0;   ///< the planes from here to `read_given` and to `plain_planes` can rest
  std::vector<bool> rest;             ///< by plane from `busy_planes` on: its bit at rest. The host's are 0 at rest
  std::vector<FleetStep> resting;     ///< the tick where all of these rest; empty if there are none
  std::vector<FleetPart> parts;       ///< ascending: of planes and of parts before
  std::vector<FleetDerived> derived;
  std::vector<bool> weighed;          ///< by fact: its certainty is needed to compute strengths
  std::vector<std::vector<std::uint32_t>> exclusive;   ///< satellites of which at most one is high; the kernel relies on it
  bool exclusive_strategies = true;   ///< no two can be active
};

/// A fleet's kernel is straight-line code: larger programs would take a C++ compiler minutes.
inline constexpr std::uint32_t kMostFleetRules = 2'000;

/// What keeps the program from being compiled for fleets, worded to follow "it has ..."; empty if nothing does.
[[nodiscard]] std::string against_fleet(const Tables& tables);

/// Pure. Cost: rules times the cells that they write, and for each cell the pairs of rules that disagree about it.
[[nodiscard]] FleetForm build_fleet(const program::Program& program, const Tables& tables, const FleetRest& rest = {});

}  // namespace kb::tables
