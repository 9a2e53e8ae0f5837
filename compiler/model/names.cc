#include "compiler/model/names.h"

#include <utility>

namespace kb::model {

std::string_view words_for(Entity::Kind kind) {
  switch (kind) {
    case Entity::Kind::kBroken: return "a name";
    case Entity::Kind::kFact: return "a fact";
    case Entity::Kind::kSatellite: return "a satellite";
    case Entity::Kind::kStrategy: return "a strategy";
    case Entity::Kind::kGroup: return "a group of cells";
    case Entity::Kind::kSet: return "a finite set";
    case Entity::Kind::kRelation: return "a relation";
    case Entity::Kind::kTable: return "a table";
    case Entity::Kind::kMap: return "a map";
    case Entity::Kind::kFuzzy: return "a fuzzy controller";
    case Entity::Kind::kPrototype: return "a prototype";
    case Entity::Kind::kSensor: return "a sensor";
    case Entity::Kind::kLandmark: return "a landmark";
    case Entity::Kind::kCommand: return "a command";
    case Entity::Kind::kRoute: return "a route";
    case Entity::Kind::kRow: return "a row";
  }
  return "a name";
}

bool Names::declare(syntax::Name name, Entity entity, diagnostics::Diagnostics& diagnostics, diagnostics::Kind twice) {
  entity.declared = name.span;
  const auto [known, fresh] = add(name.text, entity);
  if (fresh) return true;
  known.twice = true;
  if (!known.declared.known()) {   // only one thing is declared nowhere
    diagnostics.report(diagnostics::Kind::kNameOfCommands, name.span, {name.text});
    return false;
  }
  // Names are not declared in the order of the text (sets come first). The message is about the later one, but never about the library's.
  source::Span first = known.declared;
  source::Span second = name.span;
  const auto of_library = [&](source::Span at) { return at.known() && diagnostics.sources().standard(at.file); };
  const bool turned = first.file == second.file ? second.begin < first.begin : of_library(second) && first.known() && !of_library(first);
  if (turned) std::swap(first, second);
  diagnostics.report(twice, second, {name.text}).note(diagnostics::Kind::kFirstDeclaredHere, first);
  return false;
}

void Names::declare_quietly(std::string_view text, Entity entity) {
  add(text, entity);
}

const Entity* Names::find(std::string_view text) const {
  const auto found = place_of_.find(text);
  return found == place_of_.end() ? nullptr : &all_[found->second].entity;
}

void Names::reserve(std::size_t count) {
  if (count <= place_of_.capacity()) return;
  place_of_.reserve(count + count / 2);
  all_.reserve(count + count / 8);
}

std::pair<Entity&, bool> Names::add(std::string_view text, const Entity& entity) {
  const auto [known, fresh] = place_of_.try_emplace(text, static_cast<std::uint32_t>(all_.size()));
  if (fresh) all_.push_back({text, entity});
  return {all_[known->second].entity, fresh};
}

}  // namespace kb::model
