#include "compiler/tables/fuzzy_fold.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <string>

#include <waymark/runtime/fuzzy_straight.h>

namespace kb::tables {
namespace {

using fuzzy::Node;

constexpr std::uint32_t kLeastGroup = 4;    // smaller groups are not worth vector operations
constexpr std::uint32_t kLeastNests = 3, kMostNests = 64;
constexpr std::uint32_t kMostCells = 256;

/// A nest without its words, and the words in the order in which they are read.
struct Pattern {
  std::string text;
  std::vector<std::uint32_t> degrees;
};

class Folder {
 public:
  Folder(const fuzzy::Controller& c, const FuzzyForm& form, FuzzyLayout& layout) : c_(c), form_(form), to_(layout) {}

  void run() {
    if (c_.nests.empty() || !all_outputs_listed()) return;
    const std::uint32_t count = static_cast<std::uint32_t>(c_.nests.size());
    for (std::uint32_t first = 0; first < count;) {
      const Pattern pattern = read(first);
      std::vector<Pattern> alike = {pattern};
      while (first + alike.size() < count && alike.size() < kMostNests) {
        Pattern next = read(first + static_cast<std::uint32_t>(alike.size()));
        if (pattern.text.empty() || next.text != pattern.text || !follows(first + static_cast<std::uint32_t>(alike.size()))) break;
        alike.push_back(std::move(next));
      }
      if (alike.size() >= kLeastNests) return fold(first, alike);
      first += static_cast<std::uint32_t>(alike.size());
    }
  }

 private:
  [[nodiscard]] bool all_outputs_listed() const { return std::all_of(to_.listed.begin(), to_.listed.end(), [](bool listed) { return listed; }); }
  /// Whether no rule stands between this nest and the one before.
  [[nodiscard]] bool follows(std::uint32_t nest) const { return c_.nests[nest - 1].end_rule == c_.nests[nest].first_rule; }
  [[nodiscard]] bool has_child(std::uint32_t nest) const {
    return std::any_of(c_.nests.begin(), c_.nests.end(), [&](const fuzzy::Nest& other) { return other.parent == nest; });
  }

  /// The pattern of a nest; its text is empty if the nest cannot be folded.
  [[nodiscard]] Pattern read(std::uint32_t id) const {
    const fuzzy::Nest& nest = c_.nests[id];
    Pattern pattern;
    if (nest.parent != fuzzy::kNone || has_child(id)) return pattern;
    bool can = read(nest.condition, pattern);
    for (std::uint32_t r = nest.first_rule; r < nest.end_rule; ++r) {
      fmt::format_to(std::back_inserter(pattern.text), "; {} ", static_cast<float>(c_.rules[r].weight));
      can = read(c_.rules[r].condition, pattern) && can;
    }
    if (!can) pattern.text.clear();
    return pattern;
  }
  /// Recursion as deep as conditions nest.
  [[nodiscard]] bool read(std::uint32_t id, Pattern& pattern) const {
    const Node& node = c_.nodes[id];
    if (node.op == Node::Op::kDegree) {
      const std::uint32_t slot = c_.degrees[node.degree].slot;
      const mts::Membership& row = form_.terms[form_.term_of_degree[node.degree]];
      const bool group = to_.place_of_degree[node.degree] != fuzzy::kNone;
      pattern.text += group ? std::string("g ") : fmt::format("x{} ", slot);
      pattern.degrees.push_back(node.degree);
      return group || row.profile == mts::Profile::kLinear;
    }
    fmt::format_to(std::back_inserter(pattern.text), "({} ", static_cast<int>(node.op));
    bool can = read(node.left, pattern);
    if (node.op == Node::Op::kAnd || node.op == Node::Op::kOr) can = read(node.right, pattern) && can;
    pattern.text += ") ";
    return can;
  }

  void fold(std::uint32_t first, const std::vector<Pattern>& nests) {
    FuzzyFold& fold = to_.fold;
    fold.first_nest = first;
    fold.end_nest = first + static_cast<std::uint32_t>(nests.size());
    fold.rows.resize(nests.size());
    std::vector<std::vector<std::uint16_t>> known;   // the columns so far, each with its words row by row
    for (std::size_t leaf = 0; leaf < nests[0].degrees.size(); ++leaf) {
      const std::uint32_t degree = nests[0].degrees[leaf];
      const FoldColumn column{to_.place_of_degree[degree] != fuzzy::kNone, c_.degrees[degree].slot};
      std::vector<std::uint16_t> values;
      for (const Pattern& nest : nests) {
        const std::uint32_t d = nest.degrees[leaf];
        values.push_back(column.of_group ? static_cast<std::uint16_t>(to_.place_of_degree[d]) : form_.term_of_degree[d]);
      }
      std::size_t at = 0;
      while (at < known.size() && !(known[at] == values && fold.columns[at].of_group == column.of_group &&
                                    (column.of_group || fold.columns[at].slot == column.slot))) ++at;
      if (at == known.size()) {
        known.push_back(values);
        fold.columns.push_back(column);
        for (std::size_t row = 0; row < values.size(); ++row) fold.rows[row].push_back(values[row]);
      }
      fold.column_of_leaf.push_back(static_cast<std::uint32_t>(at));
    }
    index(nests);
  }

  // ---- the index over cells

