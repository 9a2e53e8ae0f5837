#include "compiler/tables/fleet.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "compiler/tables/fleet_rules.h"

namespace kb::tables {
namespace {

using PlaneKind = FleetPlane::Kind;
using StepKind = FleetStep::Kind;
using AtomKind = AtomOrigin::Kind;
using program::Term;
using Rules = std::vector<std::uint32_t>;

/// A write to planes of one level: bits that are set and cleared where `set` and `clear` are.
struct PlaneWrite {
  std::uint32_t satellite, bit;
  Ref set, clear;
};

class FleetBuilder {
 public:
  FleetBuilder(const program::Program& program, const Tables& tables)
      : p_(program), t_(tables), rules_(program, tables), fire_(program.rules.size(), kZeros), timer_(tables.shape.timers, kZeros) {}

  FleetForm build() {
    f_.weighed.assign(p_.facts, false);
    f_.exclusive = rules_.exclusive();
    codes();
    strategies_before();
    sightings();
    for (std::uint32_t level = 0; level < p_.levels.size(); ++level) run_level(level);
    decide();
    for (std::uint32_t s = 0; s < p_.satellites; ++s) {
      for (std::uint32_t b = 0; b < f_.satellites[s].bits; ++b) store_later(PlaneKind::kCode, s, code_[s][b], b);
    }
    if (fall_back_ != kZeros) logic_.append({StepKind::kFallBack, 0, fall_back_});
    for (const auto& [plane, value] : stores_) {
      if (value == logic_.load(plane)) continue;
      if (causes(f_.planes[plane].kind)) store(plane, value);
      else logic_.append({StepKind::kPut, plane, value});
    }
    for (std::uint32_t f = 0; f < p_.facts; ++f) plane(PlaneKind::kBad, f);
    f_.plain_planes = static_cast<std::uint32_t>(f_.planes.size());
    traced();
    f_.steps = std::move(logic_.steps);
    return std::move(f_);
  }

 private:
  // ---- planes

  std::uint32_t plane(PlaneKind kind, std::uint32_t of, std::uint32_t bit = 0) {
    const auto [at, fresh] = planes_.try_emplace({kind, of, bit}, static_cast<std::uint32_t>(f_.planes.size()));
    if (fresh) f_.planes.push_back({kind, of, bit});
    return at->second;
  }
  Ref load(PlaneKind kind, std::uint32_t of, std::uint32_t bit = 0) { return logic_.load(plane(kind, of, bit)); }
  void store(std::uint32_t plane, Ref value) { logic_.append({StepKind::kStore, plane, value}); }
  void store_later(PlaneKind kind, std::uint32_t of, Ref value, std::uint32_t bit = 0) {
    stores_.emplace_back(plane(kind, of, bit), value);
  }

  /// Where these stay as they are, and no fact is new, the next tick decides as this one did. (What rules fired follows from
  /// them and from the tick before, so that traced fleets look at `kDone` as well: see traced().)
  static bool causes(PlaneKind kind) {
    return kind == PlaneKind::kCode || kind == PlaneKind::kSeen || kind == PlaneKind::kTimerOver;
  }

  void codes() {
    std::vector<std::vector<float>> values(p_.satellites);
    for (std::uint32_t s = 0; s < p_.satellites; ++s) values[s].push_back(p_.cells[p_.facts + s].initial + 0.0f);
    for (std::uint32_t r = 0; r < p_.rules.size(); ++r) {
      for (const CellWrite& w : rules_.writes(r)) values[w.satellite].push_back(w.value);
    }
    code_.resize(p_.satellites);
    for (std::uint32_t s = 0; s < p_.satellites; ++s) {
      FleetCode& code = f_.satellites.emplace_back();
      std::sort(values[s].begin(), values[s].end());
      values[s].erase(std::unique(values[s].begin(), values[s].end()), values[s].end());
      code.values = values[s];
      while ((std::size_t{1} << code.bits) < code.values.size()) ++code.bits;
      code.first_plane = static_cast<std::uint32_t>(f_.planes.size());
      for (std::uint32_t b = 0; b < code.bits; ++b) code_[s].push_back(load(PlaneKind::kCode, s, b));
    }
  }

