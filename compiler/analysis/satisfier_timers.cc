// What the Satisfier knows of timers.
#include <algorithm>
#include <optional>

#include "compiler/analysis/satisfier.h"

namespace kb::analysis {
namespace {

using program::Cond;
using program::CondId;

/// What a timer that has run out says of a sighting that its condition demands, which has been so on the tick before as well.
std::optional<Sightings> held_sighting(Sightings demanded) {
  if ((demanded & ~kSeen) == 0) return kStillSeen;
  if ((demanded & kSeen) == 0) return kUnseen;
  return std::nullopt;
}

}  // namespace

/// Finds `for` conditions over events, which never hold, and what the others say of sightings. Parts have smaller numbers than the conditions
/// that contain them, so what is found for a part is known when its whole is examined.
void Satisfier::find_timed_events() {
  for (std::uint32_t i = 0; i < program_.conds.size(); ++i) {
    const Cond& cond = program_.conds[i];
    if (cond.op != Cond::Op::kFor || cond.duration_us == 0) continue;
    const std::vector<Restriction> each = demands(cond.children.front(), 0).each;
    begin(0);   // undoes the assumptions
    if (is_moment(each)) {
      timed_events_.push_back(CondId{i});
      values_[timer_of(CondId{i})] = kTimerFalse;
      continue;
    }
    for (const Restriction& demand : each) {
      const auto held = is_sighting(demand.variable) ? held_sighting(demand.allowed) : std::nullopt;
      if (held) held_[CondId{i}].push_back({demand.variable, *held});
    }
  }
}

bool Satisfier::is_moment(std::span<const Restriction> demanded) const {
  return std::ranges::any_of(demanded, [this](const Restriction& demand) {
    return is_sighting(demand.variable) && (demand.allowed == kJustSeen || demand.allowed == kJustLost);
  });
}

bool Satisfier::is_timed_event(CondId condition) const { return std::binary_search(timed_events_.begin(), timed_events_.end(), condition); }

/// What the other timers over the same condition leave open of one: it has run out if a longer one has, and has not if a shorter one has not.
std::uint8_t Satisfier::left_by_others(std::uint32_t timer) const {
  const Cond& cond = program_.conds[timer - timer_of(CondId{0})];
  const auto known = elapsed_.find(cond.children.front());
  const Elapsed elapsed = known != elapsed_.end() ? known->second : Elapsed();
  std::uint8_t left = kTimerTrue | kTimerFalse;
  if (cond.duration_us <= elapsed.at_least) left &= kTimerTrue;
  if (cond.duration_us >= elapsed.below) left &= kTimerFalse;
  return left;
}

/// A timer is now certain.
void Satisfier::note_elapsed(std::uint32_t timer) {
  const Cond& cond = program_.conds[timer - timer_of(CondId{0})];
  Elapsed& elapsed = elapsed_[cond.children.front()];
  timed_.push_back({cond.children.front(), elapsed, trail_.size()});
  const std::int64_t duration = cond.duration_us;
  if (values_[timer] == kTimerTrue) elapsed.at_least = std::max(elapsed.at_least, duration);
  else elapsed.below = std::min(elapsed.below, duration);
}

}  // namespace kb::analysis
