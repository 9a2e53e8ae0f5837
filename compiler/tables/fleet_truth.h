// What a fleet's kernel knows at one moment of a tick: its planes, and the truth of atoms and conditions as bits.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "compiler/tables/fleet.h"
#include "compiler/tables/fleet_derived.h"
#include "compiler/tables/fleet_rules.h"

namespace kb::tables {

using PlaneKind = FleetPlane::Kind;

/// Makes planes and the steps that read them. After `set_code` conditions read the new value of a satellite.
class FleetTruth {
 public:
  /// `derived` and `rest` must outlive this.
  FleetTruth(const program::Program& program, const Tables& tables, const DerivedPlanes& derived, const FleetRest& rest);

  // ---- planes

  std::uint32_t plane(PlaneKind kind, std::uint32_t of, std::uint32_t bit = 0);
  /// The plane as the last tick or the host left it; computed from others if it is derived.
  Ref load(PlaneKind kind, std::uint32_t of, std::uint32_t bit = 0);
  /// Makes the value the plane's, if the plane is kept.
  void store(PlaneKind kind, std::uint32_t of, Ref value, std::uint32_t bit = 0);
  /// Where a plane that is taken to be at rest has another bit now.
  Ref wakes();

  // ---- truth

  /// Notices facts as the tick begins: `seen` and `was_seen`, and their planes.
  void notice_all();
  /// The same for a fact that no rule asks for.
  void notice(std::uint32_t fact);
  Ref event(std::uint32_t fact);
  Ref lost(std::uint32_t fact) { return logic.both(was_seen_[fact], seen_[fact] ^ 1u); }
  [[nodiscard]] bool noticed(std::uint32_t fact) const { return seen_[fact] != kZeros; }
  Ref literal(I l) { return atom(l >> 1) ^ (l & 1u); }
  /// Counts how many rules from `begin` to `end` read each literal. Conditions put the most read first, so that they share beginnings.
  void count_uses(std::uint32_t begin, std::uint32_t end);
  Ref condition(std::uint32_t rule);
  void set_timer(I timer, Ref over) { timer_[timer] = over; }

  [[nodiscard]] Ref code(std::uint32_t satellite, std::uint32_t bit) const { return code_[satellite][bit]; }
  void set_code(std::uint32_t satellite, std::uint32_t bit, Ref value) { code_[satellite][bit] = value; }

  FleetForm form;
  FleetLogic logic;
  FleetRules rules;

 private:
  Ref part(std::uint32_t part);
  void make_codes();
  void load_strategies();
  Ref satellite_term(std::uint32_t s, program::Term term, const std::vector<Ref>& code);
  Ref cell_term(program::CellId cell, program::Term term);
  Ref atom(I a);
  Ref node(std::uint32_t n);
  [[nodiscard]] std::vector<I> ordered(std::span<const I> literals) const;
  [[nodiscard]] std::size_t uses(I literal) const;

  const program::Program& p_;
  const Tables& t_;
  const DerivedPlanes& derived_;
  const FleetRest& rest_;
  std::map<PlaneKey, Ref> left_;                                    // of planes at rest: the last value that was stored
  std::map<PlaneKey, std::uint32_t> planes_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> attention_;   // by fact: satellites that draw attention to it
  std::map<I, std::size_t> uses_;                                   // by literal, in the level at hand
  std::vector<std::vector<Ref>> first_code_, code_;                 // by satellite: its code as the tick began, as it is now
  std::vector<Ref> timer_, seen_, was_seen_, active_;
};

}  // namespace kb::tables
