// The questions to the whole knowledge base, asked of small ones in the language itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "compiler/diagnostics/consumers.h"
#include "compiler/driver/compile.h"
#include "compiler/source/source.h"

namespace kb::analysis {
namespace {

using diagnostics::Diagnostic;

/// Compiles `text` as main.kb and gives back what was said of it.
std::vector<Diagnostic> said_of(const std::string& text, bool standard_library = false) {
  source::MemoryFileSystem files;
  files.add("main.kb", text);
  const source::RealFileSystem disk;
  const std::string library = std::string(KB_PROJECT_ROOT) + "/stdlib_rules";
  for (const char* name :
       {"basics", "care", "crossing", "detour", "driving", "mission", "navigation", "obstacle", "retreat", "road", "route", "search"}) {
    const source::FileSystem::Result file = disk.read(library + "/std/" + name + ".kb");
    files.add(std::string("lib/std/") + name + ".kb", file.bytes.value_or(""));
  }
  for (const char* name : {"labyrinth.kb", "route1.kb"}) {
    const source::FileSystem::Result file = disk.read(std::string(KB_PROJECT_ROOT) + "/examples/01_route1/" + name);
    files.add(name, file.bytes.value_or(""));
  }
  driver::Options options;
  options.library = "lib";
  options.until = driver::Stage::kAnalysis;
  options.warnings.standard_library = standard_library;
  std::vector<Diagnostic> said;
  (void)driver::compile("main.kb", files, options, diagnostics::Keeping::make, &said);
  return said;
}

/// "KB1010 `a` and `b` can ...", one for each message.
std::vector<std::string> messages(const std::vector<Diagnostic>& said) {
  std::vector<std::string> found;
  for (const Diagnostic& one : said) found.push_back(diagnostics::code_text(one.kind) + " " + one.message);
  return found;
}

using Strings = std::vector<std::string>;

/// The block after `word` ("Wrong:", "Right:") of an explanation.
std::string example(std::string_view explanation, const std::string& word) {
  const std::size_t begin = explanation.find("```kb\n", explanation.find(word));
  if (begin == std::string_view::npos) return {};
  const std::size_t first = begin + 6;
  return std::string(explanation.substr(first, explanation.find("```", first) - first));
}

TEST(Explanations, OfWarningsAreRightAboutWrongAndRight) {
  for (int i = 0; i < static_cast<int>(diagnostics::Kind::kCount_); ++i) {
    const auto kind = static_cast<diagnostics::Kind>(i);
    const diagnostics::KindInfo& info = diagnostics::info(kind);
    const bool ours = info.code >= 1001 && info.code <= 1099 && info.severity == diagnostics::Severity::kWarning;
    if (!ours) continue;
    const std::string code = diagnostics::code_text(kind);
    const std::vector<Diagnostic> wrong = said_of(example(diagnostics::explanation(kind), "Wrong:"));
    ASSERT_EQ(wrong.size(), 1u) << code << ::testing::PrintToString(messages(wrong));
    EXPECT_EQ(wrong[0].kind, kind) << ::testing::PrintToString(messages(wrong));
    const std::vector<Diagnostic> right = said_of(example(diagnostics::explanation(kind), "Right:"));
    EXPECT_TRUE(right.empty()) << code << ::testing::PrintToString(messages(right));
  }
}

TEST(Diagnose, SaysNothingOfTheStandardLibraryWithTheMissionOfThePaper) {
  EXPECT_EQ(messages(said_of("import \"route1.kb\"")), Strings{});
}

TEST(Diagnose, TellsTheLibrarysOwnOnRequest) {
  const Strings said = messages(said_of("import \"route1.kb\"", true));
  EXPECT_FALSE(said.empty());
  for (const std::string& message : said) {
    // `Wary` of std.obstacle is raised by std.hall, which is not imported here. Three timers run on if a road or a mission ends and the next begins on one tick.
    const auto known = {"set_out", "control", "`Wary`", "rule `drive_as_seen[mark]` may run on", "rule `look_round` may run on", "rule `report_no_track` may run on"};
    EXPECT_TRUE(std::ranges::any_of(known, [&](const char* words) { return message.find(words) != std::string::npos; })) << message;
  }
}

TEST(Diagnose, NamesOneInstanceAndCountsTheOthers) {
  const Strings said = messages(said_of(R"(levels goal > control
names Method { mark, dist, azimuth }
facts Up[Method], Down[Method]
strategies Move[Method]
priority Move
rule up[k in Method] at goal when seen Up[k] then +sat Move[k]
rule down[k in Method] at goal when seen Down[k] then -sat Move[k]
control Move[*] = drive()
)"));
  ASSERT_EQ(said.size(), 1u) << ::testing::PrintToString(said);
  EXPECT_EQ(said[0],
            "KB1010 `up[mark]` and `down[mark]` can fire together at level `goal` and disagree about `sat Move.mark`"
            " (and 2 more such pairs of their instances)");
}

/// The message about priorities of two strategies, `rules` being all that is said of their satellites.
Strings unsettled(const std::string& rules) {
  Strings said = messages(said_of("levels goal > control\nfacts P, Q\nstrategies A, B\ncontrol A = a()\ncontrol B = b()\n" + rules));
  std::erase_if(said, [](const std::string& one) { return !one.starts_with("KB1062"); });
  return said;
}

TEST(Diagnose, NamesStrategiesThatNothingOrdersIfTheyCanMeet) {
  const Strings one = {"KB1062 no `priority` orders `B` against `A`"};
  EXPECT_EQ(unsettled("rule a at goal when P then +sat A\nrule b at goal when Q then +sat B\n"), one);
  EXPECT_EQ(unsettled("rule a at goal when P then +sat A\nrule b at goal when Q then +sat B\npriority B > A\n"), Strings{});
  EXPECT_EQ(unsettled("rule a at goal when P then +sat A\n"), Strings{}) << "nothing wants B";
  EXPECT_EQ(unsettled("rule a at goal when P then +sat A\nset idle = B\n"), Strings{}) << "idle runs where nothing is wanted";
  const std::string choice = "satellites X of A, Y of B exclusive\nrule a at goal when P then +X\n";
  EXPECT_EQ(unsettled(choice + "rule b at goal when Q then +Y\n"), Strings{});
  EXPECT_EQ(unsettled(choice + "rule b at goal when Q then +Y, X = 0\n"), one) << "blended with `a` both may be high";
  EXPECT_EQ(unsettled(choice + "rule b at goal when Q then +Y, +sat A\n"), one) << "A is wanted by another satellite as well";
}

TEST(Diagnose, BlamesTheUsersRuleWhereItDisagreesWithTheLibrary) {
  const std::vector<Diagnostic> said = said_of(R"(import "route1.kb"
rule linger at passage when seen Line then -Driving
)");
  ASSERT_EQ(said.size(), 1u) << ::testing::PrintToString(messages(said));
  EXPECT_EQ(messages(said)[0],
            "KB1010 `leave` and `linger` can fire together at level `passage` and disagree about `Driving`");
  EXPECT_EQ(said[0].span.begin, 24u);
  EXPECT_EQ(said[0].notes.size(), 1u);
}

TEST(Diagnose, LetsConditionsTellRulesApart) {
  for (const char* conditions : {"A and not B|A and B", "A is high|A is low", "In.N|In.S", "seen In.N|seen In.S", "P|Q",
                                 "event A|not seen A", "A for 1 s|not A", "(A or B) and not A|not B"}) {
    const std::string text = conditions;
    const std::size_t bar = text.find('|');
    const Strings said = messages(said_of(R"(levels goal > control
facts A, B
facts In { N, S } exclusive
satellites P, Q exclusive
strategy Go
rule p at goal when event A and not B then +P
rule q at goal when event B and not A and not seen A then +Q
rule p_read at goal when P and lost A then -P
rule q_read at goal when Q and lost B then -Q
rule use at goal when any In and any In and P and Q then +P
rule up at goal when )" + text.substr(0, bar) +
                                          " then +sat Go\nrule down at goal when " + text.substr(bar + 1) +
                                          " then -sat Go\ncontrol Go = drive()\n"));
    for (const std::string& message : said)
      EXPECT_EQ(message.find("sat Go"), std::string::npos) << conditions << ": " << message;
  }
}

TEST(Diagnose, AResetDisagreesWithNobody) {
  EXPECT_EQ(messages(said_of(R"(levels goal > control
facts Abort, Line
strategy Go
rule go at goal when seen Line then +sat Go
rule abort at goal while Abort then reset
control Go = drive()
)")),
            Strings{});
}

TEST(Diagnose, SaysWhenItDidNotLook) {
  std::string text = "levels goal > control\nnames Place { p0";
  for (int i = 1; i < 3000; ++i) text += ", p" + std::to_string(i);
  text += R"( }
facts Seen[Place]
strategy Greet
rule greet[p in Place] at goal when seen Seen[p] then +sat Greet
rule leave[p in Place] at goal when not seen Seen[p] then -sat Greet
control Greet = greet()
)";
  const Strings said = messages(said_of(text));
  ASSERT_EQ(said.size(), 1u) << ::testing::PrintToString(said);
  EXPECT_EQ(said[0],
            "KB1040 not all conflicts between rules of level `goal` are looked for: too many of them write `sat Greet`");
}

}  // namespace
}  // namespace kb::analysis
