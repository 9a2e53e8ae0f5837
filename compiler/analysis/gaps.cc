// Reports timers that may run on although what they time ended and began again between two looks.
//
// note [unseen gaps]
// A timer looks once a tick, when the rules of its level are evaluated. A satellite that is lowered at that level or below it, after the look,
// and raised above it on the next tick, before the look, was high at every look. So was one that is lowered and raised again on one tick, on two
// levels with no look between them. For each timer, each rule that could lower its satellite there
// and each that could raise it, what the satellites can be is followed from the one look to the next. A pair is left out as soon as one of the rules,
// or the timer itself, asks for what cannot be. What other rules of the levels between could write counts as possible.
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/subject.h"
#include "compiler/program/conditions.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::CellId;
using program::CellKind;
using program::Cond;
using program::CondId;
using program::Program;
using program::Rule;
using program::RuleId;

constexpr std::uint64_t kMostGapSteps = 1'000'000;
constexpr Regions kHighRegions = kRegionHigh | kRegionHighZero;

/// A timer at its level, the satellite that it needs high, and the rules that lower and raise that between two looks.
struct Gap {
  CondId timer = CondId::kNone;
  CellId cell = CellId::kNone;
  RuleId lowers = RuleId::kNone, raises = RuleId::kNone;
};

/// What all questions share.
struct Common {
  explicit Common(const Subject& of)
      : subject(of), program(of.program), satisfier(of.satisfier()) {}

  const Demands& demands_of(RuleId rule) {
    const auto [known, fresh] = demands.try_emplace(rule);
    if (fresh) known->second = satisfier.demands(program[rule].condition, program[rule].level);
    return known->second;
  }
  [[nodiscard]] bool spent() const { return steps + satisfier.steps() > kMostGapSteps; }

  const Subject& subject;
  const Program& program;
  Satisfier& satisfier;
  std::map<RuleId, Demands> demands;
  std::uint64_t steps = 0;
};

/// What cells and sightings can be at one moment. A cell that is not listed can be anything that it ever is.
class State {
 public:
  explicit State(Common& common) : common_(common), program_(common.program) {}

  /// False if the condition, which demands this, cannot hold.
  [[nodiscard]] bool demand(const Demands& demands, CondId condition) {
    if (!demands.possible) return false;
    for (const Restriction& one : demands.each) {
      if (one.variable >= program_.cells.size() + program_.facts) continue;   // timers
      ++common_.steps;
      const auto left = static_cast<std::uint8_t>(possible(one.variable) & one.allowed);
      if (left == 0) return false;
      values_[one.variable] = left;
      if (is_satellite(one.variable) && (left & ~kHighRegions) == 0) keep_others_down(one.variable);
    }
    return may(condition, true);
  }

  /// The rule fires; others of its level may.
  void fire(RuleId id) {
    const Rule& rule = program_[id];
    Values after = values_;
    for (const program::Write& write : rule.writes) {
      if (is_satellite(static_cast<std::uint32_t>(write.cell))) after.try_emplace(static_cast<std::uint32_t>(write.cell), std::uint8_t{0});
    }
    for (auto& [variable, value] : after) {
      if (!is_satellite(variable)) continue;
      const auto written = program::net_value(program_, common_.subject.group_of, rule, CellId{variable});
      if (written) value = region_of(*written, firing());
      value |= written_at(rule.level, variable, id);
    }
    values_ = std::move(after);
  }

