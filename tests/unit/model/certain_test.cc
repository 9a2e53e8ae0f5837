// Files with text that could not be read: which errors about names are reported besides.
#include <gtest/gtest.h>

#include "tests/unit/model/knowing.h"

namespace kb::model::testing {
namespace {

using diagnostics::Kind;

void expect_something_but_no_unknown_name(const Known& known) {
  EXPECT_FALSE(known.said(Kind::kUnknownName)) << known.said();
  EXPECT_FALSE(known.said().empty());
}

TEST(Certain, AMisspeltNameIsReportedBesideAnErrorOfSyntax) {
  const Known known("levels go\nfact Wall\nsatellite Turn\nrule a at go when seen Wall +Turn\nrule b at go when seen Wal then +Turn\nset = 1\n");
  EXPECT_TRUE(known.said(Kind::kUnknownName)) << known.said();
  EXPECT_NE(known.said().find("main.kb:5:24: KB0401 nothing is called `Wal` -> Wall"), std::string::npos) << known.said();
}

TEST(Certain, ANameThatUnreadTextMayDeclareIsNotReported) {
  const Known known("levels go\nfact Wall = = 1\nsatellite Turn\nrule b at go when seen Wall then +Turn\n");
  expect_something_but_no_unknown_name(known);
}

TEST(Certain, AMemberThatUnreadTextMayAddIsNotReported) {
  const Known known("levels go\nnames Side { left, right }\nnames Side more { top \nfacts Wall[Side]\nsatellite Turn\nrule b at go when Wall[top] then +Turn\nrule c at go when Wall[bottom] then +Turn\n");
  EXPECT_EQ(known.said().find("`top` is no member"), std::string::npos) << known.said();
  EXPECT_NE(known.said().find("`bottom`"), std::string::npos) << known.said();
}

TEST(Certain, ALandmarkThatCouldNotBeReadIsNotMissed) {
  const Known known("import std.navigation\nmap M {\n  landmark A\n  landmark B at (1, \n  landmark C\n  road A.E -- B.W by mark\n  road A.N -- D.S by mark\n}\n");
  EXPECT_EQ(known.said().find("no landmark `B`"), std::string::npos) << known.said();
  EXPECT_NE(known.said().find("no landmark `D`"), std::string::npos) << known.said();
}

TEST(Certain, NothingIsCertainWhereAnImportIsMissing) {
  for (const char* const import : {"import \"nowhere.kb\"\n", "import \"open.kb\n", "import std\n", "imprt \"other.kb\"\n", "import = \"other.kb\"\n", "\"other.kb\"\n"}) {
    const Known known(import + std::string("fact Wall\nlevels go\nsatellite Turn\nrule b at go when seen Wal then +Turn\n"), {{"other.kb", "fact Wal\n"}});
    expect_something_but_no_unknown_name(known);
  }
}

TEST(Certain, NothingIsCertainWhereLettersCouldNotBeRead) {
  for (const std::string_view damaged : {std::string_view("\xff\xfe" "f\0a\0c\0t\0 \0W\0a\0l\0", 18), std::string_view("fact W\xe4l\n"), std::string_view("fact W\0al\n", 10)}) {
    const Known known("levels go\nimport \"damaged.kb\"\nsatellite Turn\nrule b at go when seen Wal then +Turn\n", {{"damaged.kb", std::string(damaged)}});
    expect_something_but_no_unknown_name(known);
  }
}

TEST(Certain, SemicolonsHideNothing) {
  const Known known("levels go;\nfact Wall;\nsatellite Turn;\nrule b at go when seen Wal then +Turn;\n");
  EXPECT_TRUE(known.said(Kind::kUnknownName)) << known.said();
}

TEST(Certain, NothingIsCertainWhereADeclarationLacksItsName) {
  const Known known("levels go\nfact\nsatellite Turn\nrule b at go when seen Wall then +Turn\n");
  expect_something_but_no_unknown_name(known);
}

TEST(Certain, WhatFollowsFromTheRestIsNotReported) {
  const Known known("names Side { left, right }\nfact Wall\ntable f(Side) -> Side {\n  left: right\n}\nroute = 1\n");
  EXPECT_FALSE(known.said(Kind::kTableIncomplete)) << known.said();
}

TEST(Certain, WarningsWaitUntilAllIsRead) {
  const Known known("levels go\nnames Side { left, right }\nfact Wall\nsatellite Turn\nrule r[s in Side] at go when seen Wall then +Turn\nroute = 1\n");
  EXPECT_FALSE(known.said(Kind::kUnusedBinder)) << known.said();
}

}  // namespace
}  // namespace kb::model::testing
