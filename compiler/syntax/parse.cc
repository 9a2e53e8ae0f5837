#include <utility>

#include "compiler/syntax/parser.h"
#include "compiler/syntax/syntax.h"
#include "compiler/syntax/token_stream.h"
#include "compiler/syntax/tree_builder.h"

namespace kb::syntax {

Tree parse(const source::Sources& sources, source::FileId file, diagnostics::Diagnostics& diagnostics) {
  TokenStream stream(sources, prepare(sources, scan(sources, file, Comments::kDrop)), diagnostics);
  TreeBuilder builder(sources, file, diagnostics);
  generated::Parser parser(stream, builder);
  parser.parse();
  return builder.take();
}

}  // namespace kb::syntax
