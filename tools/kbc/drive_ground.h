// The basis of drives in the simulator: a knowledge base compiled once, and a floor for each scenario.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planners/maps/maps.h"
#include "sim/mind/knowledge.h"
#include "sim/scenario/scenario.h"
#include "sim/scenario/setting.h"
#include "tools/kbc/support.h"

namespace CLI { class App; }

namespace kb::cli {

/// The options that `kbc sim`, `kbc fleet` and `kbc drive` share.
struct GroundOptions {
  std::string file, background, dt;
  std::vector<std::string> set;   ///< see sim::read_sweep
  std::vector<std::string> stub;  ///< controllers for which the robot stands
  std::optional<double> scale;
};
/// Declares FILE, --scale, --background, --dt, --set and --stub. `options` must outlive the app.
void add_ground_options(CLI::App& app, GroundOptions& options);
void add_set_option(CLI::App& app, std::vector<std::string>& set);

/// Each combination of the values given with --set. Nothing (reported) if a key is there twice, there are too many, or `refused` objects
/// to a key; it returns what to do instead.
[[nodiscard]] std::optional<sim::Combinations> combinations(const std::vector<std::string>& set,
                                                            const std::function<std::string(std::string_view key)>& refused, Session& session);

/// The settings of --set if each key has one value; nothing otherwise (reported).
[[nodiscard]] std::optional<std::vector<sim::Setting>> one_setting(const std::vector<std::string>& set, Session& session);

/// Whether `count` seeds or scenarios (`what`), each driven `each` times, are few enough for one command. Reported if not.
[[nodiscard]] bool are_few_enough(std::uint64_t count, std::string_view what, std::uint64_t each, Session& session);

/// A scenario and the floor that it happens on: halls that it furnishes are part of the floor.
struct Scene {
  std::unique_ptr<sim::Labyrinth> labyrinth;
  sim::Scenario scenario;
};

struct DriveGround {
  std::unique_ptr<driver::Compilation> compiled;
  std::optional<planners::MapFile> background;
  std::optional<double> scale;
  std::optional<sim::Knowledge> knowledge;   ///< set with the first scene
  std::uint32_t dt_us = 100'000;             ///< of a tick of the mind
  std::vector<std::string> stub;             ///< controllers for which the robot stands

  /// Reads a scenario file, or makes the plain scenario if `path` is empty, and lays out the floor. Nothing if anything is wrong
  /// (reported).
  [[nodiscard]] std::optional<Scene> scene(const std::string& path, const std::vector<sim::Setting>& settings, Session& session, diagnostics::Diagnostics& messages,
                                           sim::MissionsBy by = sim::MissionsBy::kRoutes);
  /// The same floor, but only the robot of the scenario; the usual robot if `path` is empty.
  [[nodiscard]] std::optional<Scene> robot(const std::string& path, const std::vector<sim::Setting>& settings, Session& session, diagnostics::Diagnostics& messages);

 private:
  struct Script {
    std::vector<source::FileId> settings;
    std::optional<source::FileId> file;
  };
  /// Opens `path` as the script's file. Null if anything is wrong (reported).
  [[nodiscard]] std::unique_ptr<sim::Labyrinth> floor(const std::string& path, Script& script, Session& session, diagnostics::Diagnostics& messages);
};
/// Compiles the knowledge base. Null if anything is wrong (reported). The result must outlive the scenes and does not move.
[[nodiscard]] std::unique_ptr<DriveGround> prepare_ground(const GroundOptions& options, Session& session);
/// The same for a knowledge base that was compiled already, by any means.
[[nodiscard]] std::unique_ptr<DriveGround> prepare_ground(const GroundOptions& options, std::unique_ptr<driver::Compilation> compiled, Session& session);

}  // namespace kb::cli
