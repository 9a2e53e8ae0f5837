// When a robot has lost the line of its road sidewards, and looks for it.
//
// note [beside its line]
// A robot that was touched may stand beside its road, and its wheels do not notice; one that went round something may come back a little
// beside it. If the line is gone then, the robot looks for it to both sides while it goes on by compass, and begins anew where it has
// crossed it.
#pragma once

#include "on_road.h"
#include "registry.h"

namespace mts {

class LineSeeker {
 public:
  /// A controller begins to drive.
  constexpr void begin(ControllerId id) noexcept {
    const bool rounds = id == ControllerId::kRoundObstacle, stands = id == ControllerId::kStand || id == ControllerId::kTurnRound || id == ControllerId::kLookRound;
    if (rounds && !rounds_) {
      rounds_ = true;
      left_line_ = drove_ == ControllerId::kFollowLine;
    }
    if (rounds || stands) return;
    rounds_ = false;
    drove_ = id;
  }
  /// One control period. `moves`: `id` follows a road. The senses must have been `heard`, of size 1. True if the robot has crossed the line that it
  /// seeks, and `place` has learnt where it is: then the controller must begin anew.
  constexpr bool step(const Senses& senses, OnRoad& place, ControllerId id, bool moves, bool crosses) noexcept {
    const bool by_line = moves && id == ControllerId::kFollowLine && place.driven_by("mark");
    const bool beside = place.road() != nullptr && !crosses && !(by_line && place.sees_line(senses));
    pushed_ = (pushed_ || senses.touched) && beside;
    strayed_ = (strayed_ || (rounds_ && left_line_)) && beside;
    const bool found = (rounds_ || pushed_ || strayed_) && place.cross_line(senses, pushed_) && moves && id == ControllerId::kHoldHeading;
    if (found) pushed_ = strayed_ = false;
    return found;
  }
  constexpr void forget() noexcept { pushed_ = strayed_ = rounds_ = left_line_ = false; }

  /// Whether the line is somewhere beside the robot.
  [[nodiscard]] constexpr bool gone() const noexcept { return pushed_ || strayed_; }
  /// Whether to look for it to both sides. A robot that strayed knows how far along its road it is, and so whether there is room for that; one
  /// that was pushed does not.
  [[nodiscard]] constexpr bool seeks(const OnRoad& place) const noexcept { return place.driven_by("mark") && (pushed_ || (strayed_ && place.has_room_to_seek())); }

 private:
  ControllerId drove_ = ControllerId::kStand;      // the last controller that followed a road or crossed
  bool rounds_ = false, left_line_ = false;        // it goes round something, and has not driven on since; its road had a line when it began to
  bool pushed_ = false, strayed_ = false;
};

}  // namespace mts
