// What the pictures of rules share. Private to the printers of DOT.
#pragma once

#include <set>
#include <string_view>
#include <vector>

#include "compiler/program/program.h"

namespace kb::emit {

/// Attributes of the node of a cell. Shapes tell the kinds apart even in black and white; outputs, which the program reads, have a double
/// border.
[[nodiscard]] std::string_view cell_shape(program::CellKind kind, bool output);

/// Added to the legend of a picture that has an output.
inline constexpr std::string_view kOutputLegend = "   double border: the program reads it";

/// The cells that conditions ask for. O(conditions of the program).
[[nodiscard]] std::set<program::CellId> cells_read(const program::Program& program, const std::vector<program::CondId>& conditions);

}  // namespace kb::emit
