// The closed loop: world -> senses -> mind -> strategy -> world.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/world/drive.h"
#include "tests/world/facts.h"
#include "tests/world/mind.h"
#include "tests/world/promises.h"
#include "tests/world/sense.h"
#include "tests/world/world.h"

namespace kb::world {

class Simulation {
 public:
  /// May change what is sensed, or the world, before the mind ticks.
  using Disturbance = std::function<void(Simulation&, Readings&)>;
  using Until = std::function<bool(const Simulation&)>;
  /// Sees what the mind got and what it decided.
  using Observer = std::function<void(std::span<const float> facts, std::uint32_t dt_us, const program::Tick&)>;

  /// A step of the trace that is kept.
  struct Step { program::Tick tick; Pose pose; };

  Simulation(const Knowledge& knowledge, Mind& mind, World world);

  World world;
  std::vector<Disturbance> disturbances;
  Observer observer;
  std::int64_t dt_ms = 100;
  bool keep_trace = true;

  /// From the next tick on, for `ticks` ticks.
  void press(std::string_view button, int ticks = 1) { pressed_.push_back({std::string(button), ticks}); }
  const program::Tick& tick();
  /// Until the mission has ended or `until` holds; false if neither happened within `ticks`.
  bool run(int ticks, const Until& until = {});
  /// Forgets what was driven and seen, for a second mission in the same world.
  void begin_again();

  [[nodiscard]] const Knowledge& knowledge() const { return knowledge_; }
  [[nodiscard]] Mind& mind() { return mind_; }
  [[nodiscard]] bool high(program::CellId cell) const;
  [[nodiscard]] bool high(std::string_view cell) const { return high(knowledge_.cell(cell)); }
  /// Ticks so far.
  [[nodiscard]] int ticks() const { return ticks_; }
  /// The strategy that runs; empty for none.
  [[nodiscard]] std::string_view strategy() const { return strategy_name(last_.strategy); }
  [[nodiscard]] std::string_view strategy_name(program::CellId strategy) const;
  [[nodiscard]] const std::vector<Step>& trace() const { return trace_; }
  /// Whether a strategy ran on any tick so far.
  [[nodiscard]] bool ever_ran(std::string_view strategy) const;
  [[nodiscard]] bool started() const { return started_; }
  [[nodiscard]] bool ended() const { return ended_; }
  /// What the robot reports now: `lost`, `refused`, `no_track`, `blocked`, `astray`, joined by spaces.
  [[nodiscard]] std::string help() const;
  [[nodiscard]] int conflicts() const { return conflicts_; }
  void forget_conflicts() { conflicts_ = 0; }
  /// Ticks with more than one active strategy.
  [[nodiscard]] int overlaps() const { return overlaps_; }
  /// The first promise of the library that a tick broke; empty if none.
  [[nodiscard]] const std::string& broken_promise() const { return broken_promise_; }

 private:
  struct Button { std::string name; int ticks = 0; };
  void push_buttons(Readings& now);
  void judge(const program::Tick& tick);

  const Knowledge& knowledge_;
  Mind& mind_;
  FactMap facts_;
  Promises promises_;
  std::vector<Action> actions_;   // by strategy
  std::vector<Button> pressed_;
  std::vector<Step> trace_;
  program::Tick last_;
  std::vector<bool> ran_;         // by strategy
  int ticks_ = 0, conflicts_ = 0, overlaps_ = 0;
  bool started_ = false, ended_ = false;
  std::string broken_promise_;
};

}  // namespace kb::world
