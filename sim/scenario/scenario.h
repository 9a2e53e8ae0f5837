// What happens in a drive: where it begins, what is pressed, what goes wrong and when. Names are resolved already. The file
// format (TOML) is described in docs/simulator.md and read by read_scenario.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"
#include "sim/mind/knowledge.h"
#include "sim/robot/sensors.h"
#include "sim/world/floor.h"

namespace kb::sim {

/// When an event happens: once, `delay_s` after the first moment at which this holds.
struct Trigger {
  enum class Kind : std::uint8_t {
    kTime,       ///< the clock says `time_s`
    kPlace,      ///< the robot is on `road`, `along_m` past the stop line where it begins, and drives as `going` says
    kCrossing,   ///< the robot is inside `crossing`
    kFact,       ///< the fact `cell` is seen
    kCell,       ///< the satellite `cell` is high (any, or a leg), or the strategy `cell` runs
  } kind{};
  double time_s = 0.0;
  RoadId road = RoadId::kNone;
  CrossingId crossing = CrossingId::kNone;
  double along_m = 0.0;
  enum class Going : std::uint8_t { kAnyWay, kOut, kBack } going = Going::kAnyWay;   ///< away from the road's beginning; towards it
  std::vector<program::CellId> cells;   ///< any of them: a leg named by its landmarks may be several rows
  double delay_s = 0.0;
};

struct Action {
  enum class Kind : std::uint8_t {
    kPress,                          ///< `cell` is certain for two ticks, or, if `held`, until kRelease: a command, `Abort`, `Resume`, a switch
    kRelease,
    kClose, kOpen,                   ///< `road`
    kUnsafe, kSafe,                  ///< `crossing`
    kObstacle, kMove, kRemove,       ///< `obstacle`; kMove within `amount` seconds
    kWear, kMend,                    ///< the marking of `road` from `from_m` to `to_m`
    kTag,                            ///< of `arm` at `crossing`: `tag`, and `instead`
    kSensor,                         ///< `sensor`, `element`, `fault`, `amount`
    kKidnap,                         ///< to `pose`
    kSteel, kNoSteel,                ///< `obstacle`, which turns the compass by `amount` degrees
    kPowerOff, kPowerOn,
  } kind{};
  program::CellId cell = program::CellId::kNone;
  bool held = false;
  RoadId road = RoadId::kNone;
  CrossingId crossing = CrossingId::kNone;
  std::uint32_t arm = 0;
  Obstacle obstacle;
  double from_m = 0.0, to_m = 0.0;
  Floor::TagState tag = Floor::TagState::kWell;
  CrossingId instead = CrossingId::kNone;
  SensorId sensor{};
  std::optional<std::uint32_t> element;
  Fault fault = Fault::kNone;
  double amount = 1.0;
  Pose pose;
  Floor::Cause cause = Floor::kNobody;   ///< shared by an action that ends later and the action that ends it
};

/// Whether the action restores its thing to how it was at the beginning; such an action has none that ends it.
[[nodiscard]] bool restores(const Action& action);

struct Event {
  Trigger when;
  Action action;
  std::optional<Action> undo;     ///< what ends it, `lasts_s` later
  double lasts_s = 0.0;
  std::string text;               ///< for people: `road LM7.E closed`
  std::string undo_text;
  source::Span at;                ///< where it is written
};

/// The methods of a crossing that differs from the others.
struct CrossingMethods { CrossingId crossing{}; std::vector<std::string> methods; };

struct Scenario {
  std::string title;
  std::uint64_t seed = 1;
  double limit_s = 300.0;
  Pose start;
  std::vector<Event> events;
  std::vector<CrossingMethods> crossings;
  SensorBuilds sensors;
  /// Of the labyrinth's size, with the floor's paint. Controllers, perception and sensors use it; the world uses its radius.
  mts::Body body = kRobot;
  DriveLimits drive;              ///< of the same robot
  /// Its missions come from elsewhere: only buttons that it names are pressed, and it ends at its limit or when its driver leaves.
  bool open_end = false;
};

/// Where the missions come from.
enum class MissionsBy : std::uint8_t {
  kRoutes,   ///< the knowledge base
  kDriver,   ///< its routes or, if it has none, the driver: then the drive has an open end, and must say where it starts
};

/// Values that override those of a scenario file or are added to them: texts `sensors.range.noise = 0.2`, as made by Setting::toml.
using Settings = std::span<const source::FileId>;

/// What a scenario file says of the floor. Nothing if the file is not TOML or is wrong there (reported).
[[nodiscard]] std::optional<FloorBuild> read_floor(source::FileId file, Settings settings, diagnostics::Diagnostics& diagnostics);
/// Reads a scenario file. All things that it names must exist. Errors are reported (KB132x), and nothing is returned then.
[[nodiscard]] std::optional<Scenario> read_scenario(source::FileId file, Settings settings, const Labyrinth& labyrinth, const Knowledge& knowledge,
                                                    const model::Model& model, diagnostics::Diagnostics& diagnostics, MissionsBy by = MissionsBy::kRoutes);
/// Reads what such a file says of the robot: `[robot]`, `[sensors]`, `[[crossing]]`. What it says of a drive is ignored.
[[nodiscard]] std::optional<Scenario> read_robot(source::FileId file, Settings settings, const Labyrinth& labyrinth, const Knowledge& knowledge,
                                                 diagnostics::Diagnostics& diagnostics);
/// Nothing goes wrong: the first command is pressed after a second, and the robot stands on the road to the first landmark of
/// its route. Nothing is returned if there is no route (reported).
[[nodiscard]] std::optional<Scenario> plain_scenario(const Labyrinth& labyrinth, const Knowledge& knowledge, const model::Model& model,
                                                     diagnostics::Diagnostics& diagnostics, MissionsBy by = MissionsBy::kRoutes);

}  // namespace kb::sim
