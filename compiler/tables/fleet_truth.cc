#include "compiler/tables/fleet_truth.h"

#include <algorithm>

namespace kb::tables {

using AtomKind = AtomOrigin::Kind;
using program::Term;

FleetTruth::FleetTruth(const program::Program& program, const Tables& tables, const DerivedPlanes& derived, const FleetRest& rest)
    : rules(program, tables), p_(program), t_(tables), derived_(derived), rest_(rest), timer_(tables.shape.timers, kZeros), seen_(program.facts, kZeros),
      was_seen_(program.facts, kZeros) {
  make_codes();
  load_strategies();
}

std::uint32_t FleetTruth::plane(PlaneKind kind, std::uint32_t of, std::uint32_t bit) {
  const auto [at, fresh] = planes_.try_emplace({kind, of, bit}, static_cast<std::uint32_t>(form.planes.size()));
  if (fresh) form.planes.push_back({kind, of, bit});
  return at->second;
}

Ref FleetTruth::load(PlaneKind kind, std::uint32_t of, std::uint32_t bit) {
  if (const auto resting = rest_.find({kind, of, bit}); resting != rest_.end()) return resting->second ? kOnes : kZeros;
  const auto at = derived_.roots.find({kind, of, bit});
  if (at == derived_.roots.end()) return logic.load(plane(kind, of, bit));
  const Ref value = part(at->second.part);
  return at->second.later ? logic.both(value, logic.later()) : value;
}

Ref FleetTruth::part(std::uint32_t number) {
  const DerivedPlanes::Part& part = derived_.parts[number];
  if (part.kept) return load(part.plane.kind, part.plane.of, part.plane.bit);
  return number == 0 ? kZeros : logic.both(this->part(part.a >> 1) ^ (part.a & 1u), this->part(part.b >> 1) ^ (part.b & 1u));
}

void FleetTruth::store(PlaneKind kind, std::uint32_t of, Ref value, std::uint32_t bit) {
  if (derived_.roots.contains({kind, of, bit})) return;
  if (rest_.contains({kind, of, bit})) left_[{kind, of, bit}] = value;
  else logic.append({FleetStep::Kind::kPut, plane(kind, of, bit), value});
}

Ref FleetTruth::wakes() {
  Ref wakes = kZeros;
  for (const auto& [key, value] : left_) wakes = logic.either(wakes, value ^ (rest_.at(key) ? 1u : 0u));
  return wakes;
}

void FleetTruth::make_codes() {
  std::vector<std::vector<float>> values(p_.satellites);
  for (std::uint32_t s = 0; s < p_.satellites; ++s) values[s].push_back(p_.cells[p_.facts + s].initial + 0.0f);
  for (std::uint32_t r = 0; r < p_.rules.size(); ++r) {
    for (const CellWrite& w : rules.writes(r)) values[w.satellite].push_back(w.value);
  }
  code_.resize(p_.satellites);
  for (std::uint32_t s = 0; s < p_.satellites; ++s) {
    FleetCode& code = form.satellites.emplace_back();
    source::sort_unique(values[s]);
    code.values = values[s];
    while ((std::size_t{1} << code.bits) < code.values.size()) ++code.bits;
    code.first_plane = static_cast<std::uint32_t>(form.planes.size());
    for (std::uint32_t b = 0; b < code.bits; ++b) code_[s].push_back(load(PlaneKind::kCode, s, b));
  }
  first_code_ = code_;
}

void FleetTruth::load_strategies() {
  active_.assign(p_.strategies, kZeros);
  for (const AtomOrigin& o : t_.origins) {
    if (o.kind != AtomKind::kTerm || p_[o.cell].kind != program::CellKind::kStrategy) continue;
    const auto u = static_cast<std::uint32_t>(index(o.cell)) - p_.first_strategy();
    active_[u] = load(PlaneKind::kActive, u);
  }
}

Ref FleetTruth::satellite_term(std::uint32_t s, Term term, const std::vector<Ref>& code) {
  const std::vector<float>& values = form.satellites[s].values;
  Ref holds = kZeros;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!program::holds(term, values[i], t_.firing)) continue;
    Ref is = kOnes;
    for (std::size_t b = 0; b < code.size(); ++b) is = logic.both(is, code[b] ^ ((i >> b & 1u) != 0 ? 0u : 1u));
    holds = logic.either(holds, is);
  }
  return holds;
}

