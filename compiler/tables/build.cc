// From the program to the tables, one table after another.
#include <algorithm>
#include <map>

#include "compiler/program/net_effects.h"
#include "compiler/source/same_number.h"
#include "compiler/tables/atoms.h"
#include "compiler/tables/image.h"
#include "compiler/tables/lists.h"
#include "compiler/tables/tables.h"

namespace kb::tables {
namespace {

using program::CellKind;
using program::Program;

using source::same_number;
static_assert(same_number(program::Idle::kStop, mts::Idle::kStop) && same_number(program::Idle::kHold, mts::Idle::kHold) && same_number(program::Idle::kStrategy, mts::Idle::kStrategy));

constexpr int kCrowded = 4;   ///< added to an atom's rank (see `rarity`) if very many rules read it

class TableBuilder {
 public:
  TableBuilder(const Program& program, const Limits& limits) : p_(program), limits_(limits), atoms_(make_atoms(program, limits.longest)) {}

  Tables build() {
    settings();
    cells();
    place_rules();
    conditions();
    readers();
    nodes();
    timers();
    groups();
    writes();
    truth();
    strengths();
    t_.narrow = mts::is_narrow(image_head(t_, 0));
    return std::move(t_);
  }

 private:
  void settings() {
    t_.shape.facts = p_.facts;
    t_.shape.satellites = p_.satellites;
    t_.shape.strategies = p_.strategies;
    t_.shape.rules = number(p_.rules.size());
    t_.shape.levels = number(p_.levels.size());
    t_.shape.atoms = number(atoms_.protos.size());
    t_.firing = static_cast<float>(p_.settings.firing);
    t_.idle = static_cast<mts::Idle>(p_.settings.idle);
    if (p_.settings.idle == program::Idle::kStrategy) t_.idle_strategy = strategy(p_.settings.idle_strategy);
    t_.hold_limit_us = p_.settings.hold_limit_us;
    for (const program::CellId id : p_.priority) t_.priority.push_back(strategy(id));
    for (const Proto& proto : atoms_.protos) t_.origins.push_back(proto.origin);
  }

  I strategy(program::CellId id) const { return number(index(id) - p_.first_strategy()); }
  I satellite(program::CellId id) const { return number(index(id) - p_.facts); }

  void cells() {
    t_.cell_atoms.resize(p_.cells.size(), {0, 0, 0});
    t_.fact_atoms.resize(p_.facts, {0, 0, 0, 0.0f, 0.0f});
    for (std::size_t a = 0; a < atoms_.protos.size(); ++a) {
      const AtomOrigin& o = atoms_.protos[a].origin;
      if (o.kind == AtomOrigin::Kind::kTerm) {
        auto& cell = t_.cell_atoms[index(o.cell)];
        (o.term == program::Term::kHigh ? cell.high : o.term == program::Term::kLow ? cell.low : cell.zero) = number(a);
      } else if (o.kind == AtomOrigin::Kind::kSeen) {
        t_.fact_atoms[index(o.cell)].seen = number(a);
      } else if (o.kind == AtomOrigin::Kind::kEvent) {
        t_.fact_atoms[index(o.cell)].event = number(a);
      } else if (o.kind == AtomOrigin::Kind::kLost) {
        t_.fact_atoms[index(o.cell)].lost = number(a);
      }
    }
    Lists<I> attends(p_.satellites);
    for (I f = 0; f < p_.facts; ++f) {
      const auto limits = program::thresholds(p_.cells[f]);
      t_.fact_atoms[f].plain = limits.plain;
      t_.fact_atoms[f].attended = limits.attended;
      for (const program::CellId s : p_.cells[f].satellites) attends.add(satellite(s), f);
    }
    t_.attends_begin = attends.flatten(t_.attends);
    t_.keep = words_for(p_.satellites);
    for (I s = 0; s < p_.satellites; ++s) {
      t_.initial.push_back(p_.cells[p_.facts + s].initial);
      if (p_.cells[p_.facts + s].keep) set_bit(t_.keep, s);
    }
  }

