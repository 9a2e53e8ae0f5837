// What can be written at a place. The parser is asked: it gets a token there that no grammar takes, and says what it expects instead.
#include <algorithm>
#include <utility>

#include "compiler/diagnostics/consumers.h"
#include "compiler/syntax/parser.h"
#include "compiler/syntax/syntax.h"
#include "compiler/syntax/token_stream.h"
#include "compiler/syntax/tree_builder.h"

namespace kb::syntax {
namespace {

/// The statement around `offset`, up to there, followed by the question.
Prepared statement_up_to(const source::Sources& sources, source::FileId file, std::uint32_t offset) {
  Scan scanned = scan(sources, file, Comments::kDrop);
  std::erase_if(scanned.tokens, [&](const Token& token) { return token.span.end > offset || token.kind == TokenKind::kEnd; });
  scanned.tokens.emplace_back(TokenKind::kEnd, source::Span{file, offset, offset});
  Prepared out = prepare(sources, {std::move(scanned.tokens), {}});
  out.errors.clear();
  const auto first = std::find_if(out.tokens.rbegin(), out.tokens.rend(), [](const Token& token) { return token.begins_statement && token.begins_line; });
  if (first != out.tokens.rend()) out.tokens.erase(out.tokens.begin(), std::prev(first.base()));
  Token question = out.tokens.back();   // it begins a line if the end does
  question.kind = TokenKind::kComment;
  out.tokens.insert(std::prev(out.tokens.end()), question);
  return out;
}

std::optional<Wanted> ask(const source::Sources& sources, source::FileId file, Prepared statement) {
  diagnostics::CountingConsumer nobody;   // mistakes before the place are reported elsewhere
  diagnostics::Diagnostics diagnostics(sources, nobody);
  TokenStream stream(sources, std::move(statement), diagnostics);
  TreeBuilder builder(sources, file, diagnostics);
  generated::Parser parser(stream, builder);
  parser.parse();
  return stream.wanted();
}

}  // namespace

std::optional<Wanted> wanted_at(const source::Sources& sources, source::FileId file, std::uint32_t offset) {
  const Prepared statement = statement_up_to(sources, file, offset);
  const std::size_t size = statement.tokens.size();
  // In a fuzzy block the `is` that makes a name a subject is not written yet, so the name was taken for another name, or for a unit.
  const bool fuzzy = statement.tokens.front().kind == TokenKind::kFuzzy && size > 3 && statement.tokens[size - 3].kind == TokenKind::kIdentifier;
  std::optional<Wanted> out = fuzzy && statement.tokens[size - 3].begins_line ? std::nullopt : ask(sources, file, statement);
  if (out || !fuzzy) return out;
  Prepared other = statement;
  other.tokens[size - 3].kind = TokenKind::kSubject;
  return ask(sources, file, std::move(other));
}

}  // namespace kb::syntax
