#include <cstdint>
#include <utility>
#include <vector>

#include "compiler/syntax/parser.h"
#include "compiler/syntax/syntax.h"
#include "compiler/syntax/token_stream.h"
#include "compiler/syntax/tree_builder.h"

namespace kb::syntax {

Tree parse(const source::Sources& sources, source::FileId file, diagnostics::Diagnostics& diagnostics) {
  Prepared prepared = prepare(sources, scan(sources, file, Comments::kDrop));
  std::vector<std::uint32_t> begins;
  for (const Token& token : prepared.tokens) {
    if (token.begins_statement) begins.push_back(token.span.begin);
  }
  diagnostics.know_statements(file, begins);
  TokenStream stream(sources, std::move(prepared), diagnostics);
  TreeBuilder builder(sources, file, diagnostics);
  generated::Parser parser(stream, builder);
  parser.parse();
  return builder.take();
}

}  // namespace kb::syntax
