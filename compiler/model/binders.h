// Variables: what `[l in Landmark, d in Direction]` ranges over, for rules and for what is perceived.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "compiler/model/references.h"

namespace kb::model {

/// The values of one variable, and how instances are named after them.
struct Range {
  std::vector<Operand> values;
  std::vector<std::string_view> names;
};

/// Looks up what the variables range over: a relation's rows, a group's cells, or a set's members; the members of a group
/// over one set stand for its cells too. False if anything was reported.
bool read_binders(Draft& draft, const std::vector<syntax::Rule::Binder>& written, std::vector<Binder>& binders,
                  std::vector<Range>& ranges);

/// How many combinations of values there are; nothing, and said so of `owner`, if they are too many.
[[nodiscard]] std::optional<std::size_t> combinations(Draft& draft, const std::vector<Range>& ranges, syntax::Name owner);

}  // namespace kb::model
