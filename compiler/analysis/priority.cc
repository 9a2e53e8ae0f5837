// Reports pairs of strategies that can be wanted at once and that no `priority` line settles.
#include <boost/dynamic_bitset.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/subject.h"
#include "compiler/diagnostics/display.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::CellId;
using program::Program;

/// With more strategies than this, pairs are not checked, which would take a bit for each pair.
constexpr std::size_t kMaxPairsAsked = 8192;
constexpr std::size_t kShown = 4;

using Set = boost::dynamic_bitset<>;   // of strategies

class PriorityQuestions {
 public:
  explicit PriorityQuestions(Subject& subject)
      : subject_(subject),
        program_(subject.program),
        first_(program_.first_strategy()),
        count_(program_.cells.size() - first_) {
    for (std::uint32_t i = 0; i < count_; ++i) {
      const bool same = i > 0 && strategy(i).declared == strategy(i - 1).declared;
      unit_.push_back(i == 0 ? 0 : unit_.back() + (same ? 0 : 1));
      standard_.push_back(same ? standard_.back() : subject.in_library(strategy(i).declared));
      wanting_.push_back(those_that_can_be_high(strategy(i)));
    }
  }

  void run() {
    const std::vector<model::Precedence>& lines = subject_.model.precedences;
    if (count_ > kMaxPairsAsked || lines.size() > kMaxPairsAsked) return;
    find_settled(lines);
    said_.assign(count_, std::vector<bool>(count_));
    for (std::size_t i = 0; i < program_.priority.size(); ++i) {
      const std::uint32_t a = node(program_.priority[i]);
      for (std::size_t j = i + 1; j < program_.priority.size(); ++j) {
        const std::uint32_t b = node(program_.priority[j]);
        if (!below_[a][b] && unit_[a] != unit_[b] && wanted_together(a, b)) note(a, b);
      }
    }
    report();
  }

 private:
  using Nodes = std::vector<std::uint32_t>;
  struct Unsettled {
    std::uint32_t at;
    source::Span place;
    Nodes others;           // the first ones, which the message names
    std::size_t count = 0;  // of all others
    bool partly = false;    // lines order other members of the two groups, so the message names members, not groups
  };

  [[nodiscard]] const program::Cell& strategy(std::uint32_t node) const { return program_.cells[first_ + node]; }
  [[nodiscard]] std::uint32_t node(CellId strategy) const { return static_cast<std::uint32_t>(program::index(strategy) - first_); }

  [[nodiscard]] std::vector<CellId> those_that_can_be_high(const program::Cell& strategy) const {
    std::vector<CellId> found;
    std::copy_if(strategy.satellites.begin(), strategy.satellites.end(), std::back_inserter(found),
                 [this](CellId satellite) { return can_be_high(subject_.domains, satellite); });
    return found;
  }

  /// Whether both can be wanted at once. At most one satellite of an exclusive group is high, unless rules blend.
  [[nodiscard]] bool wanted_together(std::uint32_t a, std::uint32_t b) const {
    if (wanting_[a].empty() || wanting_[b].empty()) return false;
    return std::any_of(wanting_[a].begin(), wanting_[a].end(), [&](CellId x) {
      const std::uint32_t group = subject_.group_of[program::index(x)];
      if (group == program::kNoGroup || !subject_.exclusive(group)) return true;
      return std::any_of(wanting_[b].begin(), wanting_[b].end(), [&](CellId y) { return group != subject_.group_of[program::index(y)]; });
    });
  }

  /// Finds which strategies come after each one, beginning with the last in priority: then all that a line puts after a strategy are done.
  void find_settled(const std::vector<model::Precedence>& lines) {
    const Set none(count_);
    below_.assign(count_, none);
    std::vector<Set> below_line(lines.size());   // each is filled when first needed
    std::vector<Nodes> lines_of(count_);
    const std::vector<CellId> order = program::cell_order(subject_.model);
    const auto node_of = [&](model::CellId cell) { return node(order[model::index(cell)]); };
    for (std::uint32_t line = 0; line < lines.size(); ++line) {
      for (const model::CellId cell : lines[line].before) lines_of[node_of(cell)].push_back(line);
    }
    for (auto at = program_.priority.rbegin(); at != program_.priority.rend(); ++at) {
      for (const std::uint32_t line : lines_of[node(*at)]) {
        Set& after = below_line[line];
        if (after.empty()) {
          after = none;
          for (const model::CellId cell : lines[line].after) {
            const std::uint32_t later = node_of(cell);
            after |= below_[later];
            after.set(later);
          }
        }
        below_[node(*at)] |= after;
      }
    }
  }