Ref FleetTruth::cell_term(program::CellId cell, Term term) {
  const auto number = static_cast<std::uint32_t>(index(cell));
  switch (p_[cell].kind) {
    case program::CellKind::kFact:
      return load(term == Term::kHigh ? PlaneKind::kHigh : term == Term::kLow ? PlaneKind::kLow : PlaneKind::kZero, number);
    case program::CellKind::kSatellite: return satellite_term(number - p_.facts, term, code_[number - p_.facts]);
    case program::CellKind::kStrategy: {
      const Ref active = active_[number - p_.first_strategy()];
      return term == Term::kHigh ? active : term == Term::kLow ? active ^ 1u : kZeros;
    }
  }
  return kZeros;
}

/// The atom's truth as the planes are now.
Ref FleetTruth::atom(I a) {
  const AtomOrigin& o = t_.origins[a];
  const auto fact = static_cast<std::uint32_t>(index(o.cell));
  switch (o.kind) {
    case AtomKind::kTrue: return kOnes;
    case AtomKind::kFalse: return kZeros;
    case AtomKind::kTerm: return cell_term(o.cell, o.term);
    case AtomKind::kSeen: return seen_[fact];
    case AtomKind::kEvent: return event(fact);
    case AtomKind::kLost: return lost(fact);
    case AtomKind::kTimer: return timer_[a - (t_.shape.first_timer())];
    case AtomKind::kNode: return node(a - t_.shape.first_node());
  }
  return kZeros;
}

Ref FleetTruth::event(std::uint32_t fact) {
  return logic.both(logic.both(seen_[fact], was_seen_[fact] ^ 1u), logic.later());
}

Ref FleetTruth::node(std::uint32_t n) {
  const bool all = rules.is_and(n);
  Ref truth = all ? kOnes : kZeros;
  for (const I child : ordered(rules.children(n))) truth = all ? logic.both(truth, literal(child)) : logic.either(truth, literal(child));
  return truth;
}

void FleetTruth::count_uses(std::uint32_t begin, std::uint32_t end) {
  uses_.clear();
  for (std::uint32_t r = begin; r < end; ++r) {
    for (const I l : rules.literals(r)) ++uses_[l];
  }
}

std::vector<I> FleetTruth::ordered(std::span<const I> literals) const {
  std::vector<I> sorted(literals.begin(), literals.end());
  std::stable_sort(sorted.begin(), sorted.end(), [&](I a, I b) { return uses(a) > uses(b); });
  return sorted;
}

std::size_t FleetTruth::uses(I literal) const {
  const auto found = uses_.find(literal);
  return found == uses_.end() ? 0 : found->second;
}

Ref FleetTruth::condition(std::uint32_t rule) {
  Ref truth = kOnes;
  for (const I l : ordered(rules.literals(rule))) truth = logic.both(truth, literal(l));
  return truth;
}

// ---- what is noticed

void FleetTruth::notice_all() {
  for (std::uint32_t s = 0; s < p_.satellites; ++s) {
    for (I i = t_.attends_begin[s]; i < t_.attends_begin[s + 1]; ++i) attention_[t_.attends[i]].push_back(s);
  }
  for (std::uint32_t f = 0; f < p_.facts; ++f) {
    const mts::FactAtoms<I>& asked = t_.fact_atoms[f];
    if (asked.seen != 0 || asked.event != 0 || asked.lost != 0) notice(f);
  }
}

void FleetTruth::notice(std::uint32_t f) {
  was_seen_[f] = load(PlaneKind::kSeen, f);
  const Ref plain = load(PlaneKind::kPlain, f), attended = load(PlaneKind::kAttended, f);
  Ref attention = was_seen_[f];
  for (const std::uint32_t s : attention_[f]) attention = logic.either(attention, satellite_term(s, Term::kHigh, first_code_[s]));
  seen_[f] = logic.either(plain, logic.both(attended, attention));
  store(PlaneKind::kSeen, f, seen_[f]);
}

}  // namespace kb::tables
