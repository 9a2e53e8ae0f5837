// Which name stands at a place of a text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/model/known_names.h"
#include "compiler/source/source.h"
#include "compiler/syntax/syntax.h"

namespace kb::lsp {

/// Whether the byte can be part of a name; of letters that are not ASCII only the lexer knows more.
[[nodiscard]] constexpr bool in_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || (static_cast<unsigned char>(c) & 0x80u) != 0;
}

struct Mention {
  source::Span span;       ///< of the name
  std::string_view name;   ///< `left`, a view into the sources
  std::string before;      ///< what it is a member of, with the dot: `Turn.` of `Turn.left`; empty if of nothing
};

/// The name that holds byte `offset` of the file, or ends there.
[[nodiscard]] std::optional<Mention> mention_at(const source::Sources& sources, source::FileId file, std::uint32_t offset);

/// What is meant: the name as a whole, else what it is a member of. None if nobody knows it. `names`: as model::known_names has them.
[[nodiscard]] std::vector<const model::KnownName*> meanings(const Mention& mention, const std::vector<model::KnownName>& names);

}  // namespace kb::lsp
