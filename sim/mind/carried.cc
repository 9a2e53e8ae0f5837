// Notices that the robot was carried, or may have been: then it no longer knows its place.
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/mind/perception.h"
#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr float kCompassAgrees = 0.6f;       // rad, with the wheels: a greater difference is no error of the two
constexpr float kDrives = 0.15f;             // m/s: a slower robot may still be turning into its road
constexpr float kOffsetTau = 2.0f, kDisagrees = 0.2f, kSaysCarried = 0.5f;   // s
constexpr float kRests = 2.0f;               // s: nobody carries the robot elsewhere in less

}  // namespace

// note [carried]
// If the robot is lifted and set down the other way round, its compass turns but its wheels do not. If it is set down on a road that runs in
// the direction of its own, it notices where that road bends otherwise. Then nothing that the memory told of its road is true any more: all
// that it knows is the heading in which it was set down, and that this heading is along a road.
void Perception::hear_carried(float dt_s) {
  carried_s_ = std::max(carried_s_ - dt_s, 0.0f);
  if (cells_->carried == kNoFact || !senses_.heading_known || !senses_.turned_known) return;
  if (!std::exchange(offset_known_, true)) offset_rad_ = senses_.heading_rad - senses_.turned_rad;   // from the first moment at which both are known
  const auto off_rad = static_cast<float>(wrap(static_cast<double>(senses_.heading_rad - senses_.turned_rad - offset_rad_)));
  const bool follows = doing_ != nullptr && doing_->doing == Doing::kMove && phase_ != Phase::kInside;
  const bool drives = follows && !in_hall() && senses_.odometry_known && senses_.speed_m_s > kDrives;
  const bool elsewhere = std::abs(off_rad) > kCompassAgrees || (drives && road_.progress(reckoning_.at).turned_rad > kAcross);
  if (elsewhere && disagree_s_ <= 0.0f) set_down_rad_ = senses_.heading_rad;
  disagree_s_ = elsewhere ? disagree_s_ + dt_s : 0.0f;
  if (!elsewhere) offset_rad_ += off_rad * (dt_s / (kOffsetTau + dt_s));   // follows slowly: odometry drifts
  if (disagree_s_ < kDisagrees) return;
  forget_place();
  memory_ = nullptr;
  phase_ = Phase::kOnRoad;
  carried_s_ = kSaysCarried;
  set_down_ = anew_ = true;
}

/// Forgets the road and all that the robot did on it.
void Perception::forget_place() {
  offset_known_ = false;
  reckoning_.start(senses_, reckoning_.at);
  last_heading_rad_ = reckoning_.at.heading_rad;
  road_.forget();
  rounding_ = guided_ = out_awaited_ = crosses_ = met_line_ = begins_on_road_ = false;
  disagree_s_ = 0.0f;
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
// carried unless its host says so (mode MANUAL): it keeps its place on its road, or in its crossing, until the next order.

// note [an order begins at the line]
// A robot that brakes at a stop line comes to rest with the line just behind its sensors. If its order ends there, the next one begins
// there, and the mind, which remembers nothing of the order before, must be told of the line: else it would drive across as on a road. And
// if an order ends just out of a crossing, the line out may lie under its sensors: that is no line to stop at.
void Perception::rest(bool rests, float dt_s) {
  rest_s_ = rests ? rest_s_ + dt_s : 0.0f;
  waits_at_line_ = keeps_place_ && met_line_ && (rests || waits_at_line_);
  begins_on_road_ = keeps_place_ && (rests || begins_on_road_);
  if (rest_s_ < kRests || (keeps_place_ && (in_crossing() || on_road() || met_line_))) return;
  forget_place();
  pushed_ = strayed_ = set_down_ = anew_ = false;
  beside_m_ = without_line_m_ = carried_s_ = held_s_ = 0.0f;
  out_told_ = true;
  exit_ = kNoExit;
  drove_ = nullptr;
  const bool reads = unread_s_ < kReadingLasts && phase_ != Phase::kInside;
  if (reads) return;
  memory_ = nullptr;
  phase_ = Phase::kOnRoad;
}

}  // namespace kb::sim
