// Tokens. The kinds are declared in grammar/tokens.def.
#pragma once

#include <cstdint>

#include "compiler/source/source.h"

namespace kb::syntax {

enum class TokenKind : std::uint8_t {
#define KB_TOKEN(name, spelling) k##name,
#define KB_KEYWORD(name, spelling) k##name,
#include "grammar/tokens.def"
#undef KB_TOKEN
#undef KB_KEYWORD
};

struct Token {
  Token() = default;
  Token(TokenKind k, source::Span s) : kind(k), span(s) {}

  TokenKind kind = TokenKind::kEnd;
  bool begins_line = false, begins_statement = false;   ///< false until `prepare` (token_stream.h) has found out
  source::Span span;
};

}  // namespace kb::syntax
