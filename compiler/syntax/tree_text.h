// Small parts of a tree as text.
#pragma once

#include <string>

#include "compiler/syntax/tree.h"

namespace kb::syntax {

/// A reference as it is written: `Turn[turn_of(i, o)]`.
[[nodiscard]] std::string ref_text(const Tree& tree, RefId id);
/// `-0.5 m`, the shortest digits that give the value back.
[[nodiscard]] std::string number_text(const Number& number);

}  // namespace kb::syntax
