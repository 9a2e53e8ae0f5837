// Reports rules that lose what they wait for to a `reset` of their own level or one above, and resets that last.
#include <algorithm>
#include <optional>
#include <unordered_map>
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
using program::Program;
using program::Rule;
using program::RuleId;

/// A rule that resets, and the cell whose change by it takes the chance from another rule.
struct Loss {
  RuleId reset = RuleId::kNone;
  CellId cell = CellId::kNone;
};

using Alike = std::vector<RuleId>;   // rules of one level with the same effects: a rule loses the same to each of them

class SilencedQuestions {
 public:
  explicit SilencedQuestions(const Subject& subject)
      : subject_(subject), program_(subject.program), satisfier_(subject.satisfier()) {}

  void find_losses() {
    find_resets();
    if (resets_.empty()) return;
    const std::vector<bool> may_lose = asking_for([this](std::size_t fact) { return resets_.contains(fact); });
    ByFamily<Loss> found(subject_);
    for (std::uint32_t i = 0; i < program_.rules.size() && satisfier_.steps() < Satisfier::kTotalSteps; ++i) {
      const Rule& rule = program_.rules[i];
      if (!may_lose[program::index(rule.condition)] || Subject::generated(rule) || rule.level < highest_ || (rule.reset && rule.level == highest_)) continue;
      if (const auto loss = loss_of(rule)) found.add(RuleId{i}, *loss);
    }
    found.for_each([&](RuleId id, const Loss& loss, std::uint32_t count) {
      const Rule& rule = program_[id];
      const Rule& reset = program_[loss.reset];
      auto message = subject_.diagnostics.report(Kind::kSilencedByReset, rule.span, {rule.name, reset.name, program_[loss.cell].name, more(count),
                                                                                             reset.level == rule.level ? std::string() : "stand at level `" + program_.levels[reset.level] + "`, "});
      if (reset.span != rule.span) message.note(Kind::kOtherRuleHere, reset.span, {reset.name});
    });
  }

  /// Reports `while` rules that reset on a level where another rule waits for the same fact, or writes what is kept: for as long as such a rule fires
  /// the other one does not. What the `reset` also takes a satellite from is left to the message about that.
  void find_lasting() {
    std::vector<std::pair<RuleId, std::vector<std::size_t>>> resets;   // and the facts that they await
    for (std::uint32_t i = 0; i < program_.rules.size(); ++i) {
      const Rule& rule = program_.rules[i];
      if (!rule.reset || rule.mode != program::Mode::kWhile || Subject::generated(rule)) continue;
      const Demands demands = satisfier_.demands(rule.condition, rule.level);
      if (undone(subject_, demands, rule)) continue;   // it resets once
      for (const std::size_t fact : resets.emplace_back(RuleId{i}, awaited(demands)).second) waiting_[fact];
    }
    if (resets.empty()) return;
    find_waiting();
    ByFamily<RuleId> found(subject_);
    for (const auto& [reset, facts] : resets) {
      if (const RuleId other = silenced_by(program_[reset], facts); other != RuleId::kNone) found.add(reset, other);
    }
    found.for_each([&](RuleId id, RuleId other, std::uint32_t count) {
      const Rule& rule = program_[id];
      const bool lasting = !satisfier_.is_moment(satisfier_.demands(rule.condition, rule.level).each);
      subject_.diagnostics.report(Kind::kSilencesLevel, rule.span, {rule.name, program_.levels[rule.level], program_[other].name, more(count),
                                                                    lasting ? "`when` resets once, and " : ""});
    });
  }

 private:
  static constexpr std::size_t kKept = static_cast<std::size_t>(-1);   // in place of a fact

  /// By condition: whether it asks for such a fact.
  template <class Asked>
  [[nodiscard]] std::vector<bool> asking_for(Asked asked) const {
    return program::marked(program_, [asked](const program::Cond& cond) { return !program::has_parts(cond.op) && asked(program::index(cond.cell)); });
  }

