// Priority: the `priority` lines define a partial order of the strategies, which is extended to a total order for the model.
//
// note [extending the priorities]
// Strategies are ranked in the order in which `priority` lines first name them, members of a group in the order of declaration;
// those that no line names come last, as declared. Of the strategies that no remaining one has to precede, the one of the lowest
// rank comes next. Members of one group may rely on that order. If others can be wanted at once and no line decides between them,
// the analysis warns.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <queue>

#include "compiler/model/references.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

class PriorityReader {
 public:
  explicit PriorityReader(Draft& draft) : draft_(draft) {
    node_of_.assign(draft.model.cells.size(), kNone32);
    for (std::uint32_t i = 0; i < draft.model.cells.size(); ++i) {
      if (draft.model.cells[i].kind != CellKind::kStrategy) continue;
      const bool same = !strategies_.empty() && draft.model[strategies_.back()].declared == draft.model.cells[i].declared;
      unit_.push_back(strategies_.empty() ? 0 : unit_.back() + (same ? 0 : 1));
      node_of_[i] = static_cast<std::uint32_t>(strategies_.size());
      strategies_.push_back(CellId{i});
    }
    after_.resize(strategies_.size());
    before_.resize(strategies_.size(), 0);
    rank_.assign(strategies_.size(), kNone32);
  }

  void run() {
    draft_.each<syntax::Priority>([&](const syntax::Tree& tree, const auto&, const syntax::Priority& line) { read_line(tree, line); });
    for (std::uint32_t& rank : rank_) {
      if (rank == kNone32) rank = next_rank_++;
    }
    if (!sort()) report_cycle();
  }

 private:
  using Nodes = std::vector<std::uint32_t>;
  struct Joint { source::Span span; bool first_is_group, second_is_group; };

  void read_line(const syntax::Tree& tree, const syntax::Priority& line) {
    std::vector<Binder> binders;
    References references(draft_, tree, binders);
    std::vector<Nodes> parts;
    std::vector<source::Span> spans;
    for (const syntax::RefId id : line.order) {
      const std::uint32_t ref = references.compile(id);
      const Operand operand = references.evaluate(ref, {});
      const auto cells = references.cells_of(operand);
      if (operand.kind == Operand::Kind::kBroken) continue;
      Nodes nodes;
      for (const CellId cell : cells.value_or(std::vector<CellId>{})) {
        if (node_of_[index(cell)] != kNone32) nodes.push_back(node_of_[index(cell)]);
      }
      if (!cells || nodes.size() != cells->size()) {
        draft_.diagnostics.report(Kind::kPriorityOfNonStrategy, references.span(ref), {references.text(ref), references.describe(operand)});
        continue;
      }
      for (const std::uint32_t node : nodes) name(node);
      parts.push_back(std::move(nodes));
      spans.push_back(references.span(ref));
    }
    if (check_twice(parts, spans)) chain(parts, spans);
  }

  /// Ranks the strategy, and all others of its group with it.
  void name(std::uint32_t node) {
    if (rank_[node] != kNone32) return;
    std::uint32_t member = static_cast<std::uint32_t>(std::lower_bound(unit_.begin(), unit_.end(), unit_[node]) - unit_.begin());
    for (; member < unit_.size() && unit_[member] == unit_[node]; ++member) rank_[member] = next_rank_++;
  }

