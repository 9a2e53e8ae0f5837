#include "compiler/tables/atoms.h"

#include <absl/container/flat_hash_map.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "compiler/program/conditions.h"
#include "compiler/program/net_effects.h"

namespace kb::tables {
namespace {

using program::Cond;
using program::CondId;
using Kind = AtomOrigin::Kind;

constexpr Literal kTrue = mts::kTrueAtom << 1;
constexpr Literal kFalse = mts::kFalseAtom << 1;

class Maker {
 public:
  Maker(const program::Program& program, std::size_t longest) : program_(program), longest_(longest), simple_(6 * program.cells.size(), kTrue) {
    add({.origin = {.kind = Kind::kTrue}});
    add({.origin = {.kind = Kind::kFalse}});
  }

  /// The literals of the rule's condition; valid until the next call.
  const std::vector<Literal>& rule(const program::Rule& rule) {
    level_ = rule.level;
    control_ = rule.level + 1 == program_.levels.size();
    rule_.clear();
    inline_and(rule.condition, rule_);
    return rule_ = tidy(std::move(rule_), true);
  }

  std::vector<Proto> take() { return std::move(protos_); }

 private:
  std::uint32_t add(Proto proto) {
    protos_.push_back(std::move(proto));
    return static_cast<std::uint32_t>(protos_.size() - 1);
  }

  /// Sorts the parts, without repetition and without constants that decide nothing. An `and` that contradicts itself becomes {false}.
  /// (`X or not X` stays: it is always true, but its strength is not always 1.)
  static std::vector<Literal> tidy(std::vector<Literal> parts, bool is_and) {
    const Literal nothing = is_and ? kTrue : kFalse;
    const Literal decided = is_and ? kFalse : kTrue;
    source::sort_unique(parts);
    std::erase(parts, nothing);
    std::erase(parts, decided ^ 1u);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const bool both = is_and && i + 1 < parts.size() && parts[i + 1] == (parts[i] ^ 1u);
      if (both || parts[i] == decided || parts[i] == (nothing ^ 1u)) return {decided};
    }
    return parts;
  }

  void inline_and(CondId id, std::vector<Literal>& parts) {
    const Cond& cond = program_[id];
    if (cond.op != Cond::Op::kAnd || width(id) > longest_) {
      parts.push_back(literal(id));
      return;
    }
    for (const CondId child : cond.children) inline_and(child, parts);
  }

  /// The number of literals that the conjunction would have if it were written out.
  std::size_t width(CondId id) {
    if (width_.empty()) {
      width_.resize(program_.conds.size(), 1);
      for (std::size_t i = 0; i < program_.conds.size(); ++i) {  // parts have smaller ids than what contains them
        if (program_.conds[i].op != Cond::Op::kAnd) continue;
        std::size_t sum = 0;
        for (const CondId child : program_.conds[i].children) sum += width_[index(child)];
        width_[i] = std::min<std::size_t>(sum, longest_ + 1);
      }
    }
    return width_[index(id)];
  }

  Literal term(const Cond& cond) {
    // For the control level every strategy is -1, so what its rules ask about strategies is decided here.
    if (control_ && program_[cond.cell].kind == program::CellKind::kStrategy) {
      return cond.term == program::Term::kLow ? kTrue : kFalse;
    }
    return simple({.kind = Kind::kTerm, .term = cond.term, .cell = cond.cell});
  }

  /// A literal about one cell: one of its three terms, or whether it is seen, comes or goes.
  Literal simple(AtomOrigin origin) {
    const std::size_t which = origin.kind == Kind::kTerm   ? static_cast<std::size_t>(origin.term)
                              : origin.kind == Kind::kSeen  ? 3u
                              : origin.kind == Kind::kEvent ? 4u
                                                            : 5u;
    Literal& known = simple_[6 * index(origin.cell) + which];
    if (known == kTrue) known = add({.origin = origin}) << 1;
    return known;
  }

