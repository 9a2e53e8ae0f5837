// How facts are perceived: `fact X = ...`, `facts G { a = ... }`, and `perceive`, once for each combination of its variables.
#include <fmt/format.h>

#include "compiler/model/percepts.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

class PerceptionReader {
 public:
  PerceptionReader(Draft& draft, const syntax::Tree& tree)
      : draft_(draft), tree_(tree), references_(draft, tree, binders_), percepts_(draft, tree, references_, binders_) {}

  /// `perceive [binders] target = percept`
  void perceive(const syntax::Perceive& statement) {
    const std::size_t errors = draft_.diagnostics.errors();
    const bool bound = read_binders(draft_, statement.binders, binders_, ranges_);
    const std::uint32_t target = references_.compile(statement.target);
    const source::Span at = tree_[statement.target].span;
    const auto count = combinations(draft_, ranges_, {at, draft_.diagnostics.sources().text(at)});
    if (!bound || !count) return;
    std::vector<std::size_t> places(ranges_.size(), 0);
    for (std::size_t i = 0; i < *count && draft_.diagnostics.errors() == errors; ++i) {
      values_.clear();
      names_.clear();
      for (std::size_t b = 0; b < places.size(); ++b) {
        values_.push_back(ranges_[b].value(places[b]));
        names_.push_back(ranges_[b].name(places[b]));
      }
      make_instance(target, statement);
      next_combination(places, [this](std::size_t b) { return ranges_[b].size(); });
    }
    if (draft_.diagnostics.errors() != errors || *count == 0) return;
    for (const Binder& binder : binders_) {
      if (!binder.used) draft_.diagnostics.report(Kind::kUnusedBinder, binder.name.span, {binder.name.text, "perceive"});
    }
  }

  /// For a definition at the fact's declaration.
  void define(CellId fact, syntax::PerceptId percept, source::Span at) {
    PerceptId made{};
    if (percepts_.read(percept, {}, {}, made) == Outcome::kMade) add(fact, made, at);
  }

 private:
  void make_instance(std::uint32_t target, const syntax::Perceive& statement) {
    const Operand operand = references_.evaluate(target, values_);
    if (operand.kind == Operand::Kind::kBroken || operand.kind == Operand::Kind::kMissing) return;
    const source::Span at = tree_[statement.target].span;
    const auto cell = references_.cell_of(operand);
    if (!cell || draft_.model[*cell].kind != CellKind::kFact) {
      draft_.diagnostics.report(Kind::kPerceiveNoFact, at, {references_.text(target), references_.describe(operand)});
      return;
    }
    const std::size_t percepts = draft_.model.percepts.size();
    PerceptId made{};
    if (percepts_.read(statement.percept, values_, names_, made) == Outcome::kMade) add(*cell, made, at);
    else draft_.model.percepts.resize(percepts);
  }

  void add(CellId fact, PerceptId percept, source::Span at) {
    const auto place = static_cast<std::uint32_t>(draft_.model.perceived.size());
    const auto [first, fresh] = draft_.perceived_of.emplace(static_cast<std::uint32_t>(index(fact)), place);
    if (fresh) {
      draft_.model.perceived.push_back({fact, percept, false, at});
      return;
    }
    draft_.diagnostics.report(Kind::kPerceivedTwice, at, {draft_.model[fact].name})
        .note(Kind::kFirstPerceivedHere, draft_.model.perceived[first->second].span);
  }

  Draft& draft_;
  const syntax::Tree& tree_;
  std::vector<Binder> binders_;
  std::vector<Range> ranges_;  // by binder
  References references_;
  Percepts percepts_;
  std::vector<Operand> values_;          // of the binders, in this instance
  std::vector<std::string_view> names_;  // ... and their names
};

/// The facts that an item declared; none if it is broken.
std::vector<CellId> cells_of(const Draft& draft, const syntax::Declaration::Item& item) {
  const Entity* entity = draft.names.find(item.name.text);
  if (entity == nullptr || entity->declared.begin != item.name.span.begin || entity->declared.file != item.name.span.file) return {};
  switch (entity->kind) {
    case Entity::Kind::kFact: return {CellId{entity->id}};
    case Entity::Kind::kCommand: return {draft.model[RowId{entity->id}].cell};
    case Entity::Kind::kGroup: return draft.model.groups[entity->id].cells;
    default: return {};
  }
}

void read_members(Draft& draft, const syntax::Tree& tree, const syntax::Declaration::Item& item, const std::vector<CellId>& cells) {
  for (std::size_t i = 0; i < item.definitions.size(); ++i) {
    if (!item.definitions[i] || cells.empty()) continue;
    const auto member = draft.member(draft.set_of.at(item.name.text), item.names[i].text);
    if (member) PerceptionReader(draft, tree).define(cells[member->index], *item.definitions[i], item.names[i].span);
  }
}

void read_definitions(Draft& draft, const syntax::Tree& tree, const syntax::Declaration& from) {
  const bool facts = from.kind == syntax::Declaration::Kind::kFact || from.kind == syntax::Declaration::Kind::kCommand;
  if (!facts) return;  // refused together with the declaration
  std::size_t declared = 0;
  for (const syntax::Declaration::Item& item : from.items) {
    const std::vector<CellId> cells = cells_of(draft, item);
    declared += cells.size();
    read_members(draft, tree, item, cells);
  }
  if (!from.definition) return;
  if (declared > 1) {
    draft.diagnostics.report(Kind::kDefinitionOfMany, from.definition_span, {fmt::format("{}", declared)});
    return;
  }
  const std::vector<CellId> cells = cells_of(draft, from.items.front());
  if (!cells.empty()) PerceptionReader(draft, tree).define(cells.front(), *from.definition, from.items.front().name.span);
}

/// Done last, because the statement that says how a fact is perceived may be in another file.
void read_lazy(Draft& draft, const syntax::Declaration& from) {
  if (!from.lazy) return;
  for (const syntax::Declaration::Item& item : from.items) {
    for (const CellId cell : cells_of(draft, item)) {
      const auto perceived = draft.perceived_of.find(static_cast<std::uint32_t>(index(cell)));
      if (perceived != draft.perceived_of.end()) {
        draft.model.perceived[perceived->second].lazy = true;
      } else if (!draft.diagnostics.failed()) {
        draft.diagnostics.report(Kind::kLazyNotPerceived, *from.lazy, {draft.model[cell].name});
      }
    }
  }
}

}  // namespace

void read_perception(Draft& draft) {
  for (const syntax::Tree& tree : draft.forest.trees) {
    for (const syntax::Statement& statement : tree.statements) {
      if (const auto* declaration = std::get_if<syntax::Declaration>(&statement.node)) read_definitions(draft, tree, *declaration);
      if (const auto* perceive = std::get_if<syntax::Perceive>(&statement.node)) PerceptionReader(draft, tree).perceive(*perceive);
    }
  }
  draft.each<syntax::Declaration>([&](const auto&, const auto&, const auto& declaration) { read_lazy(draft, declaration); });
  for (std::size_t s = 0; s < draft.sensors.size(); ++s) {
    const Sensor& sensor = draft.model.sensors[s];
    if (!draft.sensors[s].used) draft.diagnostics.report(Kind::kUnusedSensor, sensor.declared, {sensor.name});
  }
}

}  // namespace kb::model
