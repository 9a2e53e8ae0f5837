#include "compiler/tables/fleet.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "compiler/tables/fleet_derived.h"
#include "compiler/tables/fleet_truth.h"

namespace kb::tables {
namespace {

using StepKind = FleetStep::Kind;
using Rules = std::vector<std::uint32_t>;

/// What a level writes to a plane: its bits become 1 where `set` is 1, and 0 where `clear` is 1.
struct PlaneWrite {
  std::uint32_t satellite, bit;
  Ref set, clear;
};

bool is_given(PlaneKind kind) {
  switch (kind) {
    case PlaneKind::kHigh:
    case PlaneKind::kLow:
    case PlaneKind::kZero:
    case PlaneKind::kPlain:
    case PlaneKind::kAttended:
    case PlaneKind::kBad: return true;
    default: return false;
  }
}

/// Numbers the planes in the order of their memory: first those that the host gives, those of a fact next to each other and those that no
/// kernel reads behind the others; then those that the kernel makes. In both parts the planes that only traced fleets have come last.
/// Of the planes that untraced kernels read and write, those in `rest` come last.
void given_first(FleetForm& f, const FleetRest& rest) {
  std::vector<std::uint32_t> order(f.planes.size()), place(f.planes.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto part = [&](std::uint32_t i) {
    if (!is_given(f.planes[i].kind)) return i < f.plain_planes ? 3 : 4;
    return i >= f.plain_planes ? 2 : f.planes[i].kind == PlaneKind::kBad ? 1 : 0;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (part(a) != part(b)) return part(a) < part(b);
    if (const bool rests = rest.contains(key_of(f.planes[b])); rest.contains(key_of(f.planes[a])) != rests) return rests;
    return part(a) <= 2 && f.planes[a].of < f.planes[b].of;
  });
  std::vector<FleetPlane> planes;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const int of = part(order[i]);
    const auto resting = rest.find(key_of(f.planes[order[i]]));
    if (of == 0 && resting == rest.end()) f.busy_given = i + 1;
    if (of == 3 && resting == rest.end()) f.busy_planes = i + 1;
    if (of == 3 && resting != rest.end()) f.rest.push_back(resting->second);
    f.read_given += of == 0 ? 1 : 0;
    f.plain_given += of <= 1 ? 1 : 0;
    f.given += of <= 2 ? 1 : 0;
    place[order[i]] = i;
    planes.push_back(f.planes[order[i]]);
  }
  f.busy_planes = std::max(f.busy_planes, f.given);
  f.plain_planes += f.given - f.plain_given;
  f.planes = std::move(planes);
  for (FleetCode& code : f.satellites) {
    if (code.bits != 0) code.first_plane = place[code.first_plane];
  }
  for (FleetStep& step : f.steps) {
    if (step.kind == StepKind::kLoad || step.kind == StepKind::kPut) step.what = place[step.what];
  }
}

/// Adds the derived planes, as expressions of planes that are kept.
void add_derived(FleetForm& f, const DerivedPlanes& derived) {
  std::map<PlaneKey, std::uint32_t> places;
  for (std::uint32_t i = 0; i < f.planes.size(); ++i) places[key_of(f.planes[i])] = i;
  std::vector<std::uint32_t> number{0};   // by part
  const auto operand = [&](Ref ref) { return number[ref >> 1] << 1 | (ref & 1u); };
  for (std::size_t i = 1; i < derived.parts.size(); ++i) {
    const DerivedPlanes::Part& part = derived.parts[i];
    number.push_back(part.kept ? places.at(key_of(part.plane))
                               : static_cast<std::uint32_t>(f.planes.size() + f.parts.size()));
    if (!part.kept) f.parts.push_back({operand(part.a), operand(part.b)});
  }
  for (const auto& [key, root] : derived.roots) {
    const auto& [kind, of, bit] = key;
    if (root.part != 0) f.derived.push_back({{kind, of, bit}, number[root.part]});
  }
}

class FleetBuilder {
 public:
  /// `rest`: planes that are taken to be at rest.
  FleetBuilder(const program::Program& program, const Tables& tables, const DerivedPlanes& derived, const FleetRest& rest = {})
      : p_(program), t_(tables), derived_(derived), rest_(rest), truth_(program, tables, derived, rest_), rules_(truth_.rules), logic_(truth_.logic), f_(truth_.form),
        fire_(program.rules.size(), kZeros) {}

