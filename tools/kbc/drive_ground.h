// What drives in the simulator stand on: a knowledge base compiled once, and a floor for each scenario.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "planners/maps/maps.h"
#include "sim/mind/knowledge.h"
#include "sim/scenario/scenario.h"
#include "tools/kbc/support.h"

namespace CLI { class App; }

namespace kb::cli {

/// The options that `kbc sim` and `kbc fleet` share.
struct GroundOptions {
  std::string file, background, dt;
  std::optional<double> scale;
};
/// Declares FILE, --scale, --background and --dt. `options` must outlive the app.
void add_ground_options(CLI::App& app, GroundOptions& options);

/// A scenario and the floor that it happens on: halls that it furnishes are part of the floor.
struct Scene {
  std::unique_ptr<sim::Labyrinth> labyrinth;
  sim::Scenario scenario;
};

struct DriveGround {
  std::unique_ptr<driver::Compilation> compiled;
  std::optional<planners::MapFile> background;
  std::optional<double> scale;
  std::optional<sim::Knowledge> knowledge;   ///< once the first scene is there
  std::uint32_t dt_us = 100'000;             ///< of a tick of the mind

  /// Reads a scenario file, or makes the plain scenario if `path` is empty, and lays the floor out. Nothing if anything is wrong
  /// (reported).
  [[nodiscard]] std::optional<Scene> scene(const std::string& path, Session& session, diagnostics::Diagnostics& messages);
};
/// Null if anything is wrong (reported). It must outlive the scenes and does not move.
[[nodiscard]] std::unique_ptr<DriveGround> prepare_ground(const GroundOptions& options, Session& session);

}  // namespace kb::cli
