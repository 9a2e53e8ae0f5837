// A trial: one knowledge base and one robot in a world, and the questions that every scenario asks at the end.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/world/simulation.h"

namespace kb::world {

/// What a scenario found to be wrong, in words; empty if all was as it should be.
using Finding = std::string;

/// Everything that went into a mind and came out of it.
struct Recording {
  struct Row { std::int64_t time_us = 0; std::vector<float> facts; };
  std::shared_ptr<const Knowledge> knowledge;
  std::vector<Row> rows;
  std::vector<program::Tick> ticks;
};

/// How the scenarios are to be run.
struct Setting {
  MindKind mind = MindKind::kBoth;
  Recording* recording = nullptr;   ///< if given: holds what the scenario's last trial did
};

struct WorldOptions {
  ArrivalSeen arrival_seen = ArrivalSeen::kBoth;
  MemoryRead memory_read = MemoryRead::kOnLine;
  double length_m = 2.4;            ///< of every road
};

class Trial {
 public:
  /// `text` follows `import std.navigation`.
  Trial(const Setting& setting, std::string_view text, WorldOptions options = {});

  /// Puts the robot 1.2 m before the end of the road that leaves `LM1.S`, or `s_m` behind its beginning.
  Trial& at(std::string_view edge);
  Trial& at(std::string_view edge, double s_m);
  Trial& disturb(Simulation::Disturbance disturbance);
  /// Power-up, then the command; drives until the mission has ended or `until` holds.
  bool go(int ticks = 3000, const Simulation::Until& until = {}, std::string_view command = "Start1");
  void wait(int ticks);

  [[nodiscard]] World& world() { return sim_->world; }
  [[nodiscard]] Road& road(std::string_view edge) { return world().map.road(world().map.edge(edge)); }
  [[nodiscard]] Landmark& landmark(std::string_view name) { return world().map[world().map.landmark(name)]; }
  /// Puts an obstacle `at_m` behind the beginning of a road.
  void block(std::string_view edge, double at_m, bool passable = true);
  [[nodiscard]] Simulation& sim() { return *sim_; }
  [[nodiscard]] Mind& mind() { return *mind_; }
  [[nodiscard]] const Knowledge& knowledge() const { return *knowledge_; }

  /// Five ticks later: the mission has ended, the way was `way`, there was no accident, conflict, second strategy or
  /// broken promise, the robot stands at the last sign, and every satellite has its initial value.
  [[nodiscard]] Finding drove(std::string_view way);
  /// The satellites that do not have their initial value.
  [[nodiscard]] std::string left_over() const;
  /// The first accident; empty if there was none.
  [[nodiscard]] Finding accident() const;

 private:
  std::shared_ptr<const Knowledge> knowledge_;
  std::unique_ptr<Mind> mind_;
  std::unique_ptr<Simulation> sim_;
};

/// Nothing if `holds`, else `otherwise`.
[[nodiscard]] Finding expect(bool holds, std::string_view otherwise);
/// The findings that are not empty, joined.
[[nodiscard]] Finding all_of(std::initializer_list<Finding> findings);

// ---- the experiment's map and mission
/// The labyrinth of the examples, and Route1 on it.
[[nodiscard]] const std::string& labyrinth();
inline constexpr std::string_view kRoute1 =
    "command Start1\nroute Route1 on Labyrinth by Start1: LM5 -> LM2 -> LM3 -> LM6 -> LM7 -> LM13 -> LM15\n";
inline constexpr std::string_view kRoute1Way = "LM5.W LM2.S LM3.E LM6.S LM7.E LM13.E";
/// Route1 with `extra` declarations, the robot before LM5 on the road from LM1.
[[nodiscard]] Trial route1(const Setting& setting, std::string_view extra = "", WorldOptions options = {});
/// `command Go`, and a route on the labyrinth by it.
[[nodiscard]] std::string labyrinth_route(std::string_view stops);

}  // namespace kb::world
