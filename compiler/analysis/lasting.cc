// Reports strategies that stay wanted for ever, so that strategies of lower priority never run again.
#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/subject.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::CellId;
using program::Program;
using program::Rule;
using program::RuleId;

struct Lasting {
  CellId strategy = CellId::kNone, satellite = CellId::kNone;
  CellId starved = CellId::kNone;      ///< comes after it, and can be wanted; none if it is the last
  RuleId lowering = RuleId::kNone;     ///< would lower the satellite, but can never fire
};

class LastingQuestions {
 public:
  explicit LastingQuestions(const Subject& subject)
      : subject_(subject), program_(subject.program), firing_(static_cast<float>(program_.settings.firing)), satisfier_(subject.satisfier()),
        lowered_(program_.cells.size(), false), raised_once_(program_.cells.size(), false), spared_by_clears_(program_.cells.size()), raised_by_resets_(program_.cells.size()),
        dead_(program_.cells.size(), RuleId::kNone), dead_clears_(program_.exclusive.size()), clears_(program_.exclusive.size()) {
    find_strategies();
    for (const auto& cells : program_.exclusive) {
      wanting_group_.push_back(std::any_of(cells.begin(), cells.end(), [this](CellId cell) { return wanting(cell); }));
    }
    for (std::uint32_t i = 0; i < program_.rules.size(); ++i) count(RuleId{i});
  }

  void run() {
    ByFamily<Lasting> found(subject_);
    std::vector<bool> told(program_.cells.size(), false);
    std::map<std::uint32_t, std::set<std::uint32_t>> leaving;   // by family: its instances
    for (const bool library : {false, true}) {   // if rules of both raise it, the message is about the user's
      for (std::uint32_t i = 0; i < program_.rules.size(); ++i) {
        if (program_.rules[i].standard != library) continue;
        for (const program::Write& write : program_.rules[i].writes) {
          if (write.value < firing_ || told[program::index(write.cell)] || !lasts(write.cell) || !matters(write.cell) || !can_fire(program_.rules[i])) continue;
          told[program::index(write.cell)] = true;
          const CellId strategy = wants_[program::index(write.cell)];
          found.add(RuleId{i}, {strategy, write.cell, starved_[program::index(strategy)], dead_lowering(write.cell)});
          leaving[subject_.family[i]].insert(i);
        }
      }
    }
    found.for_each([&](RuleId rule, const Lasting& lasting, std::uint32_t count) {
      const bool one = leaving[subject_.family[program::index(rule)]].size() == 1;
      report(program_[rule], lasting, one ? more(count, "that it leaves wanted") : more(count));
    });
  }

 private:
  [[nodiscard]] bool wanting(CellId satellite) const { return wants_[program::index(satellite)] != CellId::kNone; }

  [[nodiscard]] bool can_fire(const Rule& rule) {
    const Goal goal{rule.condition, true};
    return satisfier_.together({&goal, 1}, rule.level) != Answer::kNo;
  }

  [[nodiscard]] bool lowers(const program::Write& write) const {
    return write.value < firing_ && wanting(write.cell) && !lowered_[program::index(write.cell)];
  }

  /// Counts the rule among those that lower cells. A clear lowers all members of its group, and a reset all satellites, except those that
  /// the same rule raises; these exceptions are counted too. No rule lowers a cell that cannot be high while the rule fires, as `no Step` in its
  /// condition says of all steps. Whether the rule can fire is costly to find out, and asked only if it matters.
  void count(RuleId id) {
    const Rule& rule = program_[id];
    const bool matters = rule.reset || std::any_of(rule.writes.begin(), rule.writes.end(), [this](const auto& write) { return lowers(write); }) ||
                         std::any_of(rule.clears.begin(), rule.clears.end(), [this](std::uint32_t group) { return wanting_group_[group]; });
    if (!matters) return;
    if (!can_fire(rule)) return count_dead(id);
    resets_ += rule.reset ? 1 : 0;
    const Demands demands = satisfier_.demands(rule.condition, rule.level);
    for (const program::Write& write : rule.writes) {
      const std::size_t cell = program::index(write.cell);
      if (write.value < firing_ && !asks_that_it_is_not_high(demands, write.cell)) lowered_[cell] = true;
      raised_by_resets_[cell] += rule.reset ? 1 : 0;
    }
    for (const std::uint32_t group : rule.clears) {
      if (wanting_group_[group]) count_clear(rule, group, demands);
    }
  }

  [[nodiscard]] static bool asks_that_it_is_not_high(const Demands& demands, CellId cell) {
    const auto at = std::lower_bound(demands.each.begin(), demands.each.end(), program::index(cell), [](const Restriction& r, std::size_t c) { return r.variable < c; });
    return at != demands.each.end() && at->variable == program::index(cell) && rules_out_high(*at);
  }
  [[nodiscard]] static bool rules_out_high(const Restriction& demand) { return (demand.allowed & regions_of(program::Term::kHigh)) == 0; }

  /// A rule that asks for one member of an exclusive group lowers no other.
  void count_clear(const Rule& rule, std::uint32_t group, const Demands& demands) {
    const auto of_group = [&](std::size_t variable) { return variable < program_.cells.size() && subject_.group_of[variable] == group; };
    const auto asked = std::find_if(demands.holders.begin(), demands.holders.end(), [&](const Holder& holder) { return of_group(holder.variable); });
    if (asked != demands.holders.end()) {
      if (program::net_value(program_, subject_.group_of, rule, CellId{asked->variable}).value_or(firing_) < firing_) lowered_[asked->variable] = true;
      return;
    }
    std::set<std::size_t> spared;
    for (const program::Write& write : rule.writes) {
      if (of_group(program::index(write.cell))) spared.insert(program::index(write.cell));
    }
    for (const Restriction& demand : demands.each) {
      if (of_group(demand.variable) && rules_out_high(demand)) spared.insert(demand.variable);
    }
    ++clears_[group];
    for (const std::size_t cell : spared) ++spared_by_clears_[cell];
  }

