#include "compiler/syntax/scan.h"
#include "compiler/syntax/syntax.h"

namespace kb::syntax {

void report(const LexicalError& error, diagnostics::Diagnostics& diagnostics) {
  diagnostics.report(error.kind, error.span, {error.first, error.second});
}

std::vector<Token> lex(const source::Sources& sources, source::FileId file, diagnostics::Diagnostics& diagnostics) {
  Scan scanned = scan(sources, file, Comments::kKeep);
  for (const LexicalError& error : scanned.errors) report(error, diagnostics);
  return std::move(scanned.tokens);
}

}  // namespace kb::syntax
