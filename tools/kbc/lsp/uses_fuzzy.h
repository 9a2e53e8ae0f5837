// What the names within a fuzzy block stand for.
#pragma once

#include <vector>

#include "compiler/syntax/tree.h"
#include "tools/kbc/lsp/uses.h"

namespace kb::lsp {

/// Inputs, outputs and their terms, wherever they stand in the block. `number`: the how manieth of the knowledge base it is.
void add_uses(const syntax::Fuzzy& fuzzy, std::uint32_t number, std::vector<Use>& to);

}  // namespace kb::lsp