  void count_dead(RuleId id) {
    const Rule& rule = program_[id];
    if (rule.reset) dead_resets_.push_back(id);
    for (const std::uint32_t group : rule.clears) {
      if (wanting_group_[group]) dead_clears_[group].push_back(id);
    }
    for (const program::Write& write : rule.writes) {
      if (write.value < firing_) dead_[program::index(write.cell)] = id;
    }
  }

  /// A rule that can never fire and would lower the satellite, if there is one.
  [[nodiscard]] RuleId dead_lowering(CellId satellite) const {
    if (const RuleId known = dead_[program::index(satellite)]; known != RuleId::kNone) return known;
    const auto lowers_it = [&](RuleId id) { return program::net_value(program_, subject_.group_of, program_[id], satellite).value_or(firing_) < firing_; };
    const auto last_of = [&](const std::vector<RuleId>& rules) {   // a rule of these may raise the satellite
      const auto found = std::find_if(rules.rbegin(), rules.rend(), lowers_it);
      return found != rules.rend() ? *found : RuleId::kNone;
    };
    const std::uint32_t group = subject_.group_of[program::index(satellite)];
    const RuleId clears = group == program::kNoGroup ? RuleId::kNone : last_of(dead_clears_[group]);
    return clears != RuleId::kNone ? clears : last_of(dead_resets_);
  }

  /// Fills `wants_` and `starved_`. A strategy can starve another only if one of lower priority can be wanted as well, or is the idle one.
  void find_strategies() {
    for (const Rule& rule : program_.rules) {
      for (const program::Write& write : rule.writes) {
        if (rule.mode == program::Mode::kWhen && write.value >= firing_) raised_once_[program::index(write.cell)] = true;
      }
    }
    wants_.assign(program_.cells.size(), CellId::kNone);
    starved_.assign(program_.cells.size(), CellId::kNone);
    CellId after = CellId::kNone;
    for (auto at = program_.priority.rbegin(); at != program_.priority.rend(); ++at) {
      starved_[program::index(*at)] = after;
      const bool idle = program_.settings.idle == program::Idle::kStrategy && program_.settings.idle_strategy == *at;
      if (after != CellId::kNone || !idle) {
        for (const CellId satellite : program_[*at].satellites) wants_[program::index(satellite)] = *at;
      }
      if (idle || attended_at_times(program_, subject_.domains, *at)) after = *at;
    }
  }

  /// The last strategy starves none. But where only `while` rules raise it, it was meant to end with what they ask for.
  [[nodiscard]] bool matters(CellId satellite) const {
    const CellId strategy = wants_[program::index(satellite)];
    return starved_[program::index(strategy)] != CellId::kNone || !raised_once_[program::index(satellite)];
  }

  /// Whether no rule lowers the satellite once it is raised. If it is high from the start, that is on purpose.
  [[nodiscard]] bool lasts(CellId satellite) const {
    const std::size_t cell = program::index(satellite);
    const program::Cell& it = program_[satellite];
    if (!wanting(satellite) || lowered_[cell] || it.initial >= firing_) return false;
    if (!it.keep && resets_ > raised_by_resets_[cell]) return false;
    const std::uint32_t group = subject_.group_of[cell];
    return group == program::kNoGroup || clears_[group] == spared_by_clears_[cell];
  }

  void report(const Rule& rule, const Lasting& lasting, const std::string& others) const {
    const std::string_view satellite = program_[lasting.satellite].name;
    const std::string consequence =
        lasting.starved == CellId::kNone ? "" : fmt::format(", so `{}`, which comes after it, never runs again", program_[lasting.starved].name);
    const bool dead = lasting.lowering != RuleId::kNone;
    auto message = subject_.diagnostics.report(Kind::kNeverLowered, rule.span,
        {program_[lasting.strategy].name, rule.name, satellite, consequence, others, dead ? "that can fire " : ""});
    if (dead) message.note(Kind::kLoweringIsDead, program_[lasting.lowering].span, {program_[lasting.lowering].name});
    if (rule.mode == program::Mode::kWhile) message.note(Kind::kWhileLeavesWritten, {}, {satellite});
  }

  const Subject& subject_;
  const Program& program_;
  float firing_;
  Satisfier& satisfier_;
  std::uint32_t resets_ = 0;
  std::vector<RuleId> dead_resets_;                                  // of the rules that can never fire, those that reset
  std::vector<bool> lowered_;                                        // by cell: a rule writes less than `firing` to it
  std::vector<bool> raised_once_;                                    // by cell: a `when` rule raises it
  std::vector<std::uint32_t> spared_by_clears_, raised_by_resets_;   // by cell: how many rules clear its group and do not lower it, or reset and raise it
  std::vector<RuleId> dead_;                                         // by cell: of the rules that can never fire, one that lowers it by name
  std::vector<std::vector<RuleId>> dead_clears_;                     // by group: of the rules that can never fire, those that clear it
  std::vector<std::uint32_t> clears_;                                // by group: how many rules clear it
  std::vector<CellId> wants_;                                        // by satellite: the strategy that it makes wanted, if that can starve another
  std::vector<CellId> starved_;                                      // by strategy: the one that it can starve
  std::vector<bool> wanting_group_;                                  // by group: a member makes a strategy wanted
};

}  // namespace

void diagnose_lasting(const Subject& subject) { LastingQuestions(subject).run(); }

}  // namespace kb::analysis
