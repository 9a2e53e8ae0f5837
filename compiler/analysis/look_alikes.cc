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

/// Names of ASCII are what they look like: most knowledge bases have no others.
template <class F>
void for_each_name(const model::Model& model, F&& f) {
  for (const model::FiniteSet& set : model.sets) {
    f(std::string_view(set.name), set.declared);
    for (const std::string& member : set.members) f(std::string_view(member), set.declared);
  }
  for (const model::Group& group : model.groups) f(std::string_view(group.name), group.declared);
  for (const model::Cell& cell : model.cells) {
    const bool written = !cell.own_satellite && cell.name.find_first_of(".[") == std::string_view::npos;   // a member has been looked at
    if (written) f(cell.name, cell.declared);
  }
}

}  // namespace

void diagnose_look_alikes(const Subject& subject) {
  bool foreign = false;
  for_each_name(subject.model, [&](std::string_view name, source::Span) { foreign = foreign || !is_ascii(name); });
  if (!foreign) return;
  LookAlikes names(subject);
  for_each_name(subject.model, [&](std::string_view name, source::Span declared) { names.add(name, declared); });
}

}  // namespace kb::analysis
