#include <gtest/gtest.h>

#include "tests/unit/model/knowing.h"

namespace kb::model::testing {
namespace {

using diagnostics::Kind;

const std::string kNavigation = "import std.navigation\n";
const std::string kSmallMap = kNavigation + "map M { landmark A at (0, 0) landmark B landmark C road A.E -- B.W by mark road B.E -> C.W road A.N -- C.N }\ncommand Go\n";

TEST(Maps, ARoadIsARowForEachDirection) {
  const Known known(kSmallMap);
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.rows("Road"), (std::vector<std::string>{"A.E>B.W", "B.W>A.E", "B.E>C.W", "A.N>C.N", "C.N>A.N"}));
  EXPECT_EQ(known.field("B.W>A.E", "exit"), "W");
  EXPECT_EQ(known.field("B.W>A.E", "approach"), "E");
  EXPECT_EQ(known.field("B.W>A.E", "by"), "mark");
  EXPECT_EQ(known.field("B.E>C.W", "by"), "missing");
  EXPECT_EQ(known.field("A", "at"), "(0, 0)");
  const Map& map = known.model().maps.front();
  ASSERT_EQ(map.roads.size(), 5u);
  EXPECT_EQ(map.roads[0].road, map.roads[1].road);
  EXPECT_NE(map.roads[1].road, map.roads[2].road);
}

TEST(Maps, ABendIsPassedBackwardsOnTheWayBack) {
  const Known known(kNavigation + "map M { landmark A landmark B road A.E -- B.W through (1, 2), (3, 4) }\n");
  const Map& map = known.model().maps.front();
  EXPECT_EQ(map.through(map.roads[0]).front().x, 1.0);
  EXPECT_EQ(map.through(map.roads[1]).front().x, 3.0);
}

TEST(Maps, AnExitWithANameOfItsOwnIsAddedToTheDirections) {
  const std::string map = "map M { landmark A landmark B road A.gate -- B.W }\n";
  EXPECT_TRUE(Known(kNavigation + map).said_only(Kind::kUnknownExit));
  const Known incomplete(kNavigation + "names Direction more { gate }\n" + map);
  EXPECT_EQ(incomplete.said().find("main.kb:2:24: KB0720 table `turn_of` has no entry for `(N, gate)`, `(E, gate)`, `(S, gate)`, `(W, gate)`, `(gate, N)` and 4 more"), 0u)
      << incomplete.said();
  const Known complete(kNavigation + "names Direction more { gate }\n"
                       "table turn_of more { gate  N: left E: right S: left W: forward }\n"
                       "table turn_of more { N E S W gate  gate: left left right forward back }\n" + map);
  EXPECT_EQ(complete.said(), "");
  EXPECT_EQ(complete.effects("choose_turn[W,gate]"), "Turn.forward=1");
  EXPECT_NE(complete.cell("Closed.gate"), nullptr);
}

TEST(Maps, NothingDependsOnThereBeingFourDirections) {
  std::string sixteen = "levels c\nrelation Road(from, to, exit)\nrelation Leg(from, to, exit) satellites\nnames Side { ";
  std::string map = "map M { landmark Hub ";
  for (int i = 0; i < 16; ++i) {
    sixteen += (i == 0 ? "" : ", ") + std::string("s") + std::to_string(i);
    map += "landmark P" + std::to_string(i) + " road Hub.s" + std::to_string(i) + " -- P" + std::to_string(i) + ".s0 ";
  }
  const Known known(sixteen + " }\nfacts Shut[Side]\n" + map + "}\ncommand Go\nroute R on M by Go: P3 -> Hub -> P11\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.field("R.2:Hub>P11", "exit"), "s11");
}

TEST(Maps, FaultsOfAMapAreFoundWhereTheyStand) {
  EXPECT_TRUE(Known(kNavigation + "map M { landmark A landmark A landmark B road A.E -- B.W }").said_only(Kind::kLandmarkTwice));
  EXPECT_TRUE(Known(kNavigation + "map M { landmark A landmark B road A.E -- B.W road A.E -- B.S }").said_only(Kind::kExitTwice));
  EXPECT_TRUE(Known(kNavigation + "map M { landmark A road A.E -- A.E }").said_only(Kind::kRoadToItself));
    EXPECT_TRUE(Known(kNavigation + "map M { landmark A landmark B road A.E -- B.W by marc road A.N -- B.N by mark }").said_only(Kind::kUnknownMethod));
  EXPECT_TRUE(Known(kNavigation + "map M { landmark A landmark B landmark C road A.E -- B.W }").said_only(Kind::kUnreachedLandmark));
  EXPECT_EQ(Known(kNavigation + "map M { landmark A road A.E -- A.N }").said(), "");  // a loop
}

TEST(Maps, AMapWithoutTheLibrarySaysWhatToImport) {
  const Known known("map M { landmark A landmark B road A.E -- B.W by mark }\ncommand Go\nroute R on M by Go: A -> B\n");
  EXPECT_EQ(known.said(), "main.kb:1:5: KB0317 `map` writes rows of the relation `Road`, which is not declared; add `import std.navigation`\n");
}

TEST(Maps, ALibraryMayDeclareFewerFieldsOrMore) {
  const Known known("levels only\nnames Side { E, W }\nrelation Road(from, length)\nrelation Leg(to, speed) satellites\nrelation Route(first)\n"
                    "map M { landmark A landmark B road A.E -- B.W }\ncommand Go\nroute R on M by Go: A -> B\n"
                    "rule slow[l in Leg] at only when l and l.speed then -l\n");
  EXPECT_TRUE(known.said_only(Kind::kUnfilledField)) << known.said();
  EXPECT_EQ(known.field("A.E>B.W", "from"), "A");
  EXPECT_EQ(known.field("A.E>B.W", "exit"), "no such field");
  EXPECT_EQ(known.instances("slow"), 0u);
}

TEST(Maps, ALandmarkWhoseNameIsTakenIsToldOfOnce) {
  const Known known(kNavigation + "map M { landmark Gate landmark B road Gate.E -- B.W }\ncommand Go\nroute R on M by Go: Gate -> B\n");
  EXPECT_TRUE(known.said_only(Kind::kRedeclared)) << known.said();
}

TEST(Maps, ARoadThatCannotBeReadLeavesNoLandmarkUnreached) {
  EXPECT_TRUE(Known(kNavigation + "map M { landmark A landmark B road A.E -- X.W }\n").said_only(Kind::kRoadUnknownLandmark));
}

TEST(Routes, ARouteMayComeToALandmarkTwice) {
  const Known known(kSmallMap + "route R on M by Go: A -> B -> A -> C\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.rows("Leg"), (std::vector<std::string>{"R.0:A", "R.1:A>B", "R.2:B>A", "R.3:A>C"}));
  EXPECT_EQ(known.field("R.3:A>C", "ends"), "R");
  EXPECT_EQ(known.field("R", "first"), "R.0:A");
  EXPECT_EQ(known.field("R", "command"), "Go");
}

TEST(Routes, ARouteOfOneLandmarkLeadsThere) {
  const Known known(kSmallMap + "route R on M by Go: B\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.field("R.0:B", "ends"), "R");
}

TEST(Routes, AMissingRoadIsExplained) {
  const Known back(kSmallMap + "route R on M by Go: C -> B\n");
  EXPECT_TRUE(back.said_only(Kind::kNoRoad));
  EXPECT_NE(back.said().find("the road goes the other way only, from `B` to `C`"), std::string::npos) << back.said();
  const Known over(kNavigation + "map M { landmark A landmark B landmark C landmark D road A.E -- B.W road B.E -- C.W road C.E -- D.W }\ncommand Go\nroute R on M by Go: A -> D\n");
  EXPECT_NE(over.said().find("there is a way over others: `A -> B -> C -> D`"), std::string::npos) << over.said();
  const Known never(kNavigation + "map M { landmark A landmark B landmark C landmark D road A.E -- B.W road C.E -- D.W }\ncommand Go\nroute R on M by Go: A -> D\n");
  EXPECT_TRUE(never.said_only(Kind::kUnreachable));
}

TEST(Routes, OfParallelRoadsTheExitIsNamed) {
  const std::string map = kNavigation + "map M { landmark A landmark B road A.E -- B.W road A.N -- B.N }\ncommand Go\n";
  const Known open(map + "route R on M by Go: A -> B\n");
  EXPECT_TRUE(open.said_only(Kind::kParallelRoads));
  EXPECT_NE(open.said().find("-> A.E"), std::string::npos);
  const Known named(map + "route R on M by Go: A.N -> B\n");
  EXPECT_EQ(named.said(), "");
  EXPECT_EQ(named.field("R.1:A>B", "exit"), "N");
  EXPECT_TRUE(Known(map + "route R on M by Go: A.S -> B\n").said_only(Kind::kNoSuchExit));
  EXPECT_TRUE(Known(map + "route R on M by Go: A.N -> B.E\n").said_only(Kind::kLastStopExit));
}

TEST(Routes, WhatARouteNamesMustBeThere) {
  EXPECT_TRUE(Known(kSmallMap + "route R on N by Go: A -> B\n").said_only(Kind::kUnknownMap));
  EXPECT_TRUE(Known(kSmallMap + "route R on M by Goo: A -> B\n").said_only(Kind::kUnknownCommand));
  EXPECT_TRUE(Known(kSmallMap + "route R on M by Line: A -> B\n").said_only(Kind::kNotACommand));
  EXPECT_TRUE(Known(kSmallMap + "route R on M by Go: A -> BB\n").said_only(Kind::kUnknownLandmark));
  EXPECT_TRUE(Known(kSmallMap + "route R on M by Go: A -> Line\n").said_only(Kind::kNotALandmark));
  EXPECT_TRUE(Known(kSmallMap + "route R on M by Go: A -> B\nroute S on M by Go: B -> C\n").said_only(Kind::kCommandTwice));
  EXPECT_TRUE(Known(kSmallMap + "map M2 { landmark D landmark E road D.E -- E.W }\nroute R on M by Go: A -> D\n").said_only(Kind::kOtherMap));
}

TEST(Maps, ALargeMapAndALongRouteAreRead) {
  constexpr int kSide = 100;
  std::string text = kNavigation + "map M {\n";
  const auto name = [](int x, int y) { return "L" + std::to_string(x) + "_" + std::to_string(y); };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      text += "landmark " + name(x, y) + "\n";
      if (x > 0) text += "road " + name(x - 1, y) + ".E -- " + name(x, y) + ".W\n";
      if (y > 0) text += "road " + name(x, y - 1) + ".S -- " + name(x, y) + ".N\n";
    }
  }
  text += "}\ncommand Go\nroute R on M by Go: " + name(0, 0);
  for (int i = 1; i < kSide; ++i) text += " -> " + name(i, 0);
  const Known known(text + "\ndetours on R\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.rows("Landmark").size(), 10'000u);
  EXPECT_EQ(known.rows("Road").size(), 39'600u);
  EXPECT_GT(known.rows("Detour").size(), 1'000u);
}

}  // namespace
}  // namespace kb::model::testing
