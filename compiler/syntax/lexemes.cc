#include <algorithm>
#include <utility>

#include "compiler/syntax/syntax.h"
#include "compiler/syntax/token_stream.h"
#include "compiler/syntax/words.h"

namespace kb::syntax {
namespace {

Lexeme::Class class_of(TokenKind kind) {
  switch (kind) {
    case TokenKind::kIdentifier:
    case TokenKind::kLabel:
    case TokenKind::kSubject: return Lexeme::Class::kName;
    case TokenKind::kNumber: return Lexeme::Class::kNumber;
    case TokenKind::kString: return Lexeme::Class::kString;
    case TokenKind::kComment: return Lexeme::Class::kComment;
    default: break;
  }
  const bool word = is_keyword(kind) || (kind >= TokenKind::kInput && kind <= TokenKind::kMore);
  return word ? Lexeme::Class::kWord : Lexeme::Class::kSign;
}

}  // namespace

std::vector<Lexeme> lexemes(const source::Sources& sources, source::FileId file) {
  std::vector<Lexeme> out;
  const auto add = [&](const Token& token) {
    if (token.span.begin < token.span.end) out.push_back({class_of(token.kind), token.span});
  };
  Scan scanned = scan(sources, file, Comments::kKeep);
  std::erase_if(scanned.tokens, [&](const Token& token) {
    if (token.kind == TokenKind::kComment) add(token);
    return token.kind == TokenKind::kComment;
  });
  const auto comments_end = static_cast<std::ptrdiff_t>(out.size());
  for (const Token& token : prepare(sources, std::move(scanned)).tokens) add(token);
  std::inplace_merge(out.begin(), out.begin() + comments_end, out.end(), [](const Lexeme& a, const Lexeme& b) { return a.span.begin < b.span.begin; });
  const auto one_place = [](const Lexeme& a, const Lexeme& b) { return a.span.begin == b.span.begin; };   // `!=` is read as `is not`
  out.erase(std::unique(out.begin(), out.end(), one_place), out.end());
  return out;
}

}  // namespace kb::syntax
