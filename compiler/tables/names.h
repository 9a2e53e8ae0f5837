// Atoms and literals in the language's own words, for printing and for comments in emitted tables.
#pragma once

#include <cstdint>
#include <string>

#include "compiler/program/program.h"
#include "compiler/tables/form.h"

namespace kb::tables {

/// `Line`, `Safe is low`, `seen LM5`, `(Arrived for 100 ms)`.
[[nodiscard]] std::string atom_name(const Tables& tables, const program::Program& program, std::uint32_t atom);
/// The same, with `not ` before it if the literal is negated.
[[nodiscard]] std::string literal_name(const Tables& tables, const program::Program& program, std::uint32_t literal);

}  // namespace kb::tables
