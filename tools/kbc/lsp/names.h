// What a name stands for, in words for people.
#pragma once

#include <string>
#include <string_view>

#include "tools/kbc/lsp/workspace.h"

namespace kb::lsp {

/// The space of names for things of that kind (a kind of model::KnownName).
[[nodiscard]] constexpr Meaning::Space space_of(std::string_view kind) {
  return kind == "rule" ? Meaning::Space::kRule : kind == "level" ? Meaning::Space::kLevel : Meaning::Space::kName;
}

struct Symbol {
  std::string_view kind;   ///< `fact`, `member`; of kinds.h, or a relation's name
  std::string more;        ///< what belongs to it, or what it belongs to, as written in the language: `{ N, E, S, W }`, `of Turn`
};
/// `fact`, `member of Turn`.
[[nodiscard]] inline std::string detail(const Symbol& symbol) { return std::string(symbol.kind) + (symbol.more.empty() ? "" : " " + symbol.more); }
/// Nothing for a name without a declaration. For an unknown controller of a control line, says that Waymark has none of that name.
[[nodiscard]] std::optional<Symbol> symbol(const Knowledge& knowledge, const Use& use);

}  // namespace kb::lsp
