// Which tracks can be followed where the robot is: line, walls, compass.
#include <cmath>

#include <waymark/controllers/line_sight.h>
#include <waymark/controllers/road_sight.h>
#include "sim/mind/perception.h"
#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr float kAlong = 0.7f;                // rad: a robot that goes round an obstacle and is turned farther than this is not yet coming back to the road
constexpr float kClear = 4.0f;                // s
constexpr float kComesBack = 0.8f;            // m

}  // namespace

// note [no compass on an untold road]
// A compass says where east is, not where the road lies. It can lead the robot along a road that the memory told of, as far as that road
// reaches; in the direction in which a robot that was carried has been set down; and, as long as there was nothing else to follow, in the
// direction in which it was put at the start. A robot that loses line or walls on a road of which no memory told has driven off it: straight
// on would lead anywhere.
bool Perception::compass_leads() const {
  const bool tells = senses_.heading_known && senses_.odometry_known;
  return tells && !road_.given_up() && (road_.known() || set_down_ || !guided_);
}

// note [pushed aside]
// A robot that was touched may stand beside its road, and its wheels do not notice; one that went round something may come back a little
// beside it. If the line is gone then, the robot looks for it to both sides while it goes on by compass, and begins anew where it has
// crossed it.
void Perception::hear_pushed() {
  const bool moves = doing_ != nullptr && doing_->doing == Doing::kMove;
  const bool on_line = moves && doing_->method == road_.method() && mts::look_at_line(senses_, body_).seen;
  const bool beside = road_.known() && phase_ != Phase::kInside && !on_line;
  pushed_ = (pushed_ || senses_.touched) && beside;
  strayed_ = (strayed_ || (rounding_ && avoids_line_)) && beside;
  const bool found = (rounding_ || pushed_ || strayed_) && road_.cross_line(senses_, reckoning_.at, body_, pushed_);
  if (found && moves && doing_->method == "azimuth") {
    pushed_ = strayed_ = false;
    anew_ = true;
  }
}

/// A road may have more pieces than a task has room for.
void Perception::hear_told() {
  const bool follows = doing_ != nullptr && doing_->doing == Doing::kMove && phase_ == Phase::kOnRoad;
  if (!follows || road_.pieces() <= told_to_ || road_.pieces() <= mts::kLongestCourse) return;
  const std::size_t piece = road_.progress(reckoning_.at).piece;
  if (piece < told_to_) return;
  anew_ = true;
  told_to_ = piece + mts::kLongestCourse - 2;
}

void Perception::write_tracks(std::span<float> facts) const {
  const bool on_road = phase_ == Phase::kOnRoad || (rounding_ && phase_ != Phase::kInside);
  const Progress here = phase_ != Phase::kInside ? road_.progress(reckoning_.at) : Progress{}, now = on_road ? here : Progress{};
  const bool rounds = rounding_ && clear_s_ < kClear;   // the obstacle may still be between it and the road
  const bool comes_back = (strayed_ || pushed_) && clear_s_ >= kClear;   // see note [pushed aside]
  const bool beside = now.aside_m > (rounds ? kAside : comes_back ? kComesBack : kRoadOff), avoiding = doing_ != nullptr && doing_->doing == Doing::kAvoid;
  // A robot that, going round something, has driven past the stop line beside it is in a crossing that it may not enter: what it sees there
  // is not its road.
  const bool enters = phase_ != Phase::kInside && (rounding_ || beside_m_ > 0.0f) && road_.passed(reckoning_.at);
  // A robot that goes round something and faces along the piece before a bend may be crossing the piece behind it, so the nearest piece
  // counts.
  const auto middle = avoiding && on_road && road_.method() != "dist" ? road_.middle(reckoning_.at) : std::nullopt;
  const float turned_rad = middle ? static_cast<float>(std::abs(wrap(static_cast<double>(reckoning_.at.heading_rad - middle->heading_rad)))) : now.turned_rad;
  for (const NamedFact& track : cells_->track) {
    const bool paved = track.name == "mark" || track.name == "dist" || track.name == "azimuth";
    if (!paved || in_hall()) {
      const bool sensed = senses_.odometry_known && senses_.range_known;
      const bool crosses = in_hall() && road_.method() == track.name;
      put(facts, track.fact, !crosses ? -kSure : sensed ? kSure : 0.0f);
    } else if (enters || turned_rad > (avoiding ? kAlong : kAcross)) {   // nothing that it sees now is its road
      put(facts, track.fact, -kSure);
    } else if (track.name == "mark") {
      bool dark = false;
      for (const float darkness : senses_.line) dark = dark || darkness > mts::StopLine::kDarkFrom;
      put(facts, track.fact, !senses_.line_known ? 0.0f : dark ? kSure : -kSure);
    } else if (track.name == "dist") {
      put(facts, track.fact, mts::walls_beside(senses_, here.to_bend_m < mts::kBendNear_m));
    } else {
      put(facts, track.fact, compass_leads() && !beside ? kSure : -kSure);
    }
  }
}

}  // namespace kb::sim
