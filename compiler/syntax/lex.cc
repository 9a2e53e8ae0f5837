#include <algorithm>

#include "compiler/source/encoding.h"
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
  const auto foreign = [](char c) { return static_cast<unsigned char>(c) >= 0x80; };
  std::string name(text.substr(0, kLongest));
  std::replace_if(name.begin(), name.end(), [&](char c) { return !source::is_letter_or_digit(c) && !foreign(c); }, '_');
  if (std::any_of(name.begin(), name.end(), foreign) && !is_name("a" + name)) std::replace_if(name.begin(), name.end(), foreign, '_');
  return name;
}

}  // namespace kb::syntax
