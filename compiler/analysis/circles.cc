// Reports satellites that are never raised because the rules that raise them wait for each other.
#include <algorithm>
#include <optional>
#include <vector>

#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/subject.h"
#include "compiler/program/conditions.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::CellId;
using program::Program;
using program::Rule;
using program::RuleId;

class CircleQuestions {
 public:
  explicit CircleQuestions(Subject& subject) : subject_(subject), program_(subject.program), satisfier_(subject.satisfier()), never_(subject.program.cells.size(), false) {}

  void run() {
    bool any = false;
    for (std::uint32_t i = program_.facts; i < program_.first_strategy(); ++i) {
      never_[i] = subject_.written_only_in_vain(CellId{i}) && !can_be_high(subject_.domains, CellId{i}) && subject_.raiser[i] != RuleId::kNone;
      any = any || never_[i];
    }
    if (!any) return;
    for (const Clan& clan : subject_.clans) {
      if (clan.indexed && !std::ranges::all_of(clan.cells, [this](CellId cell) { return never(cell); })) continue;
      for (const CellId cell : clan.cells) {
        if (never(cell) && !subject_.reported[program::index(cell)]) follow(cell);
      }
    }
    for (std::uint32_t i = program_.facts; i < never_.size(); ++i) {   // all else is a consequence of what has been said, also for strategies
      if (never_[i] || (i >= program_.first_strategy() && subject_.written_only_in_vain(CellId{i}))) subject_.reported[i] = true;
    }
  }

 private:
  [[nodiscard]] bool never(CellId cell) const { return never_[program::index(cell)]; }
  [[nodiscard]] const Rule& raiser(CellId cell) const { return program_[subject_.raiser[program::index(cell)]]; }

  /// What the rule waits for, if that is one of the satellites in question.
  [[nodiscard]] std::optional<CellId> awaited(const Rule& rule) {
    for (const program::CondId part : program::conjuncts(program_, rule.condition)) {
      const Goal goal{part, true};
      if (satisfier_.together({&goal, 1}, rule.level) != Answer::kNo) continue;
      for (const program::CondId id : program::reachable(program_.conds, {part})) {
        const program::Cond& cond = program_[id];
        if (cond.op == program::Cond::Op::kIs && cond.term == program::Term::kHigh && never(cond.cell)) return cond.cell;
      }
    }
    return std::nullopt;
  }

  /// From the satellite to the one for which its rule waits, and so on. If that ends somewhere, the end has been reported.
  void follow(CellId first) {
    std::vector<CellId> way;
    for (std::optional<CellId> cell = first; cell && !subject_.reported[program::index(*cell)]; cell = awaited(raiser(*cell))) {
      const auto again = std::ranges::find(way, *cell);
      if (again != way.end()) return report({again, way.end()});
      way.push_back(*cell);
    }
  }

  void report(std::vector<CellId> circle) {
    std::rotate(circle.begin(), std::min_element(circle.begin(), circle.end()), circle.end());
    for (const CellId cell : circle) subject_.reported[program::index(cell)] = true;
    const program::Cell& cell = program_[circle.front()];
    const bool at_rule = subject_.in_library(cell.declared) && !raiser(circle.front()).standard;
    auto message = subject_.diagnostics.report(Kind::kWaitsForItself, at_rule ? raiser(circle.front()).span : cell.declared, {cell.name});
    for (std::size_t i = 0; i < std::min(circle.size(), kMostNotes); ++i) {
      const Rule& rule = raiser(circle[i]);
      message.note(Kind::kRaisesAndWaits, rule.span, {rule.name, program_[circle[i]].name, program_[circle[(i + 1) % circle.size()]].name});
    }
  }

  static constexpr std::size_t kMostNotes = 6;

  Subject& subject_;
  const Program& program_;
  Satisfier& satisfier_;
  std::vector<bool> never_;   // by cell: a rule would raise it, but none that can fire
};

}  // namespace

void diagnose_circles(Subject& subject) { CircleQuestions(subject).run(); }

}  // namespace kb::analysis
