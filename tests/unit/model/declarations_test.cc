#include <gtest/gtest.h>

#include "tests/unit/model/knowing.h"

namespace kb::model::testing {
namespace {

using diagnostics::Kind;

TEST(Declarations, EveryFactAndStrategyHasASatelliteOfItsOwn) {
  const Known known("levels c\nfact Line\nfact Obst sat = +1 event 0.6 attention 0.1\ncommand Go\nstrategy U\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.cell("sat Line")->initial, -1.0f);
  EXPECT_EQ(known.cell("sat Obst")->initial, 1.0f);
  EXPECT_EQ(known.cell("sat Go")->initial, 1.0f);
  EXPECT_TRUE(known.cell("sat U")->own_satellite);
  EXPECT_EQ(known.cell("Obst")->event, 0.6);
  EXPECT_EQ(known.cell("Line")->event, 0.75);
  EXPECT_EQ(known.rows("Command"), std::vector<std::string>{"Go"});
}

TEST(Declarations, GroupsRangeOverProductsTheLastIndexFastest) {
  const Known known("levels c\nnames A { p, q }\nnames B { x, y }\nsatellites S[A, B]\nsatellites T { m, n } exclusive\nsatellites V of S[p, x], W of S[q, *] exclusive keep = 0.5\n");
  EXPECT_TRUE(known.said(Kind::kOfNothing)) << known.said();  // S is no fact
  EXPECT_EQ(known.names(known.model().groups[0].cells), "S[p,x] S[p,y] S[q,x] S[q,y]");
  EXPECT_EQ(known.names(known.model().groups[1].cells), "T.m T.n");
  EXPECT_TRUE(known.cell("V")->keep);
}

TEST(Declarations, MembersAddedLaterBelongToEveryGroup) {
  const Known known("levels c\nfacts In[Side]\nnames Side { L }\nsatellites Turn { a }\nstrategies Go[Turn]\npriority Go\nnames Side more { R }\nnames Turn more { b }\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_NE(known.cell("In.R"), nullptr);
  EXPECT_NE(known.cell("Turn.b"), nullptr);
  EXPECT_NE(known.cell("Go.b"), nullptr);
}

TEST(Declarations, MistakesAreNamed) {
  const auto says = [](const std::string& text, Kind kind) {
    const Known known("levels c\nnames A { p, q }\n" + text);
    EXPECT_TRUE(known.said_only(kind)) << text << "\n" << known.said();
  };
  says("fact X\nsatellite X\n", Kind::kRedeclared);
  says("fact A\n", Kind::kRedeclared);
  says("names B { x, x }\n", Kind::kMemberTwice);
  says("names A more { p }\n", Kind::kMemberTwice);
  says("names AA more { r }\n", Kind::kMoreOfUnknown);
  says("facts X[B]\n", Kind::kUnknownSet);
  says("fact B\nfacts X[B]\n", Kind::kNotASet);
  says("fact X keep\n", Kind::kAttributeNotHere);
  says("satellites X { a } exclusive\n", Kind::kLoneExclusive);
  says("satellite X = 1.5\n", Kind::kValueOutOfRange);
  says("satellites X { a, b } exclusive = +1\n", Kind::kTwoInitiallyHigh);
  says("fact X event 0.5 attention 0.5\n", Kind::kThresholdRange);
  says("satellite X of Y\n", Kind::kUnknownName);
  says("relation R(a, a)\n", Kind::kFieldTwice);
  says("relation R(a) satellites of b\n", Kind::kOfUnknownField);
}

TEST(Declarations, ANameThatIsDeclaredTwiceShowsBothPlaces) {
  const Known known("levels c\nfact X\nfact X\n");
  EXPECT_EQ(known.said(), "main.kb:3:6: KB0301 `X` is declared twice\n  main.kb:2:6: first declared here\n");
}

TEST(Declarations, TheLaterOfTwoIsTheSecondEvenIfSetsAreReadFirst) {
  const Known known("levels c\nfact X\nnames X { a }\n");
  EXPECT_EQ(known.said(), "main.kb:3:7: KB0301 `X` is declared twice\n  main.kb:2:6: first declared here\n");
}

TEST(Declarations, AThresholdIsToldOfWhereItsNumberStands) {
  EXPECT_EQ(Known("levels c\nfact X attention 0.9\n").said().substr(0, 18), "main.kb:2:18: KB03");
  EXPECT_EQ(Known("levels c\nfact X event 0.2\n").said().substr(0, 18), "main.kb:2:14: KB03");
}

TEST(Tables, AreTotal) {
  const std::string sets = "levels c\nnames A { p, q }\nnames B { x, y }\n";
  EXPECT_EQ(Known(sets + "table f(A, B) -> A { x y p: p q q: q p }\ntable g(A) -> B { p: x q: y }\n").said(), "");
  EXPECT_EQ(Known(sets + "table f(A, B) -> A { x y p: p q }\n").said(), "main.kb:4:7: KB0720 table `f` has no entry for `(q, x)`, `(q, y)`\n");
  EXPECT_TRUE(Known(sets + "table g(A) -> B { p: x p: y q: y }\n").said_only(Kind::kTableEntryTwice));
  EXPECT_TRUE(Known(sets + "table g(A) -> B { p: x z: y }\n").said_only(Kind::kUnknownMember));
  EXPECT_TRUE(Known(sets + "table g(A) -> B { p: x q: p }\n").said_only(Kind::kUnknownMember));
  EXPECT_TRUE(Known(sets + "table f(A, B) -> A { x y p: p q q: q }\n").said_only(Kind::kTableLine));
  EXPECT_TRUE(Known(sets + "table h(A) -> B { p: x }\ntable g more { q: x }\n").said_only(Kind::kTableMoreOfUnknown));
  EXPECT_TRUE(Known(sets + "table f(A, B, A) -> A { x y p: p q q: q p }\n").said_only(Kind::kTableParameters));
}

TEST(Settings, AFileOfTheUserOverridesTheLibrary) {
  const Known known("import std.basics\nset idle = hold, hold_limit = 2 s, event = 0.8\nfact F\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.model().settings.idle, Idle::kHold);
  EXPECT_EQ(known.model().settings.hold_limit_us, 2'000'000u);
  EXPECT_EQ(known.cell("F")->event, 0.8);
}

TEST(Settings, TwoFilesOfTheUserMustAgree) {
  const Known known("import \"a.kb\"\nset firing = 0.6\n", {{"a.kb", "set firing = 0.4\n"}});
  EXPECT_EQ(known.said(), "main.kb:2:5: KB0705 `firing` is set to two values\n  a.kb:1:5: `firing = 0.4` here\n");
}

TEST(Settings, MistakesAreNamed) {
  const auto says = [](const std::string& text, Kind kind) {
    const Known known("levels c\nstrategy Rest\n" + text);
    EXPECT_TRUE(known.said_only(kind)) << text << "\n" << known.said();
  };
  says("set evnt = 0.5\n", Kind::kUnknownSetting);
  says("set firing = 0\n", Kind::kSettingRange);
  says("set attention = 0.8\n", Kind::kSettingRange);
  says("set firing = high\n", Kind::kSettingKind);
  says("set idle = 3\n", Kind::kSettingKind);
  says("set idle = Rset\n", Kind::kIdleUnknown);
  says("set hold_limit = 5 m\n", Kind::kNotATimeUnit);
  says("levels c > d\n", Kind::kLevelsTwice);
  EXPECT_EQ(Known("levels a > b\nlevels a > b\nstrategy Rest\nset idle = Rest\n").said(), "");
  EXPECT_TRUE(Known("levels a > b > a\n").said_only(Kind::kLevelTwice));
  EXPECT_TRUE(Known("strategy U\n").said_only(Kind::kNoLevels));
}

TEST(Settings, WhoeverNamesAllLevelsInsertsMore) {
  const std::vector<std::string> all{"a", "b", "c", "d"};
  const Known outer("import \"few.kb\"\nlevels a > b > c > d\n", {{"few.kb", "levels a > c > d\n"}});
  EXPECT_EQ(outer.said(), "");
  EXPECT_EQ(outer.model().levels, all);
  const Known inner("import \"all.kb\"\nlevels a > c > d\nlevels b > d\n", {{"all.kb", "levels a > b > c > d\n"}});
  EXPECT_EQ(inner.said(), "");
  EXPECT_EQ(inner.model().levels, all);
  const Known both("import \"b.kb\"\nimport \"c.kb\"\nlevels a > b > c > d\n", {{"b.kb", "levels a > b > d\n"}, {"c.kb", "levels a > c > d\n"}});
  EXPECT_EQ(both.said(), "") << "whoever imports two files that insert levels says the order of all";
  EXPECT_EQ(both.model().levels, all);
  EXPECT_TRUE(Known("levels a > c\nlevels a > b > c\nlevels a > d > c\n").said_only(Kind::kLevelsTwice)) << "each inserts another";
  EXPECT_TRUE(Known("levels a > c\nlevels c > b > a\n").said_only(Kind::kLevelsTwice));
  EXPECT_TRUE(Known("levels a > c\nlevels a > c > d\n").said_only(Kind::kLevelsTwice)) << "the control level is one";
}

TEST(Priority, LinesMakeAPartialOrderThatIsExtended) {
  const std::string cells = "levels c\nnames S { a, b }\nstrategy Low\nstrategies G[S]\nstrategy Top\n";
  const Known known(cells + "priority Top > G\npriority G > Low\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.names(known.model().priority), "Top G.a G.b Low");
  const Known member(cells + "priority Top > G.b > G > Low\n");
  EXPECT_EQ(member.said(), "");
  EXPECT_EQ(member.names(member.model().priority), "Top G.b G.a Low");
}

TEST(Priority, MistakesAreNamed) {
  const std::string cells = "levels c\nfact F\nstrategy A\nstrategy B\nstrategy C\n";
  EXPECT_TRUE(Known(cells + "priority A > F > B > C\n").said_only(Kind::kPriorityOfNonStrategy));
  EXPECT_TRUE(Known(cells + "priority A > B > A\npriority B > C\n").said_only(Kind::kPriorityTwice));
  const Known circle(cells + "priority A > B > C\npriority C > A\n");
  EXPECT_EQ(circle.said(),
            "main.kb:6:14: KB0731 these priorities go round in a circle: `B > C > A > B`\n  main.kb:6:14: `B` before `C` here\n"
            "  main.kb:7:10: `C` before `A` here\n  main.kb:6:10: `A` before `B` here\n");
}

TEST(Controls, AFreeIndexTakesEveryMemberAndMayBeAnArgument) {
  const Known known("levels c\nnames T { l, r }\nnames K { m, d }\nstrategies U[T, K]\npriority U\n"
                    "control U[t, m] = turn(turn: t, speed: 36 km/h, angle: 20 cm, side: right)\ncontrol U[*, d] = wall()\n");
  EXPECT_EQ(known.said(), "");
  ASSERT_EQ(known.model().controls.size(), 4u);
  const Control& second = known.model().controls[1];
  EXPECT_EQ(known.model()[second.strategy].name, "U[r,m]");
  EXPECT_EQ(second.arguments[0].word, "r");
  EXPECT_EQ(second.arguments[1].number, 10.0);
  EXPECT_EQ(second.arguments[1].unit, "m/s");
  EXPECT_EQ(second.arguments[2].number, 0.2);
  EXPECT_EQ(second.arguments[3].word, "right");
}

TEST(Controls, MistakesAreNamed) {
  const auto says = [](const std::string& text, Kind kind) {
    const Known known("levels c\nfact F\nnames T { left, right }\nstrategies U[T]\npriority U\n" + text);
    EXPECT_TRUE(known.said_only(kind)) << text << "\n" << known.said();
  };
  says("control F = f()\n", Kind::kControlOfNonStrategy);
  says("control U = f()\ncontrol U.left = g()\n", Kind::kControlTwice);
  says("control U[lfet] = f()\n", Kind::kControlVariable);
  says("control U = f(v: 3 furlong)\n", Kind::kUnknownUnit);
  says("control U = f(v: 3, v: 4)\n", Kind::kControlArgumentTwice);
  says("control V = f()\n", Kind::kUnknownName);
}

TEST(Print, IsStableAndSaysEverything) {
  const std::string text = "levels c\nnames T { l, r }\nfact F\nsatellites S[T] of F exclusive\nstrategy U\nrule r[t in T] at c when F for 1 s then +S[t]\ncontrol U = go(v: 1 m/s)\n";
  const Known one(text);
  const Known two(text);
  const std::string printed = print(one.model(), one.sources());
  EXPECT_EQ(printed, print(two.model(), two.sources()));
  for (const char* line : {"set T { l, r }\n", "exclusive S.l, S.r\n", "rule r[l] at c when (F for 1000000 us) then S.l = 1  # main.kb:6:6\n", "control U = go(v: 1 m/s)  # main.kb:7:9\n"}) {
    EXPECT_NE(printed.find(line), std::string::npos) << line << printed;
  }
}

}  // namespace
}  // namespace kb::model::testing
