// Inside the C++ emitter: what the parts of fuzzy controllers share.
#pragma once

#include <string>

#include "compiler/emit/names.h"
#include "compiler/fuzzy/controller.h"
#include "compiler/tables/fuzzy.h"

namespace kb::emit {

/// `in.free[3]`.
[[nodiscard]] std::string slot_expression(const fuzzy::Controller& controller, const FuzzyNames& names, std::uint32_t slot);

/// `evaluate_tables`.
void emit_table_walk(const fuzzy::Controller& controller, const tables::FuzzyForm& form, const FuzzyNames& names, std::string& out);
/// `evaluate`: the rules as straight C++, or, for a large controller, a call of the tables' evaluator.
void emit_straight_code(const fuzzy::Controller& controller, const tables::FuzzyForm& form, const FuzzyNames& names, std::string& out);

}  // namespace kb::emit
