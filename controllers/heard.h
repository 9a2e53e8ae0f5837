// What every controller does with its senses first, and with its answer last: nothing that is not a number gets in or out, and
// nothing drives into what the range finder ahead sees, nor where none looks.
#pragma once

#include "angles.h"
#include "body.h"

namespace mts {

/// Whether a robot can have measured that, in whatever unit: no NaN, no infinity, and nothing so large that sums of it over a
/// drive, or their squares, would become one.
[[nodiscard]] constexpr bool can_be_measured(float x) noexcept { return is_finite(x) && magnitude(x) <= 1e6f; }

/// Whether that range finder says something. The senses have been `heard`.
[[nodiscard]] constexpr bool knows_range(const Senses& senses, std::size_t i) noexcept {
  return senses.range_known && (senses.ranges_unknown >> i & 1u) == 0;
}

/// The senses with numbers only. A group that holds something else is marked as silent, but of the range finders each speaks for
/// itself: one that says nothing has its bit in `ranges_unknown` and `kOutOfRange`, so that nobody sees a thing there; where all
/// say nothing the group is silent. Once heard, senses stay as they are when they are heard again. Cost: 19 looks at bits.
[[nodiscard]] constexpr Senses heard(Senses senses) noexcept {
  for (const float dark : senses.line) senses.line_known = senses.line_known && can_be_measured(dark);
  constexpr unsigned kNone = (1u << kRangeFinders) - 1u;
  unsigned unknown = senses.ranges_unknown & kNone;
  for (std::size_t i = 0; i < kRangeFinders; ++i) {
    float& range = senses.range_m[i];
    if (is_nan(range) || (range < 0.0f && is_finite(range))) unknown |= 1u << i;
    if ((unknown >> i & 1u) != 0 || range > kOutOfRange) range = kOutOfRange;
    range = greatest(range, 0.0f);
  }
  if (!(senses.met_m < kOutOfRange)) senses.met_m = kOutOfRange;
  senses.ranges_unknown = static_cast<std::uint8_t>(unknown);
  senses.range_known = senses.range_known && unknown != kNone;
  senses.heading_known = senses.heading_known && can_be_measured(senses.heading_rad);
  senses.turned_known = senses.turned_known && can_be_measured(senses.turned_rad);
  senses.odometry_known = senses.odometry_known && can_be_measured(senses.speed_m_s);
  return senses;
}

/// The same, with what is too old for that body marked as silent.
[[nodiscard]] constexpr Senses heard(const Senses& raw, const Body& body) noexcept {
  Senses senses = heard(raw);
  const auto fresh = [&](float age_s) { return age_s >= 0.0f && age_s <= body.longest_silence_s; };
  senses.line_known = senses.line_known && fresh(senses.age.line_s);
  senses.range_known = senses.range_known && fresh(senses.age.range_s);
  senses.heading_known = senses.heading_known && fresh(senses.age.heading_s);
  senses.turned_known = senses.turned_known && fresh(senses.age.odometry_s);
  senses.odometry_known = senses.odometry_known && fresh(senses.age.odometry_s);
  return senses;
}

/// The fastest from which the body stops within `room_m`, if it heard of that room `tau` ago and has been braking since:
///   v tau + a tau^2 / 2      the way since then
///   v^2 / (2 a)              the way to a halt
///   (v + a tau)^2 = 2 a room,  v = sqrt(2 a room) - a tau
/// a is half of `Body::top_acceleration_m_s2`, as the other half may be wanted for a turn; tau is `Body::range_latency_s`, or the age
/// of the ranges if that is more. 0 if there is no room; it stands a tau^2 / 2 before that (3 mm with the defaults).
/// (Without the term a tau^2 / 2 it came 5 cm too far at 0.3 s.)
[[nodiscard]] constexpr float fastest_that_stops(float room_m, const Body& body, float age_s = 0.0f) noexcept {
  if (!(room_m > 0.0f)) return 0.0f;
  const float a = 0.5f * body.top_acceleration_m_s2, tau = greatest(body.range_latency_s, age_s);
  const float fastest = square_root(2.0f * a * room_m) - a * tau;
  return fastest > 0.0f ? fastest : 0.0f;   // also of a body that is not a number
}

namespace detail {

/// How fast it may go where three range finders look, the one in the middle of them that way: so that it stops `margin_m` before
/// what that one sees, and no faster than a crawl if one of them says nothing.
[[nodiscard]] constexpr float free_speed(const Senses& senses, std::size_t middle, const Body& body, float margin_m) noexcept {
  if (!senses.range_known) return body.top_speed_m_s;   // it has none
  const bool all = knows_range(senses, middle) && knows_range(senses, middle + 1) && knows_range(senses, (middle + 7) % kRangeFinders);
  const float stops = fastest_that_stops(senses.range_m[middle] - body.radius_m - margin_m, body, senses.age.range_s);
  return least(stops, all ? body.top_speed_m_s : least(body.crawl_m_s, body.top_speed_m_s));
}

}  // namespace detail

/// The motion, slowed so that it can stop `margin_m` before what the range finder ahead sees (backwards: the one behind), and before
/// the lane of who comes from the side (`Senses::met_m`), at most the body's top speed. The turn keeps its rate. The senses have been `heard`.
///
///   the bumper is pressed                      nothing ahead; on the spot, and backwards, as asked for
///   no range finder says anything              it stands, but for turns on the spot; a body that has none drives
///   the one ahead, or one beside it, is unknown   at most `Body::crawl_m_s`; backwards those behind
///
/// What a range finder at 45 degrees sees may lie 12 degrees farther to its side (the finders are that broad), r sin(57 degrees)
/// aside. Where that is hardly more than the radius, the robot bears away from it (between two such things it goes straight on), and
/// it does not turn towards what is so near abeam; where straight on would meet it, it turns away on the spot, or stands.
[[nodiscard]] constexpr Motion braked(Motion motion, const Senses& senses, const Body& body, float margin_m = 0.06f) noexcept {
  constexpr float kSine57 = 0.838670568f, kAway_rad_s = 1.0f, kMeets_m = 0.01f, kNear_m = 0.03f, kAbeam_m = 0.03f, kBears_1_s_m = 50.0f, kBears_rad_s = 2.0f;
  if (motion.speed_m_s != motion.speed_m_s || motion.turn_rad_s != motion.turn_rad_s) return {};   // of a task that is not a number
  if (!(motion.speed_m_s > 0.0f) && !(motion.speed_m_s < 0.0f)) return motion;
  if (body.has_range_finders && !senses.range_known) return {};
  if (motion.speed_m_s < 0.0f) return {greatest(motion.speed_m_s, -detail::free_speed(senses, kRangeFinders / 2, body, margin_m)), motion.turn_rad_s};
  if (senses.touched) return {0.0f, motion.turn_rad_s};
  motion.speed_m_s = least(motion.speed_m_s, detail::free_speed(senses, 0, body, margin_m));
  if (senses.met_m < kOutOfRange) motion.speed_m_s = least(motion.speed_m_s, fastest_that_stops(senses.met_m - body.radius_m - margin_m, body, senses.age.range_s));
  if (!senses.range_known || !(motion.speed_m_s > 0.0f)) return motion;
  const auto aside = [&](std::size_t eighths) { return senses.range_m[eighths] * kSine57 - body.radius_m; };
  const float left = aside(1), right = aside(7);
  const bool left_near = left < kNear_m || senses.range_m[2] < body.radius_m + kAbeam_m;
  const bool right_near = right < kNear_m || senses.range_m[6] < body.radius_m + kAbeam_m;
  const float bears = clamped(kBears_1_s_m * (greatest(kNear_m - right, 0.0f) - greatest(kNear_m - left, 0.0f)), -kBears_rad_s, kBears_rad_s);   // to the left
  if (left_near) motion.turn_rad_s = least(motion.turn_rad_s, 0.0f);
  if (right_near) motion.turn_rad_s = greatest(motion.turn_rad_s, 0.0f);
  if (left_near != right_near) motion.turn_rad_s = right_near ? greatest(motion.turn_rad_s, bears) : least(motion.turn_rad_s, bears);
  if (left >= kMeets_m && right >= kMeets_m) return motion;
  if (left < kMeets_m && right < kMeets_m) return {};
  return {0.0f, left < kMeets_m ? least(motion.turn_rad_s, -kAway_rad_s) : greatest(motion.turn_rad_s, kAway_rad_s)};
}

}  // namespace mts
