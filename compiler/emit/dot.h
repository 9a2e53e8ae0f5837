// A knowledge base as pictures: graphs in the DOT language of Graphviz. Printing only; the same input gives the same
// bytes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compiler/model/model.h"
#include "compiler/program/program.h"

namespace kb::emit {

/// The maps: landmarks at their coordinates (`layout=neato` is set in the graph, so that any Graphviz program keeps
/// them there), roads with their exits, one line style for each method, and the routes and detours over them with
/// numbered legs. What counts as landmark, road, leg, route and detour are the relations of these names (std.route,
/// std.mission, std.detour). O(model).
[[nodiscard]] std::string print_map_dot(const model::Model& model);

/// The levels, each a frame with its rules as written, and between them the groups of cells that they write and read. A dotted
/// line stands for a read of the value that the last tick left. O(program).
[[nodiscard]] std::string print_levels_dot(const model::Model& model, const program::Program& program);

/// Some rules one by one, with the single cells that each reads and writes. O(their conditions and effects).
[[nodiscard]] std::string print_rules_dot(const program::Program& program, const std::vector<program::RuleId>& rules);

/// `text` as a quoted DOT string.
[[nodiscard]] std::string dot_string(std::string_view text);

}  // namespace kb::emit
