// What drives in the simulator stand on: a knowledge base compiled, its map laid out, once for any number of drives.
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

struct DriveGround {
  std::unique_ptr<driver::Compilation> compiled;
  std::optional<planners::MapFile> background;
  std::optional<sim::Labyrinth> labyrinth;
  std::optional<sim::Knowledge> knowledge;
  std::uint32_t dt_us = 100'000;    ///< of a tick of the mind

  /// Reads a scenario file, or makes the plain scenario if `path` is empty. Nothing if it is wrong (reported).
  [[nodiscard]] std::optional<sim::Scenario> scenario(const std::string& path, Session& session, diagnostics::Diagnostics& messages);
};
/// Null if anything is wrong (reported). It does not move: the labyrinth and the knowledge point into it.
[[nodiscard]] std::unique_ptr<DriveGround> prepare_ground(const GroundOptions& options, Session& session);

}  // namespace kb::cli
