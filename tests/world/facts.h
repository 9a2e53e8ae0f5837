// Sensors -> facts: which cell of a knowledge base holds which reading.
#pragma once

#include <span>
#include <vector>

#include "tests/world/knowledge.h"
#include "tests/world/sense.h"

namespace kb::world {

/// Made once for a knowledge base and a map. Readings that the knowledge base has no fact for are dropped.
class FactMap {
 public:
  FactMap(const Knowledge& knowledge, const Map& map);
  /// The facts of one tick by cell index; valid until the next call.
  [[nodiscard]] std::span<const float> facts(const Readings& now);

 private:
  const Knowledge& knowledge_;
  std::vector<program::CellId> cells_;  // in the order of Readings::each
  std::vector<float> values_;
};

}  // namespace kb::world
