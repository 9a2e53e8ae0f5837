// Names that a reader takes for one another and the compiler does not.
#include <algorithm>
#include <map>
#include <string>
#include <string_view>

#include "compiler/analysis/subject.h"
#include "compiler/diagnostics/look_alike.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;

class LookAlikes {
 public:
  explicit LookAlikes(const Subject& subject) : diagnostics_(subject.diagnostics) {}

  void add(std::string_view name, source::Span declared) {
    const auto [at, fresh] = known_.try_emplace(diagnostics::appearance(name), Known{name, declared});
    if (fresh || at->second.name == name) return;
    diagnostics_.report(Kind::kLookAlike, declared, {name, at->second.name, diagnostics::difference(name, at->second.name)})
        .note(Kind::kNameDeclaredHere, at->second.declared, {at->second.name});
  }

 private:
  struct Known { std::string_view name; source::Span declared; };
  diagnostics::Diagnostics& diagnostics_;
  std::map<std::string, Known> known_;   // by appearance
};

bool is_ascii(std::string_view name) {
  return std::all_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

/// Calls `f(name, place)` for each declared name that can stand beside the others in a rule: cells, sets and their members, relations, ...
template <class F>
void for_each_name(const model::Model& model, F&& f) {
  for (const model::FiniteSet& set : model.sets) {
    f(std::string_view(set.name), set.declared);
    for (const std::string& member : set.members) f(std::string_view(member), set.declared);
  }
  for (const model::Group& group : model.groups) f(std::string_view(group.name), group.declared);
  for (const model::Cell& cell : model.cells) {
    const bool written = !cell.own_satellite && cell.name.find_first_of(".[") == std::string_view::npos;   // members have been named with their set
    if (written) f(cell.name, cell.declared);
  }
  for (const model::Relation& relation : model.relations) f(std::string_view(relation.name), relation.declared);
  for (const model::Map& map : model.maps) f(std::string_view(map.name), map.declared);
  for (const model::Sensor& sensor : model.sensors) f(std::string_view(sensor.name), sensor.declared);
  for (const model::Prototype& prototype : model.prototypes) f(std::string_view(prototype.name), prototype.declared);
  for (const fuzzy::Controller& controller : model.fuzzy) f(std::string_view(controller.name), controller.declared);
}

/// Compares names with each other; `each(f)` calls `f(name, place)` for each of them. Names in ASCII do not look like others, and most
/// knowledge bases have no other names, so these are passed over quickly.
template <class Each>
void look_among(const Subject& subject, Each&& each) {
  bool foreign = false;
  each([&](std::string_view name, source::Span) { foreign = foreign || !is_ascii(name); });
  if (!foreign) return;
  LookAlikes names(subject);
  each([&](std::string_view name, source::Span declared) { names.add(name, declared); });
}

}  // namespace

void diagnose_look_alikes(const Subject& subject) {
  const model::Model& model = subject.model;
  look_among(subject, [&](auto&& f) { for_each_name(model, f); });
  look_among(subject, [&](auto&& f) {
    for (const model::Template& rule : model.templates) f(std::string_view(rule.name), rule.span);
  });
  look_among(subject, [&](auto&& f) {
    for (std::size_t i = 0; i < model.levels.size(); ++i) f(std::string_view(model.levels[i]), model.level_spans[i]);
  });
  for (const model::Relation& relation : model.relations) {
    look_among(subject, [&](auto&& f) {
      for (const std::string& field : relation.fields) f(std::string_view(field), relation.declared);
    });
  }
}

}  // namespace kb::analysis
