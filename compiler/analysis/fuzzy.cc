// Checks fuzzy controllers: whether each output has a value everywhere, whether each rule counts, whether values stay in their ranges.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "compiler/analysis/fuzzy_regions.h"
#include "compiler/analysis/fuzzy_shadows.h"
#include "compiler/analysis/subject.h"
#include "compiler/fuzzy/interpret.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using fuzzy::Controller;
using fuzzy::Node;

class FuzzyQuestions {
 public:
  FuzzyQuestions(const Controller& c, diagnostics::Diagnostics& diagnostics) : c_(c), diagnostics_(diagnostics), regions_(c) {}

  void ask() {
    find_unused();
    for (std::uint32_t o = 0; o < c_.outputs.size(); ++o) find_gap(o);
    for (std::uint32_t r = 0; r < c_.rules.size(); ++r) find_dead(r);
    find_shadowed();
    find_excess();
    if (regions_.gave_up()) diagnostics_.report(Kind::kFuzzyAnalysisIncomplete, c_.declared, {c_.name});
  }

 private:
  // ---- what nobody speaks of

  /// Recursion as deep as conditions nest.
  void note_used(std::uint32_t id, std::set<std::pair<std::uint32_t, std::uint32_t>>& used) const {
    const Node& node = c_.nodes[id];
    if (node.op == Node::Op::kDegree) {
      used.emplace(c_.degrees[node.degree].input, c_.degrees[node.degree].term);
      return;
    }
    note_used(node.left, used);
    if (node.op == Node::Op::kAnd || node.op == Node::Op::kOr) note_used(node.right, used);
  }

  void find_unused() {
    std::set<std::pair<std::uint32_t, std::uint32_t>> asked, given;   // variable, term
    std::set<std::uint32_t> read, written;
    for (const fuzzy::Nest& nest : c_.nests) note_used(nest.condition, asked);
    for (const fuzzy::Rule& rule : c_.rules) {
      note_used(rule.condition, asked);
      for (const fuzzy::Consequent& consequent : rule.consequents) {
        written.insert(consequent.output);
        if (consequent.term != fuzzy::kNone) given.emplace(consequent.output, consequent.term);
        for (const auto& part : consequent.linear) read.insert(input_of_slot(c_, part.first));
      }
    }
    for (const auto& [input, term] : asked) read.insert(input);
    for (std::uint32_t i = 0; i < c_.inputs.size(); ++i) {
      const fuzzy::Input& input = c_.inputs[i];
      if (!read.contains(i)) {
        diagnostics_.report(Kind::kFuzzyUnusedVariable, input.declared, {input.name, "no rule reads it"});
        continue;
      }
      for (std::uint32_t t = 0; t < input.terms.size(); ++t) {
        if (!asked.contains({i, t})) diagnostics_.report(Kind::kFuzzyUnusedTerm, input.terms[t].shape.span, {input.terms[t].name, input.name});
      }
    }
    for (std::uint32_t o = 0; o < c_.outputs.size(); ++o) {
      const fuzzy::Output& output = c_.outputs[o];
      if (!written.contains(o)) {
        diagnostics_.report(Kind::kFuzzyUnusedVariable, output.declared, {output.name, "no rule writes it"});
        continue;
      }
      for (std::uint32_t t = 0; t < output.terms.size(); ++t) {
        const bool is_default = output.fallback && *output.fallback == output.terms[t].number;
        if (!given.contains({o, t}) && !is_default) diagnostics_.report(Kind::kFuzzyUnusedTerm, output.terms[t].span, {output.terms[t].name, output.name});
      }
    }
  }

  // ---- where nothing is said

  void find_gap(std::uint32_t o) {
    const fuzzy::Output& output = c_.outputs[o];
    const bool written = std::any_of(c_.rules.begin(), c_.rules.end(), [o](const fuzzy::Rule& rule) {
      return std::any_of(rule.consequents.begin(), rule.consequents.end(), [o](const auto& one) { return one.output == o; });
    });
    if (!written || output.fallback) return;   // an output with a default is meant to have gaps
    const std::vector<Region> gaps = regions_.gaps(o);
    if (gaps.empty()) return;
    constexpr std::size_t kMostShown = 4;
    std::string where;
    for (std::size_t i = 0; i < std::min(gaps.size(), kMostShown); ++i) where += (i == 0 ? "" : ", or where ") + regions_.text(gaps[i]);
    if (gaps.size() > kMostShown) where += ", or in other places";
    diagnostics_.report(Kind::kFuzzyGap, output.declared, {output.name, where, fmt::format("{}", output.default_value())})
        .note(Kind::kFuzzyWitness, output.declared, {regions_.witness(gaps.front())});
  }