  // ---- truth

  Ref satellite_term(std::uint32_t s, Term term) {
    const FleetCode& code = f_.satellites[s];
    Ref holds = kZeros;
    for (std::size_t i = 0; i < code.values.size(); ++i) {
      if (!program::holds(term, code.values[i], t_.firing)) continue;
      Ref is = kOnes;
      for (std::uint32_t b = 0; b < code.bits; ++b) is = logic_.both(is, code_[s][b] ^ ((i >> b & 1u) != 0 ? 0u : 1u));
      holds = logic_.either(holds, is);
    }
    return holds;
  }

  Ref cell_term(program::CellId cell, Term term) {
    const auto number = static_cast<std::uint32_t>(index(cell));
    switch (p_[cell].kind) {
      case program::CellKind::kFact:
        return load(term == Term::kHigh ? PlaneKind::kHigh : term == Term::kLow ? PlaneKind::kLow : PlaneKind::kZero, number);
      case program::CellKind::kSatellite: return satellite_term(number - p_.facts, term);
      case program::CellKind::kStrategy: {
        const Ref active = active_[number - p_.facts - p_.satellites];
        return term == Term::kHigh ? active : term == Term::kLow ? active ^ 1u : kZeros;
      }
    }
    return kZeros;
  }

  /// The atom's truth as the planes are now.
  Ref atom(I a) {
    const AtomOrigin& o = t_.origins[a];
    const auto fact = static_cast<std::uint32_t>(index(o.cell));
    switch (o.kind) {
      case AtomKind::kTrue: return kOnes;
      case AtomKind::kFalse: return kZeros;
      case AtomKind::kTerm: return cell_term(o.cell, o.term);
      case AtomKind::kSeen: return seen_[fact];
      case AtomKind::kEvent: return event(fact);
      case AtomKind::kLost: return logic_.both(was_seen_[fact], seen_[fact] ^ 1u);
      case AtomKind::kTimer: return timer_[a - (rules_.first_node() - t_.shape.timers)];
      case AtomKind::kNode: return node(a - rules_.first_node());
    }
    return kZeros;
  }
  Ref event(std::uint32_t fact) {
    return logic_.both(logic_.both(seen_[fact], was_seen_[fact] ^ 1u), logic_.later());
  }
  Ref node(std::uint32_t n) {
    const bool all = rules_.is_and(n);
    Ref truth = all ? kOnes : kZeros;
    for (const I child : ordered(rules_.children(n))) truth = all ? logic_.both(truth, literal(child)) : logic_.either(truth, literal(child));
    return truth;
  }
  Ref literal(I l) { return atom(l >> 1) ^ (l & 1u); }

  /// Those that most rules of the level read come first: then conditions have beginnings in common, which are made once.
  std::vector<I> ordered(std::vector<I> literals) const {
    std::stable_sort(literals.begin(), literals.end(), [&](I a, I b) { return uses(a) > uses(b); });
    return literals;
  }
  std::size_t uses(I literal) const {
    const auto found = uses_.find(literal);
    return found == uses_.end() ? 0 : found->second;
  }
  Ref condition(std::uint32_t rule) {
    Ref truth = kOnes;
    for (const I l : ordered(rules_.literals(rule))) truth = logic_.both(truth, literal(l));
    return truth;
  }

  // ---- what is noticed (mts.md section 3)

  void strategies_before() {
    for (std::uint32_t u = 0; u < p_.strategies; ++u) active_.push_back(kZeros);
    for (const AtomOrigin& o : t_.origins) {
      if (o.kind != AtomKind::kTerm || p_[o.cell].kind != program::CellKind::kStrategy) continue;
      const auto u = static_cast<std::uint32_t>(index(o.cell)) - p_.facts - p_.satellites;
      active_[u] = load(PlaneKind::kActive, u);
    }
  }

