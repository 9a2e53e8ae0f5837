// What a name stands for, where it is declared, and what belongs to it: for those who look something up.
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
  std::string more;              ///< what belongs to it, as it would be written: `[Direction]`, `{ N, E, S, W }`, `at goal`
  const FiniteSet* members = nullptr;   ///< what can stand after `name.`, in the model; null if nothing can
};

/// By the alphabet; a group is one name, however many members it has. Cost: n log n of the names.
[[nodiscard]] std::vector<KnownName> known_names(const Model& model);

/// The relation whose rows the compiler writes into that field of the relations of maps, routes and detours; empty if it writes something else there,
/// nothing if it writes no such field.
[[nodiscard]] std::optional<std::string_view> rows_written_in(std::string_view relation, std::string_view field);

}  // namespace kb::model
