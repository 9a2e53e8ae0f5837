// Reports rules that lose what they wait for to a `reset` of their own level.
#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/subject.h"

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

class SilencedQuestions {
 public:
  explicit SilencedQuestions(const Subject& subject)
      : subject_(subject), program_(subject.program), satisfier_(subject.program, subject.domains) {}

  void run() {
    find_resets();
    if (resets_.empty()) return;
    ByFamily<Loss> found(subject_);
    for (std::uint32_t i = 0; i < program_.rules.size() && satisfier_.steps() < Satisfier::kTotalSteps; ++i) {
      const Rule& rule = program_.rules[i];
      if (rule.reset || !resets_at_[rule.level] || Subject::generated(rule)) continue;
      if (const auto loss = loss_of(rule)) found.add(RuleId{i}, *loss);
    }
    found.for_each([&](RuleId id, const Loss& loss, std::uint32_t count) {
      const Rule& rule = program_[id];
      const Rule& reset = program_[loss.reset];
      auto message = subject_.diagnostics.report(Kind::kSilencedByReset, rule.span, {rule.name, reset.name, program_[loss.cell].name, more(count)});
      if (reset.span != rule.span) message.note(Kind::kOtherRuleHere, reset.span, {reset.name});
    });
  }

 private:
  void find_resets() {
    resets_at_.assign(program_.levels.size(), false);
    for (std::uint32_t i = 0; i < program_.rules.size(); ++i) {
      const Rule& rule = program_.rules[i];
      if (!rule.reset) continue;
      resets_at_[rule.level] = true;
      for (const std::size_t fact : awaited(satisfier_.demands(rule.condition, rule.level))) resets_[fact].push_back(RuleId{i});
    }
  }

  /// The facts that must be high, or seen.
  [[nodiscard]] std::vector<std::size_t> awaited(const Demands& demands) const {
    const std::size_t cells = program_.cells.size();
    std::vector<std::size_t> facts;
    for (const Demand& demand : demands.each) {
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
      for (const RuleId id : resets->second) {
        const Rule& reset = program_[id];
        if (reset.level != rule.level) continue;
        const auto cell = undone(subject_, demands, reset);
        if (cell && satisfier_.together(std::to_array<Goal>({{rule.condition, true}, {reset.condition, true}}), rule.level) == Answer::kYes) return Loss{id, *cell};
      }
    }
    return std::nullopt;
  }

  const Subject& subject_;
  const Program& program_;
  Satisfier satisfier_;
  std::vector<bool> resets_at_;           // by level
  std::unordered_map<std::size_t, std::vector<RuleId>> resets_;   // by fact: the rules that reset and wait for it
};

}  // namespace

void diagnose_silenced(const Subject& subject) { SilencedQuestions(subject).run(); }

}  // namespace kb::analysis