  /// Puts rules into words. Each level begins a new word: see note [rule words].
  void place_rules() {
    word_of_.resize(p_.rules.size());
    for (std::uint32_t level = 0; level < p_.levels.size(); ++level) {
      const I first_word = number(t_.word_rule.size());
      const auto [begin, end] = program::rules_of(p_, level);
      for (std::uint32_t rule = begin; rule < end; ++rule) {
        if ((rule - begin) % mts::kWordBits == 0) t_.word_rule.push_back(rule);
        word_of_[rule] = number(t_.word_rule.size() - 1);
      }
      t_.levels.push_back({first_word, number(t_.word_rule.size()), 0, 0});
    }
    t_.shape.words = number(t_.word_rule.size());
    t_.while_rules.resize(t_.word_rule.size(), 0);
    t_.reset_rules.resize(t_.word_rule.size(), 0);
    for (std::size_t r = 0; r < p_.rules.size(); ++r) {
      if (p_.rules[r].mode == program::Mode::kWhile) t_.while_rules[word_of_[r]] |= bit(r);
      if (p_.rules[r].reset) t_.reset_rules[word_of_[r]] |= bit(r);
    }
  }
  mts::Word bit(std::size_t rule) const { return mts::Word{1} << (rule - t_.word_rule[word_of_[rule]]); }

  /// Conditions, those that the fewest rules read first (they tend to be rarely true, so a failing evaluation ends early), and each rule's key:
  /// of its positive literals that are most rarely true, the one that the fewest rules read.
  void conditions() {
    const std::vector<int> rank = rarity(p_, atoms_);
    std::vector<std::size_t> uses(2 * atoms_.protos.size(), 0);
    for (const Literal l : atoms_.literals) ++uses[l];
    // Rules that share a key wake together. So an atom that very many rules read counts as less rare.
    const auto cost = [&](I atom) { return rank[atom] + (uses[atom << 1] > limits_.crowd ? kCrowded : 0); };
    t_.rules.resize(p_.rules.size() + 1);
    std::vector<Literal> parts;
    for (std::size_t r = 0; r < p_.rules.size(); ++r) {
      const auto own = atoms_.rule(r);
      parts.assign(own.begin(), own.end());
      std::sort(parts.begin(), parts.end(), [&](Literal a, Literal b) { return std::pair(uses[a], a) < std::pair(uses[b], b); });
      I key = mts::kTrueAtom;
      for (const Literal l : parts) {
        if ((l & 1u) == 0 && (key == mts::kTrueAtom || cost(l >> 1) < cost(key))) key = l >> 1;
      }
      t_.rule_key.push_back(key);
      t_.rules[r].conditions = number(t_.conditions.size());
      t_.conditions.insert(t_.conditions.end(), parts.begin(), parts.end());
    }
    t_.rules.back().conditions = number(t_.conditions.size());
  }

  /// Calls `f(atom, way, rule)` for each way in which a rule depends on an atom. 0: it wants the atom to become false, 1: true, 2: the atom
  /// is its key.
  template <class F>
  void each_reading(F&& f) const {
    for (std::size_t r = 0; r < p_.rules.size(); ++r) {
      f(t_.rule_key[r], 2u, r);
      for (const Literal l : atoms_.rule(r)) {
        const std::uint32_t wanted = ~l & 1u;
        if (l >> 1 != t_.rule_key[r] || wanted == 0) f(l >> 1, wanted, r);
      }
    }
  }

  /// Finds atoms that so many words of rules read that asking all rules that are awake costs no more, because one key may wake as many.
  void broad() {
    struct Words { I count = 0, last = 0; };   // `last`: the last one, plus 1
    std::vector<Words> words[3];
    for (auto& by_atom : words) by_atom.resize(atoms_.protos.size());
    each_reading([&](std::size_t atom, std::uint32_t way, std::size_t rule) {
      Words& w = words[way][atom];
      if (w.last != word_of_[rule] + 1) ++w.count;
      w.last = word_of_[rule] + 1;
    });
    std::size_t least = limits_.broad + 1;
    for (const Words& keyed : words[2]) least = std::max<std::size_t>(least, keyed.count);
    for (std::size_t a = 0; a < atoms_.protos.size(); ++a) {
      t_.broad.push_back(static_cast<std::uint8_t>((words[0][a].count >= least ? 1 : 0) | (words[1][a].count >= least ? 2 : 0)));
    }
  }

  void readers() {
    broad();
    Lists<mts::Readers<I>> lists(atoms_.protos.size());
    each_reading([&](std::size_t atom, std::uint32_t way, std::size_t rule) {
      if ((t_.broad[atom] >> way & 1u) != 0) return;
      if (lists.last(atom) == nullptr || lists.last(atom)->word != word_of_[rule]) lists.add(atom, {word_of_[rule], {0, 0}, 0});
      mts::Readers<I>& row = *lists.last(atom);
      (way == 2 ? row.keyed : row.good[way]) |= bit(rule);
    });
    if (std::ranges::count(t_.broad, 0) == std::ssize(t_.broad)) t_.broad.clear();
    const std::vector<I> begin = lists.flatten(t_.readers);
    t_.atoms.resize(begin.size());
    for (std::size_t a = 0; a < begin.size(); ++a) t_.atoms[a].readers = begin[a];
  }

