// The robot's own head, from senses to wheels: the perception of the standard library's facts, the compiled mind, and the controllers.
// The simulator and `kbc drive` use the same code.
//
// note [order of a tick]
// Every control period the head reads its senses and commands the wheels. Every tick the mind gets the facts of the last period; the
// strategy that it chooses drives from the next period on.
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

inline constexpr std::int64_t kControlUs = 20'000;   ///< the simulator's control period; rates are computed with it

/// A body as its controllers must know it, which includes the latency of its range finders and the lag of its motors.
[[nodiscard]] mts::Body as_driven(mts::Body body, const SensorBuild& range, const DriveLimits& drive);

class Driver {
 public:
  /// `knowledge` must outlive it. `body`: see as_driven.
  Driver(const Knowledge& knowledge, const mts::Body& body)
      : knowledge_(&knowledge), as_(body.size), memories_(static_cast<double>(body.size)), perception_(knowledge.facts, as_.in(body)), pilot_(knowledge, body), mind_(knowledge) {}

  /// One control period: takes the senses as read, returns the motion for the wheels, within the limit of the road. `measured`: see Perception::hear.
  [[nodiscard]] mts::Motion hear(const mts::Senses& senses, const TagHeard& tag, float period_s, bool measured = false);
  /// Another knowledge base between two ticks: see Mind::take. It must outlive the driver, and so must the first one; those between need not.
  void take(const Knowledge& next);
  /// See Perception::keep_place.
  void keep_place(bool keeps) { perception_.keep_place(keeps); }
  /// See Perception::put; metres of this robot's floor.
  void put(const std::shared_ptr<const Memory>& memory, std::uint32_t exit, double along_m);
  /// One tick of the mind.
  const program::Tick& tick(std::int64_t now_us, std::uint32_t dt_us);
  [[nodiscard]] Mind& mind() { return mind_; }
  [[nodiscard]] const Mind& mind() const { return mind_; }

  /// The senses of the last period, as read.
  [[nodiscard]] const mts::Senses& senses() const { return senses_; }
  /// The current leg; null if there is none.
  [[nodiscard]] const Leg* leg() const;
  /// Where it is, by signs and wheels. A place without an exit is in that landmark's crossing, or before it. Nothing until a sign is read.
  [[nodiscard]] std::optional<MapPlace> place() const;
  /// See Perception::in_crossing.
  [[nodiscard]] bool in_crossing() const { return perception_.in_crossing(); }
  /// The strategy that drives; null if none does.
  [[nodiscard]] const Strategy* strategy() const;
  /// The route in hand; kNone if it is on no mission.
  [[nodiscard]] program::CellId mission() const;
  [[nodiscard]] bool on_mission() const { return mission() != program::CellId::kNone; }
  /// The reports that are high: `Help.lost`.
  [[nodiscard]] std::vector<std::string> reports() const { return high_of(knowledge_->reports); }
  [[nodiscard]] bool reports_any() const;
  /// The satellites declared `output` that are high.
  [[nodiscard]] std::vector<std::string> outputs() const { return high_of(knowledge_->outputs); }
  [[nodiscard]] mts::Plight plight() const { return pilot_.plight(); }
  /// Whether the controller has lost what it follows, or has driven all of it, and stands.
  [[nodiscard]] bool lost() const { return pilot_.lost(); }

 private:
  [[nodiscard]] float limit_m_s();
  [[nodiscard]] std::vector<std::string> high_of(const std::vector<program::CellId>& satellites) const;
  const Knowledge* knowledge_;    // the mind's present one; perception and controllers keep the first
  mts::Similarity as_;            // perception and controllers know robots of size 1
  mts::Senses senses_, steady_;   // as read; for perception and controllers
  SmallMemories memories_;
  mts::SteadyRanges steadied_;
  Perception perception_;
  Pilot pilot_;
  Mind mind_;
  SpeedLimits kept_;              // of the road that it was on when it took its knowledge base: an order's edge ends at its node, not before
};

}  // namespace kb::sim