  /// If a line names a member beside its group, the group stands for the others: `Cross[left,mark] > Cross`. False, after a message, if a
  /// line names a strategy twice.
  bool check_twice(std::vector<Nodes>& parts, const std::vector<source::Span>& spans) {
    std::unordered_map<std::uint32_t, std::size_t> single;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].size() != 1) continue;
      if (!single.emplace(parts[i].front(), i).second) return report_twice(spans[i]);
    }
    std::unordered_map<std::uint32_t, std::size_t> in;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].size() == 1) continue;
      std::erase_if(parts[i], [&](std::uint32_t node) { return single.contains(node); });
      for (const std::uint32_t node : parts[i]) {
        if (!in.emplace(node, i).second) return report_twice(spans[i]);
      }
    }
    return true;
  }

  bool report_twice(source::Span at) {
    draft_.diagnostics.report(Kind::kPriorityTwice, at, {draft_.diagnostics.sources().text(at)});
    return false;
  }

  /// Puts each part of the line before the next one. A group all of whose members are named beside it has become empty and is skipped.
  void chain(const std::vector<Nodes>& parts, const std::vector<source::Span>& spans) {
    std::optional<std::size_t> above;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].empty()) continue;
      if (above) put_before(parts[*above], parts[i], source::join(spans[*above], spans[i]));
      above = i;
    }
  }

  /// Adds a node, a joint, between two neighbours of a line, so that groups do not need an edge for each pair of members.
  void put_before(const Nodes& first, const Nodes& second, source::Span span) {
    const auto joint = static_cast<std::uint32_t>(after_.size());
    after_.emplace_back();
    before_.push_back(0);
    joints_.push_back({span, first.size() > 1, second.size() > 1});
    for (const std::uint32_t node : first) add_edge(node, joint);
    for (const std::uint32_t node : second) add_edge(joint, node);
    draft_.model.precedences.push_back({cells(first), cells(second)});
  }

  [[nodiscard]] std::vector<CellId> cells(const Nodes& nodes) const {
    std::vector<CellId> found;
    for (const std::uint32_t node : nodes) found.push_back(strategies_[node]);
    return found;
  }

  void add_edge(std::uint32_t from, std::uint32_t to) {
    after_[from].push_back(to);
    ++before_[to];
  }

  [[nodiscard]] bool is_joint(std::uint32_t node) const { return node >= strategies_.size(); }

  /// Kahn's algorithm; joints are passed at once.
  bool sort() {
    const auto later = [this](std::uint32_t a, std::uint32_t b) { return rank_[a] > rank_[b]; };
    std::priority_queue<std::uint32_t, Nodes, decltype(later)> ready(later);
    std::vector<std::uint32_t> waiting = before_;
    Nodes joints;
    const auto release = [&](std::uint32_t node) {
      if (is_joint(node)) joints.push_back(node);
      else ready.push(node);
    };
    for (std::uint32_t node = 0; node < after_.size(); ++node) {
      if (waiting[node] == 0) release(node);
    }
    while (!ready.empty() || !joints.empty()) {
      std::uint32_t node = 0;
      if (!joints.empty()) {
        node = joints.back();
        joints.pop_back();
      } else {
        node = ready.top();
        ready.pop();
        draft_.model.priority.push_back(strategies_[node]);
      }
      sorted_.push_back(node);
      for (const std::uint32_t next : after_[node]) {
        if (--waiting[next] == 0) release(next);
      }
    }
    if (sorted_.size() == after_.size()) return true;
    waiting_ = std::move(waiting);
    return false;
  }

  /// Reports a circle: goes backwards from a strategy that is not placed through others that are not, until one comes again.
  void report_cycle() {
    Nodes from(after_.size(), kNone32);
    for (std::uint32_t node = 0; node < after_.size(); ++node) {
      for (const std::uint32_t next : after_[node]) {
        if (waiting_[node] > 0 && from[next] == kNone32) from[next] = node;
      }
    }
    auto at = static_cast<std::uint32_t>(std::find_if(waiting_.begin(), waiting_.end(), [](std::uint32_t n) { return n > 0; }) - waiting_.begin());
    std::vector<bool> seen(after_.size(), false);
    while (!seen[at]) {
      seen[at] = true;
      at = from[at];
    }
    Nodes circle;
    for (std::uint32_t node = at;;) {
      circle.push_back(node);
      node = from[node];
      if (node == at) break;
    }
    std::reverse(circle.begin(), circle.end());
    std::rotate(circle.begin(), std::find_if(circle.begin(), circle.end(), [this](std::uint32_t n) { return !is_joint(n); }), circle.end());
    report_circle(circle);
  }

  [[nodiscard]] const Joint& joint_at(std::uint32_t node) const { return joints_[node - strategies_.size()]; }

  /// The name of a strategy, or that of its group if the circle goes through the group only once and both lines there name the group.
  [[nodiscard]] std::string circle_name(const Nodes& circle, std::size_t place) const {
    const std::uint32_t node = circle[place];
    const bool group = joint_at(circle[(place + circle.size() - 1) % circle.size()]).second_is_group && joint_at(circle[(place + 1) % circle.size()]).first_is_group;
    const std::string_view name = draft_.model[strategies_[node]].name;
    const auto visits = std::count_if(circle.begin(), circle.end(), [&](std::uint32_t other) { return !is_joint(other) && unit_[other] == unit_[node]; });
    return std::string(visits > 1 || !group ? name : declared_name(name));
  }

  /// Reported at a line of the user's, if one is part of the circle.
  void report_circle(const Nodes& circle) {
    std::string text;
    source::Span at;
    for (std::size_t i = 0; i < circle.size(); ++i) {
      if (!is_joint(circle[i])) text += circle_name(circle, i) + " > ";
      else if (!at.known() || draft_.standard(at)) at = joint_at(circle[i]).span;
    }
    text += circle_name(circle, 0);
    auto builder = draft_.diagnostics.report(Kind::kPriorityCycle, at, {fmt::format("`{}`", text)});
    for (std::size_t i = 1; i < circle.size(); ++i) {
      if (!is_joint(circle[i])) continue;
      builder.note(Kind::kPriorityHere, joint_at(circle[i]).span, {circle_name(circle, i - 1), circle_name(circle, (i + 1) % circle.size())});
    }
  }

  Draft& draft_;
  std::vector<CellId> strategies_;       // by node; joints come after them
  Nodes node_of_;                        // by cell
  std::vector<Nodes> after_;             // by node
  Nodes before_;                         // by node: how many edges come in
  Nodes rank_;                           // by strategy
  std::uint32_t next_rank_ = 0;
  std::vector<Joint> joints_;
  Nodes sorted_;
  Nodes waiting_;
  Nodes unit_;                           // by strategy: members of one group share one
};

}  // namespace

void order_strategies(Draft& draft) { PriorityReader(draft).run(); }

}  // namespace kb::model
