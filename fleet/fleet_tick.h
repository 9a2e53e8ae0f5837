// How facts get into planes, and the tick of a fleet. Part of fleet/fleet.h.
#pragma once

#include <algorithm>
#include <bit>

#include "fleet.h"

namespace mts {

namespace detail {
/// Makes a word of ones or zeros of each of the lowest bits.
template <std::size_t kBits>
void spread_bits(std::uint32_t stamp, std::uint64_t (&words)[kBits]) {
  for (std::size_t b = 0; b < kBits; ++b) words[b] = std::uint64_t{0} - (stamp >> b & 1u);
}
}  // namespace detail

template <class K>
std::vector<std::uint32_t> Fleet<K>::durations() {
  std::vector<std::uint32_t> us(K::kTables.queue_us, K::kTables.queue_us + K::kShape.queues);
  us.push_back(K::kTables.hold_limit_us);
  return us;
}

template <class K>
Fleet<K>::Fleet(std::size_t robots, FleetOptions options)
    : robots_(robots), layout_(FleetForm<K>::tables()), kernels_(FleetForm<K>::kernels(options.most_bits)),
      kernel_(options.traced ? kernels_.traced : kernels_.plain), traced_(options.traced), can_rest_(!traced_ && kernels_.resting != nullptr),
      clock_(durations(), options.first_stamp),
      memory_(blocks_for(robots),
              {.read_given = layout_.read_given, .plain_given = layout_.plain_given, .given = layout_.given,
               .planes = traced_ ? layout_.traced_planes : layout_.planes, .busy_given = layout_.busy_given, .busy_planes = layout_.busy_planes,
               .rest = can_rest_ ? layout_.rest : nullptr, .first_part = layout_.traced_planes, .parts = layout_.parts, .traced = traced_},
              kTimers + 1),
      stamp_bits_(K::kShape.queues + 1, 0), weights_(std::size_t{memory_.blocks()} * layout_.weights * kBlockRobots, 0.0f),
      blocks_(memory_.blocks()), queues_(K::kShape.queues + 1) {
  for (std::size_t w = 0; w < kPlaneWords; ++w) last_robots_[w] = within((std::max<std::size_t>(blocks_.size(), 1) - 1) * kPlaneWords + w);
  const auto fill = [&](std::uint32_t block, std::uint32_t plane) { std::fill_n(&memory_.word(block, plane, 0), kPlaneWords, ~std::uint64_t{0}); };
  for (std::uint32_t f = 0; f < K::kShape.facts; ++f) {
    for (const PlaneRange& range : FactPlanes<K>::ranges(layout_.facts[f], f)) {
      const bool rests = range.plane >= layout_.busy_given && range.plane < layout_.read_given;
      if (memory_.has(range.plane)) gives_.push_back({range, std::uint32_t{rests && can_rest_}});
    }
    gives_begin_.push_back(static_cast<std::uint32_t>(gives_.size()));
  }
  for (std::uint32_t b = 0; b < memory_.blocks(); ++b) {
    for (const Give& give : gives_) {
      if (give.range.has(0.0f)) fill(b, give.range.plane);
    }
    for (std::uint32_t i = 0; i < K::kShape.satellites; ++i) {
      const FleetSatellite& at = layout_.satellites[i];
      std::uint32_t code = 0;
      while (layout_.values[at.values + code] != K::kTables.initial[i]) ++code;
      for (std::uint32_t k = 0; k < at.bits; ++k) {
        if ((code >> k & 1u) != 0) fill(b, at.plane + k);
      }
    }
  }
}

template <class K>
void Fleet<K>::give(std::uint32_t block, std::size_t word, Fact fact, std::uint64_t robots, float certainty) {
  const auto f = static_cast<std::uint32_t>(fact);
  const SaneFact fact_now = sane_fact(certainty);
  std::uint64_t changed = 0, woken = 0;
  Block& b = blocks_[block];
  auto* const given = reinterpret_cast<std::uint64_t*>(memory_.given(block)) + word;
  const auto put = [&](std::uint32_t plane, bool bit) {
    std::uint64_t& there = given[std::size_t{plane} * kPlaneWords];
    const std::uint64_t change = (there ^ (std::uint64_t{0} - std::uint64_t{bit})) & robots;
    changed |= change;
    return there ^= change;
  };
  for (std::uint32_t i = gives_begin_[f]; i < gives_begin_[f + 1]; ++i) {
    const Give& give = gives_[i];
    woken |= put(give.range.plane, give.range.has(fact_now.value)) & (std::uint64_t{0} - give.rests);
  }
  if (fact_now.bad && b.bad.empty()) b.bad.assign(std::size_t{K::kShape.facts} * kPlaneWords, 0);
  if (!b.bad.empty()) put(layout_.facts[f].bad, fact_now.bad);
  if (changed != 0) b.given = true;
  if (woken != 0) b.resting = false;
  const std::uint32_t w = layout_.facts[f].weight;
  if (w == kNoPlane) return;
  float* const weights = &weights_[(std::size_t{block} * layout_.weights + w) * kBlockRobots + word * 64];
  for (; robots != 0; robots &= robots - 1) weights[std::countr_zero(robots)] = fact_now.value;
  b.given = true;
}

template <class K>
void Fleet<K>::begin_tick(Duration since_last) {
  if (const std::uint32_t less = clock_.renumber(); less != 0) memory_.renumber(less);
  clock_.advance(since_last.us);
  dt_us_ = since_last.us;
  for (std::uint32_t q = 0; q <= K::kShape.queues; ++q) {
    // `bits` must be enough to tell apart all stamps that robots may hold, and this tick's.
    const std::uint32_t span = clock_.stamp() - (std::min)(clock_.stamp(), clock_.ripe_before()[q]) + 1u;
    const std::uint32_t bits = 32u - static_cast<std::uint32_t>(std::countl_zero(span - 1u));
    if (bits <= stamp_bits_[q]) continue;
    for (std::uint32_t i = 0; i <= kTimers; ++i) {
      const bool asked = i < kTimers || layout_.timers[i].on != kNoPlane;
      if (asked && queue_of(i) == q) memory_.widen(i, stamp_bits_[q], bits, clock_.last_stamp());
    }
    stamp_bits_[q] = bits;
  }
  now_ = {.first = clock_.ticks() == 1, .stamp = clock_.stamp(), .last_stamp = clock_.last_stamp(), .ripe = clock_.ripe().data(),
          .ripe_before = clock_.ripe_before().data(), .bits = stamp_bits_.data(), .queues = queues_.data(), .stamps = memory_.stamps(),
          .fall_back = &Fleet::fall_back, .fleet = this};
  detail::spread_bits(now_.stamp, now_.stamp_bits);
  detail::spread_bits(now_.last_stamp, now_.last_bits);
  for (std::uint32_t q = 0; q <= K::kShape.queues; ++q) note_queue(q);
}

template <class K>
void Fleet<K>::note_queue(std::uint32_t queue) {
  const std::uint32_t ripe = clock_.ripe()[queue], before = clock_.ripe_before()[queue], bits = stamp_bits_[queue];
  const bool at_once = (queue < K::kShape.queues ? now_.stamp : now_.last_stamp) < ripe;   // `for 0 s`
  const std::uint32_t usual = ripe - before <= 1 && !at_once ? bits : 0;
  FleetQueue& at = queues_[queue];
  at.short_bits = bits <= FleetQueue::kShort ? usual : 0;
  at.long_bits = bits > FleetQueue::kShort ? usual : 0;
  at.rises = std::uint64_t{0} - std::uint64_t{ripe != before};
  detail::spread_bits(ripe - 1, at.ripe);
}

template <class K>
void Fleet<K>::tick_blocks(std::uint32_t first, std::uint32_t end, unsigned part) {
  const bool large = memory_.bytes() > kCacheBytes;
  // Where the last tick ended this one begins: those blocks are still in the caches. Large fleets leave nothing there, and processors fetch
  // ahead better upwards.
  const bool upwards = large || clock_.ticks() % 2 != 0;
  for (std::uint32_t i = first; i < end; ++i) {
    const std::uint32_t block = upwards ? i : first + (end - 1 - i);
    FleetAhead ahead;
    if (large && block + 1 < end) ahead = memory_.prefetch(block + 1, blocks_[block + 1].resting);
    Block& b = blocks_[block];
    b.passed = b.quiet && !b.given && clock_.now_us() < b.due_us;
    if (!b.passed) tick_block(block, part, ahead);
    ahead.fetch(layout_.planes);
  }
}

template <class K>
void Fleet<K>::note_bad_facts(std::uint32_t block) {
  std::vector<std::uint64_t>& bad = blocks_[block].bad;
  for (std::uint32_t i = 0; i < bad.size(); ++i) bad[i] = memory_.read(block, layout_.facts[i / kPlaneWords].bad, i % kPlaneWords);
}

template <class K>
void Fleet<K>::tick_block(std::uint32_t block, unsigned part, FleetAhead& ahead) {
  Block& b = blocks_[block];
  note_bad_facts(block);
  std::erase_if(b.alone, [](const auto& alone) { return alone->back; });
  for (std::uint64_t& word : b.lonely) word = 0;
  for (const auto& alone : b.alone) b.lonely[alone->lane / 64] |= std::uint64_t{1} << (alone->lane % 64);
  const std::size_t before = b.alone.size();
  const bool resting = b.resting;
  bool woke = false;
  (resting ? kernels_.resting : kernel_)(now_, {.given = memory_.given(block), .before = memory_.made(block), .now = memory_.room(part, resting),
                                                .index = block, .oldest = memory_.oldest(block, 0), .ahead = &ahead,
                                                .robots = there(block), .woke = &woke});
  memory_.change_places(block, part, resting);
  for (std::size_t i = 0; i < before; ++i) {
    const FleetPlace there{block, b.alone[i]->lane};
    port().tick(there, b.alone[i]->state, dt_us_, [&](std::uint32_t fact) { return weight(there, fact); });
  }
  for (const auto& alone : b.alone) alone->back = port().put_back({block, alone->lane}, alone->state);
  // If facts are new, the comparison is not worth its cost: something will have changed.
  b.quiet = !b.given && !now_.first && b.alone.empty() && memory_.same(block, part, resting);
  if (resting) b.resting = !woke && b.alone.empty();
  else if (can_rest_ && (b.quiet || (clock_.ticks() + block) % kTicksToRest == 0)) b.resting = b.alone.empty() && memory_.come_to_rest(block, there(block));
  b.given = false;
  if (b.quiet) b.due_us = due_us(block);
}

/// Called by the kernel for robots whose rules disagree, while the planes are still as the last tick left them.
template <class K>
void Fleet<K>::fall_back(void* fleet, const FleetBlock& block, std::uint32_t first_word, const std::uint64_t* robots, std::uint32_t words) {
  Fleet& self = *static_cast<Fleet*>(fleet);
  Block& b = self.blocks_[block.index];
  for (std::uint32_t w = 0; w < words; ++w) {
    for (std::uint64_t left = robots[w] & ~b.lonely[first_word + w] & self.within(block.index * std::size_t{kPlaneWords} + first_word + w); left != 0; left &= left - 1) {
      const FleetPlace at{block.index, (first_word + w) * 64 + static_cast<std::uint32_t>(std::countr_zero(left))};
      const auto weigh = [&](std::uint32_t fact) { return self.weight(at, fact); };
      auto alone = std::make_unique<Alone>();
      alone->lane = at.lane;
      self.port().take_out(at, alone->state, weigh);
      self.port().tick(at, alone->state, self.dt_us_, weigh);
      b.alone.push_back(std::move(alone));
    }
  }
}

/// When the next timer runs out in a block in which nothing else happens.
template <class K>
std::int64_t Fleet<K>::due_us(std::uint32_t block) {
  const std::uint32_t wide = kernels_.bits / 64;
  std::int64_t due = (std::numeric_limits<std::int64_t>::max)();
  for (std::uint32_t i = 0; i <= kTimers; ++i) {
    const FleetTimer& timer = layout_.timers[i];
    if (timer.on == kNoPlane) continue;
    const std::uint32_t queue = queue_of(i);
    for (std::uint32_t w = 0; w < kPlaneWords; ++w) {
      if ((memory_.read(block, timer.on, w) & ~memory_.read(block, timer.over, w)) == 0) continue;
      const std::uint32_t oldest = (std::max)(memory_.oldest(block, w / wide * wide)[i], clock_.ripe()[queue]);
      due = (std::min)(due, clock_.time_us((std::min)(oldest, clock_.stamp())) + clock_.duration_us(queue));
    }
  }
  return due;
}

}  // namespace mts
