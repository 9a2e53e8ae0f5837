// How a text is coloured.
#include <algorithm>
#include <array>

#include "compiler/syntax/syntax.h"
#include "tools/kbc/lsp/answers.h"
#include "tools/kbc/lsp/kinds.h"
#include "tools/kbc/lsp/names.h"

namespace kb::lsp {
namespace {

using syntax::Lexeme;

constexpr std::array<std::string_view, 4> kPlainTokens{"keyword", "number", "string", "comment"};
constexpr std::size_t kNoToken = 0xFFFF'FFFFu;

std::size_t plain_token(Lexeme::Class what) {
  switch (what) {
    case Lexeme::Class::kWord: return 0;
    case Lexeme::Class::kNumber: return 1;
    case Lexeme::Class::kString: return 2;
    case Lexeme::Class::kComment: return 3;
    default: return kNoToken;
  }
}

/// Names of classes of text, in the order of their numbers.
const std::vector<std::string_view>& legend() {
  static const std::vector<std::string_view> tokens = [] {
    std::vector<std::string_view> out(kPlainTokens.begin(), kPlainTokens.end());
    for (const EditorKind& kind : kEditorKinds) {
      if (std::ranges::find(out, kind.token) == out.end()) out.push_back(kind.token);
    }
    return out;
  }();
  return tokens;
}

/// The number of the class of a name; that of no class if the name is unknown.
std::size_t token_of(const Knowledge& knowledge, const Use* use) {
  const auto what = use == nullptr ? std::nullopt : symbol(knowledge, *use);
  if (!what) return kNoToken;
  return static_cast<std::size_t>(std::ranges::find(legend(), editor_kind(what->kind).token) - legend().begin());
}

}  // namespace

Json token_legend() { return legend(); }

Json semantic_tokens(const OpenFile& file) {
  Json data = Json::array();
  Position last;
  for (const Lexeme& one : syntax::lexemes(file.sources(), file.id)) {
    const std::size_t token = one.what == Lexeme::Class::kName ? token_of(file.knowledge, file.knowledge.use_at(file.id, one.span.begin)) : plain_token(one.what);
    if (token == kNoToken) continue;
    const Position at = file.knowledge.places.position(file.id, one.span.begin, file.encoding);
    data.insert(data.end(), {at.line - last.line, at.line == last.line ? at.character - last.character : at.character, file.knowledge.places.units(one.span, file.encoding), token, 0});
    last = at;
  }
  return {{"data", data}};
}

}  // namespace kb::lsp