  void sightings() {
    seen_.assign(p_.facts, kZeros);
    was_seen_.assign(p_.facts, kZeros);
    for (std::uint32_t s = 0; s < p_.satellites; ++s) {
      for (I i = t_.attends_begin[s]; i < t_.attends_begin[s + 1]; ++i) attention_[t_.attends[i]].push_back(s);
    }
    for (std::uint32_t f = 0; f < p_.facts; ++f) {
      const mts::FactAtoms<I>& asked = t_.fact_atoms[f];
      if (asked.seen == 0 && asked.event == 0 && asked.lost == 0) continue;
      notice(f);
      store_later(PlaneKind::kSeen, f, seen_[f]);
    }
  }
  void notice(std::uint32_t f) {
    was_seen_[f] = load(PlaneKind::kSeen, f);
    const Ref plain = load(PlaneKind::kPlain, f), attended = load(PlaneKind::kAttended, f);
    Ref attention = was_seen_[f];
    for (const std::uint32_t s : attention_[f]) attention = logic_.either(attention, first_code_high(s));
    seen_[f] = logic_.either(plain, logic_.both(attended, attention));
  }
  /// As the last tick left it.
  Ref first_code_high(std::uint32_t s) {
    std::vector<Ref> now;
    for (std::uint32_t b = 0; b < f_.satellites[s].bits; ++b) now.push_back(load(PlaneKind::kCode, s, b));
    now.swap(code_[s]);
    const Ref high = satellite_term(s, Term::kHigh);
    now.swap(code_[s]);
    return high;
  }

  // ---- a level

  void run_level(std::uint32_t level) {
    logic_.append({StepKind::kLevel, level});
    const auto [begin, end] = rules_.of_level(level);
    uses_.clear();
    for (std::uint32_t r = begin; r < end; ++r) {
      for (const I l : rules_.literals(r)) ++uses_[l];
    }
    const mts::Level<I>& stages = t_.levels[level];
    for (I g = stages.first_stage; g < stages.end_stage; ++g) {
      for (I i = t_.stages[g].first_timer; i < t_.stages[g].end_timer; ++i) run_timer(i);
    }
    std::vector<Ref> truth;
    for (std::uint32_t r = begin; r < end; ++r) fire(r, truth);
    silence(begin, end);
    for (std::uint32_t r = begin; r < end; ++r) logic_.append({StepKind::kFire, r, fire_[r]});
    commit(begin, end);
    const bool resets = std::any_of(p_.rules.begin() + begin, p_.rules.begin() + end, [](const program::Rule& rule) { return rule.reset; });
    for (std::uint32_t r = begin; r < end; ++r) rearm(r, truth[r - begin], resets);
  }

  void run_timer(I i) {
    const Ref input = literal(t_.timers[i].input);
    const Ref on = load(PlaneKind::kTimerOn, i), over = load(PlaneKind::kTimerOver, i);
    timer_[i] = logic_.append({StepKind::kTimer, i, input, on, over});
    store_later(PlaneKind::kTimerOn, i, input);
    store_later(PlaneKind::kTimerOver, i, timer_[i]);
  }

  [[nodiscard]] bool keeps_done(std::uint32_t r) const {
    return p_.rules[r].mode == program::Mode::kWhen && !rules_.disarms_itself(r);
  }
  void fire(std::uint32_t r, std::vector<Ref>& truth) {
    truth.push_back(condition(r));
    fire_[r] = keeps_done(r) ? logic_.both(truth.back(), load(PlaneKind::kDone, r) ^ 1u) : truth.back();
  }
  /// A reset silences its level.
  void silence(std::uint32_t begin, std::uint32_t end) {
    Ref reset = kZeros;
    for (std::uint32_t r = begin; r < end; ++r) {
      if (p_.rules[r].reset) reset = logic_.either(reset, fire_[r]);
    }
    for (std::uint32_t r = begin; r < end; ++r) {
      if (!p_.rules[r].reset) fire_[r] = logic_.both(fire_[r], reset ^ 1u);
    }
  }

  /// Where any of the rules fires. Split in halves of [begin, end), so that sets that have most rules in common share work.
  Ref any(const Rules& set, std::uint32_t begin, std::uint32_t end) {
    if (set.empty()) return kZeros;
    if (set.size() == 1) return fire_[set.front()];
    const std::uint32_t middle = begin + (end - begin) / 2;
    const auto at = std::lower_bound(set.begin(), set.end(), middle);
    return logic_.either(any({set.begin(), at}, begin, middle), any({at, set.end()}, middle, end));
  }