  /// Makes the index; only if the condition of each nest is a word of one input that is no group.
  void index(const std::vector<Pattern>& nests) {
    FuzzyFold& fold = to_.fold;
    const Node& condition = c_.nodes[c_.nests[fold.first_nest].condition];
    if (condition.op != Node::Op::kDegree || fold.columns[0].of_group) return;
    const std::uint32_t slot = fold.columns[0].slot;
    double best = static_cast<double>(nests.size());
    for (std::uint32_t cells = 4; cells <= kMostCells; cells *= 2) {
      const mts::FuzzyInput& input = form_.inputs[slot];
      const float per_cell = static_cast<float>(cells) / (input.high - input.low);
      if (!mts::is_finite(per_cell)) return;
      std::vector<std::uint64_t> rows = rows_in_cells(nests, slot, cells, per_cell);
      double looked_at = 0.0;
      for (const std::uint64_t bits : rows) looked_at += std::popcount(bits);
      looked_at /= cells;
      if (looked_at > best - 0.02) continue;   // more cells would gain next to nothing
      best = looked_at;
      fold.cells = cells;
      fold.slot = slot;
      fold.per_cell = per_cell;
      fold.rows_in_cell = std::move(rows);
    }
  }

  // note [which rows can hold in a cell]
  //   mts::cell_of never falls as x grows, so the floats of a cell are those from its first to its last one, which bisection finds. A
  //   linear term, as it is computed, is positive on one interval, because each of its operations is monotone. If it is 0 at both ends of
  //   the cell, it is positive inside only if the whole interval lies inside, and so its middle. On a circle, cells must not be larger
  //   than half the circle for that. A term that is not positive at its middle counts as positive everywhere.
  [[nodiscard]] std::vector<std::uint64_t> rows_in_cells(const std::vector<Pattern>& nests, std::uint32_t slot, std::uint32_t cells,
                                                         float per_cell) const {
    const mts::FuzzyInput& input = form_.inputs[slot];
    const float last = input.period > 0.0f ? before(input.low, input.high, [&](float x) { return !mts::lies_on_circle(x, input.low, input.period); })
                                           : input.high;
    std::vector<std::uint64_t> rows(cells, 0);
    float first_in = input.low;
    for (std::uint32_t cell = 0; cell < cells; ++cell) {
      const float last_in = before(first_in, last, [&](float x) { return mts::cell_of(x, input.low, per_cell, cells) > cell; });
      for (std::size_t n = 0; n < nests.size(); ++n) {
        if (may_hold(form_.terms[form_.term_of_degree[nests[n].degrees[0]]], input, first_in, last_in)) rows[cell] |= std::uint64_t{1} << n;
      }
      first_in = std::min(std::nextafter(last_in, mts::kInfinity), last);
    }
    return rows;
  }
  /// The last float from `from` to `to` for which `beyond` is false; `from` if there is none. `beyond` must stay true once it is true.
  template <class Beyond>
  [[nodiscard]] static float before(float from, float to, Beyond beyond) {
    if (!beyond(to)) return to;
    while (std::nextafter(from, to) < to) {
      float middle = from + 0.5f * (to - from);
      if (!(middle > from && middle < to)) middle = std::nextafter(from, to);
      (beyond(middle) ? to : from) = middle;
    }
    return from;
  }
  [[nodiscard]] static bool may_hold(const mts::Membership& term, const mts::FuzzyInput& input, float first, float last) {
    if (mts::mu(term, first) > 0.0f || mts::mu(term, last) > 0.0f) return true;
    if (input.period > 0.0f) return !(mts::mu(term, term.centre) > 0.0f) || (term.centre >= first && term.centre <= last);
    if (!mts::is_finite(term.low) || !mts::is_finite(term.high)) return false;   // the term reaches to an end of the range
    const float middle = term.low + 0.5f * (term.high - term.low);
    return !(mts::mu(term, middle) > 0.0f) || (middle >= first && middle <= last);
  }

  const fuzzy::Controller& c_;
  const FuzzyForm& form_;
  FuzzyLayout& to_;
};

void place_groups(const fuzzy::Controller& c, FuzzyLayout& to) {
  to.place_of_degree.assign(c.degrees.size(), fuzzy::kNone);
  for (const fuzzy::Input& input : c.inputs) {
    if (!input.group || input.count < kLeastGroup) continue;
    for (std::uint32_t t = 0; t < input.terms.size(); ++t) {
      for (std::uint32_t e = 0; e < input.count; ++e) {
        to.place_of_degree[input.first_degree + e * input.terms.size() + t] = to.places++;
      }
    }
  }
}

/// Chooses the outputs whose values are looked up by the number of a rule: their values must be constants. (Plain averages and sums are
/// faster in registers, see lay_out.)
void choose_lists(const fuzzy::Controller& c, const FuzzyForm& form, FuzzyLayout& to) {
  to.listed.assign(c.outputs.size(), true);
  for (const mts::FuzzyConsequent& consequent : form.consequents) {
    if (consequent.first_part != consequent.end_part) to.listed[consequent.output] = false;
  }
  for (const fuzzy::Rule& rule : c.rules) {   // a rule with two values for one output cannot be looked up
    for (std::size_t i = 0; i < rule.consequents.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (rule.consequents[j].output == rule.consequents[i].output) to.listed[rule.consequents[i].output] = false;
      }
    }
  }
}

}  // namespace

FuzzyLayout lay_out(const fuzzy::Controller& controller, const FuzzyForm& form) {
  FuzzyLayout layout;
  place_groups(controller, layout);
  choose_lists(controller, form, layout);
  Folder(controller, form, layout).run();
  if (layout.fold.end_nest != 0) return layout;
  for (std::size_t o = 0; o < form.outputs.size(); ++o) {
    const mts::FuzzyCombine how = form.outputs[o].combine;
    if (how == mts::FuzzyCombine::kAverage || how == mts::FuzzyCombine::kSum) layout.listed[o] = false;
  }
  return layout;
}

}  // namespace kb::tables
