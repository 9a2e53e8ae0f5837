#include "tests/world/trial.h"

#include <gtest/gtest.h>

namespace kb::world {
namespace {

constexpr Setting kOracle{MindKind::kInterpreter};

/// A mission of one leg: from the road to A on to B.
Trial short_mission() {
  Trial trial(kOracle,
              "map M { landmark A landmark B landmark C road C.E -- A.W by mark road A.E -- B.W by mark }\n"
              "command Go\nroute R on M by Go: A -> B\n");
  trial.at("C.E");
  return trial;
}

TEST(Drove, FindsNothingWhenAllWasAsItShouldBe) {
  Trial trial = short_mission();
  EXPECT_TRUE(trial.go(500, {}, "Go"));
  EXPECT_EQ(trial.drove("A.E"), "");
}

TEST(Drove, FindsAnotherWayAndAMissionWithoutEnd) {
  Trial trial = short_mission();
  trial.road("A.E").closed = true;
  EXPECT_FALSE(trial.go(100, {}, "Go"));
  const Finding found = trial.drove("A.E");
  EXPECT_NE(found.find("drove ``, not `A.E`"), std::string::npos) << found;
  EXPECT_NE(found.find("did not end"), std::string::npos) << found;
}

TEST(Drove, FindsAnAccidentAndASatelliteThatIsLeftOver) {
  Trial trial = short_mission();
  trial.go(500, {}, "Go");
  trial.world().fault("bumped into a cupboard");
  trial.mind().poke(trial.knowledge().cell("Astride"), 1.0f);
  trial.world().put(trial.world().map.edge("A.E"), trial.world().map.road(trial.world().map.edge("A.E")).length_m);
  const Finding found = trial.drove("A.E");
  EXPECT_NE(found.find("bumped into a cupboard"), std::string::npos) << found;
  EXPECT_NE(found.find("left over: Astride"), std::string::npos) << found;
}

TEST(Drove, FindsAPromiseThatIsBroken) {
  Trial trial = short_mission();
  trial.go(10, {}, "Go");
  trial.mind().poke(trial.knowledge().cell("Out.N"), 1.0f);
  trial.wait(1);
  EXPECT_EQ(trial.sim().broken_promise(), "an exit or a turn without a landmark");
}

}  // namespace
}  // namespace kb::world
