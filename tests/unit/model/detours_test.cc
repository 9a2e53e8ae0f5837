#include <gtest/gtest.h>

#include "tests/unit/model/knowing.h"

namespace kb::model::testing {
namespace {

using diagnostics::Kind;

//   A -- B -- C -- D      and below B and C:  V -- W, V to B, W to C and D
const std::string kMap =
    "import std.navigation\n"
    "map M { landmark A landmark B landmark C landmark D landmark V landmark W\n"
    "  road A.E -- B.W road B.E -- C.W road C.E -- D.W road B.S -- V.N road V.E -- W.W road W.N -- C.S road W.E -- D.S }\n"
    "command Go\nroute R on M by Go: A -> B -> C -> D\n";

/// The first detour that takes the place of a leg.
std::string detour_instead_of(const Known& known, const std::string& leg) {
  for (const std::string& name : known.rows("Detour")) {
    if (known.field(name, "instead") == leg) return name;
  }
  return "none";
}

TEST(Detours, AWrittenDetourTakesThePlaceOfALegAndGoesOnAfterwards) {
  const Known known(kMap + "detour B -> V -> W -> D when Closed[exit] and not seen leg.to\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.rows("Detour"), std::vector<std::string>{"R.d0"});
  EXPECT_EQ(known.field("R.d0", "instead"), "R.2:B>C");
  EXPECT_EQ(known.field("R.d0", "first"), "R.d0.0:B>V");
  EXPECT_EQ(known.field("R.d0", "when"), "and(Closed.E not(seen:C))");
  EXPECT_EQ(known.field("R.d0.1:V>W", "next"), "R.d0.2:W>D");
  EXPECT_EQ(known.field("R.d0.2:W>D", "ends"), "R");
  EXPECT_EQ(known.condition("take_detour[R.d0]"), "and(R.2:B>C Arrived and(Closed.E not(seen:C)))");
}

TEST(Detours, ADetourWithoutAConditionIsAlwaysTaken) {
  const Known known(kMap + "detour B -> V -> W -> C\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.field("R.d0", "when"), "and()");
  EXPECT_EQ(known.field("R.d0.2:W>C", "next"), "R.3:C>D");
}

TEST(Detours, ADetourMayHaveADetour) {
  const Known known(kMap + "detour B -> V -> W -> C when Closed[exit]\ndetour W -> D -> C when Closed[exit]\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.field("R.d1", "instead"), "R.d0.2:W>C");
  EXPECT_EQ(known.field("R.d1.1:D>C", "next"), "R.3:C>D");
}

TEST(Detours, ADetourServesEveryRouteThatItFits) {
  const Known known(kMap + "command Go2\nroute S on M by Go2: B -> C\ndetour B -> V -> W -> C when Closed[exit]\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.rows("Detour"), (std::vector<std::string>{"R.d0", "S.d0"}));
  const Known one(kMap + "command Go2\nroute S on M by Go2: B -> C\ndetour B -> V -> W -> C on S when Closed[exit]\n");
  EXPECT_EQ(one.rows("Detour"), std::vector<std::string>{"S.d0"});
}

TEST(Detours, ADetourThatFitsNoRouteSaysWhy) {
  EXPECT_EQ(Known(kMap + "detour V -> W -> C\n").said(), "main.kb:6:8: KB0531 this detour belongs to no route: no leg of a route leaves `V`\n");
  const Known behind(kMap + "detour B -> A\n");
  EXPECT_NE(behind.said().find("a route leaves `B`, but does not come to `A` after it"), std::string::npos) << behind.said();
  EXPECT_NE(Known(kMap + "detour B -> C\n").said().find("goes that way already"), std::string::npos);
  const Known twice(kMap + "detour B -> V -> W -> C\ndetour B -> V -> W -> C\n");
  EXPECT_NE(twice.said().find("the leg that leaves `B` has a detour already\n  main.kb:6:1: the leg from `B` to `C` has this detour already"), std::string::npos) << twice.said();
  EXPECT_TRUE(Known(kMap + "detour B\n").said_only(Kind::kDetourOneStop));
  EXPECT_TRUE(Known(kMap + "detour B -> V -> W -> C on Q\n").said_only(Kind::kUnknownRoute));
}

TEST(Detours, APlannedDetourIsTakenWhenAllBetterOnesAreClosed) {
  const Known known(kMap + "detours on R\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.field(detour_instead_of(known, "R.2:B>C"), "when"), "and(Closed.E not(Closed.S))");
}

/// All rows and fields that detours have made.
std::string detours_of(const Known& known) {
  std::string out;
  for (const std::string& name : known.rows("Detour")) {
    out += name + ": " + known.field(name, "instead") + " " + known.field(name, "first") + " " + known.field(name, "when") + "\n";
  }
  return out;
}

TEST(Detours, AWrittenDetourComesBeforePlannedOnesWhereverItStands) {
  const std::string written = "fact Wet\ndetour B -> V -> W -> C when Wet\n", planned = "detours on R\n";
  const Known before(kMap + written + planned), after(kMap + planned + written);
  EXPECT_EQ(before.said(), "");
  EXPECT_EQ(after.said(), "");
  EXPECT_EQ(after.field("R.d0", "instead"), "R.2:B>C");
  EXPECT_EQ(after.field("R.d0", "when"), "Wet");
  EXPECT_EQ(after.field("R.2:B>C=>R.p2S.0:B>V", "when"), "and(Closed.E not(Closed.S) not(Wet))");
  EXPECT_EQ(detours_of(before), detours_of(after));
}

TEST(Detours, AWrittenDetourServesPlannedLegsThatTakeTheRoadItReplaces) {
  const Known known(kMap + "fact Wet\ndetours on R\ndetour W -> V -> B -> C when Wet\n");   // no leg of the route leaves W
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.field("R.d0", "instead"), "R.p2S.2:W>C");
}

TEST(Detours, AWayRoundIsNamedByItsLegAndItsExit) {
  const Known small(kMap + "detours on R\n");
  const std::string more = "landmark X road A.S -- X.N road X.E -- V.W }";
  std::string larger = kMap;
  larger.replace(larger.find('}'), 1, more);
  const Known large(larger + "detours on R\n");
  for (const std::string leg : {"R.p2S.0:B>V", "R.p2S.1:V>W", "R.p3S.1:W>D"}) {
    EXPECT_NE(small.row(leg), nullptr) << leg;
    EXPECT_NE(large.row(leg), nullptr) << leg;
  }
}

TEST(Detours, TheShortestWayRoundIsOneOfMetresWherePlacesAreKnown) {
  //   A -- B -- C     over F by two long roads, over D and E by three short ones
  const auto of = [](const std::string& place_of_f) {
    return Known(
        "import std.navigation\n"
        "map M { landmark A at (0, 0) landmark B at (4, 0) landmark C at (8, 0) landmark D at (4, 1) landmark E at (6, 1) landmark F" + place_of_f +
        "  road A.E -- B.W road B.E -- C.W road B.N -- D.S road D.E -- E.W road E.E -- C.N road B.S -- F.N road F.E -- C.S through (8, -20) }\n"
        "command Go\nroute R on M by Go: A -> B -> C\ndetours on R\n");
  };
  const Known placed = of(" at (4, -20)\n"), lost = of("\n");
  EXPECT_EQ(placed.field("R.2:B>C=>R.p2N.0:B>D", "when"), "and(Closed.E not(Closed.N))");
  EXPECT_EQ(lost.field("R.2:B>C=>R.p2S.0:B>F", "when"), "and(Closed.E not(Closed.S))");   // the fewest roads
}

TEST(Detours, TheConditionOfPlannedDetoursIsAskedOfEachRoad) {
  const Known known(kMap + "facts Snow[Direction]\ndetours on R when Snow[exit] and not seen leg.from\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.field(detour_instead_of(known, "R.2:B>C"), "when"), "and(and(Snow.E not(seen:B)) not(and(Snow.S not(seen:B))))");
}

TEST(Detours, PlannedDetoursNeedToKnowWhatIsClosed) {
  EXPECT_TRUE(Known(kMap + "detours on R when Safe is low\n").said_only(Kind::kDetoursForAllExits));
  EXPECT_TRUE(Known(kMap + "detours on R\ndetours on R\n").said_only(Kind::kDetoursTwice));
  EXPECT_TRUE(Known(kMap + "detours on Q\n").said_only(Kind::kUnknownRoute));
  const Known unclosed("levels c\nnames Side { E, W, N }\nrelation Road(from, to, exit)\nrelation Leg(from, to, exit, next) satellites\n"
                       "relation Detour(instead, first, when)\nmap M { landmark A landmark B road A.E -- B.W road A.N -- B.N }\ncommand Go\n"
                       "route R on M by Go: A.E -> B\ndetours on R\n");
  EXPECT_TRUE(unclosed.said_only(Kind::kDetoursWithoutClosed)) << unclosed.said();
}

}  // namespace
}  // namespace kb::model::testing
