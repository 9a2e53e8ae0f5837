// Finds somebody who comes from the side on a collision course: seen at the same bearing all the way, and nearer all the time.
//
// A thing that stands still comes nearer, in the eyes of a range finder, by the robot's own way at most; to a side, by the cosine of that:
//   u = C - v cos(33 degrees) - omega r            C: how fast the range r falls, by the straight line through the last 0.3 s of
//   u = C - v - 4 omega r^2    (straight ahead)       readings; v, omega: how fast the robot drove and turned meanwhile
// u is how fast the thing comes by its own motion. (33 degrees is the edge of what the range finder at 45 sees; omega r allows for a wall
// seen aslant, omega r^2 for a wall 25 cm aside seen far along a corridor.) If u is more than the spread of the readings explains, and the
// readings come nearer step by step, somebody comes. If both went on, they would meet after the robot has driven v D / C, where D is the
// distance to the middle of the comer. The comer's lane begins before that place, by half its width and some room. A comer seen abeam meets
// only a robot that is at most half as fast: a faster robot passes before it, and would be in its way if it stopped. `braked` in heard.h
// says how fast the robot may go to stop before the lane.
//
// Some things that stand look the same: a wall square to the way that ends beside the robot's lane (1.2 v at 45 degrees; the robot brakes
// for it where it would nearly graze it), and slanted walls all round in a hall. So controllers that cross halls or go round something
// ignore `Senses::met_m`. A comer is not seen if it is hidden behind a wall until it is near, or if it comes while the robot turns.
#pragma once

#include <cstdint>

#include "heard.h"
#include "reckoning.h"

namespace mts {

/// At most 376 bytes. Cost of a new reading: some 30 multiplications a direction, three directions; between readings two subtractions.
class Comers {
 public:
  /// Call it each period, before `take`. The senses must have been `heard`, and `reckoning` must have made its step.
  void step(const Reckoning& reckoning, float dt_s) noexcept {
    since_s_ += dt_s;
    since_m_ += reckoning.way_m();
    hold_s_ = greatest(hold_s_ - dt_s, 0.0f);
    lane_m_ -= reckoning.way_m();
  }

  /// Takes a new reading of the range finders; `spread_m` is the spread of a single one.
  void take(const Senses& senses, const Reckoning& reckoning, float spread_m) noexcept {
    const float* range = senses.range_m;
    Reading& now = readings_[next_];
    const float left = least(range[2], range[3]), right = least(range[6], range[5]);
    now = {since_s_, since_m_, reckoning.at.heading_rad, {range[0], least(range[1], left), least(range[7], right)}, {false, range[1] >= left, range[7] >= right}};
    since_s_ = since_m_ = 0.0f;
    next_ = (next_ + 1) % kMost;
    count_ = count_ < kMost ? count_ + 1 : kMost;
    if (!senses.odometry_known || !reckoning.heading_known()) return forget();
    for (std::size_t where = 0; where < kDirections; ++where) {
      const float lane = lane_of(look(where, greatest(spread_m, kSpread_m)), where, now.abeam[where]);
      if (!(lane < kOutOfRange)) seen_[where] = 0;
      else if (seen_[where] == 0) seen_[where] = 1;   // another reading has to confirm it
      else {
        lane_m_ = hold_s_ > 0.0f ? least(lane_m_, lane) : lane;
        hold_s_ = kHolds_s;
      }
    }
  }

  /// Forgets all readings: the range finders are silent.
  void forget() noexcept { count_ = 0; }

  /// The distance from the robot's centre ahead to the lane of somebody who comes: see `Senses::met_m`.
  [[nodiscard]] float met_m() const noexcept { return hold_s_ > 0.0f ? lane_m_ : kOutOfRange; }

 private:
  static constexpr std::size_t kMost = 12, kDirections = 3;   ///< ahead, left, right
  struct Reading {
    float since_s = 0.0f, since_m = 0.0f;   ///< time and way since the one before
    float heading_rad = 0.0f;
    float range_m[kDirections] = {};        ///< the nearest that is seen there
    bool abeam[kDirections] = {};           ///< the range finder at 45 degrees sees nothing nearer than those abeam and behind do
  };
  /// A thing that comes nearer in one direction, by the straight line through its last ranges.
  struct Approach {
    bool seen = false;
    float range_m = 0.0f, closing_m_s = 0.0f;
    float doubt_m_s = 0.0f;                 ///< spread of `closing_m_s`
    float speed_m_s = 0.0f, turn_rad_s = 0.0f;   ///< of the robot meanwhile
  };
  [[nodiscard]] const Reading& before(std::size_t readings) const noexcept { return readings_[(next_ + 2 * kMost - 1 - readings) % kMost]; }

