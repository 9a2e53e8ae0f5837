// What the standard library promises of its satellites after every tick.
#pragma once

#include <string>
#include <vector>

#include "tests/world/mind.h"

namespace kb::world {

class Promises {
 public:
  explicit Promises(const Knowledge& knowledge);
  /// The first promise that the mind's satellites break; empty if none.
  [[nodiscard]] std::string broken(const Mind& mind) const;
  /// Whether a mission is in hand.
  [[nodiscard]] bool on_a_mission(const Mind& mind) const { return any(mind, routes_); }

 private:
  using Cells = std::vector<program::CellId>;
  [[nodiscard]] bool high(const Mind& mind, program::CellId cell) const { return mind.value(cell) >= firing_; }
  [[nodiscard]] bool any(const Mind& mind, const Cells& cells) const;

  float firing_;
  program::CellId line_in_, line_out_, arrived_, driving_;
  Cells plans_at_landmark_, road_methods_, routes_, legs_;
};

}  // namespace kb::world