  /// `last`: planes that come last in memory.
  FleetForm build(const FleetRest& last = {}) {
    tick();
    for (std::uint32_t f = 0; f < p_.facts; ++f) truth_.plane(PlaneKind::kBad, f);
    f_.plain_planes = static_cast<std::uint32_t>(f_.planes.size());
    traced();
    f_.steps = std::move(logic_.steps);
    given_first(f_, last);
    add_derived(f_, derived_);
    return std::move(f_);
  }
  /// The tick of robots in which the planes of `rest` rest, with the planes of `whole`.
  std::vector<FleetStep> build_resting(const FleetForm& whole) {
    tick();
    if (const Ref wakes = truth_.wakes(); wakes != kZeros) logic_.append({StepKind::kWake, 0, wakes});
    std::map<PlaneKey, std::uint32_t> places;
    for (std::uint32_t i = 0; i < whole.planes.size(); ++i) places[key_of(whole.planes[i])] = i;
    for (FleetStep& step : logic_.steps) {
      if (step.kind == StepKind::kLoad || step.kind == StepKind::kPut) step.what = places.at(key_of(f_.planes[step.what]));
    }
    return std::move(logic_.steps);
  }

 private:
  void tick() {
    f_.weighed.assign(p_.facts, false);
    f_.exclusive = rules_.exclusive();
    truth_.notice_all();
    for (std::uint32_t level = 0; level < p_.levels.size(); ++level) run_level(level);
    decide();
    keep_codes();
  }

  // ---- a level

  void run_level(std::uint32_t level) {
    logic_.append({StepKind::kLevel, level});
    const auto [begin, end] = program::rules_of(p_, level);
    truth_.count_uses(begin, end);
    const mts::Level<I>& stages = t_.levels[level];
    for (I g = stages.first_stage; g < stages.end_stage; ++g) {
      for (I i = t_.stages[g].first_timer; i < t_.stages[g].end_timer; ++i) run_timer(i);
    }
    const bool resets = std::any_of(p_.rules.begin() + begin, p_.rules.begin() + end, [](const program::Rule& rule) { return rule.reset; });
    std::vector<Ref> truth;
    for (std::uint32_t r = begin; r < end; ++r) fire(r, truth, resets);
    silence(begin, end);
    for (std::uint32_t r = begin; r < end; ++r) logic_.append({StepKind::kFire, r, fire_[r]});
    commit(begin, end);
    for (std::uint32_t r = begin; r < end; ++r) rearm(r, truth[r - begin], resets);
  }

  void run_timer(I i) {
    const Ref input = truth_.literal(t_.timers[i].input);
    const Ref on = truth_.load(PlaneKind::kTimerOn, i), over = truth_.load(PlaneKind::kTimerOver, i);
    truth_.store(PlaneKind::kTimerOn, i, input);
    const Ref now = wait({StepKind::kTimer, i, input, on, over});
    truth_.store(PlaneKind::kTimerOver, i, now);
    truth_.set_timer(i, now);
  }

  /// Appends the step of a timer, unless it is plain what comes out.
  Ref wait(const FleetStep& step) {
    if (step.a == kZeros) return kZeros;
    return step.c == kOnes ? step.a : logic_.append(step);
  }

