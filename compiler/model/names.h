// Every name of a knowledge base, in one space: cells, groups, finite sets, relations, rows, tables, maps.
// (Levels, rules and controllers are named only where nothing else can stand, so they have name spaces of their own.)
#pragma once

#include <absl/container/flat_hash_map.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/syntax/tree.h"

namespace kb::model {

struct Entity {
  enum class Kind : std::uint8_t {
    kBroken,    ///< its declaration was reported as wrong; nothing more is reported about it
    kFact, kSatellite, kStrategy,  ///< `id` is a CellId
    kGroup,     ///< `id` is an index into `Model::groups`
    kSet, kRelation, kTable, kMap,
    kPrototype,  ///< `id` is an index into `Model::prototypes`
    kSensor,     ///< `id` is an index into `Model::sensors`
    kFuzzy,      ///< `id` is an index into `Model::fuzzy`
    kLandmark, kCommand, kRoute, kRow,  ///< `id` is a RowId
  };
  Kind kind = Kind::kBroken;
  std::uint32_t id = 0;
  source::Span declared;
  bool twice = false;   ///< the name was declared a second time, perhaps as something else; reported
};

/// "a fact", "a finite set", ...
[[nodiscard]] std::string_view words_for(Entity::Kind kind);

class Names {
 public:
  /// Declares a name. A second declaration is reported with a note at the first (unless that one was broken) and changes
  /// nothing. `text` must outlive this (it is a view into the sources, or a literal).
  bool declare(syntax::Name name, Entity entity, diagnostics::Diagnostics& diagnostics,
               diagnostics::Kind twice = diagnostics::Kind::kRedeclared);
  /// Declares a name if it is free.
  void declare_quietly(std::string_view text, Entity entity);
  /// The entity of this name, or null. Valid until the next name is declared.
  [[nodiscard]] const Entity* find(std::string_view text) const;
  /// The nearest name that satisfies `fits`, for "did you mean" (see Diagnostics::nearest).
  template <class Fits>
  [[nodiscard]] std::optional<std::string> nearest(std::string_view text, Fits fits, const diagnostics::Diagnostics& diagnostics) const {
    return diagnostics.nearest(text, all_, [&fits](const Named& one) { return fits(one.entity) ? one.text : std::string_view(); });
  }
  [[nodiscard]] std::optional<std::string> nearest(std::string_view text, Entity::Kind kind, const diagnostics::Diagnostics& diagnostics) const {
    return nearest(text, [kind](const Entity& entity) { return entity.kind == kind; }, diagnostics);
  }
  struct Named { std::string_view text; Entity entity; };
  /// All names in order of declaration.
  [[nodiscard]] const std::vector<Named>& all() const { return all_; }
  /// Room for so many names in all.
  void reserve(std::size_t count);

 private:
  /// The entity of the name, and whether it was added.
  std::pair<Entity&, bool> add(std::string_view text, const Entity& entity);

  std::vector<Named> all_;
  absl::flat_hash_map<std::string_view, std::uint32_t> place_of_;   // in `all_`; looked up, never iterated
};

}  // namespace kb::model
