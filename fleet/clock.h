// The clock that all robots of a fleet share: see note [stamps].
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace mts {

/// Numbers the distinct times of ticks (a number is a *stamp*), and knows for each duration (a *queue*) which stamps are ripe. The clock
/// may run for ever: before stamps reach 2^32 they are numbered anew, see `renumber`.
class FleetClock {
 public:
  /// Durations in microseconds. A stamp is ripe if it is at least as old as the duration. The last duration is how long a strategy may be
  /// held: for this one, a stamp is ripe only if it is older.
  /// `first`: the first stamp; not 0 only for tests.
  explicit FleetClock(std::vector<std::uint32_t> durations_us, std::uint32_t first = 0)
      : durations_us_(std::move(durations_us)), ripe_(durations_us_.size(), first), ripe_before_(ripe_), first_(first), stamp_(first), last_stamp_(first) {}

  /// Begins the next tick, `dt_us` after the last one; the first is at 0. Cost: a step for each duration and for each stamp that becomes
  /// ripe.
  void advance(std::uint32_t dt_us) {
    last_us_ = now_us_;
    last_stamp_ = stamp_;
    if (ticks_++ == 0) {
      times_us_.push_back(0);
    } else if (dt_us != 0) {
      now_us_ += dt_us;
      times_us_.push_back(now_us_);
      ++stamp_;
    }
    std::uint32_t oldest = stamp_;
    for (std::size_t q = 0; q < ripe_.size(); ++q) {
      ripe_before_[q] = ripe_[q];
      oldest = ripe_[q] < oldest ? ripe_[q] : oldest;
      const std::int64_t limit = now_us_ - durations_us_[q] - (q + 1 == ripe_.size() ? 1 : 0);
      while (ripe_[q] <= stamp_ && time_us(ripe_[q]) <= limit) ++ripe_[q];
    }
    for (; first_ < oldest; ++first_) times_us_.pop_front();
  }

  /// If stamps have become large, and all that can still be asked for have, numbers them from kLess less on and returns that number, to be
  /// subtracted from stamps that are kept elsewhere. Their low 31 bits stay the same. 0 if nothing is to be done.
  [[nodiscard]] std::uint32_t renumber() {
    constexpr std::uint32_t kLess = std::uint32_t{1} << 31;
    if (stamp_ < kLess + kLess / 2 || first_ < kLess) return 0;   // first_ is the least of all
    for (std::uint32_t* stamp : {&first_, &stamp_, &last_stamp_}) *stamp -= kLess;
    for (std::size_t q = 0; q < ripe_.size(); ++q) {
      ripe_[q] -= kLess;
      ripe_before_[q] -= kLess;
    }
    return kLess;
  }

  [[nodiscard]] std::uint64_t ticks() const { return ticks_; }
  [[nodiscard]] std::int64_t now_us() const { return now_us_; }
  /// The time of the previous tick.
  [[nodiscard]] std::int64_t last_us() const { return last_us_; }
  [[nodiscard]] std::uint32_t stamp() const { return stamp_; }
  [[nodiscard]] std::uint32_t last_stamp() const { return last_stamp_; }
  [[nodiscard]] std::uint32_t duration_us(std::size_t queue) const { return durations_us_[queue]; }
  [[nodiscard]] const std::vector<std::uint32_t>& ripe() const { return ripe_; }
  [[nodiscard]] const std::vector<std::uint32_t>& ripe_before() const { return ripe_before_; }
  /// Memory of the times that can still be asked for.
  [[nodiscard]] std::size_t bytes() const { return times_us_.size() * sizeof(std::int64_t); }
  /// The time of a stamp that was not ripe on the last tick.
  [[nodiscard]] std::int64_t time_us(std::uint32_t stamp) const { return times_us_[stamp - first_]; }
  /// The stamp of the time of a tick; for a time so old that it is forgotten, the oldest stamp that is known.
  [[nodiscard]] std::uint32_t stamp_of(std::int64_t time_us) const {
    std::size_t low = 0, high = times_us_.size();
    while (low < high) {
      const std::size_t middle = low + (high - low) / 2;
      if (times_us_[middle] < time_us) low = middle + 1;
      else high = middle;
    }
    return first_ + static_cast<std::uint32_t>(low);
  }

 private:
  std::vector<std::uint32_t> durations_us_, ripe_, ripe_before_;
  std::deque<std::int64_t> times_us_;   // from stamp first_ on
  std::uint32_t first_ = 0, stamp_ = 0, last_stamp_ = 0;
  std::int64_t now_us_ = 0, last_us_ = 0;
  std::uint64_t ticks_ = 0;
};

}  // namespace mts
