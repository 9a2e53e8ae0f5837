#include <fmt/format.h>

#include <iterator>

#include "compiler/syntax/syntax.h"
#include "compiler/syntax/words.h"

namespace kb::syntax {
std::string print_tokens(const source::Sources& sources, const std::vector<Token>& tokens) {
  std::string out;
  for (const Token& token : tokens) {
    const source::Location at = sources.locate(token.span.file, token.span.begin);
    const std::string_view name = is_keyword(token.kind) ? "Word" : kind_name(token.kind);
    const std::string_view text = sources.text(token.span);
    fmt::format_to(std::back_inserter(out), "{}:{} {}{}{}\n", at.line, at.column, name, text.empty() ? "" : " ", text);
  }
  return out;
}

}  // namespace kb::syntax
