// The printed forms of a program and of a tick.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "compiler/program/cell_uses.h"
#include "compiler/program/net_effects.h"
#include "tests/unit/program/program_builder.h"
#include "tests/unit/program/random_program.h"

namespace kb::program::testing {
namespace {

using nlohmann::json;

Program example() {
  ProgramBuilder b({"goal", "control"});
  b.fact("Line").fact("Safe", 0.6, 0.1);
  b.satellite("A").satellite("B").satellite("K", 0.25f, true).of("A", "Line").exclusive({"A", "B"});
  b.strategy("Go[left,mark]").idle("hold");
  b.when("enter[left]", "goal",
         all({event("Line"), no(any({low("Safe"), zero("B")})), held(no(seen("Safe")), 300'000)}),
         {raise("A"), raise("sat Go[left,mark]"), assign("K", -0.5f)});
  b.while_true("abort", "goal", lost("Line"), {reset_all()});
  return b.build();
}

TEST(Print, SpeaksTheLanguagesOwnWords) {
  const Program program = example();
  std::string rules;
  print(program, {rule(program, "enter[left]"), rule(program, "abort"), rule(program, "run[Go[left,mark]]")}, [&](std::string_view piece) { rules += piece; });
  EXPECT_EQ(rules,
            "rule enter[left] at goal    # built.kb:1:1\n"
            "    when event Line and not (Safe is low or B is zero) and not seen Safe for 300 ms\n"
            "    then +A, +sat Go[left,mark], K = -0.5\n"
            "rule abort at goal    # built.kb:2:1\n"
            "    while lost Line\n"
            "    then reset\n"
            "rule run[Go[left,mark]] at control    # priority\n"
            "    while sat Go[left,mark]\n"
            "    then +Go[left,mark]\n");
}

TEST(Print, ParenthesesStandWhereTheLanguageNeedsThem) {
  ProgramBuilder b({"goal", "control"});
  b.satellite("A").satellite("B");
  const auto printed = [&](Expression condition) {
    ProgramBuilder copy = b;
    copy.when("r", "goal", std::move(condition), {raise("A")});
    const Program program = copy.build();
    return print_condition(program, program.rules[0].condition);
  };
  EXPECT_EQ(printed(all({any({high("A"), high("B")}), high("B")})), "(A or B) and B");
  EXPECT_EQ(printed(any({all({high("A"), low("B")}), high("B")})), "A and B is low or B");
  EXPECT_EQ(printed(held(all({high("A"), high("B")}), 1'500'000)), "(A and B) for 1.5 s");
  EXPECT_EQ(printed(held(held(high("A"), 500), 20'000'000)), "(A for 0.5 ms) for 20 s");
  EXPECT_EQ(printed(no(held(high("A"), 1'000'000))), "not (A for 1 s)");
  EXPECT_EQ(printed(no(no(high("A")))), "not not A");
  EXPECT_EQ(printed(any({})), "never");
  EXPECT_EQ(printed(no(all({}))), "not always");
}

TEST(Print, RulesCanBeSelectedByNameAndLevel) {
  const Program program = example();
  EXPECT_EQ(names(program, select(program, {"enter", {}})), std::vector<std::string>{"enter[left]"});
  EXPECT_EQ(select(program, {{}, "goal"}).size(), 2u);
}

TEST(CellUses, TellWhatIsNamedFromWhatIsOnlyReached) {
  const Program program = example();
  const auto uses = [&](std::string_view cell) {
    const auto at = std::find_if(program.cells.begin(), program.cells.end(), [&](const Cell& one) { return one.name == cell; });
    return uses_of(program, {static_cast<CellId>(at - program.cells.begin())}, select(program, {}));
  };
  EXPECT_EQ(names(program, uses("Safe").readers), std::vector<std::string>{"enter[left]"});
  EXPECT_TRUE(uses("Safe").writers.empty());
  EXPECT_EQ(names(program, uses("A").writers), std::vector<std::string>{"enter[left]"});
  EXPECT_EQ(names(program, uses("A").resetters), std::vector<std::string>{"abort"});
  EXPECT_EQ(names(program, uses("B").readers), std::vector<std::string>{"enter[left]"}) << "raising A also silences B, but the rule names it";
  EXPECT_TRUE(uses("K").resetters.empty()) << "it is kept";
}

TEST(ProgramJson, HasTheDocumentedShape) {
  const Program program = example();
  const json form = json::parse(print_json(program));
  EXPECT_EQ(form["settings"],
            json::parse(R"({"event":0.75,"attention":0.25,"firing":0.5,"idle":"hold","hold_limit":5})"));
  EXPECT_EQ(form["cells"][0], json::parse(R"({"name":"Line","kind":"fact","initial":0,"event":0.75,"attention":0.25,
                                              "satellites":["sat Line","A"]})"));
  EXPECT_EQ(form["cells"][6], json::parse(R"({"name":"K","kind":"satellite","initial":0.25,"keep":true})"))
      << form["cells"];
  EXPECT_EQ(form["exclusive"], json::parse(R"([["A","B"]])"));
  EXPECT_EQ(form["levels"], json::parse(R"(["goal","control"])"));
  EXPECT_EQ(form["priority"], json::parse(R"(["Go[left,mark]"])"));
  EXPECT_EQ(form["rules"][0], json::parse(R"({"name":"enter[left]","level":"goal","mode":"when",
      "if":{"and":[{"event":"Line"},{"not":{"or":[{"is":["Safe","low"]},{"is":["B","zero"]}]}},
                   {"for":[{"not":{"seen":"Safe"}},0.3]}]},
      "then":[["A",1],["B",-1],["K",-0.5],["sat Go[left,mark]",1]],"at":"built.kb:1:1"})"));
  EXPECT_TRUE(form["rules"][1]["reset"]);
  EXPECT_EQ(form["rules"][1]["then"].size(), 5u);  // all satellites but K
  EXPECT_EQ(form["rules"][2]["at"], "priority");
}

TEST(ProgramJson, WritesOutTheNetEffectsOfEveryRule) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Program program = random_program(seed);
    const json form = json::parse(print_json(program));
    ASSERT_EQ(form["rules"].size(), program.rules.size());
    for (std::size_t i = 0; i < program.rules.size(); ++i) {
      ASSERT_EQ(form["rules"][i]["then"].size(), net_writes(program, program.rules[i]).size()) << "seed " << seed;
    }
  }
}

TEST(TickJson, IsOneLineWithNamesAndShortestNumbers) {
  const Program program = example();
  Tick tick;
  tick.number = 3;
  tick.time_us = 400'000;
  tick.events = {cell(program, "Line")};
  tick.fired = {rule(program, "enter[left]"), rule(program, "abort")};
  tick.set = {{cell(program, "A"), 1.0f}, {cell(program, "K"), 0.1f}};
  tick.conflicts = {{cell(program, "B"), {rule(program, "abort")}}};
  tick.strategy = cell(program, "Go[left,mark]");
  tick.status = Status::kConflict;
  EXPECT_EQ(print_json(program, tick),
            R"({"tick":3,"t":0.4,"events":["Line"],"lost":[],"fired":["enter[left]","abort"],"set":{"A":1,"K":0.1},)"
            R"("conflicts":[{"cell":"B","rules":["abort"]}],"strategy":"Go[left,mark]","status":"conflict"})");
}

TEST(TickJson, TimeIsExactInMicroseconds) {
  const Program program = example();
  for (const auto& [time_us, text] :
       std::map<std::int64_t, std::string>{{0, "0"},
                                           {1, "0.000001"},
                                           {100'000, "0.1"},
                                           {12'000'000, "12"},
                                           {9'007'199'254'740'993, "9007199254.740993"}}) {
    Tick tick;
    tick.time_us = time_us;
    EXPECT_NE(print_json(program, tick).find("\"t\":" + text + ","), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace kb::program::testing