  void nodes() {
    const std::size_t n = atoms_.protos.size();
    first_node_ = n;
    while (first_node_ > 0 && atoms_.protos[first_node_ - 1].origin.kind == AtomOrigin::Kind::kNode) --first_node_;
    t_.shape.nodes = number(n - first_node_);
    Lists<I> parents(n);
    for (std::size_t a = first_node_; a < n; ++a) {
      const Proto& proto = atoms_.protos[a];
      t_.nodes.push_back({proto.is_and ? number(proto.children.size()) : 1u});
      t_.is_and.push_back(proto.is_and ? 1 : 0);
      t_.child_begin.push_back(number(t_.children.size()));
      for (const Literal child : proto.children) {
        t_.children.push_back(child);
        parents.add(child >> 1, number(a - first_node_) << 1 | (child & 1u));
      }
    }
    t_.child_begin.push_back(number(t_.children.size()));
    const std::vector<I> begin = parents.flatten(t_.parents);
    for (std::size_t a = 0; a <= n; ++a) t_.atoms[a].parents = begin[a];
  }

  /// Timers are ordered by level, rank and duration: each rank of a level is a stage, and each duration in a stage a queue.
  void timers() {
    const std::size_t n = atoms_.protos.size();
    std::size_t first = first_node_;
    while (first > 0 && atoms_.protos[first - 1].origin.kind == AtomOrigin::Kind::kTimer) --first;
    t_.shape.timers = number(first_node_ - first);
    Lists<I> inputs(n);
    for (std::size_t a = first; a < first_node_; ++a) {
      const Proto& proto = atoms_.protos[a];
      const Proto* before = a > first ? &atoms_.protos[a - 1] : nullptr;
      const bool new_stage = before == nullptr || before->level != proto.level || before->rank != proto.rank;
      if (new_stage) {
        if (before == nullptr || before->level != proto.level) t_.levels[proto.level].first_stage = number(t_.stages.size());
        const I timer = number(a - first), queue = number(t_.queue_us.size());
        t_.stages.push_back({timer, timer, queue, queue});
        t_.levels[proto.level].end_stage = number(t_.stages.size());
      }
      if (new_stage || before->duration_us != proto.duration_us) {
        t_.queue_us.push_back(proto.duration_us);
        t_.stages.back().end_queue = number(t_.queue_us.size());
      }
      t_.stages.back().end_timer = number(a - first + 1);
      t_.timers.push_back({proto.input, number(t_.queue_us.size() - 1)});
      inputs.add(proto.input >> 1, number(a - first));
    }
    t_.shape.queues = number(t_.queue_us.size());
    const std::vector<I> begin = inputs.flatten(t_.timer_inputs);
    for (std::size_t a = 0; a <= n; ++a) t_.atoms[a].timers = begin[a];
  }

  void groups() {
    large_.assign(p_.exclusive.size(), 0);
    for (std::size_t g = 0; g < p_.exclusive.size(); ++g) {
      const auto& members = p_.exclusive[g];
      const bool satellites = !members.empty() && p_[members.front()].kind == CellKind::kSatellite;
      if (!satellites || members.size() <= limits_.large_group) continue;
      if (t_.group_of.empty()) {
        t_.group_of.resize(p_.satellites, 0);
        t_.group_slot.resize(p_.satellites, 0);
      }
      large_[g] = ++t_.shape.groups;
      t_.group_begin.push_back(t_.shape.group_members);
      for (const program::CellId member : members) {
        t_.group_of[satellite(member)] = t_.shape.groups;
        t_.group_slot[satellite(member)] = t_.shape.group_members++ - t_.group_begin.back();
      }
    }
    if (t_.shape.groups > 0) t_.group_begin.push_back(t_.shape.group_members);
  }

