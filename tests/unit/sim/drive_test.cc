#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/world/geometry.h"
#include "tests/unit/sim/laboratory.h"
#include "tests/unit/stride.h"

namespace kb::sim::testing {
namespace {

using Outcome = Summary::Outcome;

Laboratory& route1() {
  static const auto made = Laboratory::of_file("examples/04_simulator/route1.kb");
  return *made;
}

std::string words(const std::vector<std::string>& all) {
  std::string out;
  for (const std::string& word : all) out += (out.empty() ? "" : " ") + word;
  return out;
}

TEST(Drive, Route1ArrivesWithoutACollisionFromManySeeds) {
  for (std::uint64_t seed = 1; seed <= 40; seed += kb::testing::stride()) {
    Scenario scenario = route1().plain();
    scenario.seed = seed;
    const Summary summary = route1().drive(scenario);
    EXPECT_EQ(describe(summary), "arrived at LM15") << "seed " << seed;
    EXPECT_EQ(words(summary.way), "LM5.W LM2.S LM3.E LM6.S LM7.E LM13.E") << "seed " << seed;
    EXPECT_TRUE(summary.collisions.empty()) << "seed " << seed;
    EXPECT_TRUE(summary.faults.empty()) << "seed " << seed;
    EXPECT_FALSE(summary.lost_unaware()) << "seed " << seed;
  }
}

TEST(Drive, TheSameSeedGivesTheSameTraceAndAnotherSeedAnotherOne) {
  Scenario scenario = route1().scenario(project_file("examples/04_simulator/detour.toml"));
  const std::string first = route1().trace(scenario);
  EXPECT_EQ(first, route1().trace(scenario));
  scenario.seed = 77;
  EXPECT_NE(first, route1().trace(scenario));
}

TEST(Drive, WhoSaysTheDefaultRowChangesNothingAndAnotherRowArrivesOtherwise) {
  const auto& plain = route1().plain();
  const std::string trace = route1().trace(plain);
  EXPECT_EQ(route1().trace(route1().scenario("[sensors.line]\nahead = 0.09\nspan = 0.1\n[floor]\nline_width = 0.03\nstop_line_width = 0.1\n")), trace);
  const Scenario other = route1().scenario("[sensors.line]\nahead = 0.14\nspan = 0.08\n");
  EXPECT_NE(route1().trace(other), trace);
  EXPECT_EQ(route1().drive(other).outcome, Summary::Outcome::kArrived);
}

TEST(Drive, ARecordingChangesNothing) {
  const Scenario scenario = route1().plain();
  Recording recording;
  const Summary watched = route1().drive(scenario, &recording), alone = route1().drive(scenario);
  EXPECT_EQ(watched.ticks, alone.ticks);
  EXPECT_DOUBLE_EQ(watched.length_m, alone.length_m);
  EXPECT_EQ(recording.frames.size(), watched.ticks);
  EXPECT_EQ(recording.outcome, "arrived at LM15");
}

TEST(Drive, AnObstacleThatIsMovedKeepsItsSize) {
  Recording recording;
  (void)route1().drive(route1().scenario("limit = 4\n[[event]]\nwhen = { time = 1 }\nobstacle = \"crate\"\nradius = 0.2\nat = [0.5, -2.5]\n"
                                   "[[event]]\nwhen = { time = 2 }\nmove = \"crate\"\nat = [0.5, -1.5]\n"),
                 &recording);
  std::vector<double> widths;
  for (const Recording::Stay& stay : recording.stays) {
    if (stay.thing.name == "crate") widths.push_back(stay.thing.to.x_m - stay.thing.from.x_m);
  }
  ASSERT_EQ(widths.size(), 2u);
  EXPECT_NEAR(widths[0], 0.4, 1e-6);
  EXPECT_NEAR(widths[1], 0.4, 1e-6);
}

TEST(Drive, WhatIsMovedOnOrPlacedAnewDoesNotGoWhereItWasToGoBefore) {
  const std::string first = "limit = 8\n[[event]]\nwhen = { time = 1 }\nobstacle = \"crate\"\nat = [0.5, -2.5]\n"
                            "[[event]]\nwhen = { time = 1 }\nmove = \"crate\"\nat = [0.5, -1.5]\nwithin = 4\n";
  for (const std::string then : {"move = \"crate\"\nat = [0.5, -2.4]\nwithin = 1\n", "obstacle = \"crate\"\nat = [0.5, -2.4]\n"}) {
    Recording recording;
    (void)route1().drive(route1().scenario(first + "[[event]]\nwhen = { time = 2 }\n" + then), &recording);
    const Recording::Stay* last = nullptr;
    for (const Recording::Stay& stay : recording.stays) {
      if (stay.thing.name == "crate") last = &stay;
    }
    ASSERT_NE(last, nullptr);
    EXPECT_NEAR((last->thing.from.y_m + last->thing.to.y_m) / 2.0, -2.4 * route1().labyrinth->scale, 0.01) << then;
  }
}

/// What was noted in a drive of 20 s with these events, and when, in seconds; without the start.
std::string notes_of(const std::string& events) {
  Recording recording;
  (void)route1().drive(route1().scenario("limit = 20\n" + events), &recording);
  std::string out;
  for (const Frame& frame : recording.frames) {
    for (const std::string& note : frame.notes) out += note == "Start1 pressed" ? "" : fmt::format("{:g} {}\n", std::round(frame.t_s * 10.0) / 10.0, note);
  }
  return out;
}

std::string event(const std::string& time, const std::string& what) { return "[[event]]\nwhen = { time = " + time + " }\n" + what + "\n"; }

TEST(Drive, WhatTwoEventsHaveDoneEndsWithTheLastOfThem) {
  const auto both = [](const std::string& what) { return notes_of(event("1", what + "\nfor = 3") + event("2", what + "\nfor = 10")); };
  EXPECT_EQ(both("sensor = \"range\"\nfault = \"dead\""), "1 sensor range dead\n2 sensor range dead\n12 sensor range well again\n");
  EXPECT_EQ(both("power = \"off\""), "1 power off\n2 power off\n12 power on\n");
  EXPECT_EQ(both("tag = \"LM2.S\"\nreads = \"nothing\""), "1 tag LM2.S reads nothing\n2 tag LM2.S reads nothing\n12 tag LM2.S reads itself again\n");
  EXPECT_EQ(both("obstacle = \"crate\"\nat = [0.5, -2.5]"), "1 crate appears\n2 crate appears\n12 crate vanishes\n");
  EXPECT_EQ(both("press = \"Abort\""), "1 Abort pressed\n2 Abort pressed\n12 Abort released\n");
}

TEST(Drive, AnEventThatEndsLeavesWhatAnEarlierOneHolds) {
  const std::string dead = event("1", "sensor = \"line\"\nfault = \"dead\"");
  const std::string noisy = event("2", "sensor = \"line\"\nfault = \"noisy\"\nfor = 1");
  const Summary without = route1().drive(route1().scenario("limit = 60\n" + dead)), with = route1().drive(route1().scenario("limit = 60\n" + dead + noisy));
  EXPECT_EQ(words(without.reports), "Help.no_line");
  EXPECT_EQ(words(with.reports), "Help.no_line");
  EXPECT_EQ(notes_of(dead + noisy), "1 sensor line dead\n2 sensor line noisy\n") << "it is not well again";
}

TEST(Drive, ADriftGoesOnUnderAFaultThatEnds) {
  const std::string exact = "limit = 20\n[sensors.compass]\nnoise = 0\nbias = 0\n", drift = "sensor = \"compass\"\nfault = \"drift\"\namount = 0.02";
  const auto heading_at_10_s = [&](const std::string& faults) {
    const Scenario scenario = route1().scenario(exact + event("19", "press = \"Start1\"") + event("1", drift) + faults);
    Recording recording;
    (void)route1().drive(scenario, &recording);
    for (const Frame& frame : recording.frames) {
      if (frame.t_s >= 10.0) return frame.senses.heading_rad;
    }
    return 0.0f;
  };
  EXPECT_NEAR(heading_at_10_s(event("5", "sensor = \"compass\"\nfault = \"noisy\"\nfor = 2")), heading_at_10_s(""), 0.001);
}

TEST(Drive, WhatIsRestoredIsNotRestoredOnceMore) {
  const auto sensor = [](const std::string& fault, const std::string& lasts) { return "sensor = \"range\"\nfault = \"" + fault + "\"" + lasts; };
  EXPECT_EQ(notes_of(event("1", sensor("dead", "\nfor = 9")) + event("3", sensor("none", "")) + event("5", sensor("stuck", ""))),
            "1 sensor range dead\n3 sensor range well again\n5 sensor range stuck\n");
}

TEST(Drive, EveryRoadOfTheLabyrinthCanBeDrivenBothWays) {
  // A tour over all roads there and back again, by line, walls and compass, over every kind of crossing.
  const std::string map = project_file("examples/04_simulator/labyrinth.kb");
  const Labyrinth& l = *route1().labyrinth;
  for (const Road& road : l.roads) {
    for (const bool back : {false, true}) {
      const Crossing& from = l[back ? road.to : road.from];
      const Crossing& to = l[back ? road.from : road.to];
      const std::string exit = back ? road.approach : road.exit;
      const auto lab = Laboratory::of_text("import std.navigation\n" + map + "command Go\nroute R on Labyrinth by Go: " + from.name + "." + exit +
                                           " -> " + to.name + "\n");
      const Summary summary = lab->drive(lab->plain());
      EXPECT_EQ(describe(summary), "arrived at " + to.name) << from.name << "." << exit;
      EXPECT_TRUE(summary.collisions.empty()) << from.name << "." << exit;
    }
  }
}

TEST(Drive, SlantedRoadsAndAllMethodsOfCrossing) {
  const auto lab = Laboratory::of_text(
      "import std.navigation\nimport std.compass8\nmap M {\n landmark A at (0, 0)\n landmark B at (3, 0.5)\n landmark C at (5, 3)\n landmark D at (2, 3)\n"
      " road A.E -- B.W\n road B.NE -- C.SW by dist\n road C.W -- D.E by azimuth\n road D.SW -- A.NE by mark\n}\ncommand Go\n"
      "route R on M by Go: A -> B -> C -> D -> A\n");
  const Summary summary = lab->drive(lab->scenario("[[crossing]]\nlandmark = \"B\"\nmethods = [\"azimuth\"]\n[[crossing]]\nlandmark = \"C\"\nmethods = [\"dist\"]\n"));
  EXPECT_EQ(describe(summary), "arrived at A");
  EXPECT_TRUE(summary.collisions.empty());
}

TEST(Drive, AfterAbortTheMindIsAsAtTheStart) {
  Recording recording;
  const Summary summary = route1().drive(route1().scenario("limit = 30\n[[event]]\nwhen = { time = 1 }\npress = \"Start1\"\n"
                                                           "[[event]]\nwhen = { time = 9 }\npress = \"Abort\"\n"), &recording);
  EXPECT_EQ(describe(summary), "aborted");
  std::vector<float> values;
  for (const auto& cell : recording.names.cells) values.push_back(cell.initial);
  for (const Frame& frame : recording.frames) {
    for (const Frame::Change& change : frame.changed) values[change.cell] = change.value;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& cell = recording.names.cells[i];
    if (cell.kind == MindNames::Cell::Kind::kSatellite) {
      EXPECT_EQ(values[i], cell.initial) << cell.name;
    }
  }
}

TEST(Drive, AfterAPowerCutItWaitsForSomebodyToPressSomething) {
  const std::string cut = "limit = 60\n[[event]]\nwhen = { time = 1 }\npress = \"Start1\"\n[[event]]\nwhen = { time = 5 }\npower = \"off\"\nfor = 3\n";
  const Summary waits = route1().drive(route1().scenario(cut));
  EXPECT_EQ(describe(waits), "stopped: Help.power");
  const Summary goes_on = route1().drive(route1().scenario("limit = 120\n" + cut.substr(cut.find('\n') + 1) + "[[event]]\nwhen = { time = 12 }\npress = \"Start1\"\n"));
  EXPECT_EQ(describe(goes_on), "arrived at LM15");
}

TEST(Drive, AnUnsafeCrossingIsNotEnteredUntilItIsSafe) {
  const Summary summary = route1().drive(route1().scenario("[[event]]\nwhen = { time = 0 }\nunsafe = \"LM2\"\nfor = 40\n"));
  EXPECT_EQ(describe(summary), "arrived at LM15");
  EXPECT_TRUE(summary.faults.empty());
  EXPECT_GT(summary.time_s, 90.0);
}

TEST(Drive, AClosedRoadIsNotTaken) {
  const Summary summary = route1().drive(route1().scenario("limit = 120\n[[event]]\nwhen = { time = 0 }\nclose = \"LM3.E\"\n"));
  EXPECT_EQ(describe(summary), "stopped: Help.refused");
  EXPECT_TRUE(summary.faults.empty());
}

/// Four crossings in a square, all by line; from A over B and C to D.
Laboratory& square() {
  static const auto made = Laboratory::of_text(
      "import std.navigation\nimport std.recover\n"
      "map M {\n  landmark A at (0, 0)\n  landmark B at (1, 0)\n  landmark C at (1, 1)\n  landmark D at (0, 1)\n"
      "  road A.E -- B.W by mark\n  road B.N -- C.S by mark\n  road C.W -- D.E by mark\n  road D.N -- C.N by mark through (0, 2), (1, 2)\n}\n"
      "command Go\nroute R on M by Go: A.E -> B.N -> C.W -> D\ndetours on R when Closed[exit]\n");
  return *made;
}

TEST(Drive, WithoutASignAndWithoutAWayRoundItGoesOnByReckoningAndTheNextSignAgrees) {
  for (const char* reads : {"nothing", "D"}) {
    const Summary summary = square().drive(square().scenario(
        std::string("limit = 300\n[start]\nroad = \"B.W\"\nmetres = 0.5\n[[event]]\nwhen = { time = 1 }\npress = \"Go\"\n"
                    "[[event]]\nwhen = { time = 0 }\ntag = \"B.W\"\nreads = \"") + reads + "\"\n"));
    EXPECT_EQ(describe(summary), "arrived at D") << reads;
    EXPECT_EQ(words(summary.way), "A.E B.N C.W") << reads;
    EXPECT_FALSE(summary.lost_unaware()) << reads;
  }
}

// From A one road leads to B, and one from B to C; D is C's like.
Laboratory& fork() {
  static const auto made = Laboratory::of_text(
      "import std.navigation\nimport std.recover\n\nmap M {\n  landmark A at (0, 0)\n  landmark B at (1, 0)\n  landmark C at (2, 0)\n"
      "  landmark E at (0, 1)\n  landmark D at (1, 1)\n  road A.E -- B.W by mark\n  road B.E -- C.W by mark\n  road A.N -- E.S by mark\n"
      "  road E.E -- D.W by mark\n  road D.S -- B.N by mark\n}\ncommand Go\nroute R on M by Go: A.E -> B.E -> C\ndetours on R when Closed[exit]\n");
  return *made;
}
constexpr const char* kGo = "limit = 300\n[start]\nroad = \"E.S\"\nmetres = 0.5\n[[event]]\nwhen = { time = 1 }\npress = \"Go\"\n";

TEST(Drive, AGoalWhoseSignIsWrongIsKnownByTheSignWhereItsRoadBegins) {
  const Summary summary = fork().drive(fork().scenario(std::string(kGo) + "[[event]]\nwhen = { time = 0 }\ntag = \"C.W\"\nreads = \"E\"\n"));
  EXPECT_EQ(describe(summary), "arrived at C");
  EXPECT_EQ(words(summary.way), "A.E B.E B.E") << "back to B, and once more";
  EXPECT_FALSE(summary.lost_unaware());
}

TEST(Drive, CarriedToTheLikeOfItsLastRoadItIsNotTakenInByTheSignAtItsEnd) {
  const Summary summary = fork().drive(fork().scenario(
      std::string(kGo) + "[[event]]\nwhen = { road = \"B.E\", metres = 0.8 }\nkidnap = { road = \"E.E\", metres = 0.8 }\n"));
  EXPECT_EQ(describe(summary), "arrived at C");
  EXPECT_FALSE(summary.lost_unaware());
}

TEST(Drive, CarriedAwayWhileItReadsTheSignOfTheGoalItHasNotArrived) {
  const Summary summary = fork().drive(fork().scenario(
      std::string(kGo) + "[[event]]\nwhen = { road = \"B.E\", metres = 1.22 }\nkidnap = { road = \"D.S\", metres = 0.5 }\n"));
  EXPECT_EQ(describe(summary), "arrived at C");
  EXPECT_FALSE(summary.lost_unaware());
}

TEST(Drive, WhoTurnsFromAWrongSignThatNamesWhereItCameFromDoesNotGoToAndFro) {
  const Summary summary = fork().drive(fork().scenario(std::string(kGo) + "[[event]]\nwhen = { time = 0 }\ntag = \"B.W\"\nreads = \"A\"\n"));
  EXPECT_EQ(describe(summary), "arrived at C");
  EXPECT_EQ(words(summary.way), "A.E A.N E.E D.S B.E");
}

TEST(Drive, AMarkingThatIsGoneBehindTheStopLineIsNotLookedForAside) {
  const Summary summary = fork().drive(fork().scenario(std::string(kGo) + "[[event]]\nwhen = { time = 0 }\nwear = \"B.E\"\nfrom = 0.0\nto = 1.5\n"));
  EXPECT_EQ(describe(summary), "arrived at C");
  EXPECT_LT(summary.time_s, 50.0);
}

void expect_arrivals(const std::string& exit, const std::string& text) {
  const auto laboratory = Laboratory::of_text(text);
  for (std::uint64_t seed = 1; seed <= 12; seed += kb::testing::stride()) {
    EXPECT_EQ(describe(laboratory->drive(laboratory->scenario("seed = " + std::to_string(seed) + "\n"))), "arrived at " + exit) << seed;
  }
}

// Roads that leave 22 degrees apart: behind the middle the row of line sensors is on three lines at once.
TEST(Drive, LinesBesideEachOtherBehindTheMiddleAreNoStopLine) {
  for (const std::string exit : {"B", "C", "D"}) {
    expect_arrivals(exit,
        "import std.navigation\nimport std.compass8\nmap M {\n  landmark A at (4, 0.4)\n  landmark O at (0, 0)\n  landmark B at (-4, 1.6)\n"
        "  landmark C at (-4, 0)\n  landmark D at (-4, -1.6)\n  road A.W -- O.E by mark\n  road O.NW -- B.E by mark\n  road O.W -- C.E by mark\n"
        "  road O.SW -- D.E by mark\n  road B.N -- A.N by mark through (-4, 4), (4, 4)\n}\ncommand Go\nroute R on M by Go: A -> O -> " + exit + "\n");
  }
}

// Wheels that are 1 % off say after such a road that the robot is 20 cm beside its last piece.
TEST(Drive, WhatTheWheelsSayAfterALongRoadDoesNotDrawItOffTheLine) {
  for (const std::string exit : {"B", "C"}) {
    expect_arrivals(exit,
        "import std.navigation\nmap M {\n  landmark A at (0, 0)\n  landmark O at (20, 1.2)\n  landmark B at (23, 1.2)\n"
        "  landmark C at (20, 4.2)\n  landmark D at (17, 1.2)\n  landmark Z at (-3, 0)\n  road Z.E -> A.W by mark\n"
        "  road A.E -> O.S by mark through (20, 0)\n  road O.E -> B.W by mark\n  road O.N -> C.S by mark\n  road O.W -> D.E by mark\n}\n"
        "command Go\nroute R on M by Go: A -> O -> " + exit + "\n");
  }
}

TEST(Drive, CarriedToAnotherRoadItFindsItselfAtTheNextSign) {
  const Summary summary = square().drive(square().scenario(
      "limit = 300\n[start]\nroad = \"B.W\"\nmetres = 0.5\n[[event]]\nwhen = { time = 1 }\npress = \"Go\"\n"
      "[[event]]\nwhen = { road = \"A.E\", metres = 0.8 }\nkidnap = { road = \"D.N\", metres = 0.5 }\n"));
  EXPECT_EQ(describe(summary), "arrived at D");
  EXPECT_FALSE(summary.lost_unaware());
}

}  // namespace
}  // namespace kb::sim::testing
