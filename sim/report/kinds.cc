#include "sim/report/kinds.h"

#include <algorithm>

namespace kb::sim::report {

Kinds strategy_kinds(const MindNames& names) {
  Kinds kinds;
  for (const MindNames::Cell& cell : names.cells) {
    if (cell.kind != MindNames::Cell::Kind::kStrategy) {
      kinds.of_cell.push_back(-1);
      continue;
    }
    const std::string kind = cell.name.substr(0, cell.name.find_first_of(".["));
    const auto found = std::find(kinds.names.begin(), kinds.names.end(), kind);
    kinds.of_cell.push_back(static_cast<std::int32_t>(found - kinds.names.begin()));
    if (found == kinds.names.end()) kinds.names.push_back(kind);
  }
  return kinds;
}

const Look& look_of(std::int32_t kind) { return kind < 0 ? kNoLook : kLooks[static_cast<std::size_t>(kind) % kLooks.size()]; }

}  // namespace kb::sim::report