  void writes() {
    std::map<float, I> palette;
    const auto value = [&](float v) {
      v = v == 0.0f ? 0.0f : v;  // no -0
      const auto [at, fresh] = palette.try_emplace(v, number(t_.values.size()));
      if (fresh) t_.values.push_back(v);
      return at->second;
    };
    value(-1.0f);
    value(1.0f);
    std::vector<program::Write> out;
    for (std::size_t r = 0; r < p_.rules.size(); ++r) {
      const program::Rule& rule = p_.rules[r];
      t_.rules[r].writes = number(t_.writes.size());
      t_.rules[r].clears = number(t_.clears.size());
      out.assign(rule.writes.begin(), rule.writes.end());
      for (const std::uint32_t g : rule.clears) {
        if (large_[g] != 0) {
          t_.clears.push_back(large_[g] - 1);
          continue;
        }
        for (const program::CellId member : p_.exclusive[g]) {
          if (!std::ranges::binary_search(rule.writes, member, {}, &program::Write::cell)) out.push_back({member, -1.0f});
        }
      }
      std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.cell < b.cell; });
      for (const program::Write& w : out) t_.writes.push_back({number(index(w.cell)), value(w.value)});
    }
    t_.rules.back().writes = number(t_.writes.size());
    t_.rules.back().clears = number(t_.clears.size());
    count_contested();
  }

  /// The most cells that may have to be blended in one tick: the (level, cell) pairs to which rules write different values.
  void count_contested() {
    constexpr I kUnwritten = 0xFFFFFFFFu, kDisputed = 0xFFFFFFFEu;
    std::uint32_t contested = 0;
    std::vector<I> first_value(p_.first_strategy(), kUnwritten);   // by cell: the first value that a rule of the level writes directly
    std::vector<I> written;
    for (std::uint32_t level = 0; level < p_.levels.size(); ++level) {
      written.clear();
      std::size_t resets = 0;
      bool clears = false;
      const auto [begin, end] = program::rules_of(p_, level);
      for (std::size_t r = begin; r < end; ++r) {
        resets += p_.rules[r].reset ? 1 : 0;
        clears = clears || t_.rules[r].clears != t_.rules[r + 1].clears;
        for (I k = t_.rules[r].writes; k < t_.rules[r + 1].writes; ++k) {
          if (t_.writes[k].cell >= p_.first_strategy()) continue;
          I& first = first_value[t_.writes[k].cell];
          if (first == kUnwritten) written.push_back(t_.writes[k].cell);
          if (first == kUnwritten) first = t_.writes[k].value;
          else if (first != t_.writes[k].value) first = kDisputed;
        }
      }
      for (const I cell : written) {
        contested += first_value[cell] == kDisputed || clears || resets > 1 ? 1 : 0;
        first_value[cell] = kUnwritten;
      }
      if (resets > 1 && clears) contested += p_.satellites;
    }
    t_.shape.contested = contested;
  }

  /// Atoms as they are at start-up: nothing is seen, facts are 0, satellites have their initial values, no timer has run.
  void truth() {
    t_.initial_truth = words_for(atoms_.protos.size());
    set_bit(t_.initial_truth, mts::kTrueAtom);
    for (std::size_t a = 0; a < atoms_.protos.size(); ++a) {
      const Proto& proto = atoms_.protos[a];
      if (proto.origin.kind == AtomOrigin::Kind::kTerm && program::holds(proto.origin.term, p_[proto.origin.cell].initial, t_.firing)) set_bit(t_.initial_truth, a);
      if (proto.origin.kind != AtomOrigin::Kind::kNode) continue;
      I holding = 0;
      for (const Literal child : proto.children) {
        holding += test_bit(t_.initial_truth, child >> 1) != ((child & 1u) != 0) ? 1u : 0u;
      }
      t_.initial_count.push_back(holding);
      if (holding >= t_.nodes[a - first_node_].need) set_bit(t_.initial_truth, a);
    }
  }

  /// The tables that only contradicting rules need.
  void strengths() {
    if (t_.shape.contested == 0) {
      t_.child_begin.clear();
      t_.children.clear();
      t_.is_and.clear();
      return;
    }
    for (const Proto& proto : atoms_.protos) {
      const bool term = proto.origin.kind == AtomOrigin::Kind::kTerm;
      t_.atom_cell.push_back(term ? number(index(proto.origin.cell)) : number(p_.cells.size()));
      t_.atom_term.push_back(static_cast<std::uint8_t>(proto.origin.term));
    }
  }

  const Program& p_;
  const Limits& limits_;
  Atoms atoms_;
  Tables t_;
  std::vector<I> word_of_;
  std::vector<std::uint32_t> large_;
  std::size_t first_node_ = 0;
};

}  // namespace

Tables build(const program::Program& program, const Limits& limits) {
  Tables tables = TableBuilder(program, limits).build();
  for (const fuzzy::Controller& controller : program.fuzzy) tables.fuzzy.push_back(pack(controller));
  return tables;
}

}  // namespace kb::tables
