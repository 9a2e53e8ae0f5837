// Many robots with one knowledge base, decided 64 to 512 at a time, one bit each. User code includes this through the header that
// `kbc compile --fleet` writes. Needs hosted C++20. Uses the heap; throws only std::bad_alloc, and not while it ticks: half a tick cannot be
// taken back, so running out of memory there ends the program. With -fno-exceptions it always does.
//
//   route1::Fleet fleet(100'000);
//   for (;;) {
//     for (const Sighting& s : news) fleet.set(s.robot, route1::Fact::Line, s.certainty);
//     fleet.tick(mts::milliseconds(20));
//     if (fleet.drives(7)) go(fleet.strategy(7));
//   }
//
// note [a fleet is exact]
// Each robot decides exactly as a mts::Mind given the same facts at the same times: same strategy, status, events, fired rules and
// changed cells. Truth is bits (see note [atoms]), so planes hold all that a rule asks for. There is one exception: if rules of a level
// write different values to one cell, the result depends on strengths. The engine itself then ticks that robot (it is *alone*) until
// planes can express its state again. A test runs random fleets of random knowledge bases beside the interpreter.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "crew.h"
#include "kernel.h"
#include "lane.h"
#include "memory.h"
#include "../runtime/mind.h"

namespace mts {

struct FleetOptions {
  bool traced = false;              ///< keeps what `read` returns; costs memory and about doubles the time of a tick
  std::uint32_t most_bits = 512;    ///< most robots decided at once: 64, 256 or 512; lower it only for tests
  std::uint32_t first_stamp = 0;    ///< the number of the first time, see clock.h; not 0 only for tests
};

/// One robot's last tick, with the content of a mts::Decision. Lists are in ascending order, except that `fired` goes from the highest
/// level to the lowest and `active` by priority.
template <class K>
struct RobotTick {
  struct Change { typename K::Satellite satellite; float value; };
  struct Conflict { typename K::Satellite satellite; std::uint32_t level; };
  std::uint64_t tick = 0;    ///< the first is 1
  std::int64_t time_us = 0;  ///< since the first tick
  std::vector<typename K::Fact> events, lost;
  std::vector<typename K::Rule> fired;
  std::vector<Change> changed;
  std::vector<Conflict> conflicts;
  std::vector<typename K::Strategy> active;
  std::optional<typename K::Strategy> strategy;
  std::uint32_t bad_facts = 0;   ///< how many facts were NaN or outside [-1, 1]
  Status status = Status::kNoStrategy;
  bool holding = false, hold_expired = false;   ///< as in mts::Decision: not hidden by bad facts and conflicts
};

/// Any number of robots. Can be moved into a new object, but neither copied nor assigned.
template <class K>
class Fleet {
 public:
  using Fact = typename K::Fact;
  using Satellite = typename K::Satellite;
  using Strategy = typename K::Strategy;
  static_assert(K::kAbi == kAbi, "this knowledge base was compiled for another version of the runtime: compile it again (with CMake: run cmake, then build)");
  static_assert(requires { requires FleetForm<K>::kAbi == kFleetAbi; },
                "this fleet was compiled for another version of the runtime: compile it again (with CMake: run cmake, then build)");

  /// Puts all robots in the state of start-up, with all facts 0. They share one clock and start together. Memory: `bytes()`.
  explicit Fleet(std::size_t robots, FleetOptions options = {});

  [[nodiscard]] std::size_t robots() const { return robots_; }
  /// Number of words of 64 robots. Robot r is bit r % 64 of word r / 64.
  [[nodiscard]] std::size_t words() const { return (robots_ + 63) / 64; }
  /// How many robots the processor decides at once.
  [[nodiscard]] std::uint32_t width() const { return kernels_.bits; }

  // ---- facts: a certainty counts from the next tick on and stays until it is given again. As for mts::Mind, NaN is taken as 0 and
  // values outside [-1, 1] are clamped; both count as bad for as long as they stay. Different threads may give facts to robots of
  // different blocks of 512, but not while a tick runs. Here and below, a robot must be less than `robots()` and a word less than
  // `words()`; neither is checked.

  /// Gives one robot a fact. Cost: a read and a write for each plane of the fact. The planes lie near each other: a few nanoseconds, plus
  /// a cache miss in large fleets.
  void set(std::size_t robot, Fact fact, float certainty) {
    give(static_cast<std::uint32_t>(robot / kBlockRobots), robot % kBlockRobots / 64, fact, std::uint64_t{1} << (robot % 64), certainty);
  }
  /// Gives a fact to the robots of a word whose bits are set in `robots`. Costs as much as `set` for one robot; if the fact's certainty is
  /// kept (see `weighed`), a write for each robot as well.
  void set_word(std::size_t word, Fact fact, std::uint64_t robots, float certainty) {
    give(static_cast<std::uint32_t>(word / kPlaneWords), word % kPlaneWords, fact, robots, certainty);
  }
  /// Whether the fact's certainty is kept as a number, because rules that can contradict each other read it.
  [[nodiscard]] bool weighed(Fact fact) const { return layout_.facts[static_cast<std::uint32_t>(fact)].weight != kNoPlane; }