  void find_dead(std::uint32_t r) {
    if (regions_.fires(r)) return;
    dead_.insert(r);
    diagnostics_.report(Kind::kFuzzyDeadRule, c_.rules[r].span, {fuzzy::text(c_, c_.rules[r].condition)});
  }

  // ---- rules that others make needless

  void find_shadowed() {
    FuzzyShadows shadows(c_);
    for (std::uint32_t later = 0; later < c_.rules.size(); ++later) {
      if (dead_.contains(later)) continue;
      const auto by = shadows.next(later);
      if (!by) continue;
      diagnostics_.report(Kind::kFuzzyShadowedRule, c_.rules[later].span, {by->same ? "an earlier one has the same condition" : "an earlier, wider one is never weaker, and the strongest wins"})
          .note(Kind::kFuzzyOtherRule, c_.rules[by->rule].span, {fuzzy::text(c_, c_.rules[by->rule])});
    }
  }

  // ---- outputs that leave their range

  void find_excess() {
    std::set<std::uint32_t> said;
    for (const fuzzy::Rule& rule : c_.rules) {
      for (const fuzzy::Consequent& one : rule.consequents) {
        const fuzzy::Output& output = c_.outputs[one.output];
        if (output.circular || !one.linear.empty() || output.combine == fuzzy::Combine::kSum || said.contains(one.output)) continue;
        if (one.constant >= output.low && one.constant <= output.high) continue;
        said.insert(one.output);
        const source::Span at = one.term == fuzzy::kNone ? one.span : output.terms[one.term].span;
        diagnostics_.report(Kind::kFuzzyExcess, at, {output.name, fmt::format("{}", one.constant), range(output), "in this rule"});
      }
    }
    if (may_leave(said)) sample(said);
  }

  [[nodiscard]] static std::string range(const fuzzy::Output& output) { return fmt::format("{}..{}", output.low, output.high); }

  /// Whether an output may leave its range at all: only sums, and values that depend on inputs, can.
  [[nodiscard]] bool may_leave(const std::set<std::uint32_t>& said) const {
    return std::any_of(c_.rules.begin(), c_.rules.end(), [&](const fuzzy::Rule& rule) {
      return std::any_of(rule.consequents.begin(), rule.consequents.end(), [&](const fuzzy::Consequent& one) { return may_leave(one, said); });
    });
  }

  /// Whether the output may leave its range through this rule.
  [[nodiscard]] bool may_leave(const fuzzy::Consequent& one, const std::set<std::uint32_t>& said) const {
    const fuzzy::Output& output = c_.outputs[one.output];
    return !output.circular && !said.contains(one.output) && (output.combine == fuzzy::Combine::kSum || !one.linear.empty());
  }

