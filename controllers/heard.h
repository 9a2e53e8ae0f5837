// What every controller does first with its senses and last with its answer. No NaN or infinity gets in or out, and no robot drives into
// what the range finder ahead sees, or at speed where no range finder looks.
#pragma once

#include "angles.h"
#include "body.h"

namespace mts {

/// Whether a robot can have measured this number, in whatever unit: not NaN, not infinite, and not so large that its sums over a drive,
/// or their squares, would overflow.
[[nodiscard]] constexpr bool can_be_measured(float x) noexcept { return is_finite(x) && magnitude(x) <= 1e6f; }

/// Whether this range finder has a reading. The senses must have been `heard`.
[[nodiscard]] constexpr bool knows_range(const Senses& senses, std::size_t i) noexcept {
  return senses.range_known && (senses.ranges_unknown >> i & 1u) == 0;
}

/// The senses with valid numbers only. A group with an invalid number is marked as silent. Range finders are judged one by one: a silent
/// one gets its bit in `ranges_unknown` and the value `kOutOfRange`, so that no obstacle is seen there; if all are silent, so is the group.
/// Hearing senses twice changes nothing more. Cost: 19 bit tests.
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

/// The same; groups that are too old for this body are marked as silent too.
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

/// The highest speed from which the body stops within `room_m`, if it measured that room `tau` ago and has been braking since:
///   v tau + a tau^2 / 2      the distance driven since then
///   v^2 / (2 a)              the distance to a halt
///   (v + a tau)^2 = 2 a room,  v = sqrt(2 a room) - a tau
/// a is half of `Body::top_acceleration_m_s2`, since a turn may need the other half; tau is `Body::range_latency_s`, or the age of the
/// ranges if that is more. 0 if there is no room; the robot stands a tau^2 / 2 before that (3 mm with the defaults). Without the term
/// a tau^2 / 2 it came 5 cm too far at tau = 0.3 s.
[[nodiscard]] constexpr float fastest_that_stops(float room_m, const Body& body, float age_s = 0.0f) noexcept {
  if (!(room_m > 0.0f)) return 0.0f;
  const float a = 0.5f * body.top_acceleration_m_s2, tau = greatest(body.range_latency_s, age_s);
  const float fastest = square_root(2.0f * a * room_m) - a * tau;
  return fastest > 0.0f ? fastest : 0.0f;   // 0 also if the body holds a NaN
}

/// From the robot's edge: it does not turn towards a thing abeam that is nearer than this.
inline constexpr float kNearestBeside_m = 0.03f;

namespace detail {

/// The highest speed towards where the middle one of three neighbouring range finders looks: slow enough to stop `margin_m` before what
/// it sees, and no faster than a crawl if one of the three is silent.
[[nodiscard]] constexpr float free_speed(const Senses& senses, std::size_t middle, const Body& body, float margin_m) noexcept {
  if (!senses.range_known) return body.top_speed_m_s;   // the body has no range finders
  const bool all = knows_range(senses, middle) && knows_range(senses, middle + 1) && knows_range(senses, (middle + 7) % kRangeFinders);
  const float stops = fastest_that_stops(senses.range_m[middle] - body.radius_m - margin_m, body, senses.age.range_s);
  return least(stops, all ? body.top_speed_m_s : least(body.crawl_m_s, body.top_speed_m_s));
}

}  // namespace detail

/// The motion, slowed so that the robot can stop `margin_m` before what the range finder ahead sees (backwards: the one behind), and
/// before the lane of somebody who comes from the side (`Senses::met_m`). At most the body's top speed. The turning rate stays, except as
/// said below. The robot stands if one of the two numbers is NaN or infinite. The senses must have been `heard`.
///
///   the bumper is pressed                      no driving ahead; turns on the spot and driving backwards as asked for
///   all range finders are silent               it stands, except for turns on the spot; a body without range finders drives
///   the one ahead, or one beside it, is silent    at most `Body::crawl_m_s`; backwards likewise for those behind
///
/// A thing seen by a range finder at 45 degrees may lie 12 degrees farther to the side (the finders are that broad), at r sin(57 degrees)
/// from the robot's axis. If that is hardly more than the radius, the robot bears away from it; between two such things it goes straight
/// on. It does not turn towards a thing as near abeam. If it would hit the thing by going straight on, it turns away on the spot, or
/// stands if there is one on each side.
[[nodiscard]] constexpr Motion braked(Motion motion, const Senses& senses, const Body& body, float margin_m = 0.06f) noexcept {
  constexpr float kSine57 = 0.838670568f, kAway_rad_s = 1.0f, kMeets_m = 0.01f, kNear_m = 0.03f, kBears_1_s_m = 50.0f, kBears_rad_s = 2.0f;
  if (!is_finite(motion.speed_m_s) || !is_finite(motion.turn_rad_s)) return {};   // the task or the gains hold such a number
  if (!(motion.speed_m_s > 0.0f) && !(motion.speed_m_s < 0.0f)) return motion;
  if (body.has_range_finders && !senses.range_known) return {};
  if (motion.speed_m_s < 0.0f) return {greatest(motion.speed_m_s, -detail::free_speed(senses, kRangeFinders / 2, body, margin_m)), motion.turn_rad_s};
  if (senses.touched) return {0.0f, motion.turn_rad_s};
  motion.speed_m_s = least(motion.speed_m_s, detail::free_speed(senses, 0, body, margin_m));
  if (senses.met_m < kOutOfRange) motion.speed_m_s = least(motion.speed_m_s, fastest_that_stops(senses.met_m - body.radius_m - margin_m, body, senses.age.range_s));
  if (!senses.range_known || !(motion.speed_m_s > 0.0f)) return motion;
  const auto aside = [&](std::size_t eighths) { return senses.range_m[eighths] * kSine57 - body.radius_m; };
  const float left = aside(1), right = aside(7);
  const bool left_near = left < kNear_m || senses.range_m[2] < body.radius_m + kNearestBeside_m;
  const bool right_near = right < kNear_m || senses.range_m[6] < body.radius_m + kNearestBeside_m;
  const float bears = clamped(kBears_1_s_m * (greatest(kNear_m - right, 0.0f) - greatest(kNear_m - left, 0.0f)), -kBears_rad_s, kBears_rad_s);   // to the left
  if (left_near) motion.turn_rad_s = least(motion.turn_rad_s, 0.0f);
  if (right_near) motion.turn_rad_s = greatest(motion.turn_rad_s, 0.0f);
  if (left_near != right_near) motion.turn_rad_s = right_near ? greatest(motion.turn_rad_s, bears) : least(motion.turn_rad_s, bears);
  if (left >= kMeets_m && right >= kMeets_m) return motion;
  if (left < kMeets_m && right < kMeets_m) return {};
  return {0.0f, left < kMeets_m ? least(motion.turn_rad_s, -kAway_rad_s) : greatest(motion.turn_rad_s, kAway_rad_s)};
}

/// How fast a search comes to its end, by odometry, which must be known; a wheel that odometry does not see turn counts for a quarter of what it was asked
/// for, so that a dead encoder ends a search later, but not never.
[[nodiscard]] constexpr float searched_m_s(const Senses& senses, float asked_m_s) noexcept { return greatest(magnitude(senses.speed_m_s), 0.25f * asked_m_s); }

/// The same way at no more than `limit_m_s`: the turn becomes slower with the speed, so that the robot drives the same curve.
[[nodiscard]] constexpr Motion slowed(const Motion& wanted, float limit_m_s) noexcept {
  const float speed_m_s = magnitude(wanted.speed_m_s);
  if (!(speed_m_s > limit_m_s)) return wanted;
  const float share = limit_m_s / speed_m_s;
  return {share * wanted.speed_m_s, share * wanted.turn_rad_s};
}

}  // namespace mts
