// Read-only questions to the whole program and model. Each reports; none changes anything.
#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/model/model.h"
#include "compiler/program/program.h"

namespace kb::analysis {

/// By controller: the names of what it has to set. Of controllers that are not the user's own, as whoever calls the compiler knows them.
using KnownArguments = std::map<std::string_view, std::vector<std::string_view>>;

/// Rules that can never fire; satellites never set or never read; rules of one level that can fire together and
/// disagree; strategies without a controller; strategies that could run at once; landmarks that no road reaches; ...
/// Of `control` lines, what has a name in `known` is taken to be written as it is meant, and what is misspelt of these is left to who knows them.
/// Cost: near linear in the program (see note [conflict buckets]).
void diagnose(const model::Model& model, const program::Program& program, const KnownArguments& known, diagnostics::Diagnostics& diagnostics);

}  // namespace kb::analysis