  Literal literal(CondId id) {
    if (!program::has_parts(program_[id].op)) return make(id);
    const auto key = std::pair(index(id), level_);  // per level: each level samples its own timers; see also term()
    if (const auto known = memo_.find(key); known != memo_.end()) return known->second;
    const Literal made = make(id);
    memo_.emplace(key, made);
    return made;
  }

  Literal make(CondId id) {
    const Cond& cond = program_[id];
    switch (cond.op) {
      case Cond::Op::kIs: return term(cond);
      case Cond::Op::kEvent: return simple({.kind = Kind::kEvent, .cell = cond.cell});
      case Cond::Op::kLost: return simple({.kind = Kind::kLost, .cell = cond.cell});
      case Cond::Op::kSeen: return simple({.kind = Kind::kSeen, .cell = cond.cell});
      case Cond::Op::kNot: return negation(id, literal(cond.children.front()));
      case Cond::Op::kFor: return timer(id, literal(cond.children.front()), cond.duration_us);
      case Cond::Op::kAnd:
      case Cond::Op::kOr: return node(id);
    }
    return kFalse;
  }

  /// `not not X` has the truth of X, but its strength is 1 instead of X's membership, so the inner `not` becomes a node.
  Literal negation(CondId id, Literal of) {
    const bool constant = of >> 1 == mts::kTrueAtom || of >> 1 == mts::kFalseAtom;
    return ((of & 1u) != 0 && !constant ? shared_node(id, true, {of}) : of) ^ 1u;
  }

  Literal timer(CondId id, Literal input, std::uint32_t duration_us) {
    if (input == kFalse || input == (kTrue | 1u)) return input;
    const auto [at, fresh] = timers_.try_emplace(std::tuple(level_, input, duration_us), 0);
    if (fresh) {
      at->second = add({.origin = {.kind = Kind::kTimer, .condition = id},
                        .input = input,
                        .duration_us = duration_us,
                        .level = level_,
                        .rank = rank_over(input)})
                   << 1;
    }
    return at->second;
  }

  /// One more than the highest rank of the timers in the literal; 0 if there is none.
  std::uint32_t rank_over(Literal literal) const {
    const Proto& proto = protos_[literal >> 1];
    return proto.rank + (proto.origin.kind == Kind::kTimer ? 1 : 0);
  }

  Literal node(CondId id) {
    const Cond& cond = program_[id];
    const bool is_and = cond.op == Cond::Op::kAnd;
    std::vector<Literal> parts;
    parts.reserve(cond.children.size());
    for (const CondId child : cond.children) parts.push_back(literal(child));
    parts = tidy(std::move(parts), is_and);
    if (parts.empty()) return is_and ? kTrue : kFalse;
    if (parts.size() == 1) return parts.front();
    return shared_node(id, is_and, parts);
  }

  Literal shared_node(CondId id, bool is_and, const std::vector<Literal>& parts) {
    const auto [at, fresh] = nodes_.try_emplace(std::pair(is_and, parts), 0);
    if (fresh) {
      std::uint32_t rank = 0;
      for (const Literal part : parts) rank = std::max(rank, rank_over(part));
      at->second = add({.origin = {.kind = Kind::kNode, .condition = id}, .is_and = is_and, .children = parts, .rank = rank}) << 1;
    }
    return at->second;
  }

