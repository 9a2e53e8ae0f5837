// What a name stands for, where it is declared, and what belongs to it: for editors and other tools that look names up.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/model/model.h"

namespace kb::model {

struct KnownName {
  std::string_view kind, name;   ///< `fact`, `Line`; views into the model
  source::Span declared;
  std::string more;              ///< what belongs to it, as written in the language: `[Direction]`, `{ N, E, S, W }`, `at goal`
  const FiniteSet* members = nullptr;   ///< what can stand after `name.`, in the model; null if nothing can
};

/// In alphabetical order; a group is one name, however many members it has. Cost: n log n of the names.
[[nodiscard]] std::vector<KnownName> known_names(const Model& model);

/// The compiler fills fields of the relations of maps, routes and detours. This is the relation whose rows it writes into that field;
/// empty if it writes something else there, nothing if it writes no such field.
[[nodiscard]] std::optional<std::string_view> rows_written_in(std::string_view relation, std::string_view field);

}  // namespace kb::model
