// Connects the parser that bison makes with the tokens, and with the messages for tokens that it does not accept.
#include <iterator>

#include "compiler/syntax/expectation.h"
#include "compiler/syntax/parser.h"
#include "compiler/syntax/syntax_error.h"

namespace kb::syntax::generated {
namespace {

constexpr int kNumberOf[] = {
#define KB_TOKEN(name, spelling) Parser::token::k##name,
#define KB_KEYWORD(name, spelling) Parser::token::k##name,
#include "grammar/tokens.def"
#undef KB_TOKEN
#undef KB_KEYWORD
};

// Bison has a name of its own for the terminal 0.
struct Symbols : Parser::symbol_kind {
  static constexpr Parser::symbol_kind_type S_End = S_YYEOF;
};
struct Terminal {
  Parser::symbol_kind_type symbol;
  TokenKind kind;
};
constexpr Terminal kTerminals[] = {
#define KB_TOKEN(name, spelling) {Symbols::S_##name, TokenKind::k##name},
#define KB_KEYWORD(name, spelling) {Symbols::S_##name, TokenKind::k##name},
#include "grammar/tokens.def"
#undef KB_TOKEN
#undef KB_KEYWORD
};

}  // namespace

int yylex(std::uint32_t* value, source::Span* location, TokenStream& stream);   // called only by the parser

int yylex(std::uint32_t* value, source::Span* location, TokenStream& stream) {
  const Token token = stream.next();
  *value = 0;
  *location = token.span;
  return kNumberOf[static_cast<std::size_t>(token.kind)];
}

void Parser::error(const source::Span&, const std::string&) {}  // called only if memory runs out

void Parser::report_syntax_error(const context& at) const {
  if (builder.diagnostics().errors() > diagnostics::Diagnostics::kMaxErrors) return stream.recover(false);
  Parser::symbol_kind_type symbols[std::size(kTerminals)];
  const int count = at.expected_tokens(symbols, static_cast<int>(std::size(symbols)));
  TokenSet expected;
  for (int i = 0; i < count; ++i) {
    for (const Terminal& terminal : kTerminals) {
      if (terminal.symbol == symbols[i]) expected.insert(terminal.kind);
    }
  }
  if (stream.behind(0).kind == TokenKind::kComment) return stream.stop(wanted(stream, expected));
  diagnose_syntax_error(stream, expected, builder.diagnostics());
  const bool complete = statement_may_begin(expected) && stream.behind(0).begins_line;
  stream.recover(complete && !builder.ends_with_statement_at(stream.statement().span));
}

}  // namespace kb::syntax::generated
