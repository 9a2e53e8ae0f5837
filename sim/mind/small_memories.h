// What tags say to a robot of another size, in the measure of the one that perception and controllers know: see similarity.h.
#pragma once

#include <map>
#include <memory>

#include "sim/robot/sensors.h"
#include "sim/world/floor.h"

namespace kb::sim {

class SmallMemories {
 public:
  /// Lengths are divided by `size`. With 1 what is heard is passed on.
  explicit SmallMemories(double size) : size_(size) {}

  /// What was read once is the same memory, and the same hall, when it is read again. Valid until the next call, and as long as `tag` is.
  [[nodiscard]] const TagHeard& of(const TagHeard& tag);

 private:
  [[nodiscard]] std::shared_ptr<const Memory> smaller(const Memory& memory);
  [[nodiscard]] std::shared_ptr<const HallMap> smaller(const std::shared_ptr<const HallMap>& hall);

  double size_;
  TagHeard heard_;
  std::shared_ptr<const Memory> read_, small_;   // the last one
  std::map<std::shared_ptr<const HallMap>, std::shared_ptr<const HallMap>> halls_;   // all that were read, and theirs
};

}  // namespace kb::sim
