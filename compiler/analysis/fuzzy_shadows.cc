#include "compiler/analysis/fuzzy_shadows.h"

#include <algorithm>
#include <iterator>

#include "compiler/source/texts.h"

namespace kb::analysis {

using fuzzy::Node;

FuzzyShadows::FuzzyShadows(const fuzzy::Controller& controller) : c_(controller) {
  Texts texts;
  for (const fuzzy::Rule& rule : c_.rules) {
    std::vector<std::uint32_t> nodes;
    operands(rule.condition, Node::Op::kAnd, nodes);
    for (std::uint32_t nest = rule.nest; nest != fuzzy::kNone; nest = c_.nests[nest].parent) operands(c_.nests[nest].condition, Node::Op::kAnd, nodes);
    of_.push_back(parts(nodes, texts));
  }
  uses_.resize(alternatives_.size());
  for (const Parts& of_rule : of_) {
    for (const std::uint32_t part : of_rule) ++uses_[part];
  }
}

// The operands of nested `and`s, or of nested `or`s. Recursion as deep as conditions nest, as in the functions below.
void FuzzyShadows::operands(std::uint32_t id, Node::Op op, std::vector<std::uint32_t>& to) const {
  const Node& node = c_.nodes[id];
  if (node.op != op) {
    to.push_back(id);
    return;
  }
  operands(node.left, op, to);
  operands(node.right, op, to);
}

// A text that conditions share if they differ only in the order of operands.
std::string FuzzyShadows::key(std::uint32_t id) const {
  const Node& node = c_.nodes[id];
  const std::string word(fuzzy::kOpWords[static_cast<std::size_t>(node.op)]);
  if (node.op == Node::Op::kDegree) return fuzzy::text(c_, id);
  if (node.op != Node::Op::kAnd && node.op != Node::Op::kOr) return word + "(" + key(node.left) + ")";
  std::vector<std::uint32_t> nodes;
  operands(id, node.op, nodes);
  std::vector<std::string> keys;
  for (const std::uint32_t one : nodes) keys.push_back(key(one));
  std::sort(keys.begin(), keys.end());
  std::string all = word + "(";
  for (const std::string& one : keys) all += one + ",";
  return all + ")";
}

FuzzyShadows::Parts FuzzyShadows::parts(const std::vector<std::uint32_t>& nodes, Texts& texts) {
  Parts all;
  for (const std::uint32_t node : nodes) all.push_back(number(node, texts));
  source::sort_unique(all);
  return all;
}

std::uint32_t FuzzyShadows::number(std::uint32_t id, Texts& texts) {
  const auto [known, fresh] = texts.try_emplace(key(id), static_cast<std::uint32_t>(alternatives_.size()));
  const std::uint32_t part = known->second;
  if (!fresh) return part;
  alternatives_.emplace_back();
  if (c_.nodes[id].op != Node::Op::kOr) return part;
  std::vector<std::uint32_t> nodes;
  operands(id, Node::Op::kOr, nodes);
  std::vector<Parts> alternatives;
  for (const std::uint32_t one : nodes) {
    std::vector<std::uint32_t> joined;
    operands(one, Node::Op::kAnd, joined);
    alternatives.push_back(parts(joined, texts));
  }
  std::sort(alternatives.begin(), alternatives.end());
  alternatives_[part] = std::move(alternatives);
  return part;
}

// Parts of which any rule that this one shadows asks one: its rarest part, or a part of each of that part's alternatives.
FuzzyShadows::Parts FuzzyShadows::handles(std::uint32_t rule) const {
  const std::uint32_t rarest = *std::min_element(of_[rule].begin(), of_[rule].end(), [&](std::uint32_t a, std::uint32_t b) { return uses_[a] < uses_[b]; });
  Parts all{rarest};
  for (const Parts& one : alternatives_[rarest]) all.push_back(one.front());
  source::sort_unique(all);
  return all;
}

FuzzyShadows::Parts FuzzyShadows::questions(std::uint32_t rule) const {
  Parts all = of_[rule];
  for (const std::uint32_t part : of_[rule]) {
    for (const Parts& one : alternatives_[part]) all.insert(all.end(), one.begin(), one.end());
  }
  source::sort_unique(all);
  return all;
}

// A part serves once: of a product, `(a or b) and (a or c)` may be less than `a`.
bool FuzzyShadows::never_weaker(std::uint32_t first, std::uint32_t later) const {
  Parts wide, left;
  std::set_difference(of_[first].begin(), of_[first].end(), of_[later].begin(), of_[later].end(), std::back_inserter(wide));
  std::set_difference(of_[later].begin(), of_[later].end(), of_[first].begin(), of_[first].end(), std::back_inserter(left));
  return std::all_of(wide.begin(), wide.end(), [&](std::uint32_t part) {
    const std::vector<Parts>& ways = alternatives_[part];
    for (const Parts& way : ways) {
      if (!std::includes(left.begin(), left.end(), way.begin(), way.end())) continue;
      std::erase_if(left, [&](std::uint32_t one) { return std::binary_search(way.begin(), way.end(), one); });
      return true;
    }
    const auto narrower = std::find_if(left.begin(), left.end(), [&](std::uint32_t one) {
      return !alternatives_[one].empty() && std::includes(ways.begin(), ways.end(), alternatives_[one].begin(), alternatives_[one].end());
    });
    if (narrower == left.end()) return false;
    left.erase(narrower);
    return true;
  });
}

// Whether `first` writes every output that `later` writes, under the same condition or, if the strongest rule wins, a wider one.
bool FuzzyShadows::shadows(std::uint32_t first, std::uint32_t later) const {
  const fuzzy::Rule& a = c_.rules[first];
  const fuzzy::Rule& b = c_.rules[later];
  const bool same = of_[first] == of_[later];
  if (!same && (a.weight < b.weight || !never_weaker(first, later))) return false;
  return std::all_of(b.consequents.begin(), b.consequents.end(), [&](const fuzzy::Consequent& one) {
    const bool both = std::any_of(a.consequents.begin(), a.consequents.end(), [&](const auto& other) { return other.output == one.output; });
    return both && (same || c_.outputs[one.output].combine == fuzzy::Combine::kWinner);
  });
}

std::optional<Shadow> FuzzyShadows::next(std::uint32_t later) {
  std::uint32_t by = later;
  for (const std::uint32_t part : questions(later)) {
    const auto& earlier = rules_[part];
    const auto found = std::find_if(earlier.begin(), earlier.end(), [&](std::uint32_t first) { return first >= by || shadows(first, later); });
    if (found != earlier.end()) by = std::min(by, *found);
  }
  for (const std::uint32_t part : handles(later)) rules_[part].push_back(later);
  if (by == later) return std::nullopt;
  return Shadow{by, of_[by] == of_[later]};
}

}  // namespace kb::analysis