  [[nodiscard]] Approach look(std::size_t where, float spread_m) const noexcept {
    float age = 0.0f, ages = 0.0f, ranges = 0.0f, squares = 0.0f, products = 0.0f, leap = 0.0f;
    std::size_t k = 0;
    for (;; ++k) {
      if (k == count_) return {};
      const float range = before(k).range_m[where];
      if (!(range < kFar_m)) return {};
      if (k > 0) {
        const float nearer = range - before(k - 1).range_m[where];
        if (nearer < -kBack * spread_m) return {};
        leap = greatest(leap, nearer);
      }
      ages += age;
      ranges += range;
      squares += age * age;
      products += age * range;
      if (k + 1 >= kLeast && age >= kSpan_s) break;
      age += before(k).since_s;
    }
    if (age > kOld_s) return {};
    const float n = static_cast<float>(k + 1), width = squares - ages * ages / n;
    const float closing = (products - ages * ranges / n) / width;
    if (leap > kLeap * closing * age) return {};   // no comer, but an edge that comes into sight
    Approach seen{true, (ranges - closing * ages) / n, closing, spread_m / square_root(width), 0.0f, 0.0f};
    drove(0, k, seen);
    if (k + kLate < count_) drove(k, k + kLate, seen);
    return seen;
  }

  /// Raises speed and turning rate to those of the robot from one reading to another. It is called for an earlier span as well, since ranges
  /// may be heard later than the odometry of the same moment.
  void drove(std::size_t to, std::size_t from, Approach& meanwhile) const noexcept {
    float age = 0.0f, way = 0.0f;
    for (std::size_t k = to; k < from; ++k) {
      age += before(k).since_s;
      way += before(k).since_m;
    }
    meanwhile.speed_m_s = greatest(meanwhile.speed_m_s, way / age);
    meanwhile.turn_rad_s = greatest(meanwhile.turn_rad_s, magnitude(wrapped_angle(before(to).heading_rad - before(from).heading_rad)) / age);
  }

  /// The distance from the robot's centre to the comer's lane; kOutOfRange: nobody comes.
  [[nodiscard]] static float lane_of(const Approach& a, std::size_t where, bool abeam) noexcept {
    if (!a.seen || a.turn_rad_s > kTurns_rad_s || a.range_m > kNear_m + kSoon_s * a.closing_m_s) return kOutOfRange;
    const float aslant = where == 0 ? a.range_m / kAside_m : 1.0f;
    const float stands = a.speed_m_s * (where == 0 ? 1.0f : kCosine33) + a.turn_rad_s * a.range_m * aslant;
    if (abeam && a.closing_m_s - stands < kAbeam * a.speed_m_s) return kOutOfRange;   // the comer passes behind the robot
    const float surely = where == 0 ? kAhead_m_s : kSurely * a.doubt_m_s;
    if (a.closing_m_s - stands < greatest(surely, kSurely * a.doubt_m_s)) return kOutOfRange;
    return greatest(a.speed_m_s, kCreeps_m_s) * (a.range_m + kRadius_m) / a.closing_m_s - kHalf_m;
  }

  static constexpr float kSpan_s = 0.29f, kOld_s = 0.8f;   ///< the readings looked at span at least the first, at most the second
  static constexpr std::size_t kLeast = 4, kLate = 4;
  static constexpr float kSpread_m = 0.01f;        ///< the least spread that is assumed
  static constexpr float kSurely = 4.0f, kBack = 3.0f;   ///< in spreads
  static constexpr float kLeap = 0.5f;             ///< the most of the whole approach that may come in one step
  static constexpr float kFar_m = 2.5f, kNear_m = 0.12f, kSoon_s = 1.4f;   ///< a comer that would be there later need not be braked for yet
  static constexpr float kAhead_m_s = 0.25f;       ///< for a slower comer ahead, braking as for a thing that stands suffices
  static constexpr float kCosine33 = 0.838670568f, kAside_m = 0.25f, kTurns_rad_s = 0.3f;
  static constexpr float kRadius_m = 0.2f, kHalf_m = 0.25f;   ///< of the comer; half the width of its lane
  static constexpr float kAbeam = 2.0f;            ///< times the robot's speed: the least speed of a comer abeam that can meet the robot
  static constexpr float kCreeps_m_s = 0.1f;       ///< a robot that stands is taken to go on at this speed
  static constexpr float kHolds_s = 0.5f;          ///< how long a comer counts after it was seen last
  Reading readings_[kMost] = {};
  std::size_t next_ = 0, count_ = 0;
  std::uint8_t seen_[kDirections] = {};
  float since_s_ = 0.0f, since_m_ = 0.0f;
  float hold_s_ = 0.0f, lane_m_ = 0.0f;
};
static_assert(sizeof(Comers) <= 376);

}  // namespace mts
