// Perception of the model, in the program's cells. Private to this folder.
#pragma once

#include <vector>

#include "compiler/program/program.h"

namespace kb::program {

/// `cell_of`: by cell of the model, the program's cell.
[[nodiscard]] Perception lower_perception(const model::Model& model, const std::vector<CellId>& cell_of);

}  // namespace kb::program
