// Bytes to tokens, before anything is reported. Private to this folder; implemented in grammar/lexer.re.
#pragma once

#include <string>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"
#include "compiler/syntax/tokens.h"

namespace kb::syntax {

/// Something in the text that is no token.
struct LexicalError {
  diagnostics::Kind kind;
  source::Span span;
  std::string first, second;   ///< arguments of the message
  bool repaired = false;       ///< the token that was surely meant stands in its place, so what follows can be checked
};

struct Scan {
  std::vector<Token> tokens;           ///< the last one is kEnd
  std::vector<LexicalError> errors;    ///< in order of the text
};

enum class Comments : std::uint8_t { kKeep, kDrop };

/// All tokens of a file. O(bytes). A run of bad bytes is one error.
[[nodiscard]] Scan scan(const source::Sources& sources, source::FileId file, Comments comments);

/// Reports `error`.
void report(const LexicalError& error, diagnostics::Diagnostics& diagnostics);

}  // namespace kb::syntax
