// Small parts of a tree as text.
#pragma once

#include <string>

#include "compiler/syntax/tree.h"

namespace kb::syntax {

/// A reference as it is written: `Turn[turn_of(i, o)]`.
[[nodiscard]] std::string ref_text(const Tree& tree, RefId id);
/// A membership function as it is written: `gaussian(0.9, left 0.15, right inf)`.
[[nodiscard]] std::string shape_text(const Shape& shape);
/// What defines a fact: `line[0] ~ dark and not Obst`. With `inside`, as a part of another `and` or `or`, in parentheses.
[[nodiscard]] std::string percept_text(const Tree& tree, PerceptId id, bool inside = false);
/// A condition of a fuzzy block, every pair in parentheses; a whole rule.
[[nodiscard]] std::string fuzzy_text(const Fuzzy& fuzzy, std::uint32_t condition);
[[nodiscard]] std::string fuzzy_text(const Fuzzy& fuzzy, const Fuzzy::Rule& rule);
/// `-0.5 m`, with the fewest digits that read back as the same value.
[[nodiscard]] std::string number_text(const Number& number);

}  // namespace kb::syntax