  /// Ticks all robots. `since_last` is the time since the tick before; it is ignored on the first. Cost: blocks of 512 robots in which
  /// nothing happens are passed over; docs/fleets.md has figures for the others.
  void tick(Duration since_last) noexcept {
    begin_tick(since_last);
    memory_.make_room(1);
    tick_blocks(0, memory_.blocks(), 0);
    memory_.note_ticked();
  }
  /// The same, shared out among the threads of a crew. The decisions are the same.
  void tick(Duration since_last, Crew& crew) noexcept {
    begin_tick(since_last);
    const std::uint64_t blocks = memory_.blocks();
    memory_.make_room(crew.threads());
    crew.run([&](unsigned part) {
      tick_blocks(static_cast<std::uint32_t>(blocks * part / crew.threads()), static_cast<std::uint32_t>(blocks * (part + 1) / crew.threads()), part);
    });
    memory_.note_ticked();
  }

  // ---- what the last tick decided

  /// Whether a controller is to drive. If not, the robot must stand still. Cost: a read for each strategy.
  [[nodiscard]] bool drives(std::size_t robot) const { return dispatched(place(robot)) != kNone; }
  /// The strategy whose controller is to drive. Call it only if `drives()`.
  [[nodiscard]] Strategy strategy(std::size_t robot) const { return static_cast<Strategy>(dispatched(place(robot))); }
  /// The worst thing that happened on the last tick, as in mts::Decision. Facts that have been given since then count from the next tick on.
  [[nodiscard]] Status status(std::size_t robot) const;
  /// As in mts::Decision: whether the last strategy goes on although none is active, or has gone on for as long as it may.
  [[nodiscard]] bool holding(std::size_t robot) const { return driving(place(robot)) == Status::kHolding; }
  [[nodiscard]] bool hold_expired(std::size_t robot) const { return driving(place(robot)) == Status::kHoldExpired; }
  /// The robots of a word that run the strategy, one bit each. Robots that hold it although no strategy is active (idle = hold) are
  /// included; robots that run it as their named idle strategy are not. Cost: one read, or one for each strategy that comes before it.
  [[nodiscard]] std::uint64_t running(Strategy strategy, std::size_t word) const;
  [[nodiscard]] float value(std::size_t robot, Satellite satellite) const;
  [[nodiscard]] bool high(std::size_t robot, Satellite satellite) const { return value(robot, satellite) >= K::kTables.firing; }
  /// The whole of a robot's last tick. Needs a traced fleet; from others, events, rules and changes are missing.
  [[nodiscard]] RobotTick<K> read(std::size_t robot) const;

  [[nodiscard]] std::uint64_t ticks() const { return clock_.ticks(); }
  [[nodiscard]] std::int64_t time_us() const { return clock_.now_us(); }
  /// Number of robots on the scalar engine.
  [[nodiscard]] std::size_t alone() const;
  /// Number of blocks of 512 robots that the last tick passed over.
  [[nodiscard]] std::size_t passed_over() const;
  /// Number of blocks that will be ticked without the planes that a profile leaves at rest (`kbc compile --fleet --profile`); 0 without one,
  /// and in traced fleets.
  [[nodiscard]] std::size_t resting() const;
  /// Memory of all planes, stamps and certainties, and of the clock, which grows with the fleet's age: it keeps 8 bytes for each tick
  /// within the longest duration that rules wait for or hold a strategy. `for 1 h` at a tick a millisecond is 29 MB, whatever the number
  /// of robots; it has its full size after that hour.
  [[nodiscard]] std::size_t bytes() const { return memory_.bytes() + weights_.size() * sizeof(float) + clock_.bytes(); }

 private:
  static constexpr std::uint32_t kNone = 0xFFFF'FFFFu;
  static constexpr std::size_t kCacheBytes = std::size_t{8} << 20;   // from this size on, planes are prefetched
  static constexpr std::uint32_t kTicksToRest = 16;   // so often a block is asked whether it rests, and when nothing happens there
  static constexpr std::uint64_t kAll = ~std::uint64_t{0};
  alignas(kPlaneBytes) static constexpr std::uint64_t kAllRobots[kPlaneWords] = {kAll, kAll, kAll, kAll, kAll, kAll, kAll, kAll};
  static constexpr std::uint32_t kTimers = K::kShape.timers;   // the timer of `idle = hold` comes after these
  [[nodiscard]] static constexpr std::uint32_t queue_of(std::uint32_t timer) {
    return timer < kTimers ? K::kTables.timers[timer].queue : K::kShape.queues;
  }