  [[nodiscard]] bool keeps_done(std::uint32_t r) const {
    return p_.rules[r].mode == program::Mode::kWhen && !rules_.disarms_itself(r);
  }
  /// Whether after a tick a rule is disarmed exactly where its condition held.
  [[nodiscard]] bool done_where_true(std::uint32_t r, bool resets) const {
    return !rules_.disturbed(r) && (!resets || p_.rules[r].reset);
  }
  void fire(std::uint32_t r, std::vector<Ref>& truth, bool resets) {
    truth.push_back(truth_.condition(r));
    fire_[r] = truth.back();
    if (!keeps_done(r)) return;
    fire_[r] = logic_.both(truth.back(), truth_.load(PlaneKind::kDone, r) ^ 1u);
    if (done_where_true(r, resets)) truth_.store(PlaneKind::kDone, r, truth.back());
  }
  /// Where a reset fires, the other rules of its level do not fire.
  void silence(std::uint32_t begin, std::uint32_t end) {
    Ref reset = kZeros;
    for (std::uint32_t r = begin; r < end; ++r) {
      if (p_.rules[r].reset) reset = logic_.either(reset, fire_[r]);
    }
    for (std::uint32_t r = begin; r < end; ++r) {
      if (!p_.rules[r].reset) fire_[r] = logic_.both(fire_[r], reset ^ 1u);
    }
  }

  /// Where any of the rules fires. [begin, end) is split in halves, so that sets with many common rules share operations.
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

