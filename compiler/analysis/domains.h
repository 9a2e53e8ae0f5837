// Which values a cell can have: the few regions of [-1, 1] that conditions tell apart, and which of them a cell can reach.
//
// note [reached regions]
// A satellite has its initial value, and what is written by rules that can fire. A rule can fire if its condition can hold, and that depends
// on what satellites can be. So regions grow from those of start-up, rule by rule, until nothing is added; of rules that wait for each other
// none is ever reached. What is left out only makes the answer wider: conditions are looked at cell by cell, long ones not at all,
// and after some millions of steps every rule counts as one that can fire.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/program/program.h"

namespace kb::analysis {

/// A set of regions of certainty. A region is what a value makes true of `high`, `zero` and `low`: which of them
/// overlap depends on `firing`.
using Regions = std::uint8_t;
inline constexpr Regions kRegionHigh = 1;      ///< high only
inline constexpr Regions kRegionHighZero = 2;  ///< high and zero (firing <= 0.5)
inline constexpr Regions kRegionZero = 4;
inline constexpr Regions kRegionLowZero = 8;
inline constexpr Regions kRegionLow = 16;
inline constexpr Regions kRegionNone = 32;  ///< neither high nor zero nor low (firing > 0.5)

/// The regions in which a term holds.
[[nodiscard]] Regions regions_of(program::Term term);

/// A set of states of a fact's sighting.
using Sightings = std::uint8_t;
inline constexpr Sightings kUnseen = 1;  ///< not seen, and not on the tick before
inline constexpr Sightings kJustLost = 2;
inline constexpr Sightings kStillSeen = 4;
inline constexpr Sightings kJustSeen = 8;  ///< an event
inline constexpr Sightings kSeen = kStillSeen | kJustSeen;
inline constexpr Sightings kAnySighting = kSeen | kUnseen | kJustLost;

struct Domains {
  Regions all = 0;                   ///< every region there is at this `firing`
  std::vector<Regions> cells;        ///< by cell: where it can ever be
  std::vector<Sightings> facts;      ///< by fact
  std::vector<Regions> when_seen;    ///< by fact: where it can be while it is seen, ...
  std::vector<Regions> when_lost;    ///< ... on the tick on which it is lost, which takes less than to come into view, ...
  std::vector<Regions> when_unseen;  ///< ... and while it is not seen
};

/// The regions that each cell can reach: see note [reached regions]. A satellite can have its initial value, the values that rules write that
/// can fire, and, if these differ, anything between them (rules that contradict each other blend). A strategy runs only if one
/// of its satellites can be high. Facts can be anything.
[[nodiscard]] Domains find_domains(const program::Program& program);
/// The same if every rule could fire.
[[nodiscard]] Domains written_domains(const program::Program& program);
/// The same, but satellites can have any value too: what holds in these domains holds whatever the rules do.
[[nodiscard]] Domains widest_domains(const program::Program& program);

/// Whether some value of the cell is in the term `high`.
[[nodiscard]] bool can_be_high(const Domains& domains, program::CellId cell);
/// Whether one of the cell's satellites can be high: then a fact is attended at times, and a strategy wanted.
[[nodiscard]] bool attended_at_times(const program::Program& program, const Domains& domains, program::CellId cell);
/// The region of one value.
[[nodiscard]] Regions region_of(float value, float firing);

}  // namespace kb::analysis