  /// Completes `waiting_`, which has the facts in question.
  void find_waiting() {
    const std::vector<bool> may_wait = asking_for([this](std::size_t fact) { return waiting_.contains(fact); });
    std::vector<RuleId>& keeping = waiting_[kKept];
    for (std::uint32_t i = 0; i < program_.rules.size() && satisfier_.steps() < Satisfier::kTotalSteps; ++i) {
      const Rule& rule = program_.rules[i];
      if (rule.reset || Subject::generated(rule)) continue;
      if (may_wait[program::index(rule.condition)]) {
        for (const std::size_t fact : awaited(satisfier_.demands(rule.condition, rule.level))) {
          if (const auto waiting = waiting_.find(fact); waiting != waiting_.end()) waiting->second.push_back(RuleId{i});
        }
      }
      if (std::ranges::any_of(rule.writes, [this](const program::Write& write) { return program_[write.cell].keep; })) keeping.push_back(RuleId{i});
    }
  }

  [[nodiscard]] RuleId silenced_by(const Rule& reset, std::vector<std::size_t> facts) {
    facts.push_back(kKept);
    for (const std::size_t fact : facts) {
      for (const RuleId id : of_level(program_, waiting_.at(fact), reset.level)) {
        if (satisfier_.steps() >= Satisfier::kTotalSteps) return RuleId::kNone;
        if (fires_with(program_[id], reset)) return id;
      }
    }
    return RuleId::kNone;
  }

  [[nodiscard]] bool fires_with(const Rule& rule, const Rule& reset) {
    const Demands demands = satisfier_.demands(rule.condition, rule.level);
    const Goal goals[] = {{rule.condition, true}, {reset.condition, true}};
    return demands.possible && !undone(subject_, demands, reset) && satisfier_.together(goals, reset.level) == Answer::kYes;
  }

  void find_resets() {
    for (std::uint32_t i = 0; i < program_.rules.size(); ++i) {
      const Rule& rule = program_.rules[i];
      if (!rule.reset) continue;
      highest_ = std::min(highest_, rule.level);
      for (const std::size_t fact : awaited(satisfier_.demands(rule.condition, rule.level))) {
        std::vector<Alike>& all = resets_[fact];
        const auto alike = std::ranges::find_if(all, [&](const Alike& one) {
          const Rule& first = program_[one.front()];
          return first.level == rule.level && program::same_effects(first, rule);
        });
        (alike == all.end() ? all.emplace_back() : *alike).push_back(RuleId{i});
      }
    }
  }

  /// The facts that must be high, or seen.
  [[nodiscard]] std::vector<std::size_t> awaited(const Demands& demands) const {
    const std::size_t cells = program_.cells.size();
    std::vector<std::size_t> facts;
    for (const Restriction& demand : demands.each) {
      const bool sighting = demand.variable >= cells;
      const std::size_t fact = sighting ? demand.variable - cells : demand.variable;
      if (fact < program_.facts && (demand.allowed & ~(sighting ? kSeen : regions_of(program::Term::kHigh))) == 0) facts.push_back(fact);
    }
    return facts;
  }

  /// What a rule loses to a `reset` that waits for the same fact. (Any rule that resets silences others at times; only where both wait for
  /// one fact do they fire together as a rule.)
  [[nodiscard]] std::optional<Loss> loss_of(const Rule& rule) {
    const Demands demands = satisfier_.demands(rule.condition, rule.level);
    if (!demands.possible) return std::nullopt;
    for (const std::size_t fact : awaited(demands)) {
      const auto resets = resets_.find(fact);
      if (resets == resets_.end()) continue;
      for (const Alike& alike : resets->second) {
        const Rule& first = program_[alike.front()];
        if (first.level > rule.level || (first.level == rule.level && rule.reset)) continue;   // resets of one level fire together
        const auto cell = undone(subject_, demands, first);
        if (!cell) continue;
        for (const RuleId id : alike) {
          const Goal goals[] = {{rule.condition, true}, {program_[id].condition, true}};
          if (satisfier_.together(goals, first.level) == Answer::kYes) return Loss{id, *cell};
        }
      }
    }
    return std::nullopt;
  }

  const Subject& subject_;
  const Program& program_;
  Satisfier& satisfier_;
  std::unordered_map<std::size_t, std::vector<RuleId>> waiting_;   // by fact: the rules that wait for it, ascending; kKept: those that write what is kept
  std::uint32_t highest_ = UINT32_MAX;     // level of rules that reset
  std::unordered_map<std::size_t, std::vector<Alike>> resets_;   // by fact: the rules that reset and wait for it
};

}  // namespace

void diagnose_silenced(const Subject& subject) {
  SilencedQuestions(subject).find_lasting();
  SilencedQuestions(subject).find_losses();   // with a budget of its own
}

}  // namespace kb::analysis