  /// Leaves robots for which rules of both sets fire to the scalar engine.
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
      source::sort_unique(*rules);
      for (const std::uint32_t r : *rules) rules_.weigh(r, f_.weighed);
    }
    Ref one = any(from_a, begin, end), other = any(from_b, begin, end);
    if (contested_.contains(other)) std::swap(one, other);
    Ref& against = contested_.try_emplace(one, kZeros).first->second;
    against = logic_.either(against, other);
  }

  void carry_out(const std::vector<PlaneWrite>& writes) {
    Ref contested = kZeros;
    for (const auto& [one, against] : contested_) contested = logic_.either(contested, logic_.both(one, against));
    if (contested != kZeros) logic_.append({StepKind::kFallBack, 0, contested});
    contested_.clear();
    for (const PlaneWrite& w : writes) {
      const Ref before = truth_.code(w.satellite, w.bit);
      const Ref value = logic_.either(logic_.both(before, w.clear ^ 1u), w.set);
      if (value == before) continue;
      truth_.set_code(w.satellite, w.bit, value);
      truth_.store(PlaneKind::kCode, w.satellite, value, w.bit);
    }
  }
  /// Keeps the values that no level has changed.
  void keep_codes() {
    for (std::uint32_t s = 0; s < p_.satellites; ++s) {
      for (std::uint32_t b = 0; b < f_.satellites[s].bits; ++b) {
        const Ref before = truth_.load(PlaneKind::kCode, s, b);
        if (truth_.code(s, b) == before) truth_.store(PlaneKind::kCode, s, before, b);
      }
    }
  }

  /// A `when` rule that has fired stays disarmed as long as its condition holds, beginning right after this commit.
  void rearm(std::uint32_t r, Ref truth, bool resets) {
    if (!keeps_done(r) || done_where_true(r, resets)) return;
    const Ref still = rules_.disturbed(r) ? truth_.condition(r) : truth;
    truth_.store(PlaneKind::kDone, r, logic_.either(logic_.both(truth, truth_.load(PlaneKind::kDone, r)), logic_.both(fire_[r], still)));
  }

  // ---- strategies

  void want(std::uint32_t begin, std::uint32_t end) {
    std::map<std::uint32_t, Rules> wanted;
    for (std::uint32_t r = begin; r < end; ++r) {
      for (const program::Write& w : p_.rules[r].writes) {
        if (p_[w.cell].kind != program::CellKind::kStrategy || !(w.value >= t_.firing)) continue;
        wanted[static_cast<std::uint32_t>(index(w.cell)) - p_.first_strategy()].push_back(r);
        if (p_.at(p_.rules[r]) != "priority") f_.exclusive_strategies = false;
      }
    }
    for (std::uint32_t u = 0; u < p_.strategies; ++u) wanted_.push_back(any(wanted[u], begin, end));
  }

  /// Which strategy runs on a tick: the first one that is wanted; if none is, perhaps the one before.
  void decide() {
    wanted_.resize(p_.strategies, kZeros);
    std::vector<Ref> runs = wanted_;
    Ref some = kZeros, several = kZeros;
    for (const program::CellId cell : p_.priority) {
      const auto u = static_cast<std::uint32_t>(index(cell)) - p_.first_strategy();
      if (!f_.exclusive_strategies) {
        several = logic_.either(several, logic_.both(some, wanted_[u]));
        runs[u] = logic_.both(wanted_[u], some ^ 1u);
      }
      some = logic_.either(some, wanted_[u]);
    }
    if (t_.idle == mts::Idle::kHold) hold(runs, some);
    for (std::uint32_t u = 0; u < p_.strategies; ++u) {
      truth_.store(PlaneKind::kActive, u, wanted_[u]);
      if (!f_.exclusive_strategies || t_.idle == mts::Idle::kHold) truth_.store(PlaneKind::kRuns, u, runs[u]);
    }
    if (!f_.exclusive_strategies) truth_.store(PlaneKind::kSeveral, 0, several);
  }
  void hold(std::vector<Ref>& runs, Ref some) {
    Ref any_held = kZeros;
    for (std::uint32_t u = 0; u < p_.strategies; ++u) any_held = logic_.either(any_held, truth_.load(PlaneKind::kHeld, u));
    const Ref holding = logic_.both(any_held, some ^ 1u);
    const Ref on = truth_.load(PlaneKind::kHoldOn, 0), over = truth_.load(PlaneKind::kHoldOver, 0);
    truth_.store(PlaneKind::kHoldOn, 0, holding);
    const Ref expired = wait({StepKind::kHold, t_.shape.timers, holding, on, over});
    truth_.store(PlaneKind::kHoldOver, 0, expired);
    for (std::uint32_t u = 0; u < p_.strategies; ++u) {
      const Ref idle = logic_.both(truth_.load(PlaneKind::kHeld, u), some ^ 1u);
      truth_.store(PlaneKind::kHeld, u, logic_.either(runs[u], idle));
      runs[u] = logic_.either(runs[u], logic_.both(idle, expired ^ 1u));
    }
  }

  // ---- what traced fleets keep beside

  void traced() {
    logic_.append({StepKind::kTraced});
    for (std::uint32_t f = 0; f < p_.facts; ++f) {
      if (!truth_.noticed(f)) truth_.notice(f);
      truth_.store(PlaneKind::kEvent, f, truth_.event(f));
      truth_.store(PlaneKind::kLost, f, truth_.lost(f));
    }
    for (std::uint32_t r = 0; r < p_.rules.size(); ++r) truth_.store(PlaneKind::kFired, r, fire_[r]);
    for (std::uint32_t s = 0; s < p_.satellites; ++s) {
      for (std::uint32_t b = 0; b < f_.satellites[s].bits; ++b) truth_.store(PlaneKind::kBefore, s, truth_.load(PlaneKind::kCode, s, b), b);
    }
  }

  const program::Program& p_;
  const Tables& t_;
  const DerivedPlanes& derived_;
  const FleetRest rest_;   // for `truth_`
  FleetTruth truth_;
  FleetRules& rules_;
  FleetLogic& logic_;
  FleetForm& f_;
  std::vector<Ref> fire_, wanted_;
  std::map<Ref, Ref> contested_;   // in this level: rules disagree where both are true
};

}  // namespace

std::string against_fleet(const Tables& tables) {
  if (tables.shape.rules > kMostFleetRules) {
    return fmt::format("{} rules; a fleet's kernel holds {}", tables.shape.rules, kMostFleetRules);
  }
  return {};
}

FleetForm build_fleet(const program::Program& program, const Tables& tables, const FleetRest& rest) {
  const DerivedPlanes none;
  const FleetForm all_kept = FleetBuilder(program, tables, none).build();
  const DerivedPlanes derived = derived_planes(all_kept, program);
  FleetForm form = FleetBuilder(program, tables, derived).build(rest);
  if (!rest.empty()) form.resting = FleetBuilder(program, tables, derived, rest).build_resting(form);
  return form;
}

}  // namespace kb::tables
