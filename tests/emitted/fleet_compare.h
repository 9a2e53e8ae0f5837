// Runs an emitted fleet beside an interpreter for each of some of its robots, and compares every tick.
#pragma once

#include <cstdio>
#include <vector>

#include <waymark/fleet/fleet.h>
#include "compiler/program/interpret.h"
#include "compiler/program/net_effects.h"
#include "tests/emitted/usual_facts.h"
#include "tests/unit/program/random_program.h"

namespace kb::emitted {

template <class Id, class E>
Id cell_of(E thing, std::uint32_t first = 0) {
  return Id{static_cast<std::uint32_t>(thing) + first};
}

/// A robot's tick as the compiler's own record of it.
template <class K>
program::Tick record_of(const program::Program& p, const mts::RobotTick<K>& robot) {
  program::Tick tick;
  tick.number = robot.tick;
  tick.time_us = robot.time_us;
  for (const auto fact : robot.events) tick.events.push_back(cell_of<program::CellId>(fact));
  for (const auto fact : robot.lost) tick.lost.push_back(cell_of<program::CellId>(fact));
  for (const auto rule : robot.fired) tick.fired.push_back(cell_of<program::RuleId>(rule));
  for (const auto& c : robot.changed) tick.set.push_back({cell_of<program::CellId>(c.satellite, p.facts), c.value});
  for (const auto& c : robot.conflicts) {
    const auto cell = cell_of<program::CellId>(c.satellite, p.facts);
    tick.conflicts.push_back({cell, program::writers_among(p, tick.fired, c.level, cell)});
  }
  for (const auto u : robot.active) tick.active.push_back(cell_of<program::CellId>(u, p.first_strategy()));
  if (robot.strategy) tick.strategy = cell_of<program::CellId>(*robot.strategy, p.first_strategy());
  tick.bad_facts = robot.bad_facts;
  tick.status = static_cast<program::Status>(robot.status);
  return tick;
}

/// Two fleets of some blocks: a traced one whose every tick is compared, and one of another width that must run the same
/// strategies. Twenty of their robots have an interpreter; facts are given to robots and to words of robots. On calm days robots are mostly
/// told what is usual, so that blocks rest in between.
template <class K>
class FleetTrial {
 public:
  static constexpr std::size_t kRobots = 1'100, kWatched = 20;

