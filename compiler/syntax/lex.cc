#include <algorithm>

#include "compiler/source/encoding.h"
#include "compiler/source/utf8.h"
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

std::string worded(std::string_view text) {
  constexpr std::size_t kLongest = 200;
  std::string name;
  for (std::string_view left = text.substr(0, kLongest); !left.empty();) {
    const std::size_t bytes = std::max<std::size_t>(source::code_point(left).bytes, 1);
    const std::string_view character = left.substr(0, bytes);
    const bool belongs = bytes == 1 ? source::is_letter_or_digit(character[0]) : is_name("a" + std::string(character));
    name += belongs ? character : "_";
    left.remove_prefix(bytes);
  }
  return name;
}

}  // namespace kb::syntax
