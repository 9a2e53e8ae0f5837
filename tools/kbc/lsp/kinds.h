// Editors' terms for the things that names stand for.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace kb::lsp {

struct EditorKind {
  std::string_view kind;    ///< as in model::KnownName, or names.cc
  int symbol, completion;   ///< numbers of SymbolKind and CompletionItemKind
  std::string_view token;   ///< a name of SemanticTokenTypes
};

inline constexpr std::array kEditorKinds{
    EditorKind{"fact", 13, 6, "variable"},        EditorKind{"satellite", 7, 10, "property"},  EditorKind{"strategy", 12, 3, "function"},
    EditorKind{"level", 3, 9, "namespace"},       EditorKind{"set", 10, 13, "enum"},           EditorKind{"relation", 23, 22, "struct"},
    EditorKind{"map", 5, 7, "class"},             EditorKind{"rule", 12, 3, "method"},         EditorKind{"prototype", 26, 25, "type"},
    EditorKind{"table", 12, 3, "function"},
    EditorKind{"sensor", 8, 5, "parameter"},      EditorKind{"fuzzy", 5, 7, "class"},          EditorKind{"control", 6, 2, "method"},
    EditorKind{"member", 22, 20, "enumMember"},   EditorKind{"field", 8, 5, "property"},       EditorKind{"variable", 13, 6, "parameter"},
    EditorKind{"input", 8, 5, "parameter"},       EditorKind{"output", 8, 5, "parameter"},     EditorKind{"term", 22, 20, "enumMember"},
    EditorKind{"controller", 12, 3, "method"},    EditorKind{"argument", 8, 5, "parameter"},
    EditorKind{"Landmark", 22, 20, "enumMember"}, EditorKind{"Command", 24, 23, "event"},      EditorKind{"Route", 19, 21, "event"},
};
/// A row of any other relation.
inline constexpr EditorKind kRowKind{"", 19, 21, "enumMember"};

[[nodiscard]] constexpr const EditorKind& editor_kind(std::string_view kind) {
  const auto* const at = std::ranges::find(kEditorKinds, kind, &EditorKind::kind);
  return at == kEditorKinds.end() ? kRowKind : *at;
}

}  // namespace kb::lsp
