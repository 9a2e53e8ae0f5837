// Reports what compiles about perception but is hardly meant.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "compiler/analysis/confusion.h"
#include "compiler/analysis/definitions.h"
#include "compiler/analysis/subject.h"

namespace kb::analysis {
namespace {

using diagnostics::Diagnostics;
using diagnostics::Kind;
using program::CellId;
using program::Program;

constexpr std::size_t kMostConfusablePairs = 200'000;
constexpr std::size_t kMostPairsOfNumbers = 20'000;   // a text is compared at once, a number by a search

/// Families of facts of which two must not be believed at once: members of a group, and landmarks. By the program's cells.
struct Families {
  std::map<CellId, std::vector<std::uint32_t>> groups;
  std::set<CellId> landmarks;

  [[nodiscard]] bool share_group(CellId a, CellId b) const {
    const auto x = groups.find(a), y = groups.find(b);
    if (x == groups.end() || y == groups.end()) return false;
    return std::any_of(x->second.begin(), x->second.end(), [&](std::uint32_t group) {
      return std::find(y->second.begin(), y->second.end(), group) != y->second.end();
    });
  }
};

Families families(const model::Model& model, const Program& program) {
  Families found;
  const std::vector<CellId> cell_of = program::cell_order(model);
  std::uint32_t group = 0;
  for (const model::Group& from : model.groups) {
    for (const model::CellId cell : from.cells) found.groups[cell_of[model::index(cell)]].push_back(group);
    ++group;
  }
  for (const auto& members : program.exclusive) {
    for (const CellId cell : members) found.groups[cell].push_back(group);
    ++group;
  }
  for (const model::RowId row : model.rows_of("Landmark")) {
    const model::CellId cell = model[row].cell;
    if (cell != model::CellId::kNone) found.landmarks.insert(cell_of[model::index(cell)]);   // a row that is no part of a map has none
  }
  return found;
}

/// See note [confusion]. A landmark counts as believed from the certainty that is enough for an awaited one. Two facts without a family
/// are not reported if one is a special case of the other, which is meant.
void diagnose_confusable(const model::Model& model, const Program& program, Confusions& confusions, Diagnostics& diagnostics) {
  const auto& perceived = program.perception.perceived;
  if (perceived.size() < 2) return;
  const Families family = families(model, program);
  std::size_t pairs = 0, of_numbers = 0;
  for (const program::Perceived& one : perceived) {
    if (!confusions.looked_into(one.fact)) {
      diagnostics.report(Kind::kConfusionOfMany, one.span,
                         {program[one.fact].name, std::to_string(Definitions::kMostTerms), std::to_string(Definitions::kMostParts), std::to_string(Definitions::kMostKept)});
    }
  }
  for (std::size_t k = 0; k < perceived.size(); ++k) {
    const CellId b = perceived[k].fact;
    const bool number = confusions.reads_number(b);
    for (const std::size_t i : confusions.sharing_before(k)) {
      if (diagnostics.full(Kind::kConfusable)) return;
      const CellId a = perceived[i].fact;
      const bool numbers = number && confusions.reads_number(a);
      if (++pairs > kMostConfusablePairs || (numbers && ++of_numbers > kMostPairsOfNumbers) || confusions.tired()) {
        diagnostics.report(Kind::kConfusionNotAsked, perceived[k].span, {std::to_string(pairs - 1), program[b].name});
        return;
      }
      const bool landmarks = family.landmarks.contains(a) && family.landmarks.contains(b);
      const auto x = program::thresholds(program[a]), y = program::thresholds(program[b]);
      const double believed = landmarks ? std::max(x.attended, y.attended) : std::max(x.plain, y.plain);
      const Confusion found = confusions.between(a, b, believed);
      if (found.degree <= believed) continue;
      const bool meant = !landmarks && !family.share_group(a, b) &&
                         (confusions.special_case(a, b, y.attended) || confusions.special_case(b, a, x.attended));
      if (meant) continue;
      diagnostics.report(Kind::kConfusable, perceived[k].span, {program[a].name, program[b].name, fmt::format("{:.2f}", found.degree), found.readings})
          .note(Kind::kPerceivedHere, perceived[i].span, {program[a].name});
    }
  }
}

/// Reports facts that no reading makes sure enough, mostly because a prototype is narrower than the noise. Of the facts that one
/// statement defines, only the first is reported.
void diagnose_never_sure(const Subject& subject) {
  Confusions& confusions = *subject.confusions;
  const Program& program = subject.program;
  source::Span told;
  for (const program::Perceived& perceived : program.perception.perceived) {
    const program::Cell& fact = program[perceived.fact];
    const std::size_t place = program::index(perceived.fact);
    if (subject.reader[place] == program::RuleId::kNone || subject.reported[place] || perceived.span == told) continue;
    if (!confusions.looked_into(perceived.fact)) continue;
    const program::Thresholds limits = program::thresholds(fact);
    const float limit = attended_at_times(program, subject.domains, perceived.fact) ? limits.attended : limits.plain;
    const bool sight = subject.asks_sight(perceived.fact), high = subject.asks_high(perceived.fact);
    if (!sight && !high) continue;   // `is low` does not need a sure fact
    const double wanted = std::max<double>(limit, program.settings.firing);
    const Surest most = confusions.surest(perceived.fact, wanted);
    const bool unseen = sight && most.degree <= limit, unsure = high && most.degree < program.settings.firing;
    if (!unseen && !unsure) continue;
    told = perceived.span;
    subject.diagnostics.report(Kind::kNeverSure, perceived.span,
                               {fact.name, unseen ? "seen" : "high", fmt::format("{:.2f}", most.degree), most.readings.empty() ? "" : ", where " + most.readings,
                                unseen ? fmt::format("exceed {}", limit) : fmt::format("reach {}", program.settings.firing)});
  }
}

}  // namespace

void diagnose_perception(Subject& subject) {
  diagnose_confusable(subject.model, subject.program, *subject.confusions, subject.diagnostics);
  diagnose_never_sure(subject);
}

}  // namespace kb::analysis