  /// Rules of the levels from `first` to before `end` may fire.
  void pass(std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t level = first; level < end; ++level) {
      Values after = values_;
      for (auto& [variable, value] : after) {
        if (is_satellite(variable)) value |= written_at(level, variable, RuleId::kNone);
      }
      values_ = std::move(after);
    }
  }

  /// The next tick begins: what was seen is in view or just lost, and the certainty of facts is any.
  void next_tick() {
    const auto cells = static_cast<std::uint32_t>(program_.cells.size());
    std::erase_if(values_, [&](const auto& entry) { return entry.first < cells && !is_satellite(entry.first); });
    for (auto& [variable, value] : values_) {
      if (variable < cells) continue;
      const Sightings from_seen = (value & kSeen) != 0 ? kStillSeen | kJustLost : Sightings{0};
      const Sightings from_unseen = (value & ~kSeen) != 0 ? kUnseen | kJustSeen : Sightings{0};
      value = from_seen | from_unseen;
    }
  }

 private:
  using Values = std::map<std::uint32_t, std::uint8_t>;
  static constexpr std::size_t kFewMembers = 32;   // of larger groups the other members are not followed

  [[nodiscard]] float firing() const { return static_cast<float>(program_.settings.firing); }
  [[nodiscard]] bool is_satellite(std::uint32_t variable) const {
    return variable < program_.cells.size() && program_.cells[variable].kind == CellKind::kSatellite;
  }

  void keep_others_down(std::uint32_t variable) {
    const std::uint32_t group = common_.subject.group_of[variable];
    if (group == program::kNoGroup || !common_.subject.exclusive(group) || program_.exclusive[group].size() > kFewMembers) return;
    for (const CellId member : program_.exclusive[group]) {
      const auto other = static_cast<std::uint32_t>(member);
      if (other != variable) values_[other] = static_cast<std::uint8_t>(possible(other) & ~kHighRegions);
    }
  }

  [[nodiscard]] std::uint8_t possible(std::uint32_t variable) const {
    if (const auto known = values_.find(variable); known != values_.end()) return known->second;
    return variable < program_.cells.size() ? common_.subject.domains.cells[variable] : std::uint8_t{kAnySighting};
  }

  /// Whether the condition may be as wanted, part by part. Recursion as deep as conditions nest.
  [[nodiscard]] bool may(CondId id, bool wanted) const {
    ++common_.steps;
    const Cond& cond = program_[id];
    const auto is = [&](std::size_t variable, std::uint8_t allowed) {
      return (possible(static_cast<std::uint32_t>(variable)) & (wanted ? allowed : static_cast<std::uint8_t>(~allowed))) != 0;
    };
    const std::size_t sighting = program_.cells.size() + program::index(cond.cell);
    switch (cond.op) {
      case Cond::Op::kNot: return may(cond.children.front(), !wanted);
      case Cond::Op::kFor: return !wanted || may(cond.children.front(), true);
      case Cond::Op::kIs: return is(program::index(cond.cell), regions_of(cond.term));
      case Cond::Op::kSeen: return is(sighting, kSeen);
      case Cond::Op::kEvent: return is(sighting, kJustSeen);
      case Cond::Op::kLost: return is(sighting, kJustLost);
      default: break;
    }
    const auto part_may = [&](CondId part) { return may(part, wanted); };
    return (cond.op == Cond::Op::kAnd) == wanted ? std::ranges::all_of(cond.children, part_may) : std::ranges::any_of(cond.children, part_may);
  }

  /// What the rules of a level, except one, may write to a cell, if they can fire in this state.
  [[nodiscard]] Regions written_at(std::uint32_t level, std::uint32_t variable, RuleId except) const {
    const std::uint32_t group = common_.subject.group_of[variable];
    Regions regions = written_by(common_.subject.writers.by_name[variable], level, variable, except);
    if (group != program::kNoGroup) regions |= written_by(common_.subject.writers.by_clear[group], level, variable, except);
    return regions | written_by(common_.subject.writers.by_reset, level, variable, except);
  }

  [[nodiscard]] Regions written_by(std::span<const RuleId> rules, std::uint32_t level, std::uint32_t variable, RuleId except) const {
    Regions regions = 0;
    for (const RuleId id : of_level(program_, rules, level)) {
      ++common_.steps;
      if (id == except || common_.spent()) continue;
      const auto value = program::net_value(program_, common_.subject.group_of, program_[id], CellId{variable});
      if (value && (regions & region_of(*value, firing())) == 0 && goes_with(common_.demands_of(id))) regions |= region_of(*value, firing());
    }
    return regions;
  }

  [[nodiscard]] bool goes_with(const Demands& demands) const {
    return demands.possible && std::ranges::all_of(demands.each, [this](const Restriction& one) {
      const auto known = values_.find(one.variable);
      return known == values_.end() || (known->second & one.allowed) != 0;
    });
  }

  Common& common_;
  const Program& program_;
  Values values_;
};

