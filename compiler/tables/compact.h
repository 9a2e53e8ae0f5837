// Whether a knowledge base can be emitted in compact form (runtime/compact_tables.h), and how much memory it then needs.
#pragma once

#include <cstddef>
#include <string>

#include <waymark/runtime/compact_tables.h>
#include "compiler/program/program.h"
#include "compiler/tables/form.h"

namespace kb::tables {

/// The bounds that size the memory of a compact mind. O(tables).
[[nodiscard]] mts::CompactShape compact_shape(const Tables& tables);

/// Bytes of a compact mind, that is, of mts::CompactState with these counts. A C++ compiler may add a few bytes of padding.
[[nodiscard]] std::size_t compact_state_bytes(const mts::Shape& shape, const mts::CompactShape& bounds);

/// What keeps the program from the compact form, worded to follow "it has ..."; empty if nothing does.
[[nodiscard]] std::string against_compact(const Tables& tables, const program::Program& program);

}  // namespace kb::tables
