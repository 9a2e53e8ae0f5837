// The standard library over the labyrinth: what comes out of it is known from the prototype of the language.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "compiler/model/standard_names.h"
#include "tests/unit/model/knowing.h"

namespace kb::model::testing {
namespace {

const std::string kRoute1 = "command Start1\nroute Route1 on Labyrinth by Start1: LM5 -> LM2 -> LM3 -> LM6 -> LM7 -> LM13 -> LM15\n";

std::size_t count(const Model& model, CellKind kind) {
  std::size_t found = 0;
  for (const Cell& cell : model.cells) found += cell.kind == kind ? 1 : 0;
  return found;
}

TEST(Library, Route1HasTheCellsAndRulesOfTheExperiment) {
  const Known known("import std.navigation\n" + labyrinth() + kRoute1 + "detour LM7 -> LM11 -> LM13 when Safe is low\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(count(known.model(), CellKind::kFact), 42u);
  EXPECT_EQ(count(known.model(), CellKind::kSatellite), 105u);
  EXPECT_EQ(count(known.model(), CellKind::kStrategy), 18u);
  EXPECT_EQ(known.model().rules.size(), 115u);
  for (const auto& [rule, instances] : {std::pair("choose_turn", 16u), {"enter", 12u}, {"look_out", 8u}, {"arrive", 8u},
                                        {"take_road", 8u}, {"finish", 1u}, {"take_detour", 1u}, {"obey", 1u}}) {
    EXPECT_EQ(known.instances(rule), instances) << rule;
  }
}

TEST(Library, EveryFileThatDeclaresSomethingIsKnownToMessages) {
  std::vector<std::string> there, known(standard_files().begin(), standard_files().end());
  for (const auto& file : std::filesystem::directory_iterator(KB_PROJECT_ROOT "/stdlib_rules/std")) {
    const std::string stem = file.path().stem().string();
    if (stem != "navigation" && stem != "driving") there.push_back("std." + stem);   // imports the others
  }
  std::sort(there.begin(), there.end());
  std::sort(known.begin(), known.end());
  EXPECT_EQ(known, there);

  const source::RealFileSystem files;
  StandardNames names(KB_PROJECT_ROOT "/stdlib_rules", files), none("/no/such/library", files);
  EXPECT_EQ(names.file_with("Arrived"), "std.route");
  EXPECT_EQ(names.file_with("turn_of"), "std.crossing");
  EXPECT_EQ(names.file_with("GoToGoal"), "std.go_to_goal");
  EXPECT_EQ(names.file_with_member("Direction", "SE"), "std.compass8");
  EXPECT_EQ(names.file_with_member("Help", "lost"), "std.search");
  EXPECT_EQ(names.file_with("arrived"), std::nullopt);
  EXPECT_EQ(none.file_with("Arrived"), std::nullopt);
}

TEST(Library, InstancesStandInOrderOfDeclarationTheLastBinderFastest) {
  const Known known("import std.navigation\n");
  std::vector<std::string> names;
  for (const Rule& rule : known.model().rules) {
    if (rule.name.starts_with("enter[")) names.emplace_back(rule.name);
  }
  ASSERT_EQ(names.size(), 12u);
  EXPECT_EQ(names[0], "enter[left,mark]");
  EXPECT_EQ(names[1], "enter[left,dist]");
  EXPECT_EQ(names[3], "enter[right,mark]");
  EXPECT_EQ(names[11], "enter[back,azimuth]");
}

TEST(Library, ARuleThatNeedsAMissingFieldHasNoInstanceForThatRow) {
  const Known known("import std.navigation\n" + labyrinth() + kRoute1);
  EXPECT_EQ(known.rule("look_out[Route1.0:LM5]"), nullptr);      // it comes from nowhere
  EXPECT_EQ(known.rule("arrive[Route1.6:LM13>LM15]"), nullptr);  // nothing comes next
  EXPECT_NE(known.rule("arrive[Route1.0:LM5]"), nullptr);
  EXPECT_NE(known.rule("finish[Route1.6:LM13>LM15]"), nullptr);
  EXPECT_EQ(known.condition("arrive[Route1.1:LM5>LM2]"), "and(seen:LM2 Route1.1:LM5>LM2 Looking)");
  EXPECT_EQ(known.effects("arrive[Route1.1:LM5>LM2]"), "Route1.2:LM2>LM3=1, Arrived=1");
}

TEST(Library, PrioritiesOfAllPackagesMakeOneOrder) {
  const Known known("import std.navigation\nimport std.retreat\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.names(known.model().priority),
            "Round Search Stop Avoid Cross[left,mark] Cross[left,dist] Cross[left,azimuth] Cross[right,mark] Cross[right,dist] "
            "Cross[right,azimuth] Cross[forward,mark] Cross[forward,dist] Cross[forward,azimuth] Cross[back,mark] Cross[back,dist] "
            "Cross[back,azimuth] Move.mark Move.dist Move.azimuth");
}

TEST(Library, SatOfALandmarkIsTrueIfAnythingDrawsAttentionToIt) {
  const Known known("import std.navigation\n" + labyrinth() + kRoute1 + "rule r at goal when sat LM7 then +Astray\n");
  EXPECT_EQ(known.condition("r"), "or(sat LM7 Route1.4:LM6>LM7)");
}

TEST(Library, PlannedDetoursAndRetreatsAreThoseOfThePrototype) {
  const Known known("import std.navigation\nimport std.retreat\n" + labyrinth() + kRoute1 + "detours on Route1\n");
  EXPECT_EQ(known.said(), "");
  // The prototype's 2,700 rules and 678 satellites, and what was learnt since: std.retreat to turn back at a sign that it cannot read,
  // std.hall to tell std.obstacle that it looks out for itself, std.care to stand where a sense or the bumper says so, and where there is no way back.
  EXPECT_EQ(known.model().rules.size(), 2725u);
  EXPECT_EQ(count(known.model(), CellKind::kSatellite), 689u);
  const auto legs = known.rows("Leg");
  ASSERT_EQ(legs.size(), 590u);
  EXPECT_EQ(legs[7], "Route1.p1E.0:LM5>LM4");
  EXPECT_EQ(legs[19], "Route1.p1E.1W.2:LM4>LM12");
  const auto detours = known.rows("Detour");
  ASSERT_EQ(detours.size(), 280u);
  EXPECT_EQ(detours.front(), "Route1.p1E.1:LM4>LM8=>Route1.p1E.1E.0:LM4>LM12");
  EXPECT_EQ(known.field(detours.front(), "when"), "and(Closed.S not(Closed.E))");
  const auto retreats = known.rows("Retreat");
  ASSERT_EQ(retreats.size(), 6u);
  EXPECT_EQ(known.field(retreats[2], "leg"), "Route1.3:LM3>LM6");
  EXPECT_EQ(known.field(retreats[2], "back"), "Route1.back3:LM6>LM3");
  EXPECT_EQ(known.field("Route1.back3:LM6>LM3", "next"), "Route1.back3.0:LM3>LM9");
  EXPECT_EQ(known.field("Route1.back3:LM6>LM3", "exit"), "missing");
}

TEST(Library, FromEveryLandmarkALegLeadsOnToTheGoal) {
  const Known known("import std.navigation\nimport std.recover\n"
                    "map M { landmark A landmark B landmark C landmark D landmark E\n"
                    "  road A.E -- B.W by mark\n  road B.E -- C.W by mark\n  road D.N -- B.S by mark\n  road E.E -- D.W by mark\n}\n"
                    "command Go\nroute R on M by Go: A -> B -> C\ndetours on R\n");
  EXPECT_EQ(known.said().substr(0, known.said().find(" no way")), "main.kb:11:1: KB1068") << "nothing leads round";
  ASSERT_EQ(known.rows("Rejoin").size(), 5u);
  EXPECT_EQ(known.field("R.from:A", "route"), "R");
  EXPECT_EQ(known.field("R.from:A", "leg"), "R.1:A>B");      // the route's own
  EXPECT_EQ(known.field("R.from:B", "leg"), "R.2:B>C");
  EXPECT_EQ(known.field("R.from:C", "leg"), "missing");      // the goal
  EXPECT_EQ(known.field("R.from:C", "last"), "R.2:B>C");
  EXPECT_EQ(known.field("R.from:D", "leg"), "R.r:D>B");
  EXPECT_EQ(known.field("R.r:D>B", "next"), "R.2:B>C");
  EXPECT_EQ(known.field("R.from:E", "leg"), "R.r:E>D");      // and on as from there
  EXPECT_EQ(known.field("R.r:E>D", "next"), "R.r:D>B");
  EXPECT_EQ(known.rule("rejoin[R.from:C]"), nullptr);
  ASSERT_EQ(known.rows("Recheck").size(), 1u);                 // no other road leads to the goal
  EXPECT_EQ(known.field("R.recheck", "leg"), "R.2:B>C");
  EXPECT_EQ(known.field("R.recheck", "back"), "R.back2:C>B");
  EXPECT_EQ(known.field("R.back2:C>B", "next"), "R.2:B>C");    // and over it again
  EXPECT_EQ(known.effects("find_goal[R.from:C]"), "R.2:B>C=1");
}

//   A -- B -- G      two ways of two roads lead from C to G: over F, to which the road is declared first, and over B;
//   |    |    |      three of three from D: two over C, to which the road is declared first, one over A
//   D -- C -- F
TEST(Library, OfSeveralShortestWaysOnTheOneByTheFirstRoadIsTaken) {
  const Known known("import std.navigation\nimport std.recover\n"
                    "map M { landmark A landmark B landmark G landmark D landmark C landmark F\n"
                    "  road A.E -- B.W by mark\n  road B.E -- G.W by mark\n  road C.E -- F.W by mark\n  road F.N -- G.S by mark\n"
                    "  road C.N -- B.S by mark\n  road D.E -- C.W by mark\n  road D.N -- A.S by mark\n}\n"
                    "command Go\nroute R on M by Go: B -> G\ndetours on R\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.field("R.from:A", "leg"), "R.r:A>B");
  EXPECT_EQ(known.field("R.from:C", "leg"), "R.r:C>F");
  EXPECT_EQ(known.field("R.from:D", "leg"), "R.r:D>C");
  EXPECT_EQ(known.field("R.r:D>C", "next"), "R.r:C>F");
  EXPECT_EQ(known.field("R.r:C>F", "next"), "R.r:F>G");
  EXPECT_EQ(known.field("R.r:F>G", "ends"), "R");
}

TEST(Library, ItsEightDirectionsKnowTheTurnsBetweenThem) {
  const Known known("import std.compass8\nmap M { landmark A landmark B road A.NE -- B.SW by mark }\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.instances("choose_turn"), 64u);
  EXPECT_EQ(known.effects("choose_turn[S,NE]"), "Turn.half_right=1");
  EXPECT_EQ(known.effects("choose_turn[SW,N]"), "Turn.half_left=1");
  EXPECT_NE(known.cell("Cross[sharp_left,dist]"), nullptr);
}

}  // namespace
}  // namespace kb::model::testing