class GapQuestions {
 public:
  explicit GapQuestions(const Subject& subject)
      : subject_(subject), program_(subject.program), firing_(static_cast<float>(program_.settings.firing)), common_(subject), told_(subject.instances.size()),
        times_(program::marked(program_, is_timer)) {}

  void run() {
    if (subject_.diagnostics.full(Kind::kUnseenGap)) return;
    ByFamily<Gap> found(subject_);
    for (const bool library : {false, true}) {   // the user's first, should there be too many
      for (std::uint32_t i = 0; i < program_.rules.size(); ++i) {
        const Rule& rule = program_.rules[i];
        if (rule.standard != library || Subject::generated(rule)) continue;
        std::vector<bool>::reference told = told_[subject_.family[i]];
        if (told) continue;
        const auto gap = gap_of(rule);
        told = gap.has_value();
        if (gap) found.add(RuleId{i}, *gap);
      }
    }
    found.for_each([&](RuleId id, const Gap& gap, std::uint32_t) { report(program_[id], gap); });
  }

 private:
  [[nodiscard]] static bool is_timer(const Cond& cond) { return cond.op == Cond::Op::kFor && cond.duration_us != 0; }

  [[nodiscard]] std::optional<Gap> gap_of(const Rule& rule) {
    if (!times_[program::index(rule.condition)]) return std::nullopt;
    for (const CondId id : program::reachable(program_.conds, {rule.condition})) {
      if (!is_timer(program_[id])) continue;
      const bool hidden = rule.standard && !subject_.diagnostics.options().standard_library;
      const auto [known, fresh] = known_.try_emplace({id, rule.level, hidden});
      if (fresh) known->second = search(id, rule.level, hidden);
      if (known->second) return known->second;
    }
    return std::nullopt;
  }

  /// Where the timer is the library's, messages about rules of the library alone would be `hidden`.
  [[nodiscard]] std::optional<Gap> search(CondId timer, std::uint32_t level, bool hidden) {
    if (common_.spent()) return std::nullopt;
    const Demands timed = common_.satisfier.demands(program_[timer].children.front(), level);
    if (!timed.possible) return std::nullopt;
    for (const Restriction& one : timed.each) {
      const bool satellite = one.variable < program_.cells.size() && program_.cells[one.variable].kind == CellKind::kSatellite;
      if (!satellite || (one.allowed & ~kHighRegions) != 0) continue;
      const CellId cell{one.variable};
      const std::vector<RuleId> raisers = that_write(cell, true);
      if (raisers.empty()) continue;
      for (const RuleId lowers : that_write(cell, false)) {
        for (const RuleId raises : raisers) {
          ++common_.steps;
          if (common_.spent()) return std::nullopt;
          const auto ticks = between_looks(level, program_[lowers].level, program_[raises].level);
          if (!ticks || (hidden && is_of_library(lowers, raises, *ticks))) continue;
          if (possible({timed, program_[timer].children.front(), level}, lowers, raises, *ticks)) return Gap{timer, cell, lowers, raises};
        }
      }
    }
    return std::nullopt;
  }

  /// The rules that leave the cell high, or not high.
  [[nodiscard]] std::vector<RuleId> that_write(CellId cell, bool high) {
    std::set<RuleId> all;
    const auto add = [&](std::span<const RuleId> rules) {
      for (const RuleId id : rules) {
        ++common_.steps;
        const Rule& rule = program_[id];
        const auto value = program::net_value(program_, subject_.group_of, rule, cell);
        if (value && (*value >= firing_) == high) all.insert(id);
      }
    };
    add(subject_.writers.by_name[program::index(cell)]);
    if (const std::uint32_t group = subject_.group_of[program::index(cell)]; group != program::kNoGroup) add(subject_.writers.by_clear[group]);
    add(subject_.writers.by_reset);
    return {all.begin(), all.end()};
  }

  struct Timed {
    const Demands& demands;
    CondId condition;
    std::uint32_t level;
  };

  /// On which tick a pair of rules makes a gap, counted from the first of two looks.
  struct Ticks {
    bool lowers_next, raises_next;
  };