  FleetTrial(std::uint64_t seed, std::uint32_t bits, bool calm = false)
      : seed_(seed), calm_(calm), program_(program::testing::random_program(seed)), traced_(kRobots, {.traced = true, .most_bits = bits}),
        plain_(kRobots, {.traced = false, .most_bits = bits == 64 ? 512u : 64u, .first_stamp = kNumberedAnew - static_cast<std::uint32_t>(kTicks) / 2}) {
    for (std::size_t i = 0; i < kWatched; ++i) {
      robots_.push_back(i < 4 ? 1096 + i : (seed * 37 + i * 53) % 1096);
      traces_.push_back(program::testing::random_trace(program_, seed + 1'000 * i, kTicks));
      oracles_.emplace_back(program_);
      given_.emplace_back(program_.facts, 0.0f);
    }
  }

  bool agrees() {
    for (std::size_t tick = 0; tick < (calm_ ? kCalmDays : 1) * kTicks; ++tick) {
      if (calm_ && tick % kTicks == 0) forget();
      tell(tick, calm_ && tick % kTicks < kCalm);
      const std::uint32_t dt_us = traces_[0][tick % kTicks].dt_us;
      const std::size_t resting = plain_.resting();
      traced_.tick(mts::microseconds(dt_us));
      plain_.tick(mts::microseconds(dt_us), crew_);
      for (std::size_t i = 0; i < kWatched; ++i) {
        if (!same(i, tick, oracles_[i].tick(given_[i], dt_us))) return false;
      }
      rested_ += plain_.resting() > plain_.passed_over() ? 1u : 0u;
      woke_ += plain_.resting() < resting ? 1u : 0u;
    }
    return true;
  }
  /// On how many ticks a block was ticked and went on resting, at least; and on how many the kernel found that one no longer rests.
  [[nodiscard]] std::size_t rested() const { return rested_; }
  [[nodiscard]] std::size_t woke() const { return woke_; }

 private:
  static constexpr std::size_t kTicks = 50, kCalm = 44, kCalmDays = 6;
  static constexpr std::uint32_t kNumberedAnew = 0xC000'0000u;   // the stamp at which a fleet's clock does that, here in the middle of the trial

  void tell(std::size_t tick, bool calm) {
    for (std::size_t i = 0; i < kWatched; ++i) {
      for (std::uint32_t f = 0; f < program_.facts; ++f) {
        if (!calm || is_usual(f)) give(i, f, traces_[i][tick % kTicks].facts[f]);
      }
    }
    if (tick % 3 == 1 && (!calm || is_usual(static_cast<std::uint32_t>(tick) % program_.facts))) give_word(tick);
  }
  void forget() {
    for (std::uint32_t f = 0; f < program_.facts; ++f) {
      for (std::size_t word = 0; word < plain_.words(); ++word) {
        traced_.set_word(word, static_cast<typename K::Fact>(f), ~std::uint64_t{0}, 0.0f);
        plain_.set_word(word, static_cast<typename K::Fact>(f), ~std::uint64_t{0}, 0.0f);
      }
      for (std::vector<float>& given : given_) given[f] = 0.0f;
    }
  }
  void give(std::size_t i, std::uint32_t f, float value) {
    const bool same = given_[i][f] == value || (given_[i][f] != given_[i][f] && value != value);
    if (same) return;
    given_[i][f] = value;
    traced_.set(robots_[i], static_cast<typename K::Fact>(f), value);
    plain_.set(robots_[i], static_cast<typename K::Fact>(f), value);
  }
  /// What the first robot knows becomes known to half of the robots of some word.
  void give_word(std::size_t tick) {
    const std::size_t word = robots_[tick % kWatched] / 64;
    const std::uint32_t f = static_cast<std::uint32_t>(tick) % program_.facts;
    const std::uint64_t mask = 0xA5A5'5A5A'F0F0'0F0Full * (tick | 1);
    const float value = traces_[0][tick % kTicks].facts[f];
    traced_.set_word(word, static_cast<typename K::Fact>(f), mask, value);
    plain_.set_word(word, static_cast<typename K::Fact>(f), mask, value);
    for (std::size_t i = 0; i < kWatched; ++i) {
      if (robots_[i] / 64 == word && (mask >> (robots_[i] % 64) & 1u) != 0) given_[i][f] = value;
    }
  }

  bool same(std::size_t i, std::size_t tick, const program::Tick& expected) {
    const std::size_t robot = robots_[i];
    const program::Tick got = record_of(program_, traced_.read(robot));
    bool same = got == expected;
    for (std::uint32_t s = 0; s < program_.satellites; ++s) {
      const float value = oracles_[i].value(program::CellId{program_.facts + s});
      same = same && traced_.value(robot, static_cast<typename K::Satellite>(s)) == value &&
             plain_.value(robot, static_cast<typename K::Satellite>(s)) == value;
    }
    same = same && plain_.drives(robot) == got_strategy(expected) && plain_.status(robot) == static_cast<mts::Status>(expected.status) &&
           (expected.status != program::Status::kHolding || plain_.holding(robot)) && (expected.status != program::Status::kOk || !plain_.holding(robot)) &&
           (!plain_.drives(robot) || cell_of<program::CellId>(plain_.strategy(robot), program_.first_strategy()) == expected.strategy);
    for (std::uint32_t u = 0; u < program_.strategies; ++u) {
      const auto strategy = static_cast<typename K::Strategy>(u);
      const bool runs = (plain_.running(strategy, robot / 64) >> (robot % 64) & 1u) != 0;
      const bool holds = expected.status == program::Status::kHolding || !expected.active.empty();
      same = same && (!holds || runs == (expected.strategy == cell_of<program::CellId>(u, program_.first_strategy())));
    }
    if (same) return true;
    std::printf("seed %llu, tick %zu, robot %zu, %u bits\n  interpreter: %s\n  fleet:       %s\n  untraced: %s, %s\n", static_cast<unsigned long long>(seed_),
                tick + 1, robot, traced_.width(), print_json(program_, expected).c_str(), print_json(program_, got).c_str(),
                plain_.drives(robot) ? name(plain_.strategy(robot)) : "stands", mts::text(plain_.status(robot)));
    return false;
  }
  static bool got_strategy(const program::Tick& tick) { return tick.strategy != program::CellId::kNone; }

  std::uint64_t seed_;
  bool calm_;
  std::size_t rested_ = 0, woke_ = 0;
  program::Program program_;
  mts::Fleet<K> traced_, plain_;
  mts::Crew crew_{2};
  std::vector<std::size_t> robots_;
  std::vector<std::vector<program::testing::Step>> traces_;
  std::vector<program::Interpreter> oracles_;
  std::vector<std::vector<float>> given_;
};

/// `rest`: blocks must rest on calm days, and wake again.
template <class K>
bool fleet_agrees(std::uint64_t seed, bool rest) {
  for (const std::uint32_t bits : {512u, 64u}) {
    FleetTrial<K> calm(seed, bits, true);
    if (!FleetTrial<K>(seed, bits).agrees() || !calm.agrees()) return false;
    if (!rest || (calm.rested() > 20 && calm.woke() > 0)) continue;
    std::printf("seed %llu: blocks rested on %zu ticks and woke on %zu\n", static_cast<unsigned long long>(seed), calm.rested(), calm.woke());
    return false;
  }
  return true;
}

}  // namespace kb::emitted
