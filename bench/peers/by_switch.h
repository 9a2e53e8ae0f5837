// Route1 as a firmware engineer writes it by hand: a state machine of a few enumerations, a function a concern.
#pragma once

#include "bench/peers/robot.h"

namespace peers {

class SwitchMind {
 public:
  void give(Fact fact, float value) { r_.set(fact, value); }
  /// The strategy that drives, or kNoStrategy.
  Strategy tick(std::uint32_t dt_us);

 private:
  bool goal();
  void route();
  void map();
  void turn();
  void passage();
  void drive();
  void road(bool wanting, bool any_cross);
  void trouble();
  [[nodiscard]] Strategy strategy() const;

  Robot r_;
};

}  // namespace peers
