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

bool is_name(std::string_view text) {
  source::Sources sources;
  const Scan scanned = scan(sources, sources.add({}, std::string(text)), Comments::kKeep);
  const Token& first = scanned.tokens.front();
  return scanned.errors.empty() && first.kind == TokenKind::kIdentifier && first.span.begin == 0 && first.span.end == text.size();
}

}  // namespace kb::syntax
