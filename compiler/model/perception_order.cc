// Orders perceived facts so that each comes after those that define it, and refuses facts that are defined by themselves.
#include <algorithm>
#include <queue>

#include "compiler/model/draft.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

class Order {
 public:
  explicit Order(Draft& draft)
      : draft_(draft), perceived_(draft.model.perceived), parts_(perceived_.size()), users_(perceived_.size()) {}

  void run() {
    for (std::uint32_t i = 0; i < perceived_.size(); ++i) find_parts(i);
    std::vector<std::size_t> open(perceived_.size(), 0);  // the number of parts that are not yet placed before it
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> ready;  // of several, the one declared first
    for (std::uint32_t i = 0; i < perceived_.size(); ++i) {
      open[i] = parts_[i].size();
      if (open[i] == 0) ready.push(i);
    }
    std::vector<Perceived> ordered;
    while (!ready.empty()) {
      const std::uint32_t next = ready.top();
      ready.pop();
      ordered.push_back(perceived_[next]);
      for (const std::uint32_t user : users_[next]) {
        if (--open[user] == 0) ready.push(user);
      }
    }
    if (ordered.size() == perceived_.size()) perceived_ = std::move(ordered);
    else report_cycles(open);
  }

 private:
  void find_parts(std::uint32_t fact) {
    std::vector<PerceptId> todo{perceived_[fact].percept};
    std::vector<std::uint32_t>& parts = parts_[fact];
    while (!todo.empty()) {
      const Percept& percept = draft_.model[todo.back()];
      todo.pop_back();
      todo.insert(todo.end(), percept.children.begin(), percept.children.end());
      if (percept.op != Percept::Op::kFact) continue;
      const auto part = draft_.perceived_of.find(static_cast<std::uint32_t>(index(percept.cell)));
      if (part != draft_.perceived_of.end()) parts.push_back(part->second);  // the host gives the others
    }
    source::sort_unique(parts);
    for (const std::uint32_t part : parts) users_[part].push_back(fact);
  }

  /// Follows the remaining parts of each remaining fact until one comes again. Reports each cycle once.
  void report_cycles(const std::vector<std::size_t>& open) {
    std::vector<bool> told(perceived_.size(), false);
    for (std::uint32_t begin = 0; begin < perceived_.size(); ++begin) {
      if (open[begin] == 0 || told[begin]) continue;
      std::vector<std::uint32_t> path;
      std::uint32_t at = begin;
      while (!told[at]) {
        told[at] = true;
        path.push_back(at);
        at = *std::find_if(parts_[at].begin(), parts_[at].end(), [&](std::uint32_t part) { return open[part] != 0; });
      }
      const auto first = std::find(path.begin(), path.end(), at);
      if (first != path.end()) report_cycle({first, path.end()});
    }
  }

  void report_cycle(std::vector<std::uint32_t> cycle) {
    std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
    std::string text;
    for (const std::uint32_t fact : cycle) text += "`" + name(fact) + "` by ";
    text += "`" + name(cycle.front()) + "`";
    auto message = draft_.diagnostics.report(Kind::kPerceptionCycle, perceived_[cycle.front()].span, {name(cycle.front()), text});
    for (std::size_t i = 1; i < cycle.size(); ++i) message.note(Kind::kPerceivedHere, perceived_[cycle[i]].span, {name(cycle[i])});
  }

  [[nodiscard]] std::string name(std::uint32_t fact) const { return std::string(draft_.model[perceived_[fact].fact].name); }

  Draft& draft_;
  std::vector<Perceived>& perceived_;
  std::vector<std::vector<std::uint32_t>> parts_, users_;  // by perceived fact: perceived facts
};

}  // namespace

void order_perception(Draft& draft) { Order(draft).run(); }

}  // namespace kb::model
