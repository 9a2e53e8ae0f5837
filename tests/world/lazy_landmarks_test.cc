// Landmarks that are perceived only while somebody waits for them: the robot drives as it does when it looks at all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "tests/world/scenario.h"

namespace kb::world {
namespace {

struct Drive {
  Finding finding;
  std::vector<std::string> strategies;   // each time another one runs
};

Drive drive(const Scenario& scenario, MindKind kind) {
  Recording recording;
  Drive drive{scenario.run({kind, &recording}), {}};
  program::CellId last = program::CellId::kNone;
  for (const program::Tick& tick : recording.ticks) {
    if (tick.strategy == last) continue;
    last = tick.strategy;
    drive.strategies.emplace_back(recording.knowledge->name(last));
  }
  return drive;
}

/// These two feed a mind by hand and ask for the edges of a landmark that nobody awaits: what `lazy` gives up, and what
/// -Wlazy-edge warns of. The robot drives alike in them too.
constexpr std::string_view kAskForEdges[] = {"attention_lowers_the_threshold", "attention_withdrawn_is_not_a_loss"};

TEST(LazyLandmarks, ChangeNeitherTheArrivalNorTheStrategies) {
  for (const Scenario& scenario : all_scenarios()) {
    const Drive all = drive(scenario, MindKind::kMachine), lazy = drive(scenario, MindKind::kLazyLandmarks);
    const bool edges = std::find(std::begin(kAskForEdges), std::end(kAskForEdges), scenario.name) != std::end(kAskForEdges);
    if (!edges) {
      EXPECT_EQ(lazy.finding, all.finding) << scenario.name;
    }
    EXPECT_EQ(lazy.strategies, all.strategies) << scenario.name;
  }
}

}  // namespace
}  // namespace kb::world
