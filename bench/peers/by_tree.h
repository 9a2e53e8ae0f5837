// Route1 as a behaviour tree: nested conditions and actions over the same state as the switch, a subtree a concern.
#pragma once

#include "bench/peers/behavior_tree.h"
#include "bench/peers/robot.h"

namespace peers {

class TreeMind {
 public:
  TreeMind();
  void give(Fact fact, float value) { r_.set(fact, value); }
  /// The strategy that drives, or kNoStrategy.
  Strategy tick(std::uint32_t dt_us) {
    if (!r_.first) r_.now_us += dt_us;
    (void)root_->tick();
    r_.first = false;
    return r_.ran = next_;
  }

 private:
  tree::NodePtr goal();
  tree::NodePtr route();
  tree::NodePtr map();
  tree::NodePtr turn();
  tree::NodePtr passage();
  tree::NodePtr drive();
  tree::NodePtr method(unsigned k);
  tree::NodePtr trouble();
  tree::NodePtr strategy();
  tree::NodePtr run(Strategy strategy, bool (*wanted)(const Mission&));
  void look_at_clocks();
  void note_road();

  Robot r_;
  Strategy next_ = kNoStrategy;
  bool obeyed_ = false;

  // What the drive's conditions read as it was when the tick came to them.
  struct Clocks {
    bool apart[kLegs], patient, no_track[3], on_track[3], clear_track[3], clear, clear_long, off_line;
    bool unread, searches, refused, stuck, avoids, crossing;
  } c_{};
  Mission before_;
  tree::NodePtr root_;
};

}  // namespace peers