  /// In [0, 1).
  double random() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 40) / static_cast<double>(1u << 24);
  }

  /// Tries the corners of the inputs' ranges, points between them, and the terms of each rule. Every report is real, but not every case
  /// is found.
  void sample(std::set<std::uint32_t>& said) {
    constexpr std::uint32_t kPoints = 3'000, kMostCorners = 10;
    const std::uint32_t corners = c_.slots <= kMostCorners ? 1u << c_.slots : 0;
    std::vector<double> x(c_.slots);
    for (std::uint32_t n = 0; n < corners + kPoints && said.size() < c_.outputs.size(); ++n) {
      for (std::uint32_t slot = 0; slot < c_.slots; ++slot) {
        const fuzzy::Input& input = c_.inputs[input_of_slot(c_, slot)];
        const double chance = random(), share = n < corners ? ((n >> slot) & 1u) : chance;
        x[slot] = input.low + share * (input.high - input.low);
      }
      look_at(x, said);
    }
    const auto tries = std::clamp<std::size_t>(kPoints / c_.rules.size(), 4, 64);
    for (const fuzzy::Rule& rule : c_.rules) sample_terms(rule, tries, said);
  }

  /// A narrow term is missed by points that are spread over the range.
  void sample_terms(const fuzzy::Rule& rule, std::size_t tries, std::set<std::uint32_t>& said) {
    if (std::none_of(rule.consequents.begin(), rule.consequents.end(), [&](const auto& one) { return may_leave(one, said); })) return;
    std::map<std::uint32_t, std::vector<double>> places;   // by slot
    note_places(rule.condition, places);
    for (std::uint32_t nest = rule.nest; nest != fuzzy::kNone; nest = c_.nests[nest].parent) note_places(c_.nests[nest].condition, places);
    std::vector<double> x(c_.slots);
    for (std::size_t n = 0; n < tries; ++n) {
      for (std::uint32_t slot = 0; slot < c_.slots; ++slot) {
        const fuzzy::Input& input = c_.inputs[input_of_slot(c_, slot)];
        const auto known = places.find(slot);
        const double chance = random();
        if (known == places.end()) x[slot] = input.low + std::round(4.0 * chance) / 4.0 * (input.high - input.low);
        else x[slot] = known->second[static_cast<std::size_t>(chance * static_cast<double>(known->second.size()))];
      }
      look_at(x, said);
    }
  }

  /// The corners of the terms that a condition asks for, and the middles between them. Recursion as deep as conditions nest.
  void note_places(std::uint32_t id, std::map<std::uint32_t, std::vector<double>>& to) const {
    const Node& node = c_.nodes[id];
    if (node.op != Node::Op::kDegree) {
      note_places(node.left, to);
      if (node.right != fuzzy::kNone) note_places(node.right, to);
      return;
    }
    const fuzzy::Degree& degree = c_.degrees[node.degree];
    const fuzzy::Input& input = c_.inputs[degree.input];
    std::vector<double> corners;
    add_corners(c_.shape_of(degree), corners);
    for (double& x : corners) {
      if (input.circular && std::fabs(x) < 1e300) x = fuzzy::wrapped(x, input.low, input.high - input.low);
      x = std::clamp(x, input.low, input.high);
    }
    if (corners.empty()) corners = {input.low, input.high};
    std::vector<double>& places = to[degree.slot];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      places.push_back(corners[i]);
      places.push_back(0.5 * (corners[i] + corners[(i + 1) % corners.size()]));
    }
  }

  void look_at(const std::vector<double>& x, std::set<std::uint32_t>& said) {
    const auto outcome = fuzzy::interpret(c_, x);
    for (std::uint32_t o = 0; o < c_.outputs.size(); ++o) {
      const fuzzy::Output& output = c_.outputs[o];
      const double slack = 1e-6 * (output.high - output.low), v = outcome.before[o];
      if (output.circular || said.contains(o) || (v >= output.low - slack && v <= output.high + slack)) continue;
      said.insert(o);
      diagnostics_.report(Kind::kFuzzyExcess, output.declared, {output.name, fmt::format("{:.6g}", v), range(output), "at " + point(x)});
    }
  }

  [[nodiscard]] std::string point(const std::vector<double>& x) const {
    std::string out;
    for (std::uint32_t slot = 0; slot < c_.slots; ++slot) {
      const std::string& unit = c_.inputs[input_of_slot(c_, slot)].unit;
      out += fmt::format("{}{} = {:.6g}{}{}", out.empty() ? "" : ", ", slot_name(c_, slot), x[slot], unit.empty() ? "" : " ", unit);
    }
    return out;
  }

  const Controller& c_;
  diagnostics::Diagnostics& diagnostics_;
  FuzzyRegions regions_;
  std::set<std::uint32_t> dead_;
  std::uint64_t state_ = 1;   // of `random`
};

}  // namespace

void diagnose_fuzzy(const program::Program& program, diagnostics::Diagnostics& diagnostics) {
  for (const Controller& controller : program.fuzzy) FuzzyQuestions(controller, diagnostics).ask();
}

}  // namespace kb::analysis