  const program::Program& program_;
  std::size_t longest_;                  // the longest conjunction that is written out in its rule
  std::vector<Proto> protos_;
  std::uint32_t level_ = 0;
  bool control_ = false;
  std::vector<std::size_t> width_;
  std::vector<Literal> rule_;
  std::vector<Literal> simple_;          // by cell and question; kTrue: not made yet
  absl::flat_hash_map<std::pair<std::size_t, std::uint32_t>, Literal> memo_;   // looked up, never iterated
  std::map<std::tuple<std::uint32_t, Literal, std::uint32_t>, Literal> timers_;
  std::map<std::pair<bool, std::vector<Literal>>, Literal> nodes_;
};

/// The final number of each atom: the constants, simple atoms by cell (those of one cell in their order), then timers, then nodes.
std::vector<std::uint32_t> numbering(const std::vector<Proto>& protos, std::size_t cells) {
  const auto whole = [](const Proto& p) { return p.origin.kind == Kind::kTimer || p.origin.kind == Kind::kNode; };
  const auto place = [](const Proto& p) { return p.origin.kind == Kind::kTrue || p.origin.kind == Kind::kFalse ? 0 : index(p.origin.cell) + 1; };
  std::vector<std::uint32_t> next(cells + 2, 0), wholes;   // by place; the constants are made first, in their order
  for (std::uint32_t i = 0; i < protos.size(); ++i) {
    if (whole(protos[i])) wholes.push_back(i);
    else ++next[place(protos[i]) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<std::uint32_t> number(protos.size());
  for (std::size_t i = 0; i < protos.size(); ++i) {
    if (!whole(protos[i])) number[i] = next[place(protos[i])]++;
  }
  std::sort(wholes.begin(), wholes.end(), [&](std::uint32_t x, std::uint32_t y) {
    const auto key = [&](std::uint32_t i) {
      const Proto& p = protos[i];
      const bool node = p.origin.kind == Kind::kNode;
      return std::tuple(node, p.level, node ? 0 : p.rank, p.duration_us, i);
    };
    return key(x) < key(y);
  });
  for (std::size_t i = 0; i < wholes.size(); ++i) number[wholes[i]] = static_cast<std::uint32_t>(protos.size() - wholes.size() + i);
  return number;
}

}  // namespace

Atoms make_atoms(const program::Program& program, std::size_t longest) {
  Maker maker(program, longest);
  Atoms atoms;
  atoms.begin.reserve(program.rules.size() + 1);
  for (const program::Rule& rule : program.rules) {
    atoms.begin.push_back(atoms.literals.size());
    const std::vector<Literal>& parts = maker.rule(rule);
    atoms.literals.insert(atoms.literals.end(), parts.begin(), parts.end());
  }
  atoms.begin.push_back(atoms.literals.size());
  std::vector<Proto> made = maker.take();
  const std::vector<std::uint32_t> number = numbering(made, program.cells.size());
  const auto renumber = [&](Literal l) { return number[l >> 1] << 1 | (l & 1u); };
  atoms.protos.resize(made.size());
  for (std::size_t i = 0; i < made.size(); ++i) {
    Proto& proto = atoms.protos[number[i]] = std::move(made[i]);
    proto.input = renumber(proto.input);
    for (Literal& child : proto.children) child = renumber(child);
  }
  for (Literal& l : atoms.literals) l = renumber(l);
  const auto first = atoms.literals.begin();
  for (std::size_t r = 0; r < program.rules.size(); ++r) {
    std::sort(first + static_cast<std::ptrdiff_t>(atoms.begin[r]), first + static_cast<std::ptrdiff_t>(atoms.begin[r + 1]));
  }
  return atoms;
}

std::vector<int> rarity(const program::Program& program, const Atoms& atoms) {
  const std::vector<std::uint32_t> group_of = program::group_of_cells(program);
  std::vector<int> rank;
  for (const Proto& proto : atoms.protos) {
    const AtomOrigin& o = proto.origin;
    const bool high = o.kind == Kind::kTerm && o.term == program::Term::kHigh;
    if (o.kind == Kind::kEvent || o.kind == Kind::kLost || o.kind == Kind::kFalse) rank.push_back(0);
    else if (high && group_of[index(o.cell)] != program::kNoGroup) rank.push_back(0);
    else if (o.kind == Kind::kSeen || (high && program[o.cell].kind != program::CellKind::kFact)) rank.push_back(1);
    else rank.push_back(o.kind == Kind::kTerm ? 2 : 3);
  }
  return rank;
}

}  // namespace kb::tables
