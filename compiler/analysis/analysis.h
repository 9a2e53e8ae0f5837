// Read-only checks of the whole program and model. They report what they find and change nothing.
#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/model/model.h"
#include "compiler/program/program.h"

namespace kb::analysis {

/// By controller: the names of the arguments it takes. For controllers that are not the user's own; the caller of the compiler supplies them.
using KnownArguments = std::map<std::string_view, std::vector<std::string_view>>;

/// Rules that can never fire; satellites never set or never read; rules of one level that can fire together and
/// disagree; strategies without a controller; strategies that could run at once; landmarks that no road reaches; ...
/// In `control` lines, arguments with a name in `known` are taken as meant; misspelt arguments of those controllers are left to the
/// caller, who knows them.
/// Cost: near linear in the program (see note [conflict buckets]).
void diagnose(const model::Model& model, const program::Program& program, const KnownArguments& known, diagnostics::Diagnostics& diagnostics);

/// By rule: whether no instance of its rule as written can ever fire. Nothing is reported; `diagnostics` knows the sources.
[[nodiscard]] std::vector<bool> find_dead_rules(const model::Model& model, const program::Program& program, diagnostics::Diagnostics& diagnostics);

}  // namespace kb::analysis
