// One labyrinth with one route over it: compiled, laid out, ready for any number of drives.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "compiler/driver/compile.h"
#include "sim/drive/drive.h"
#include "sim/experiment/sketch.h"
#include "sim/experiment/way.h"
#include "sim/scenario/setting.h"

namespace kb::sim::experiment {

/// What a mission of the experiment imports if no user's file says how to drive.
inline constexpr std::string_view kRules = "import std.navigation\nimport std.recover\n";

/// The text of a knowledge base: the map, a route over its landmarks by the given exits, and the rules. These are imported from the
/// file `mind` or, if that is empty, are the standard library's, with detours on all of the route and controllers for a robot of that
/// size.
[[nodiscard]] std::string mission_text(const Sketch& sketch, const Labyrinth& labyrinth, const RoutePlan& route, const std::string& mind, float size);

class Town {
 public:
  /// Compiles and lays out `text`, the file `mission.kb`, over the standard library of the folder `library`, read through
  /// `files`. Throws std::runtime_error with the messages if that fails, since generated text must be right.
  Town(const std::string& text, const std::string& library, const source::FileSystem& files);

  /// The labyrinth as last laid out: `scenario` lays it out anew if its settings change the paint or the robot's size.
  [[nodiscard]] const Labyrinth& labyrinth() const { return *labyrinth_; }
  [[nodiscard]] const Knowledge& knowledge() const { return *knowledge_; }
  /// Reads a scenario, applies settings over it, and paints the floor accordingly. Throws as above.
  [[nodiscard]] Scenario scenario(const std::string& toml, const std::vector<Setting>& settings = {});

 private:
  std::unique_ptr<driver::Compilation> compiled_;
  std::optional<Labyrinth> labyrinth_;
  std::optional<Knowledge> knowledge_;
};

/// The floor of a map alone, to plan routes on. Throws as above.
[[nodiscard]] Labyrinth floor_of(const Sketch& sketch, const std::string& library, const source::FileSystem& files);

}  // namespace kb::sim::experiment
