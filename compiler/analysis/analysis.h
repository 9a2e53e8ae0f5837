// Read-only questions to the whole program and model. Each reports; none changes anything.
#pragma once

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/model/model.h"
#include "compiler/program/program.h"

namespace kb::analysis {

/// Rules that can never fire; satellites never set or never read; rules of one level that can fire together and
/// disagree; strategies without a controller; strategies that could run at once; landmarks that no road reaches; ...
/// Cost: near linear in the program (see note [conflict buckets]).
void diagnose(const model::Model& model, const program::Program& program, diagnostics::Diagnostics& diagnostics);

}  // namespace kb::analysis
