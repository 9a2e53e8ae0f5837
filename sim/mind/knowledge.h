// What a drive needs of a compiled knowledge base: the cells of facts, the controllers of strategies, the satellites of legs. Made
// once, used by any number of drives.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <waymark/controllers/any_controller.h>
#include "compiler/diagnostics/diagnostics.h"
#include "compiler/model/model.h"
#include "compiler/model/standard_names.h"
#include "compiler/program/program.h"
#include "compiler/tables/image.h"
#include "compiler/tables/perception.h"
#include "compiler/tables/tables.h"
#include "sim/mind/speed_limits.h"

namespace kb::sim {

/// What a strategy means to the judge of a drive.
enum class Doing : std::uint8_t { kOther, kMove, kCross };

struct Strategy {
  program::CellId cell = program::CellId::kNone;
  std::string name;
  Doing doing = Doing::kOther;
  std::string method;                 ///< `Move[k]`, `Cross[t, k]`: k
  std::string turn;                   ///< `Cross[t, k]`, `Grope[t]`: t
  mts::ControllerId controller = mts::ControllerId::kStand;
  struct Setting {
    std::string name, word, unit;     ///< `word`: empty if it is a number
    float number = 0.0f;
  };
  std::vector<Setting> settings;      ///< what the control line sets
  const program::Control* control = nullptr;   ///< the control line; null: it has none

  /// Whether it follows a road, or a way through a crossing.
  [[nodiscard]] bool drives() const { return doing == Doing::kMove || doing == Doing::kCross; }
};

/// The controller that drives while it runs, as a control line names it: `follow_line`.
[[nodiscard]] std::string_view controller_name(const Strategy& strategy);

struct Leg {
  program::CellId cell = program::CellId::kNone;
  std::string name{}, from{}, exit{}, to{};   ///< landmarks, and the side of `from` by which it leaves; both are empty for the first of a route
  bool detour = false;                ///< it belongs to a detour or a retreat
  bool last = false;                  ///< it ends its route
  program::CellId sight = program::CellId::kNone;   ///< the fact of its landmark `to`
};

/// The mission that a command starts: a route, which ends at a landmark.
struct Mission {
  program::CellId command = program::CellId::kNone;
  std::string goal;
};

/// The elements of a `sensor` that the robot has too: the first reading, and how many.
struct SensorFeed {
  enum class What : std::uint8_t { kLine, kRange, kCompass, kTag, kMemory, kSpeed } what{};
  std::uint32_t first = 0, count = 1;
};

struct Knowledge {
  const program::Program* program = nullptr;
  const tables::Tables* tables = nullptr;
  const tables::LoadedImage* image = nullptr;   ///< the image of the same, on which a mind runs that is to take another; null: it runs on the tables
  std::vector<program::CellId> perceived;   ///< the facts of the standard library that a driver supplies: see lookout.h
  std::vector<program::CellRun> landmarks;  ///< of all maps; among those
  std::vector<std::string_view> methods;    ///< by which a crossing can be driven: `mark` for `CrossBy.mark`
  std::vector<Strategy> strategies;   ///< by the program's order of strategies
  std::vector<Leg> legs;
  std::vector<program::CellId> routes, reports, outputs;   ///< satellites of routes; `Help.*`; those declared `output`
  std::vector<Mission> missions;      ///< of the routes
  SpeedLimits limits;                 ///< of the roads
  std::vector<SensorFeed> feeds;
  std::optional<tables::PerceptionForm> perception;   ///< if the knowledge base perceives anything itself

  [[nodiscard]] program::CellId find(std::string_view cell) const;
};

/// Whether a mind that runs on `now` can continue on `next`: both have images, and the same facts and strategies with the same
/// controllers. O(program).
[[nodiscard]] bool can_take(const Knowledge& now, const Knowledge& next);

/// Reports (KB13xx) strategies that nothing can drive and control lines that make no sense; `library`, if not
/// null, is asked which import brings a controller. `stubs` names controllers that only the program on the robot has, if the command
/// allows any: the robot stands while they would drive; a stub that no control line names is reported. `program` and `tables` must
/// outlive the result. O(program).
[[nodiscard]] std::optional<Knowledge> prepare(const model::Model& model, const program::Program& program, const tables::Tables& tables,
                                               diagnostics::Diagnostics& diagnostics, model::StandardNames* library = nullptr,
                                               const std::vector<std::string>* stubs = nullptr);

/// How many elements of a sensor, the first ones, the robot has itself: see Knowledge::feeds.
[[nodiscard]] std::uint32_t elements_of_robot(const Knowledge& knowledge, const program::Sensor& sensor);

/// Warns of sensors, or elements of arrays, that the simulated robot does not have.
void report_lacking_sensors(const Knowledge& knowledge, diagnostics::Diagnostics& diagnostics);

}  // namespace kb::sim
