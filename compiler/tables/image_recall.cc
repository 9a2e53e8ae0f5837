// From tables back to core rules, as far as an image still contains them.
#include <fmt/format.h>

#include "compiler/program/conditions.h"
#include "compiler/source/numbers.h"
#include "compiler/tables/image.h"
#include "compiler/tables/lists.h"

namespace kb::tables {
namespace {

using program::CellId;
using program::CellKind;
using program::CondId;
using program::Program;

/// The condition of every atom, made when it is first needed. A verified image has no cycles, but conditions may nest deeply, so a stack
/// is kept instead of recursion.
class Conditions {
 public:
  Conditions(Tables& t, program::ConditionPool& pool) : t_(t), pool_(pool), known_(t.shape.atoms, CondId::kNone), parts_(parts_of_nodes(t)) {}

  CondId of_literal(I literal) {
    std::vector<I> todo{literal >> 1};
    while (!todo.empty()) {
      const I atom = todo.back();
      const std::size_t before = todo.size();
      if (known_[atom] == CondId::kNone) {
        for (const I part : parts_of(atom)) {
          if (known_[part >> 1] == CondId::kNone) todo.push_back(part >> 1);
        }
        if (todo.size() != before) continue;
        known_[atom] = make(atom);
        t_.origins[atom].condition = known_[atom];
      }
      todo.pop_back();
    }
    return known(literal);
  }
  [[nodiscard]] const std::vector<I>& parts_of_node(I node) const { return parts_[node]; }

 private:
  [[nodiscard]] std::vector<I> parts_of(I atom) const {
    if (t_.origins[atom].kind == AtomOrigin::Kind::kNode) return parts_[atom - t_.shape.first_node()];
    if (t_.origins[atom].kind == AtomOrigin::Kind::kTimer) return {timer(atom).input};
    return {};
  }
  [[nodiscard]] const mts::Timer<I>& timer(I atom) const { return t_.timers[atom - t_.shape.first_timer()]; }
  CondId known(I literal) { return (literal & 1u) != 0 ? pool_.negation(known_[literal >> 1]) : known_[literal >> 1]; }

  CondId make(I atom) {
    const AtomOrigin& o = t_.origins[atom];
    switch (o.kind) {
      case AtomOrigin::Kind::kTrue: return pool_.all_of({});
      case AtomOrigin::Kind::kFalse: return pool_.any_of({});
      case AtomOrigin::Kind::kTerm: return pool_.is(o.cell, o.term);
      case AtomOrigin::Kind::kSeen: return pool_.seen(o.cell);
      case AtomOrigin::Kind::kEvent: return pool_.event(o.cell);
      case AtomOrigin::Kind::kLost: return pool_.lost(o.cell);
      case AtomOrigin::Kind::kTimer: return pool_.held_for(known(timer(atom).input), t_.queue_us[timer(atom).queue]);
      case AtomOrigin::Kind::kNode: break;
    }
    std::vector<CondId> parts;
    for (const I part : parts_[atom - t_.shape.first_node()]) parts.push_back(known(part));
    return t_.nodes[atom - t_.shape.first_node()].need == parts.size() ? pool_.all_of(parts) : pool_.any_of(parts);
  }

  Tables& t_;
  program::ConditionPool& pool_;
  std::vector<CondId> known_;            // by atom
  std::vector<std::vector<I>> parts_;    // by node: its literals
};

class Recall {
 public:
  Recall(const LoadedImage& image, Tables& t) : image_(image), t_(t), pool_(p_.conds), conditions_(t, pool_) {}

  Program run() {
    settings();
    cells();
    groups();
    for (I l = 0; l < t_.shape.levels; ++l) p_.levels.emplace_back(name(mts::ImageKind::kLevel, l));
    rules();
    for (I a = 0; a < t_.shape.atoms; ++a) static_cast<void>(conditions_.of_literal(a << 1));   // perhaps no rule reads it
    return std::move(p_);
  }

 private:
  [[nodiscard]] std::string_view name(mts::ImageKind kind, I i) const {
    return p_.texts->keep(image_.visit([&](const auto& view) { return std::string_view(view.name(kind, i)); }));
  }
  [[nodiscard]] CellId strategy(I i) const { return CellId{t_.shape.facts + t_.shape.satellites + i}; }

  /// The number that was written: of all that are rounded to `x`, the one with the fewest digits.
  [[nodiscard]] static double written(float x) {
    double number = 0.0;
    return source::read_number(fmt::format("{}", x), number) ? number : static_cast<double>(x);
  }
  /// What was subtracted from `plain` to get `attended`.
  [[nodiscard]] static double attention(double plain, float attended) {
    const double exact = plain - static_cast<double>(attended), round = written(static_cast<float>(plain - written(attended)));
    return static_cast<float>(plain - round) == attended ? round : exact;
  }

