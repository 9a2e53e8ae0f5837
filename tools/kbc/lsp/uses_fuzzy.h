// What the names within a fuzzy block stand for.
#pragma once

#include <vector>

#include "compiler/syntax/tree.h"
#include "tools/kbc/lsp/uses.h"

namespace kb::lsp {

/// Adds inputs, outputs and their terms wherever they stand in the block. `number`: the number of the block in the knowledge base.
void add_uses(const syntax::Fuzzy& fuzzy, std::uint32_t number, std::vector<Use>& to);

}  // namespace kb::lsp
