// Notices that the robot was carried, or may have been: then it no longer knows its place.
#include <algorithm>
#include <cmath>

#include "sim/mind/perception.h"
#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr float kSaysCarried = 0.5f;         // s
constexpr float kRests = 2.0f;               // s: nobody carries the robot elsewhere in less

}  // namespace

// note [carried]
// If the robot is lifted and set down the other way round, its compass turns but its wheels do not. If it is set down on a road that runs in
// the direction of its own, it notices where that road bends otherwise. Then nothing that the memory told of its road is true any more: all
// that it knows is the heading in which it was set down, and that this heading is along a road.
void Perception::hear_carried(float dt_s) {
  carried_s_ = std::max(carried_s_ - dt_s, 0.0f);
  if (cells_->carried == kNoFact) return;
  const bool follows = doing_ != nullptr && doing_->doing == Doing::kMove && phase_ != Phase::kInside;
  const bool drives = follows && !in_hall() && senses_.odometry_known && senses_.speed_m_s > mts::Lifted::kDrives_m_s;
  lifted_.step(senses_, drives && road_.progress(reckoning_.at).turned_rad > kAcross, dt_s);
  if (!lifted_.now()) return;
  forget_place();
  memory_ = nullptr;
  phase_ = Phase::kOnRoad;
  carried_s_ = kSaysCarried;
  set_down_ = anew_ = true;
}

/// Forgets the road and all that the robot did on it.
void Perception::forget_place() {
  lifted_.forget();
  reckoning_.start(senses_, reckoning_.at);
  last_heading_rad_ = reckoning_.at.heading_rad;
  road_.forget();
  rounding_ = guided_ = out_awaited_ = crosses_ = met_line_ = begins_on_road_ = false;
}

void Perception::put(std::shared_ptr<const Memory> memory, std::uint32_t exit, double along_m) {
  forget_place();
  memory_ = nullptr;
  phase_ = Phase::kOnRoad;
  set_down_ = guided_ = false;
  const Memory::Exit& by = memory->exits[exit];
  road_.enter(std::move(memory), exit, reckoning_.at, point_on(by.course, along_m - by.stop_m).at);
}

// note [at rest]
// Between two missions somebody may carry the robot to where the next one is to begin, and its wheels do not notice. So after two seconds
// of rest it knows only what it senses, as after start-up: the sign that it reads now, but no road. A vehicle that takes orders is not
// carried unless its host says so (mode MANUAL): it keeps its place on its road, or in its crossing, until the next order: see note
// [an order begins at the line].
void Perception::rest(bool rests, float dt_s) {
  rest_s_ = rests ? rest_s_ + dt_s : 0.0f;
  waits_at_line_ = keeps_place_ && met_line_ && (rests || waits_at_line_);
  begins_on_road_ = keeps_place_ && (rests || begins_on_road_);
  if (rest_s_ < kRests || (keeps_place_ && (in_crossing() || on_road() || met_line_))) return;
  forget_place();
  pushed_ = strayed_ = set_down_ = anew_ = false;
  beside_m_ = without_line_m_ = carried_s_ = 0.0f;
  obstacle_sight_.rest();
  out_told_ = true;
  exit_ = kNoExit;
  drove_ = nullptr;
  const bool reads = unread_s_ < kReadingLasts && phase_ != Phase::kInside;
  if (reads) return;
  memory_ = nullptr;
  phase_ = Phase::kOnRoad;
}

}  // namespace kb::sim
