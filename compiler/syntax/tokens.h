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
  TokenKind kind;
  source::Span span;
};

}  // namespace kb::syntax