  /// Nothing if a look lies between the rule that lowers and the one that raises.
  [[nodiscard]] static std::optional<Ticks> between_looks(std::uint32_t look, std::uint32_t lowers, std::uint32_t raises) {
    if (lowers >= look && raises < look) return Ticks{false, true};
    if (lowers < raises && (lowers >= look) == (raises >= look)) return Ticks{lowers < look, raises < look};
    return std::nullopt;
  }

  /// Whether nothing is left to the user where the timer is the library's: both rules are, or only what the library raises on the same tick
  /// hides that a rule of the user lowers it.
  [[nodiscard]] bool is_of_library(RuleId lowers, RuleId raises, Ticks ticks) const {
    return program_[raises].standard && (program_[lowers].standard || ticks.lowers_next == ticks.raises_next);
  }

  /// Whether `lowers` can fire after the timer has looked, `raises` after that and before it looks again, and the timer find all that it asks for
  /// at both looks.
  [[nodiscard]] bool possible(const Timed& timed, RuleId lowers, RuleId raises, Ticks ticks) {
    const Rule& down = program_[lowers];
    const Rule& up = program_[raises];
    State state(common_);
    if (!state.demand(timed.demands, timed.condition) || !times_in(state, raises)) return false;
    std::uint32_t at = timed.level;
    if (ticks.lowers_next) at = end_tick(state, at);
    state.pass(at, down.level);
    if (!state.demand(common_.demands_of(lowers), down.condition)) return false;
    if (ticks.raises_next && !ticks.lowers_next && !times_in(state, raises)) return false;
    state.fire(lowers);
    at = down.level + 1;
    if (ticks.raises_next && !ticks.lowers_next) at = end_tick(state, at);
    state.pass(at, up.level);
    if (!state.demand(common_.demands_of(raises), up.condition)) return false;
    state.fire(raises);
    at = up.level + 1;
    if (!ticks.raises_next) at = end_tick(state, at);
    state.pass(at, timed.level);
    return state.demand(timed.demands, timed.condition);
  }

  /// The level at which the state is then.
  [[nodiscard]] std::uint32_t end_tick(State& state, std::uint32_t at) const {
    state.pass(at, static_cast<std::uint32_t>(program_.levels.size()));
    state.next_tick();
    return 0;
  }

  /// Whether what the timers time that a rule demands may be so. On the tick before the rule fires it has to.
  [[nodiscard]] bool times_in(const State& state, RuleId rule) {
    const std::size_t timers = program_.cells.size() + program_.facts;
    return std::ranges::all_of(common_.demands_of(rule).each, [&](const Restriction& one) {
      if (one.variable < timers || one.allowed != Satisfier::kTimerTrue) return true;
      const Cond& cond = program_.conds[one.variable - timers];
      const CondId part = cond.children.front();
      return cond.duration_us == 0 || State(state).demand(common_.satisfier.demands(part, program_[rule].level), part);
    });
  }

  void report(const Rule& rule, const Gap& gap) const {
    const Rule& lowers = program_[gap.lowers];
    const Rule& raises = program_[gap.raises];
    const Rule& at = !rule.standard ? rule : !raises.standard ? raises : !lowers.standard ? lowers : rule;
    const std::string_view cell = program_[gap.cell].name, level = program_.levels[rule.level];
    auto message = subject_.diagnostics.report(Kind::kUnseenGap, at.span,
        {program::print_condition(program_, gap.timer), rule.name, cell, lowers.name, level, raises.name});
    message.note(Kind::kGapIsSeen, {}, {raises.name, level, cell, rule.name, program_.levels[raises.level]});
    for (const Rule* other : {&rule, &lowers, &raises}) {
      const bool twice = other->span == at.span || (other == &raises && other->span == lowers.span);
      if (!twice) message.note(Kind::kOtherRuleHere, other->span, {other->name});
    }
  }

  const Subject& subject_;
  const Program& program_;
  float firing_;
  Common common_;
  std::vector<bool> told_;    // by family: an instance speaks for all
  std::vector<bool> times_;   // by condition: there is a timer in it. Most rules of a large map have none
  std::map<std::tuple<CondId, std::uint32_t, bool>, std::optional<Gap>> known_;   // by timer, level, and `hidden`
};

}  // namespace

void diagnose_gaps(const Subject& subject) { GapQuestions(subject).run(); }

}  // namespace kb::analysis