  /// A robot on the scalar engine.
  struct Alone {
    std::uint32_t lane;
    bool back = false;   ///< its state is in the planes again; kept only so that the last tick can be read
    StateOf<K> state;
  };
  struct Block {
    bool given = true;     ///< some fact is new
    bool quiet = false;    ///< the last tick changed nothing
    bool passed = false;
    bool resting = false;  ///< see note [resting blocks] in kernel.h; nobody is alone
    std::vector<std::uint64_t> bad;   ///< by fact and word: robots for which it was bad on the last tick; empty as long as none was given
    std::int64_t due_us = 0;  ///< if quiet: no timer runs out earlier
    std::uint64_t lonely[kPlaneWords] = {};   ///< robots that are alone
    std::vector<std::unique_ptr<Alone>> alone;
  };

  /// A plane that is written where a fact is given, and whether it can rest.
  struct Give {
    PlaneRange range;
    std::uint32_t rests;
  };

  void give(std::uint32_t block, std::size_t word, Fact fact, std::uint64_t robots, float certainty);
  void begin_tick(Duration since_last);
  void note_queue(std::uint32_t queue);
  void tick_blocks(std::uint32_t first, std::uint32_t end, unsigned part);
  void tick_block(std::uint32_t block, unsigned part, FleetAhead& ahead);
  void note_bad_facts(std::uint32_t block);
  [[nodiscard]] std::int64_t due_us(std::uint32_t block);
  static void fall_back(void* fleet, const FleetBlock& block, std::uint32_t first_word, const std::uint64_t* robots, std::uint32_t words);

  [[nodiscard]] FleetPlace place(std::size_t robot) const {
    return {static_cast<std::uint32_t>(robot / kBlockRobots), static_cast<std::uint32_t>(robot % kBlockRobots)};
  }
  [[nodiscard]] std::uint64_t within(std::size_t word) const {
    const std::size_t after = robots_ - (std::min)(robots_, word * 64);
    return after >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << after) - 1;
  }
  [[nodiscard]] const std::uint64_t* there(std::uint32_t block) const { return block + 1 == memory_.blocks() ? last_robots_ : kAllRobots; }
  [[nodiscard]] const Alone* alone_at(FleetPlace at) const {
    for (const auto& alone : blocks_[at.block].alone) {
      if (alone->lane == at.lane) return alone.get();
    }
    return nullptr;
  }
  [[nodiscard]] const float* weight(FleetPlace at, std::uint32_t fact) const {
    const std::uint32_t w = layout_.facts[fact].weight;
    return w == kNoPlane ? nullptr : &weights_[(std::size_t{at.block} * layout_.weights + w) * kBlockRobots + at.lane];
  }
  [[nodiscard]] LanePort<K> port() { return {layout_, memory_, clock_, stamp_bits_.data()}; }
  [[nodiscard]] std::uint32_t dispatched(FleetPlace at) const;
  [[nodiscard]] bool active(FleetPlace at) const;
  /// The status if nothing is wrong, as `driving` of a mind's state.
  [[nodiscard]] Status driving(FleetPlace at) const;
  [[nodiscard]] std::uint32_t bad_facts(FleetPlace at) const;
  [[nodiscard]] float value_before(FleetPlace at, std::uint32_t satellite, bool before) const;
  [[nodiscard]] RobotTick<K> read_alone(const Alone& alone) const;
  static std::vector<std::uint32_t> durations();

  std::size_t robots_;
  const FleetTables& layout_;
  const FleetKernels& kernels_;
  FleetKernel kernel_;
  bool traced_, can_rest_;
  FleetClock clock_;
  FleetMemory memory_;
  std::vector<std::uint32_t> stamp_bits_;   // by queue
  std::vector<Give> gives_;                 // by fact
  std::vector<std::uint32_t> gives_begin_{0};
  std::vector<float> weights_;              // by block, fact, robot
  std::vector<Block> blocks_;
  FleetTick now_;
  std::vector<FleetQueue> queues_;
  std::uint32_t dt_us_ = 0;
  alignas(kPlaneBytes) std::uint64_t last_robots_[kPlaneWords];   // which robots of the last block there are
};

}  // namespace mts

#include "fleet_read.h"
#include "fleet_tick.h"