  void settings() {
    p_.settings.firing = written(t_.firing);
    p_.settings.idle = static_cast<program::Idle>(t_.idle);
    if (t_.idle == mts::Idle::kStrategy) p_.settings.idle_strategy = strategy(t_.idle_strategy);
    p_.settings.hold_limit_us = t_.hold_limit_us;
    for (const I s : t_.priority) p_.priority.push_back(strategy(s));
  }

  void cells() {
    p_.facts = t_.shape.facts;
    p_.satellites = t_.shape.satellites;
    p_.strategies = t_.shape.strategies;
    for (I f = 0; f < t_.shape.facts; ++f) {
      program::Cell& cell = p_.cells.emplace_back();
      cell.name = name(mts::ImageKind::kFact, f);
      cell.event = written(t_.fact_atoms[f].plain);
      cell.attention = attention(cell.event, t_.fact_atoms[f].attended);
    }
    for (I s = 0; s < t_.shape.satellites; ++s) {
      program::Cell& cell = p_.cells.emplace_back();
      cell.name = name(mts::ImageKind::kSatellite, s);
      cell.kind = CellKind::kSatellite;
      cell.initial = t_.initial[s];
      cell.keep = (t_.keep[s / mts::kWordBits] >> (s % mts::kWordBits) & 1u) != 0;
      for (I i = t_.attends_begin[s]; i < t_.attends_begin[s + 1]; ++i) p_.cells[t_.attends[i]].satellites.push_back(CellId{t_.shape.facts + s});
    }
    for (I s = 0; s < t_.shape.strategies; ++s) {
      program::Cell& cell = p_.cells.emplace_back();
      cell.name = name(mts::ImageKind::kStrategy, s);
      cell.kind = CellKind::kStrategy;
      cell.initial = -1.0f;
    }
  }

  /// The large exclusive groups. Small groups have become effects.
  void groups() {
    p_.exclusive.resize(t_.shape.groups);
    for (I s = 0; s < t_.group_of.size(); ++s) {
      if (t_.group_of[s] != 0) p_.exclusive[t_.group_of[s] - 1].push_back(CellId{t_.shape.facts + s});
    }
  }

  void rules() {
    for (I l = 0; l < t_.shape.levels; ++l) {
      for (I w = t_.levels[l].first_word; w < t_.levels[l].end_word; ++w) {
        const I end = w + 1 < t_.shape.words ? t_.word_rule[w + 1] : t_.shape.rules;
        for (I r = t_.word_rule[w]; r < end; ++r) p_.rules.push_back(rule(r, l, w, mts::Word{1} << (r - t_.word_rule[w])));
      }
    }
  }

  program::Rule rule(I r, I level, I word, mts::Word bit) {
    program::Rule rule;
    rule.name = name(mts::ImageKind::kRule, r);
    rule.level = level;
    rule.mode = (t_.while_rules[word] & bit) != 0 ? program::Mode::kWhile : program::Mode::kWhen;
    rule.reset = (t_.reset_rules[word] & bit) != 0;
    rule.place = p_.place("image");
    std::vector<CondId> parts;
    for (I i = t_.rules[r].conditions; i < t_.rules[r + 1].conditions; ++i) parts.push_back(conditions_.of_literal(t_.conditions[i]));
    rule.condition = pool_.all_of(parts);
    for (I i = t_.rules[r].writes; i < t_.rules[r + 1].writes; ++i) {
      rule.writes.push_back({CellId{t_.writes[i].cell}, t_.values[t_.writes[i].value]});
      if (t_.writes[i].cell >= t_.shape.facts + t_.shape.satellites) wanted_by(r, CellId{t_.writes[i].cell});
    }
    for (I i = t_.rules[r].clears; i < t_.rules[r + 1].clears; ++i) rule.clears.push_back(t_.clears[i]);
    return rule;
  }

  /// Finds the satellites of a strategy: they are the only positive part of its rule, one satellite or an `or` of several.
  void wanted_by(I r, CellId strategy) {
    for (I i = t_.rules[r].conditions; i < t_.rules[r + 1].conditions; ++i) {
      const I literal = t_.conditions[i];
      if ((literal & 1u) != 0) continue;
      const bool node = literal >> 1 >= t_.shape.first_node();
      for (const I part : node ? conditions_.parts_of_node((literal >> 1) - t_.shape.first_node()) : std::vector<I>{literal}) {
        const AtomOrigin& o = t_.origins[part >> 1];
        const bool satellite = o.kind == AtomOrigin::Kind::kTerm && index(o.cell) >= t_.shape.facts && index(o.cell) < t_.shape.facts + t_.shape.satellites;
        if (satellite) p_.cells[index(strategy)].satellites.push_back(o.cell);
      }
    }
  }

  const LoadedImage& image_;
  Tables& t_;
  Program p_;
  program::ConditionPool pool_;
  Conditions conditions_;
};

}  // namespace

program::Program recall_program(const LoadedImage& image, Tables& tables) { return Recall(image, tables).run(); }

}  // namespace kb::tables
