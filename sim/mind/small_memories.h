// Scales what tags say to a robot of another size to size 1, which perception and controllers know: see similarity.h.
#pragma once

#include <map>
#include <memory>

#include "sim/robot/sensors.h"
#include "sim/world/floor.h"

namespace kb::sim {

class SmallMemories {
 public:
  /// Lengths are divided by `size`. With 1 everything is passed on unchanged.
  explicit SmallMemories(double size) : size_(size) {}

  /// A tag read again gives the same memory, and the same hall. Valid until the next call, and as long as `tag` is.
  [[nodiscard]] const TagHeard& of(const TagHeard& tag);

 private:
  [[nodiscard]] std::shared_ptr<const Memory> smaller(const Memory& memory);
  [[nodiscard]] std::shared_ptr<const HallMap> smaller(const std::shared_ptr<const HallMap>& hall);

  double size_;
  TagHeard heard_;
  std::shared_ptr<const Memory> read_, small_;   // the last one
  std::map<std::shared_ptr<const HallMap>, std::shared_ptr<const HallMap>> halls_;   // all halls read, with their scaled maps
};

}  // namespace kb::sim