  /// A pair of names counts once, however many members the groups have. Reported at the strategy that is the user's, else at the later one.
  void note(std::uint32_t first, std::uint32_t second) {
    const auto [low, high] = std::minmax(unit_[first], unit_[second]);
    if (said_[low][high]) return;
    said_[low][high] = true;
    if (standard_[second] && !standard_[first]) std::swap(first, second);
    const source::Span place = standard_[second] ? meeting(first, second) : strategy(second).declared;
    if (partly_settled(unit_[first], unit_[second])) {
      unsettled_.push_back({second, place, {first}, 1, true});
      return;
    }
    const auto [told, fresh] = unsettled_at_.try_emplace({unit_[second], place.file, place.begin}, unsettled_.size());
    if (fresh) unsettled_.push_back({second, place, {}});
    Unsettled& unsettled = unsettled_[told->second];
    if (unsettled.count++ < kShown) unsettled.others.push_back(first);
  }

  /// Where to report a pair of two packages that do not know each other: at the user's import of the second one, near which the user can
  /// settle it.
  [[nodiscard]] source::Span meeting(std::uint32_t first, std::uint32_t second) const {
    const source::Sources& sources = subject_.diagnostics.sources();
    const source::Span one = sources.brought_in_at(strategy(first).declared.file), other = sources.brought_in_at(strategy(second).declared.file);
    if (one == other || !one.known() || !other.known()) return strategy(second).declared;
    return one.file == other.file && other.begin < one.begin ? one : other;
  }

  [[nodiscard]] bool settled(std::uint32_t a, std::uint32_t b) const { return below_[a][b] || below_[b][a]; }
  [[nodiscard]] Nodes members(std::uint32_t unit) const {
    const auto [begin, end] = std::equal_range(unit_.begin(), unit_.end(), unit);
    Nodes found(static_cast<std::size_t>(end - begin));
    std::iota(found.begin(), found.end(), static_cast<std::uint32_t>(begin - unit_.begin()));
    return found;
  }
  [[nodiscard]] bool partly_settled(std::uint32_t unit, std::uint32_t other) const {
    const Nodes some = members(unit), others = members(other);
    return std::ranges::any_of(some, [&](std::uint32_t a) { return std::ranges::any_of(others, [&](std::uint32_t b) { return settled(a, b); }); });
  }

  /// The members of `node`'s group that nothing orders against some member of the group of `other`.
  [[nodiscard]] std::string unsettled_members(std::uint32_t node, std::uint32_t other) const {
    const Nodes others = members(unit_[other]);
    std::vector<std::string_view> names;
    for (const std::uint32_t a : members(unit_[node])) {
      const bool open = std::ranges::any_of(others, [&](std::uint32_t b) { return !settled(a, b) && wanted_together(a, b); });
      if (open) names.emplace_back(strategy(a).name);
    }
    return diagnostics::listed(names, kShown);
  }

  void report_members(const Unsettled& pair) {
    const std::uint32_t other = pair.others.front();
    auto message = subject_.diagnostics.report(Kind::kUnsettledPriority, pair.place, {unsettled_members(pair.at, other), unsettled_members(other, pair.at)});
    message.note(Kind::kNameDeclaredHere, strategy(other).declared, {model::declared_name(strategy(other).name)});
  }

  void report() {
    const auto name = [this](std::uint32_t node) { return model::declared_name(strategy(node).name); };
    for (const Unsettled& pair : unsettled_) {
      if (pair.partly) {
        report_members(pair);
        continue;
      }
      std::vector<std::string_view> others;
      for (const std::uint32_t other : pair.others) others.push_back(name(other));
      others.resize(pair.count);   // the rest is only counted
      auto message = subject_.diagnostics.report(Kind::kUnsettledPriority, pair.place, {"`" + std::string(name(pair.at)) + "`", diagnostics::listed(others, kShown)});
      if (pair.place != strategy(pair.at).declared) message.note(Kind::kNameDeclaredHere, strategy(pair.at).declared, {name(pair.at)});
      message.note(Kind::kNameDeclaredHere, strategy(pair.others.front()).declared, {others.front()});
    }
  }

  Subject& subject_;
  const Program& program_;
  std::size_t first_;                          // of the strategies, which are numbered from here
  std::size_t count_;
  Nodes unit_;                                 // by strategy: members of one group share one
  std::vector<bool> standard_;                 // by strategy: declared in the library
  std::vector<std::vector<CellId>> wanting_;   // by strategy: its satellites that can be high
  std::vector<Set> below_;                     // by strategy: those that lines put after it
  std::vector<std::vector<bool>> said_;        // pairs of units, the lower one first
  std::vector<Unsettled> unsettled_;
  std::map<std::tuple<std::uint32_t, source::FileId, std::uint32_t>, std::size_t> unsettled_at_;   // by the unit and the place
};

}  // namespace

void diagnose_priority(Subject& subject) { PriorityQuestions(subject).run(); }

}  // namespace kb::analysis
