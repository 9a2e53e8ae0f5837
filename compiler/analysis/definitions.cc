#include "compiler/analysis/definitions.h"

#include <algorithm>
#include <iterator>

namespace kb::analysis {

using program::CellId;
using program::Percept;
using program::PerceptId;

Definitions::Definitions(const program::Program& program) : program_(program) {
  const auto& perceived = program.perception.perceived;
  for (std::size_t i = 0; i < perceived.size(); ++i) place_.emplace(perceived[i].fact, i);
}

std::optional<std::size_t> Definitions::place(CellId fact) const {
  const auto found = place_.find(fact);
  return found == place_.end() ? std::nullopt : std::optional(found->second);
}

// Recurses as deep as a definition nests. The definitions of the facts in it are known already: see `of`.
Disjunction Definitions::expand(PerceptId id, bool negated) {
  const Percept& percept = program_.perception[id];
  switch (percept.op) {
    case Percept::Op::kFits: return {{{false, percept.reading, percept.prototype, {}, negated}}};
    case Percept::Op::kReads: return {{{false, percept.reading, 0, percept.text, negated}}};
    case Percept::Op::kFact: {
      if (!place_.contains(percept.cell)) return {{{true, static_cast<std::uint32_t>(index(percept.cell)), 0, {}, negated}}};
      const Definition& part = *expanded_.at({percept.cell, negated});
      cut_ = cut_ || part.cut;
      return part.terms;
    }
    case Percept::Op::kNot: return expand(percept.children.front(), !negated);
    case Percept::Op::kAnd:
    case Percept::Op::kOr: break;
  }
  const bool joins = (percept.op == Percept::Op::kOr) != negated;
  Disjunction all = expand(percept.children.front(), negated);
  for (std::size_t i = 1; i < percept.children.size(); ++i) {
    const Disjunction part = expand(percept.children[i], negated);
    if (joins) all.insert(all.end(), part.begin(), part.end());
    else all = product(all, part);
    if (all.size() > kMostTerms) {
      all.resize(kMostTerms);
      cut_ = true;
    }
  }
  return all;
}

Disjunction Definitions::product(const Disjunction& a, const Disjunction& b) {
  Disjunction all;
  for (const Conjunction& x : a) {
    for (const Conjunction& y : b) {
      if (all.size() == kMostTerms) {
        cut_ = true;
        return all;
      }
      Conjunction both;
      std::ranges::set_union(x, y, std::back_inserter(both));
      if (both.size() <= kMostParts) all.push_back(std::move(both));
      else cut_ = true;
    }
  }
  return all;
}

// The facts in a definition whose own definitions have not been found yet.
void Definitions::find_parts(PerceptId id, bool negated, std::vector<Polar>& found) const {
  const Percept& percept = program_.perception[id];
  if (percept.op == Percept::Op::kFact && place_.contains(percept.cell) && !expanded_.contains({percept.cell, negated})) found.emplace_back(percept.cell, negated);
  for (const PerceptId child : percept.children) find_parts(child, negated != (percept.op == Percept::Op::kNot), found);
}

// Facts may build on one another in long chains, so the parts of a definition are found first, without recursion.
const Definition& Definitions::of(CellId fact, bool negated) {
  for (std::vector<Polar> todo{{fact, negated}}; !todo.empty();) {
    const Polar one = todo.back();
    const PerceptId percept = program_.perception.perceived[place_.at(one.first)].percept;
    const std::size_t before = todo.size();
    if (!expanded_.contains(one)) find_parts(percept, one.second, todo);
    if (todo.size() > before) continue;
    todo.pop_back();
    if (expanded_.contains(one)) continue;
    cut_ = false;
    Disjunction terms = expand(percept, one.second);
    if (kept_ > kMostKept && terms.size() > 1) {
      terms.resize(1);
      cut_ = true;
    }
    for (const Conjunction& all : terms) kept_ += all.size();
    expanded_.emplace(one, &*definitions_.insert({std::move(terms), cut_}).first);
  }
  return *expanded_.at({fact, negated});
}

void Definitions::find_facts(PerceptId id, std::vector<CellId>& found) const {
  const Percept& percept = program_.perception[id];
  if (percept.op == Percept::Op::kFact) found.push_back(percept.cell);
  for (const PerceptId child : percept.children) find_facts(child, found);
}

bool Definitions::built_on(CellId fact, CellId part) const {
  const auto target = place(part);
  std::set<CellId> seen{fact};
  for (std::vector<CellId> todo{fact}; !todo.empty();) {
    const auto at = place(todo.back());
    todo.pop_back();
    if (!at || (target && *at <= *target)) continue;   // a fact stands after those that define it
    std::vector<CellId> named;
    find_facts(program_.perception.perceived[*at].percept, named);
    for (const CellId one : named) {
      if (one == part) return true;
      if (seen.insert(one).second) todo.push_back(one);
    }
  }
  return false;
}

}  // namespace kb::analysis
