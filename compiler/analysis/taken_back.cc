// Reports rules that wait for a satellite which a lower level takes back on the tick on which it is raised.
#include <algorithm>
#include <optional>
#include <vector>

#include "compiler/analysis/subject.h"
#include "compiler/program/conditions.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::CellId;
using program::Cond;
using program::CondId;
using program::Program;
using program::Rule;
using program::RuleId;

class TakenBackQuestions {
 public:
  explicit TakenBackQuestions(const Subject& subject)
      : subject_(subject), program_(subject.program), firing_(static_cast<float>(program_.settings.firing)), raised_(program_.cells.size()),
        taker_(program_.cells.size(), RuleId::kNone), resets_(program_.levels.size(), false) {}

  void run() {
    find_raised();
    if (!find_takers()) return;
    ByFamily<CellId> found(subject_);
    for (std::uint32_t i = 0; i < program_.rules.size(); ++i) {
      if (Subject::generated(program_.rules[i])) continue;
      if (const auto cell = missed(program_.rules[i])) found.add(RuleId{i}, *cell);
    }
    found.for_each([&](RuleId id, CellId cell, std::uint32_t count) {
      const Rule& rule = program_[id];
      const Rule& taker = program_[taker_[program::index(cell)]];
      const bool at_taker = rule.standard && !taker.standard;
      auto message = subject_.diagnostics.report(Kind::kTakenBack, at_taker ? taker.span : rule.span,
                                                 {program_[cell].name, "rule `" + std::string(rule.name) + "`", taker.name, more(count)});
      if (!at_taker) message.note(Kind::kOtherRuleHere, taker.span, {taker.name});
    });
    for (const CellId cell : outputs_) {
      const Rule& taker = program_[taker_[program::index(cell)]];
      subject_.diagnostics.report(Kind::kTakenBack, program_[cell].declared, {program_[cell].name, "the program", taker.name, ""})
          .note(Kind::kOtherRuleHere, taker.span, {taker.name});
    }
  }

 private:
  /// The levels of the rules that raise a cell; none do if `first > last`.
  struct Levels {
    std::uint32_t first = UINT32_MAX, last = 0;
  };

  void find_raised() {
    for (const Rule& rule : program_.rules) {
      if (rule.reset) resets_[rule.level] = true;
      for (const program::Write& write : rule.writes) {
        if (write.value < firing_) continue;
        Levels& levels = raised_[program::index(write.cell)];
        levels.first = std::min(levels.first, rule.level);
        levels.last = std::max(levels.last, rule.level);
      }
    }
  }

  /// The satellite for which the condition asks, if it asks for nothing else.
  [[nodiscard]] std::optional<CellId> asked(CondId id) const {
    const Cond& cond = program_[id];
    const bool high = cond.op == Cond::Op::kIs && cond.term == program::Term::kHigh && program_[cond.cell].kind == program::CellKind::kSatellite;
    return high ? std::optional(cond.cell) : std::nullopt;
  }

  /// Fills `taker_` and `outputs_`; false if there are none. A rule that asks for the satellite alone fires whenever its level finds it high, and is
  /// armed again by what it writes. A `reset` may silence it, and then lowers the satellite itself, unless that is declared `keep`.
  bool find_takers() {
    bool any = false;
    for (std::uint32_t i = 0; i < program_.rules.size(); ++i) {
      const Rule& rule = program_.rules[i];
      const auto cell = asked(rule.condition);
      if (!cell) continue;
      const Levels& levels = raised_[program::index(*cell)];
      RuleId& taker = taker_[program::index(*cell)];
      const bool after = levels.first <= levels.last && levels.last < rule.level;
      if (!after || taker != RuleId::kNone || program_[*cell].initial >= firing_ || (program_[*cell].keep && resets_[rule.level])) continue;
      const auto value = program::net_value(program_, subject_.group_of, rule, *cell);
      if (!value || *value >= firing_) continue;
      taker = RuleId{i};
      any = true;
      if (program_[*cell].output) outputs_.push_back(*cell);
    }
    return any;
  }

  /// A satellite for which the rule waits in vain.
  [[nodiscard]] std::optional<CellId> missed(const Rule& rule) const {
    for (CondId part : program::conjuncts(program_, rule.condition)) {
      if (program_[part].op == Cond::Op::kFor) part = program_[part].children.front();
      const auto cell = asked(part);
      if (!cell || taker_[program::index(*cell)] == RuleId::kNone) continue;
      const bool found_high = raised_[program::index(*cell)].first < rule.level && rule.level <= program_[taker_[program::index(*cell)]].level;
      if (!found_high) return cell;
    }
    return std::nullopt;
  }

  const Subject& subject_;
  const Program& program_;
  float firing_;
  std::vector<Levels> raised_;    // by cell
  std::vector<RuleId> taker_;     // by cell: the rule that lowers it again on the tick on which it is raised
  std::vector<bool> resets_;      // by level: whether a rule resets
  std::vector<CellId> outputs_;   // that are taken back
};

}  // namespace

void diagnose_taken_back(const Subject& subject) { TakenBackQuestions(subject).run(); }

}  // namespace kb::analysis
