#include "compiler/model/names.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <utility>

namespace kb::model {
namespace {

std::uint32_t hash_of(std::string_view text) { return static_cast<std::uint32_t>(std::hash<std::string_view>()(text)); }

}  // namespace

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
  // Names are not declared in the order of the text (sets come first): the one that stands later is told of.
  source::Span first = known.declared;
  source::Span second = name.span;
  if (first.file == second.file && second.begin < first.begin) std::swap(first, second);
  diagnostics.report(twice, second, {name.text}).note(diagnostics::Kind::kFirstDeclaredHere, first);
  return false;
}

void Names::declare_quietly(std::string_view text, Entity entity) {
  add(text, entity);
}

const Entity* Names::find(std::string_view text) const {
  const Slot& slot = slots_[slot_of(hash_of(text), text)];
  return slot.name == 0 ? nullptr : &all_[slot.name - 1].entity;
}

void Names::reserve(std::size_t count) {
  if (2 * count <= slots_.size()) return;
  all_.reserve(count + count / 8);
  std::vector<Slot> old(std::bit_ceil(2 * count));
  old.swap(slots_);
  for (const Slot& slot : old) {
    if (slot.name != 0) slots_[slot_of(slot.hash, all_[slot.name - 1].text)] = slot;
  }
}

std::size_t Names::slot_of(std::uint32_t hash, std::string_view text) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = hash & mask;
  while (slots_[at].name != 0 && (slots_[at].hash != hash || all_[slots_[at].name - 1].text != text)) at = (at + 1) & mask;
  return at;
}

std::pair<const Entity&, bool> Names::add(std::string_view text, const Entity& entity) {
  if (2 * (all_.size() + 1) > slots_.size()) reserve(all_.size() + 1);
  const std::uint32_t hash = hash_of(text);
  Slot& slot = slots_[slot_of(hash, text)];
  if (slot.name != 0) return {all_[slot.name - 1].entity, false};
  all_.push_back({text, entity});
  slot = {hash, static_cast<std::uint32_t>(all_.size())};
  return {all_.back().entity, true};
}

}  // namespace kb::model
