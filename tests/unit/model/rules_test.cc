#include <gtest/gtest.h>

#include "tests/unit/model/knowing.h"

namespace kb::model::testing {
namespace {

using diagnostics::Kind;

const std::string kCells =
    "levels high > low\nnames Side { L, R }\nnames Kind { a, b, c }\nfact F\nfacts G { x, y }\nfacts H[Side]\nsatellite S\n"
    "satellites T[Side, Kind] of F exclusive\nstrategies U[Side]\npriority U\n";
const std::string kTable = "table flip(Side) -> Side { L: R  R: L }\n";

/// With the table, or an empty line, since a warning tells of tables that nothing names.
Known with(const std::string& more) { return Known(kCells + (more.find("flip") == std::string::npos ? "\n" : kTable) + more); }

TEST(Conditions, AreResolvedAsWritten) {
  const Known known = with("rule r[s in Side] at high when (F is low or H[s]) and S is not high and seen G.x for 2 s and any T[s, *] and no G then +S\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.condition("r[R]"),
            "and(or(F:low H.R) not(S) for(seen:G.x 2000000) or(T[R,a] T[R,b] T[R,c]) not(or(G.x G.y)))");
}

TEST(Conditions, SatIsAnyThatDrawsAttention) {
  const Known known = with("rule r at high when sat F and sat G.x is low and any sat H then +S\n");
  EXPECT_EQ(known.condition("r"),
            "and(or(sat F T[L,a] T[L,b] T[L,c] T[R,a] T[R,b] T[R,c]) sat G.x:low or(sat H.L sat H.R))");
}

TEST(Conditions, ABinderOverAGroupIsItsMemberAndItsCell) {
  const Known known = with("rule r[g in G, u in U] at high when g and U[u] then -sat G[g], +sat u\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.condition("r[y,R]"), "and(G.y U.R)");
  EXPECT_EQ(known.effects("r[y,R]"), "sat G.y=-1, sat U.R=1");
}

TEST(Conditions, ATableStandsWhereAnIndexStands) {
  const Known known = with("rule r[s in Side] at high when H[s] and H[flip(flip(s))] then +T[flip(s), a]\n");
  EXPECT_EQ(known.effects("r[L]"), "T[R,a]=1");
  EXPECT_EQ(known.condition("r[L]"), "and(H.L H.L)");
}

TEST(Conditions, MistakesAreNamed) {
  const auto says = [](const std::string& condition, Kind kind) {
    const Known known = with("rule r[s in Side] at high when " + condition + " then -T[s, *]\n");
    EXPECT_TRUE(known.said_only(kind)) << condition << "\n" << known.said();
  };
  says("Fx", Kind::kUnknownName);
  says("L", Kind::kBareMember);
  says("H", Kind::kWholeGroup);
  says("H[*]", Kind::kWholeGroup);
  says("H.Q", Kind::kUnknownMember);
  says("H[Q]", Kind::kUnknownMember);
  says("H[L, R]", Kind::kIndexCount);
  says("T.L", Kind::kIndexCount);
  says("T[a, s]", Kind::kIndexOfWrongSet);
  says("H[F]", Kind::kIndexNotAMember);
  says("F[L]", Kind::kNotIndexed);
  says("F.x", Kind::kNoFields);
  says("s.x", Kind::kNoFields);
  says("s", Kind::kNotACell);
  says("Side", Kind::kNotACell);
  says("flip", Kind::kTableWithoutArguments);
  says("flip(s)", Kind::kNotACell);
  says("H[flip(L, R)]", Kind::kArgumentCount);
  says("H[flip(a)]", Kind::kArgumentOfWrongSet);
  says("H[flip(*)]", Kind::kStarInCall);
  says("F(s)", Kind::kNotATable);
  says("event S", Kind::kEventOfNonFact);
  says("lost U[s]", Kind::kEventOfNonFact);
  says("seen G", Kind::kEventOfGroup);
  says("sat S", Kind::kSatOfSatellite);
  says("any F", Kind::kAnyOfOne);
  says("F for 0.2 us", Kind::kTimeTooShort);
  says("F for 2 h", Kind::kTimeTooLong);
}

TEST(Conditions, AnUnknownNameIsSaidOnceAndTheNearestSuggested) {
  const Known known = with("fact Line\nrule r at high when Lien and not Lien then +S\nrule q at high when Lien then +S\n");
  EXPECT_EQ(known.said(), "main.kb:13:21: KB0401 nothing is called `Lien` -> Line\n");
}

TEST(Effects, AreKeptInOrderAsWritten) {
  const Known known = with("rule r at high when F then -T[*], +T[L, b], sat F = 0.5, reset, S = -0.25\n");
  EXPECT_EQ(known.effects("r"), "T[L,a]=-1, T[L,b]=-1, T[L,c]=-1, T[R,a]=-1, T[R,b]=-1, T[R,c]=-1, T[L,b]=1, sat F=0.5, reset, S=-0.25");
}

TEST(Effects, MistakesSayWhatWasProbablyMeant) {
  const auto says = [](const std::string& effect, Kind kind) {
    const Known known = with("rule r at high when F then " + effect + "\n");
    EXPECT_TRUE(known.said_only(kind)) << effect << "\n" << known.said();
  };
  says("+F", Kind::kWriteToFact);
  says("+U.L", Kind::kWriteToStrategy);
  says("-T", Kind::kWriteWholeGroup);
  says("+sat S", Kind::kSatOfSatellite);
  says("S = 1.5", Kind::kValueOutOfRange);
  says("S = 1 s", Kind::kValueWithUnit);
  says("+Side", Kind::kNotACell);
}

TEST(Rows, ARelationOfOnesOwnHasRowsWrittenOut) {
  const Known known = with("relation Pair(left, side, when) satellites of left exclusive\n"
                           "row P in Pair(left: F, side: R, when: S and F)\nrow in Pair(left: G.x, side: Side.L)\n"
                           "rule r[p in Pair] at high when p.left and p.when and H[p.side] then +p\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.condition("r[P]"), "and(F and(S F) H.R)");
  EXPECT_EQ(known.instances("r"), 1u);  // the second has no `when`
  EXPECT_EQ(known.names(known.cell("G.x")->satellites), "sat G.x Pair.1");
  EXPECT_EQ(known.names(known.model().exclusive.back()), "P Pair.1");
}

TEST(Rows, WhatAFieldIsMissingForIsNotTriedWithTheOthers) {
  const Known known = with("relation Pair(side, next)\nrow P in Pair(side: L, next: Q)\nrow Q in Pair(side: R)\nrow O in Pair(next: Q)\n"
                           "rule first[a in Pair, b in Pair, c in Pair] at high when H[a.next.side] and H[b.side] and H[c.side] then +S\n"
                           "rule last[a in Pair, b in Pair, c in Pair] at high when H[c.next.side] and H[b.side] and H[a.side] then +S\n"
                           "rule both[a in Pair, b in Pair] at high when H[b.next.side] and H[a.next.next.side] then +S\n");
  EXPECT_EQ(known.said(), "");
  EXPECT_EQ(known.instances("first"), 8u);  // P and O, P and Q, P and Q
  EXPECT_EQ(known.condition("first[O,Q,P]"), "and(H.R H.R H.L)");
  EXPECT_EQ(known.instances("last"), 8u);
  EXPECT_EQ(known.condition("last[P,Q,O]"), "and(H.R H.R H.L)");
  EXPECT_EQ(known.instances("both"), 0u);
}

TEST(Rows, MistakesAreNamed) {
  const std::string relation = "relation Pair(left, side)\nrelation Far(cell) satellites of cell\n";
  EXPECT_TRUE(with(relation + "row in Pear(left: F)\n").said_only(Kind::kUnknownRelation));
  EXPECT_TRUE(with(relation + "row in Pair(lefd: F)\n").said_only(Kind::kUnknownField));
  EXPECT_TRUE(with(relation + "row in Pair(left: F, left: S)\n").said_only(Kind::kFieldTwice));
  EXPECT_TRUE(with(relation + "row in Far(cell: S)\n").said_only(Kind::kOfFieldWithoutCell));
  EXPECT_TRUE(with(relation + "rule r[p in Pair] at high when p then +S\n").said_only(Kind::kNoState));
  EXPECT_TRUE(with(relation + "rule r[p in Pair] at high when p.lefd then +S\n").said_only(Kind::kUnknownField));
  EXPECT_TRUE(with(relation + "rule r[p in Far] at high when sat p then +S\n").said_only(Kind::kSatOfSatellite));
  EXPECT_TRUE(with(relation + "rule r[p in Far] at high when event p then +S\n").said_only(Kind::kEventOfNonFact));
}

TEST(Rules, TheirHeadsAreChecked) {
  EXPECT_TRUE(with("rule r at hihg when F then +S\n").said_only(Kind::kUnknownLevel));
  EXPECT_TRUE(with("rule r[s in Sid] at high when H[s] then +S\n").said(Kind::kUnknownSet));
  EXPECT_TRUE(with("rule r[s in F] at high when F then +S\n").said_only(Kind::kNotASet));
  EXPECT_TRUE(with("rule r[s in Side, s in Kind] at high when H[s] then +S\n").said(Kind::kBinderTwice));
  EXPECT_TRUE(with("rule r[s in Side] at high when F then +S\n").said_only(Kind::kUnusedBinder));
  EXPECT_TRUE(with("rule r[s in Side] at high when F[s] then +S\n").said_only(Kind::kNotIndexed));  // and nothing of `s`
  EXPECT_TRUE(with("rule r at high when F then +S\nrule r at low when F then -S\n").said_only(Kind::kRuleTwice));
  EXPECT_TRUE(Known("fact F\nrule r at high when F then +sat F\n").said_only(Kind::kNoLevels));
}

TEST(Rules, AProductThatIsTooLargeIsRefusedByName) {
  std::string set = "names Big { ";
  for (int i = 0; i < 300; ++i) set += (i == 0 ? "m" : ", m") + std::to_string(i);
  const Known known = with(set + " }\nfacts P[Big]\nrule r[a in Big, b in Big, c in Big] at high when P[a] and P[b] and P[c] then +S\n");
  EXPECT_EQ(known.said(), "main.kb:14:6: KB0810 rule `r` would be tried for 27000000 combinations; at most 10000000 are allowed\n");
}

}  // namespace
}  // namespace kb::model::testing
