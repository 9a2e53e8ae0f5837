// The error message for a token that cannot stand where it stands.
#pragma once

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/syntax/token_stream.h"

namespace kb::syntax {

/// Reports the one error for the last token of `stream`, where the parser would have taken any of `expected`.
void diagnose_syntax_error(const TokenStream& stream, const TokenSet& expected, diagnostics::Diagnostics& diagnostics);

}  // namespace kb::syntax
