// What a fleet's last tick was, robot by robot. Part of fleet/fleet.h.
#pragma once

#include <algorithm>

#include "fleet.h"

namespace mts {

template <class K>
std::uint64_t Fleet<K>::running(Strategy strategy, std::size_t word) const {
  const auto u = static_cast<std::uint32_t>(strategy);
  const auto block = static_cast<std::uint32_t>(word / kPlaneWords);
  const auto within_block = static_cast<std::uint32_t>(word % kPlaneWords);
  std::uint64_t bits = memory_.read(block, layout_.strategies[u].runs, within_block);
  for (const auto& alone : blocks_[block].alone) {
    if (alone->lane / 64 != within_block) continue;
    const std::uint64_t bit = std::uint64_t{1} << (alone->lane % 64);
    bits = LanePort<K>::runs(alone->state) == u ? bits | bit : bits & ~bit;
  }
  return bits & within(word);
}

template <class K>
std::uint32_t Fleet<K>::dispatched(FleetPlace at) const {
  if (const Alone* alone = alone_at(at)) return alone->state.strategy - 1u;
  for (std::uint32_t u = 0; u < K::kShape.strategies; ++u) {
    if (memory_.test(at, layout_.strategies[u].runs)) return u;
  }
  return K::kTables.idle == Idle::kStrategy && clock_.ticks() != 0 ? K::kTables.idle_strategy : kNone;
}

template <class K>
bool Fleet<K>::active(FleetPlace at) const {
  for (std::uint32_t u = 0; u < K::kShape.strategies; ++u) {
    if (memory_.test(at, layout_.strategies[u].active)) return true;
  }
  return false;
}

template <class K>
std::uint32_t Fleet<K>::bad_facts(FleetPlace at) const {
  const std::vector<std::uint64_t>& bad = blocks_[at.block].bad;
  std::uint32_t sum = 0;
  for (std::size_t i = at.word(); i < bad.size(); i += kPlaneWords) sum += (bad[i] & at.bit()) != 0 ? 1u : 0u;
  return sum;
}

template <class K>
Status Fleet<K>::status(std::size_t robot) const {
  const FleetPlace at = place(robot);
  if (const Alone* alone = alone_at(at)) return alone->state.status;
  if (memory_.test(at, layout_.several)) return Status::kTwoStrategies;
  if (bad_facts(at) != 0) return Status::kBadFact;
  return driving(at);
}

template <class K>
Status Fleet<K>::driving(FleetPlace at) const {
  if (const Alone* alone = alone_at(at)) return alone->state.driving;
  if (active(at)) return Status::kOk;
  if (!memory_.test(at, layout_.timers[kTimers].on)) return Status::kNoStrategy;
  return memory_.test(at, layout_.timers[kTimers].over) ? Status::kHoldExpired : Status::kHolding;
}

template <class K>
float Fleet<K>::value_before(FleetPlace at, std::uint32_t satellite, bool before) const {
  const FleetSatellite& s = layout_.satellites[satellite];
  return layout_.values[s.values + memory_.code(at, before ? s.before : s.plane, s.bits)];
}

template <class K>
float Fleet<K>::value(std::size_t robot, Satellite satellite) const {
  const auto i = static_cast<std::uint32_t>(satellite);
  if (const Alone* alone = alone_at(place(robot))) return alone->state.cf[K::kShape.facts + i];
  return value_before(place(robot), i, false);
}

template <class K>
std::size_t Fleet<K>::alone() const {
  std::size_t sum = 0;
  for (const Block& block : blocks_) sum += block.alone.size();
  return sum;
}

template <class K>
std::size_t Fleet<K>::passed_over() const {
  return static_cast<std::size_t>(std::count_if(blocks_.begin(), blocks_.end(), [](const Block& b) { return b.passed; }));
}

template <class K>
std::size_t Fleet<K>::resting() const {
  return static_cast<std::size_t>(std::count_if(blocks_.begin(), blocks_.end(), [](const Block& b) { return b.resting; }));
}

template <class K>
RobotTick<K> Fleet<K>::read_alone(const Alone& alone) const {
  const Decision<K> decision(alone.state);
  RobotTick<K> out;
  out.bad_facts = decision.bad_facts();
  out.status = decision.status();
  out.holding = decision.holding();
  out.hold_expired = decision.hold_expired();
  for (const auto fact : decision.events()) out.events.push_back(fact);
  for (const auto fact : decision.lost()) out.lost.push_back(fact);
  std::sort(out.events.begin(), out.events.end());
  std::sort(out.lost.begin(), out.lost.end());
  for (const auto rule : decision.fired()) out.fired.push_back(rule);
  for (const auto& c : decision.changed()) out.changed.push_back({static_cast<Satellite>(c.cell - K::kShape.facts), c.value});
  std::sort(out.changed.begin(), out.changed.end(), [](const auto& a, const auto& b) { return a.satellite < b.satellite; });
  for (const auto& c : decision.conflicts()) out.conflicts.push_back({static_cast<Satellite>(c.cell - K::kShape.facts), c.level});
  std::sort(out.conflicts.begin(), out.conflicts.end(), [](const auto& a, const auto& b) {
    return a.level != b.level ? a.level < b.level : a.satellite < b.satellite;
  });
  for (const auto strategy : decision.active()) out.active.push_back(strategy);
  if (decision.drives()) out.strategy = decision.strategy();
  return out;
}

template <class K>
RobotTick<K> Fleet<K>::read(std::size_t robot) const {
  const FleetPlace at = place(robot);
  const Alone* const alone = alone_at(at);
  RobotTick<K> out = alone != nullptr ? read_alone(*alone) : RobotTick<K>{};
  out.tick = clock_.ticks();
  out.time_us = clock_.now_us();
  if (alone != nullptr) return out;
  for (std::uint32_t f = 0; f < K::kShape.facts; ++f) {
    if (memory_.test(at, layout_.facts[f].event)) out.events.push_back(static_cast<Fact>(f));
    if (memory_.test(at, layout_.facts[f].lost)) out.lost.push_back(static_cast<Fact>(f));
  }
  for (std::uint32_t r = 0; r < K::kShape.rules; ++r) {
    if (memory_.test(at, layout_.rules[r].fired)) out.fired.push_back(static_cast<typename K::Rule>(r));
  }
  for (std::uint32_t i = 0; i < K::kShape.satellites && traced_; ++i) {
    const float now = value_before(at, i, false);
    if (now != value_before(at, i, true)) out.changed.push_back({static_cast<Satellite>(i), now});
  }
  for (std::uint32_t i = 0; i < K::kShape.strategies; ++i) {
    const auto u = K::kTables.priority[i];
    if (memory_.test(at, layout_.strategies[u].active)) out.active.push_back(static_cast<Strategy>(u));
  }
  if (drives(robot)) out.strategy = strategy(robot);
  out.bad_facts = bad_facts(at);
  out.status = status(robot);
  const Status what_drives = driving(at);
  out.holding = what_drives == Status::kHolding;
  out.hold_expired = what_drives == Status::kHoldExpired;
  return out;
}

}  // namespace mts
