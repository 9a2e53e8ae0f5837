// Notices when a sense sees nothing, or nothing new.
#include <algorithm>
#include <cmath>

#include "sim/mind/perception.h"

namespace kb::sim {
namespace {

constexpr float kSignToLine = 0.7f;          // m: a sign is read 45 cm before its stop line at the most
constexpr std::array<std::size_t, 3> kFront{0, 1, 7};   // range finders that see what the robot drives into

}  // namespace

/// A sensor that is stuck counts as silent; so does a range finder that gives no number. Without the range finders in front the robot drives
/// blind.
void Perception::hear_blindness(float dt_s, bool measured) {
  const float turned_m = senses_.turned_known ? body_.line_ahead_m * std::abs(mts::wrapped_angle(senses_.turned_rad - turned_rad_)) : 0.0f;
  const float way_m = turned_m + (senses_.odometry_known ? std::abs(senses_.speed_m_s) * dt_s : 0.0f);
  turned_rad_ = senses_.turned_rad;
  front_unknown_ = std::any_of(kFront.begin(), kFront.end(), [&](std::size_t i) { return std::isnan(senses_.range_m[i]) || (senses_.ranges_unknown >> i & 1u) != 0; });
  const bool any_near = std::any_of(std::begin(senses_.range_m), std::end(senses_.range_m), [](float range_m) { return range_m < mts::kOutOfRange; });
  line_sight_.step(senses_.line_known, senses_.line, !measured, way_m, dt_s);
  range_sight_.step(senses_.range_known, senses_.range_m, any_near, way_m, dt_s);
  senses_.line_known = line_sight_.sees();
  senses_.range_known = range_sight_.sees();
  for (float& range_m : senses_.range_m) range_m = std::isnan(range_m) ? mts::kOutOfRange : std::min(range_m, mts::kOutOfRange);
}

/// Measures how far the robot has driven past a sign without meeting the stop line that follows soon. If the line does not come, it is worn
/// off, or the line sensors do not see it.
void Perception::hear_way_without_line(float way_m) {
  const bool comes_to_it = phase_ == Phase::kApproach && doing_ != nullptr && doing_->doing == Doing::kMove && !in_hall();
  if (line_.now() || phase_ != Phase::kApproach) without_line_m_ = 0.0f;
  else if (comes_to_it) without_line_m_ += way_m;
}

bool Perception::line_missed() const { return without_line_m_ > kSignToLine; }

}  // namespace kb::sim
