#include "compiler/analysis/conflict_findings.h"

#include <algorithm>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::CellId;
using program::Rule;
using program::RuleId;

constexpr std::size_t kMostTold = 5;    // pairs of one level about one thing
constexpr std::size_t kMostNamed = 3;   // rules and cells of the others

class ConflictReports {
 public:
  ConflictReports(const Subject& subject, Satisfier& satisfier) : subject_(subject), program_(subject.program), satisfier_(satisfier) {}

  void run(const Findings& found) {
    struct Alike { std::size_t told = 0; std::vector<const Finding*> others; };
    std::map<std::tuple<Kind, std::uint32_t, std::uint32_t>, Alike> alike;   // by kind, level and thing
    std::vector<std::pair<const Finding*, const Alike*>> told;   // with those of which it is the last
    for (const auto& [families, finding] : found) {
      if (subject_.diagnostics.hides(kind(finding), here(finding).span, there(finding).span)) continue;
      Alike& those = alike[{kind(finding), here(finding).level, thing(finding.about.cell)}];
      if (those.told == kMostTold) {
        those.others.push_back(&finding);
      } else {
        told.emplace_back(&finding, ++those.told == kMostTold ? &those : nullptr);
      }
    }
    for (const auto& [finding, last_of] : told) report(*finding, last_of != nullptr ? last_of->others : std::vector<const Finding*>());
  }

 private:
  [[nodiscard]] bool first_is_users(const Finding& finding) const { return !program_[finding.first].standard && program_[finding.second].standard; }
  /// Where the message points, and the other rule.
  [[nodiscard]] const Rule& here(const Finding& finding) const { return program_[first_is_users(finding) ? finding.first : finding.second]; }
  [[nodiscard]] const Rule& there(const Finding& finding) const { return program_[first_is_users(finding) ? finding.second : finding.first]; }
  [[nodiscard]] static Kind kind(const Finding& finding) {
    return finding.about.other != CellId::kNone ? Kind::kExclusiveConflict : Kind::kConflictingRules;
  }
  /// The exclusive group of the cell, or a number of its own.
  [[nodiscard]] std::uint32_t thing(CellId cell) const {
    const std::uint32_t group = subject_.group_of[program::index(cell)];
    return group != program::kNoGroup ? group : static_cast<std::uint32_t>(program_.exclusive.size() + program::index(cell));
  }

  /// A member of a group by the name of the group.
  [[nodiscard]] std::string_view declared(CellId cell) const {
    const std::string_view name = program_[cell].name;
    return subject_.group_of[program::index(cell)] == program::kNoGroup ? name : model::declared_name(name);
  }
  [[nodiscard]] static std::string some(std::span<const std::string_view> names) {
    return diagnostics::in_a_row(names.first(std::min(names.size(), kMostNamed))) + (names.size() > kMostNamed ? ", ..." : "");
  }

  void report(const Finding& finding, const std::vector<const Finding*>& others) {
    const std::string_view a = program_[finding.first].name, b = program_[finding.second].name;
    const std::string& level = program_.levels[here(finding).level];
    const std::string_view cell = program_[finding.about.cell].name;
    const std::string such = finding.pairs.size() < kMostCounted ? more(static_cast<std::uint32_t>(finding.pairs.size()), "such pairs of their instances")
                                                                 : " (and very many more such pairs of their instances)";
    const source::Span at = here(finding).span, other = there(finding).span;
    auto message = kind(finding) == Kind::kExclusiveConflict
                       ? subject_.diagnostics.report(Kind::kExclusiveConflict, at, {a, b, level, cell, program_[finding.about.other].name, such})
                       : subject_.diagnostics.report(Kind::kConflictingRules, at, {a, b, level, cell, such});
    if (other != at) message.note(Kind::kOtherRuleHere, other, {there(finding).name});
    note_events(subject_, satisfier_, program_[finding.first], program_[finding.second], message);
    if (!others.empty()) note_others(others, message);
  }

  void note_others(const std::vector<const Finding*>& others, diagnostics::Builder& message) const {
    std::vector<std::string_view> rules, cells;
    const auto add = [](std::vector<std::string_view>& names, std::string_view name) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    };
    for (const Finding* finding : others) {
      for (const RuleId rule : {finding->first, finding->second}) add(rules, program_[rule].name);
      for (const CellId cell : {finding->about.cell, finding->about.other}) {
        if (cell != CellId::kNone) add(cells, declared(cell));
      }
    }
    const std::string_view one = cells.front();
    message.note(Kind::kOthersDisagree, {}, {diagnostics::counted(others.size(), "more pair"),
                                             diagnostics::counted(rules.size(), "rule") + (others.size() == 1 ? " disagrees" : " disagree"), some(cells), some(rules),
                                             one, cells.size() == 1 ? std::string("it") : diagnostics::quoted_code(one)});
  }

  const Subject& subject_;
  const program::Program& program_;
  Satisfier& satisfier_;
};

}  // namespace

void report_conflicts(const Subject& subject, Satisfier& satisfier, const Findings& found) { ConflictReports(subject, satisfier).run(found); }

}  // namespace kb::analysis
