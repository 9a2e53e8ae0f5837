// The model as core rules: cells in the program's order, effects folded, the control level's own rules.
#include <algorithm>
#include <array>
#include <numeric>

#include "compiler/model/model.h"
#include "compiler/program/conditions.h"
#include "compiler/program/lower_perception.h"
#include "compiler/program/net_effects.h"
#include "compiler/program/program.h"

namespace kb::program {
namespace {

constexpr std::uint32_t kNoPlace = 0xFFFFFFFFu;
constexpr std::size_t kMostBeside = 1'000;   // parts of an `and` with timers that may be loose

class Lowering {
 public:
  Lowering(const model::Model& model, const source::Sources& sources)
      : model_(model), sources_(sources), pool_(program_.conds, model.conds.size()), cond_of_(model.conds.size(), CondId::kNone) {}

  Program run() {
    program_.texts = model_.texts;
    lower_cells();
    lower_settings();
    program_.levels = model_.levels;
    for (const std::vector<model::CellId>& group : model_.exclusive) lower_exclusive(group);
    for (const model::CellId strategy : model_.priority) program_.priority.push_back(cell(strategy));
    lower_rules();
    append_control_rules(program_, pool_);
    for (const model::Control& control : model_.controls) lower_control(control);
    for (const model::LegRoad& leg : model_.leg_roads) {
      if (leg.limit_m_per_s > 0.0f) program_.limits.push_back({cell(leg.leg), leg.limit_m_per_s});
    }
    program_.perception = lower_perception(model_, cell_of_);
    program_.fuzzy = model_.fuzzy;
    return std::move(program_);
  }

 private:
  [[nodiscard]] CellId cell(model::CellId id) const {
    return id == model::CellId::kNone ? CellId::kNone : cell_of_[model::index(id)];
  }

  void lower_cells() {
    cell_of_ = cell_order(model_);
    program_.cells.resize(model_.cells.size());
    for (std::size_t i = 0; i < model_.cells.size(); ++i) {
      Cell& made = program_.cells[index(cell_of_[i])];
      made = lower_cell(model_.cells[i]);
      for (const model::CellId satellite : model_.cells[i].satellites) made.satellites.push_back(cell(satellite));
    }
  }

  Cell lower_cell(const model::Cell& from) {
    Cell made;
    made.name = from.name;
    made.kind = from.kind;
    made.initial = from.initial;
    made.command = from.command;
    made.keep = from.keep;
    made.output = from.output;
    made.declared = from.declared;
    switch (made.kind) {
      case CellKind::kFact:
        ++program_.facts;
        made.event = from.event;
        made.attention = from.attention;
        break;
      case CellKind::kSatellite: ++program_.satellites; break;
      case CellKind::kStrategy: ++program_.strategies; break;
    }
    return made;
  }

  void lower_settings() {
    const model::Settings& from = model_.settings;
    Settings& to = program_.settings;
    to.event = from.event;
    to.attention = from.attention;
    to.firing = from.firing;
    to.hold_limit_us = from.hold_limit_us;
    to.idle_strategy = cell(from.idle_strategy);
    to.idle = from.idle;
  }

  void lower_exclusive(const std::vector<model::CellId>& group) {
    if (group.empty()) return;
    std::vector<CellId>& members = program_.exclusive.emplace_back();
    for (const model::CellId member : group) members.push_back(cell(member));
    std::sort(members.begin(), members.end());
  }

  /// Recursion as deep as conditions nest, which the parser limits.
  CondId lower_condition(model::CondId id) {
    CondId& known = cond_of_[model::index(id)];
    if (known != CondId::kNone) return known;
    const model::Cond& cond = model_[id];
    source::Few<CondId, 8> parts;
    for (const model::CondId part : cond.children) parts.push_back(lower_condition(part));
    switch (cond.op) {
      case model::Cond::Op::kAnd: known = pool_.all_of(parts); break;
      case model::Cond::Op::kOr: known = pool_.any_of(parts); break;
      case model::Cond::Op::kNot: known = pool_.negation(parts.front()); break;
      case model::Cond::Op::kFor: known = pool_.held_for(parts.front(), cond.duration_us); break;
      case model::Cond::Op::kEvent: known = pool_.event(cell(cond.cell)); break;
      case model::Cond::Op::kLost: known = pool_.lost(cell(cond.cell)); break;
      case model::Cond::Op::kSeen: known = pool_.seen(cell(cond.cell)); break;
      case model::Cond::Op::kIs: known = pool_.is(cell(cond.cell), cond.term); break;
    }
    return known;
  }

  /// Conditions are made in the order of declaration; rules are ordered by level.
  void lower_rules() {
    const std::vector<std::uint32_t> group_of = group_of_cells(program_);
    std::vector<CondId> conditions;
    conditions.reserve(model_.rules.size());
    for (const model::Rule& from : model_.rules) conditions.push_back(lower_condition(from.condition));
    for (std::uint32_t i = 0; i < model_.rules.size(); ++i) {
      if (model_[model_.rules[i].condition].loose) find_loose_timers(i, model_.rules[i].condition);
    }
    source::release(cond_of_);
    place_of_.resize(model_.templates.size(), kNoPlace);
    program_.rules.reserve(model_.rules.size() + model_.priority.size());
    for (const std::uint32_t i : rules_by_level()) {
      const RuleId made{static_cast<std::uint32_t>(program_.rules.size())};
      program_.rules.push_back(lower_rule(model_.rules[i], conditions[i], group_of));
      for (auto loose = std::ranges::lower_bound(loose_, RuleId{i}, {}, &LooseTimer::rule); loose != loose_.end() && loose->rule == RuleId{i}; ++loose) {
        program_.loose_timers.push_back(*loose);
        program_.loose_timers.back().rule = made;
      }
    }
  }