  void commit(std::uint32_t begin, std::uint32_t end) {
    std::map<std::uint32_t, std::map<float, Rules>> writers;
    for (std::uint32_t r = begin; r < end; ++r) {
      for (const CellWrite& w : rules_.writes(r)) writers[w.satellite][w.value].push_back(r);
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, bool> met;
    std::vector<PlaneWrite> writes;
    for (const auto& [satellite, values] : writers) {
      for (auto a = values.begin(); a != values.end(); ++a) {
        for (auto b = std::next(a); b != values.end(); ++b) contest(a->second, b->second, begin, end, met);
      }
      const FleetCode& code = f_.satellites[satellite];
      for (std::uint32_t bit = 0; bit < code.bits; ++bit) {
        Rules set, clear;
        for (const auto& [value, who] : values) {
          const auto place = std::lower_bound(code.values.begin(), code.values.end(), value) - code.values.begin();
          Rules& into = (place >> bit & 1) != 0 ? set : clear;
          into.insert(into.end(), who.begin(), who.end());
        }
        std::sort(set.begin(), set.end());
        std::sort(clear.begin(), clear.end());
        writes.push_back({satellite, bit, any(set, begin, end), any(clear, begin, end)});
      }
    }
    carry_out(writes);
    if (end == p_.rules.size()) want(begin, end);
  }

  /// Robots where rules of both sets fire are left to the scalar engine.
  void contest(const Rules& a, const Rules& b, std::uint32_t begin, std::uint32_t end,
               std::map<std::pair<std::uint32_t, std::uint32_t>, bool>& met) {
    Rules from_a, from_b;
    for (const std::uint32_t x : a) {
      for (const std::uint32_t y : b) {
        const auto [at, fresh] = met.try_emplace({std::min(x, y), std::max(x, y)}, false);
        if (fresh) at->second = rules_.compatible(x, y);
        if (!at->second) continue;
        from_a.push_back(x);
        from_b.push_back(y);
      }
    }
    if (from_a.empty()) return;
    for (Rules* rules : {&from_a, &from_b}) {
      std::sort(rules->begin(), rules->end());
      rules->erase(std::unique(rules->begin(), rules->end()), rules->end());
      for (const std::uint32_t r : *rules) rules_.weigh(r, f_.weighed);
    }
    fall_back_ = logic_.either(fall_back_, logic_.both(any(from_a, begin, end), any(from_b, begin, end)));
  }

  void carry_out(const std::vector<PlaneWrite>& writes) {
    for (const PlaneWrite& w : writes) {
      Ref& value = code_[w.satellite][w.bit];
      value = logic_.either(logic_.both(value, w.clear ^ 1u), w.set);
    }
  }

  /// A `when` rule that fired stays disarmed for as long as its condition holds, from right after this commit on.
  void rearm(std::uint32_t r, Ref truth, bool resets) {
    if (!keeps_done(r)) return;
    const Ref done = load(PlaneKind::kDone, r);
    const Ref still = rules_.disturbed(r) ? condition(r) : truth;
    const bool plain = still == truth && (!resets || p_.rules[r].reset);
    const Ref value = plain ? truth : logic_.either(logic_.both(truth, done), logic_.both(fire_[r], still));
    store_later(PlaneKind::kDone, r, value);
  }

  // ---- strategies

  void want(std::uint32_t begin, std::uint32_t end) {
    std::map<std::uint32_t, Rules> wanted;
    for (std::uint32_t r = begin; r < end; ++r) {
      for (const program::Write& w : p_.rules[r].writes) {
        if (p_[w.cell].kind != program::CellKind::kStrategy || !(w.value >= t_.firing)) continue;
        wanted[static_cast<std::uint32_t>(index(w.cell)) - p_.facts - p_.satellites].push_back(r);
        if (p_.at(p_.rules[r]) != "priority") f_.exclusive_strategies = false;
      }
    }
    for (std::uint32_t u = 0; u < p_.strategies; ++u) wanted_.push_back(any(wanted[u], begin, end));
  }

  /// Which strategy runs (mts.md section 5, step 5): the first of those that are wanted; else, perhaps, the last one.
  void decide() {
    wanted_.resize(p_.strategies, kZeros);
    std::vector<Ref> runs = wanted_;
    Ref some = kZeros, several = kZeros;
    for (const program::CellId cell : p_.priority) {
      const auto u = static_cast<std::uint32_t>(index(cell)) - p_.facts - p_.satellites;
      if (!f_.exclusive_strategies) {
        several = logic_.either(several, logic_.both(some, wanted_[u]));
        runs[u] = logic_.both(wanted_[u], some ^ 1u);
      }
      some = logic_.either(some, wanted_[u]);
    }
    if (t_.idle == mts::Idle::kHold) hold(runs, some);
    for (std::uint32_t u = 0; u < p_.strategies; ++u) {
      store_later(PlaneKind::kActive, u, wanted_[u]);
      if (!f_.exclusive_strategies || t_.idle == mts::Idle::kHold) store_later(PlaneKind::kRuns, u, runs[u]);
    }
    if (!f_.exclusive_strategies) store_later(PlaneKind::kSeveral, 0, several);
  }
  void hold(std::vector<Ref>& runs, Ref some) {
    Ref any_held = kZeros;
    for (std::uint32_t u = 0; u < p_.strategies; ++u) any_held = logic_.either(any_held, load(PlaneKind::kHeld, u));
    const Ref holding = logic_.both(any_held, some ^ 1u);
    const Ref on = load(PlaneKind::kHoldOn, 0), over = load(PlaneKind::kHoldOver, 0);
    const Ref expired = logic_.append({StepKind::kHold, t_.shape.timers, holding, on, over});
    store_later(PlaneKind::kHoldOn, 0, holding);
    store_later(PlaneKind::kHoldOver, 0, expired);
    for (std::uint32_t u = 0; u < p_.strategies; ++u) {
      const Ref idle = logic_.both(load(PlaneKind::kHeld, u), some ^ 1u);
      store_later(PlaneKind::kHeld, u, logic_.either(runs[u], idle));
      runs[u] = logic_.either(runs[u], logic_.both(idle, expired ^ 1u));
    }
  }

  // ---- what traced fleets keep beside

  void traced() {
    std::vector<std::vector<Ref>> before(p_.satellites);
    logic_.append({StepKind::kTraced});
    for (std::uint32_t f = 0; f < p_.facts; ++f) {
      if (seen_[f] == kZeros) {
        notice(f);
        store(plane(PlaneKind::kSeen, f), seen_[f]);
      }
      store(plane(PlaneKind::kEvent, f), event(f));
      store(plane(PlaneKind::kLost, f), logic_.both(was_seen_[f], seen_[f] ^ 1u));
    }
    for (std::uint32_t r = 0; r < p_.rules.size(); ++r) store(plane(PlaneKind::kFired, r), fire_[r]);
    for (std::uint32_t s = 0; s < p_.satellites; ++s) {
      for (std::uint32_t b = 0; b < f_.satellites[s].bits; ++b) {
        store(plane(PlaneKind::kBefore, s, b), load(PlaneKind::kCode, s, b));
      }
    }
  }

  const program::Program& p_;
  const Tables& t_;
  FleetRules rules_;
  FleetForm f_;
  FleetLogic logic_;
  std::map<std::tuple<PlaneKind, std::uint32_t, std::uint32_t>, std::uint32_t> planes_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> attention_;   // by fact: satellites that draw attention to it
  std::map<I, std::size_t> uses_;                                   // by literal, in the level at hand
  std::vector<std::vector<Ref>> code_;                              // by satellite: its code as it is now
  std::vector<Ref> fire_, timer_, seen_, was_seen_, active_, wanted_;
  std::vector<std::pair<std::uint32_t, Ref>> stores_;
  Ref fall_back_ = kZeros;
};

}  // namespace

std::string against_fleet(const Tables& tables) {
  if (tables.shape.rules > kMostFleetRules) {
    return fmt::format("{} rules; a fleet's kernel holds {}", tables.shape.rules, kMostFleetRules);
  }
  return {};
}

FleetForm build_fleet(const program::Program& program, const Tables& tables) { return FleetBuilder(program, tables).build(); }

}  // namespace kb::tables
