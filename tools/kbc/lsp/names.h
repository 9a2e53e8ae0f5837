// What a name stands for, for people.
#pragma once

#include <string>
#include <string_view>

#include "tools/kbc/lsp/workspace.h"

namespace kb::lsp {

/// The space of names that things of that kind, as model::KnownName has it, are in.
[[nodiscard]] constexpr Meaning::Space space_of(std::string_view kind) {
  return kind == "rule" ? Meaning::Space::kRule : kind == "level" ? Meaning::Space::kLevel : Meaning::Space::kName;
}

struct Symbol {
  std::string_view kind;   ///< `fact`, `member`; of kinds.h, or a relation's name
  std::string more;        ///< what belongs to it, or it belongs to, as it would be written: `{ N, E, S, W }`, `of Turn`
};
/// `fact`, `member of Turn`.
[[nodiscard]] inline std::string detail(const Symbol& symbol) { return std::string(symbol.kind) + (symbol.more.empty() ? "" : " " + symbol.more); }
/// Nothing of a name that nobody declares; of what drives in control lines, that Waymark has no such controller.
[[nodiscard]] std::optional<Symbol> symbol(const Knowledge& knowledge, const Use& use);

}  // namespace kb::lsp
