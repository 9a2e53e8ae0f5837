// The robot's own head, from senses to wheels: what makes the facts of the standard library, the compiled mind, and the controllers.
// The simulator and `kbc drive` have the same.
//
// note [order of a tick]
// Every control period the head hears its senses and says what the wheels are to do. Every tick the mind is told the facts of the last
// period, and the strategy that it chooses drives from the next period on.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <waymark/controllers/similarity.h>
#include <waymark/controllers/steady_ranges.h>

#include "sim/mind/mind.h"
#include "sim/mind/perception.h"
#include "sim/mind/pilot.h"
#include "sim/mind/road_ahead.h"
#include "sim/mind/small_memories.h"

namespace kb::sim {

inline constexpr std::int64_t kControlUs = 20'000;   ///< the control period that the simulator has, and that rates are reckoned with

/// A body as its controllers have to know it: how late its range finders are heard, and its motors follow, is part of how it is built.
[[nodiscard]] mts::Body as_driven(mts::Body body, const SensorBuild& range, const DriveLimits& drive);

class Driver {
 public:
  /// `knowledge` must outlive it. `body`: see as_driven.
  Driver(const Knowledge& knowledge, const mts::Body& body)
      : knowledge_(&knowledge), as_(body.size), memories_(static_cast<double>(body.size)), perception_(knowledge.facts, as_.in(body)), pilot_(knowledge, body), mind_(knowledge) {}

  /// One control period: what the sensors say, as it is read; what the wheels are to do. `measured`: see Perception::hear.
  [[nodiscard]] mts::Motion hear(const mts::Senses& senses, const TagHeard& tag, float period_s, bool measured = false);
  /// Another knowledge base between two ticks: see Mind::take. It must outlive the driver, as the first one must; those between need not.
  void take(const Knowledge& next);
  /// See Perception::keep_place.
  void keep_place(bool keeps) { perception_.keep_place(keeps); }
  /// See Perception::put; metres of this robot's floor.
  void put(const std::shared_ptr<const Memory>& memory, std::uint32_t exit, double along_m);
  /// One tick of the mind.
  const program::Tick& tick(std::int64_t now_us, std::uint32_t dt_us);
  [[nodiscard]] Mind& mind() { return mind_; }
  [[nodiscard]] const Mind& mind() const { return mind_; }

  /// What was heard last, as it was read.
  [[nodiscard]] const mts::Senses& senses() const { return senses_; }
  /// The leg that is current; null: none.
  [[nodiscard]] const Leg* leg() const;
  /// Where it is by what signs and wheels say. Without an exit: in that landmark's crossing, or before it. Nothing: no sign has told.
  [[nodiscard]] std::optional<MapPlace> place() const;
  /// See Perception::in_crossing.
  [[nodiscard]] bool in_crossing() const { return perception_.in_crossing(); }
  /// What drives; null: nothing does.
  [[nodiscard]] const Strategy* strategy() const;
  /// The route in hand; kNone: it is on no mission.
  [[nodiscard]] program::CellId mission() const;
  [[nodiscard]] bool on_mission() const { return mission() != program::CellId::kNone; }
  /// `Help.lost`: those that are high.
  [[nodiscard]] std::vector<std::string> reports() const;
  [[nodiscard]] bool reports_any() const;
  [[nodiscard]] mts::Plight plight() const { return pilot_.plight(); }
  /// What drives has lost what it follows, or has driven all of it, and stands.
  [[nodiscard]] bool lost() const { return pilot_.lost(); }

 private:
  const Knowledge* knowledge_;    // that the mind has now; perception and controllers keep to the first
  mts::Similarity as_;            // perception and controllers know robots of size 1
  mts::Senses senses_, steady_;   // as they are read; for those two
  SmallMemories memories_;
  mts::SteadyRanges steadied_;
  Perception perception_;
  Pilot pilot_;
  Mind mind_;
};

}  // namespace kb::sim
