// The robot's own head, from senses to wheels: `mts::Lookout` perceives, the compiled mind decides, `mts::Pilot` drives, as in a C++ program of its own.
// The simulator and `kbc drive` use it.
//
// note [order of a tick]
// Every control period the head reads its senses and commands the wheels. Every tick the mind gets the facts of the last period; the
// strategy that it chooses drives from the next period on.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <waymark/controllers/lookout.h>
#include <waymark/controllers/pilot.h>

#include "sim/mind/control_lines.h"
#include "sim/mind/hall_host.h"
#include "sim/mind/map_roads.h"
#include "sim/mind/mind.h"
#include "sim/robot/sensors.h"

namespace kb::sim {

inline constexpr std::int64_t kControlUs = 20'000;   ///< the simulator's control period; rates are computed with it

/// A body as its controllers must know it, which includes the latency of its range finders and the lag of its motors.
[[nodiscard]] mts::Body as_driven(mts::Body body, const SensorBuild& range, const DriveLimits& drive);

/// Where a robot is, by the names of the map.
struct MapPlace {
  std::string landmark, exit;   ///< on the road that leaves that landmark by that exit; without an exit: in its crossing, or before it
  double along_m = 0.0;         ///< from the landmark
  bool outwards = true;         ///< it faces away from it
};

/// The facts of a knowledge base that is known only now, as `mts::Lookout` wants them.
struct FactsByName {
  using Facts = std::vector<float>;
  struct FindRoad {
    const MapRoads* roads = nullptr;
    explicit operator bool() const { return roads != nullptr; }
    const mts::MapRoad* operator()(const char* landmark, const char* exit) const { return roads->find(landmark, exit); }
  };
  const std::vector<std::string>* names = nullptr;

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(names->size()); }
  [[nodiscard]] const char* name_of(std::uint32_t fact) const { return (*names)[fact].c_str(); }
  [[nodiscard]] static float get(const Facts& facts, std::uint32_t fact) { return facts[fact]; }
  static void set(Facts& facts, std::uint32_t fact, float certainty) { facts[fact] = certainty; }
};

class Driver {
 public:
  /// `knowledge` and `labyrinth`, its floor, must outlive it. `body`: see as_driven.
  Driver(const Knowledge& knowledge, const Labyrinth& labyrinth, const mts::Body& body);
  Driver(const Driver&) = delete;   // its parts point to each other

  /// One control period: takes the senses as read, returns the motion for the wheels, within the limit of the road. `measured`: the darknesses were
  /// computed from a measured line, and may stay the same for metres although the sensor works.
  [[nodiscard]] mts::Motion hear(const mts::Senses& senses, const TagHeard& tag, float period_s, bool measured = false);
  /// Another knowledge base between two ticks: see Mind::take. It must outlive the driver, and so must the first one; those between need not.
  void take(const Knowledge& next);
  /// Whether the robot is never carried between two missions: then it keeps its place on a road, or in a crossing.
  void keep_place(bool keeps) { lookout_.keep_place(keeps); }
  /// It may be anywhere: somebody drives or carries it. To be called each period meanwhile.
  void forget_place() { lookout_.forget_place(pilot_); }
  /// An operator places it `along_m` from `landmark` on the road that leaves it by `exit`, in the middle, facing away from it.
  void put(std::string_view landmark, std::string_view exit, double along_m);
  /// One tick of the mind.
  const program::Tick& tick(std::int64_t now_us, std::uint32_t dt_us);
  [[nodiscard]] Mind& mind() { return mind_; }
  [[nodiscard]] const Mind& mind() const { return mind_; }

  /// The senses of the last period, as read.
  [[nodiscard]] const mts::Senses& senses() const { return senses_; }
  /// The current leg; null if there is none.
  [[nodiscard]] const Leg* leg() const;
  /// Where it is, by signs and wheels: on a road that the map has, and near a sign that it has just read, to the reach of its reader. A place
  /// without an exit is in that landmark's crossing. Nothing until a sign is read. A robot without a compass is taken to face the landmark.
  [[nodiscard]] std::optional<MapPlace> place() const;
  /// Whether it is past the stop line of a crossing and not out of it yet: the sign of its exit may have been read already, but not its line.
  [[nodiscard]] bool in_crossing() const { return pilot_.in_crossing(); }
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
  /// The present road, or in a crossing that by which the robot came, by the names of an end; nothing if it is unknown.
  [[nodiscard]] std::optional<RoadEnd> came_by() const;
  [[nodiscard]] float limit_m_s();
  [[nodiscard]] const mts::MapRoad* road_of_leg() const;
  [[nodiscard]] std::optional<MapPlace> place_by_sign() const;
  void read(const TagHeard& tag);
  [[nodiscard]] const std::string* tag_text() const;
  [[nodiscard]] const std::string* memory_text();
  [[nodiscard]] std::vector<std::string> high_of(const std::vector<program::CellId>& satellites) const;

  const Knowledge* knowledge_;    // the mind's present one; what perceives and drives keeps the first
  MapRoads roads_;
  ControlLines lines_;
  std::vector<std::string> names_;   // of facts
  std::vector<mts::FactRun> landmarks_;
  HallHost halls_;
  const mts::Body body_;          // the robot's own
  mts::Pilot pilot_;
  mts::Lookout<Knowledge, FactsByName> lookout_;
  Mind mind_;
  mts::Senses senses_;            // as read
  std::shared_ptr<const Memory> memory_;   // of the sign that was read last
  std::string closed_, cross_by_;          // what that says
  mts::Sign sign_;
  std::vector<float> perceived_;  // facts
  std::string memory_text_;
  int strategy_ = -1;
  SpeedLimits kept_;              // of the road that it was on when it took its knowledge base: an order's edge ends at its node, not before
};

}  // namespace kb::sim