  /// The rules as written, by level; those of a level in the order of the text.
  [[nodiscard]] std::vector<std::uint32_t> rules_by_level() const {
    std::vector<std::vector<std::uint32_t>> of_level(model_.levels.size());
    for (std::uint32_t i = 0; i < model_.rules.size(); ++i) of_level[model_[model_.rules[i].tmpl].level].push_back(i);
    std::vector<std::uint32_t> order;
    order.reserve(model_.rules.size());
    for (const auto& rules : of_level) order.insert(order.end(), rules.begin(), rules.end());
    return order;
  }

  void find_loose_timers(std::uint32_t rule, model::CondId id) {
    if (model_[id].children.size() > kMostBeside) return;   // each timer keeps a list of all other parts
    for (const model::CondId part : model_[id].children) {
      if (!model_[part].loose) continue;
      if (model_[part].op != model::Cond::Op::kFor) {
        find_loose_timers(rule, part);
        continue;
      }
      LooseTimer& timer = loose_.emplace_back(LooseTimer{RuleId{rule}, cond_of_[model::index(part)], {}, model_.loose_timers.at(part)});
      for (const model::CondId other : model_[id].children) {
        if (other != part) timer.beside.push_back(cond_of_[model::index(other)]);
      }
    }
  }

  Rule lower_rule(const model::Rule& from, CondId condition, const std::vector<std::uint32_t>& group_of) {
    const model::Template& tmpl = model_[from.tmpl];
    Rule rule;
    rule.name = from.name;
    rule.level = tmpl.level;
    rule.mode = tmpl.mode == syntax::Rule::Mode::kWhen ? Mode::kWhen : Mode::kWhile;
    rule.condition = condition;
    rule.span = tmpl.span;
    std::uint32_t& place = place_of_[model::index(from.tmpl)];   // shared by all instances
    if (place == kNoPlace) place = program_.place(sources_.origin(tmpl.span));
    rule.place = place;
    rule.standard = tmpl.standard;
    effects_.clear();
    for (const model::Write& write : from.effects) effects_.push_back({cell(write.cell), write.value, write.reset});
    fold_effects(program_, group_of, effects_, rule);
    return rule;
  }

  void lower_control(const model::Control& from) {
    Control control;
    control.strategy = cell(from.strategy);
    control.controller = from.controller;
    control.span = from.span;
    control.controller_span = from.controller_span;
    control.fuzzy = from.fuzzy;
    for (const model::Control::Argument& argument : from.arguments) {
      control.arguments.push_back({argument.name, argument.number, argument.unit, argument.word, argument.is_number, argument.span});
    }
    program_.controls.push_back(std::move(control));
  }

  const model::Model& model_;
  const source::Sources& sources_;
  Program program_;
  ConditionPool pool_;
  std::vector<CellId> cell_of_;                 // by model cell
  std::vector<CondId> cond_of_;                 // by model condition
  std::vector<std::uint32_t> place_of_;         // by template: the place of its rules, or kNoPlace
  std::vector<Effect> effects_;                 // of one rule
  std::vector<LooseTimer> loose_;               // ascending by rule, which is the model's
};

}  // namespace

std::vector<CellId> cell_order(const model::Model& model) {
  const auto number_of = [](CellKind kind) { return static_cast<std::size_t>(kind); };
  std::array<std::uint32_t, 4> next{};   // by kind
  for (const model::Cell& cell : model.cells) ++next[number_of(cell.kind) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<CellId> order;
  order.reserve(model.cells.size());
  for (const model::Cell& cell : model.cells) order.push_back(CellId{next[number_of(cell.kind)]++});
  return order;
}

std::vector<CellRun> landmark_runs(const model::Model& model) {
  const std::vector<CellId> order = cell_order(model);
  std::vector<CellId> facts;
  for (const model::Map& map : model.maps) {
    for (const model::RowId landmark : map.landmarks) {
      const model::CellId cell = model[landmark].cell;
      if (cell != model::CellId::kNone && model[cell].kind == CellKind::kFact) facts.push_back(order[model::index(cell)]);
    }
  }
  std::sort(facts.begin(), facts.end());
  std::vector<CellRun> runs;
  for (const CellId fact : facts) {
    const std::size_t past = runs.empty() ? 0 : index(runs.back().first) + runs.back().count;
    if (runs.empty() || index(fact) > past) runs.push_back({fact, 1});
    else if (index(fact) == past) ++runs.back().count;   // below: a landmark of two maps
  }
  return runs;
}

Program lower(const model::Model& model, const source::Sources& sources) { return Lowering(model, sources).run(); }

}  // namespace kb::program
