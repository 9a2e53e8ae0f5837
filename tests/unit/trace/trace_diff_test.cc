#include "tools/kbc/trace/trace_diff.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "compiler/program/tick.h"

namespace kb::trace {
namespace {

using Sentences = std::vector<std::string>;

std::string tick(int number, std::string_view fired = "", std::string_view set = "",
                 std::string_view strategy = "null") {
  return fmt::format(
      R"({{"tick":{},"t":{},"events":[],"lost":[],"fired":[{}],"set":{{{}}},"conflicts":[],"strategy":{},"status":"ok"}})",
      number, number * 0.1, fired, set, strategy);
}

TEST(CompareTicks, finds_no_difference_in_layout_or_order_of_keys) {
  EXPECT_EQ(compare_ticks(R"({"tick":1,"set":{"A":1,"B":-1}})", R"({ "set": {"B": -1.0, "A": 1}, "tick": 1 })"),
            Sentences{});
}

TEST(CompareTicks, says_every_difference_in_words) {
  EXPECT_EQ(
      compare_ticks(tick(3, R"("a","b")", R"("X":1,"Y":1)", "\"Move\""), tick(3, R"("b","c")", R"("X":-1,"Z":0.5)")),
      (Sentences{"runs nothing, expected `Move`", "`a` did not fire, which was expected",
                 "`c` fired, which was not expected", "`X` was set to -1, expected 1", "`Y` was not set, expected 1",
                 "`Z` was set to 0.5, which was not expected"}));
}

TEST(TraceKeys, are_those_of_a_tick_that_is_written) {
  program::Program program;
  program.cells.emplace_back().name = "F";
  program.facts = 1;
  program::Tick tick;
  tick.perceived.push_back({program::CellId{0}, 1.0f});
  std::vector<std::string_view> all(kTraceKeys.begin(), kTraceKeys.end());
  const std::string line = print_json(program, tick);
  EXPECT_EQ(with_keys(line, all), line);
  EXPECT_EQ(with_keys(line, {"cf"}), R"({"tick":0,"t":0,"cf":{"F":1}})");
}

TEST(CompareTicks, tells_a_changed_order_from_changed_rules) {
  EXPECT_EQ(compare_ticks(tick(1, R"("a","b")"), tick(1, R"("b","a")")),
            (Sentences{R"(fired in another order: ["b","a"], expected ["a","b"])"}));
}

TEST(CompareTicks, sees_keys_that_only_one_trace_has) {
  EXPECT_EQ(compare_ticks(R"({"tick":1,"note":"x"})", R"({"tick":1})"), (Sentences{"note is nothing, expected `x`"}));
  EXPECT_EQ(compare_ticks(R"({"tick":1})", R"({"tick":1,"note":2})"), (Sentences{"note is 2, expected nothing"}));
}

TEST(TickFault, names_what_is_no_tick) {
  EXPECT_EQ(tick_fault(tick(1)), "");
  EXPECT_EQ(tick_fault("{"), "it is not JSON");
  EXPECT_EQ(tick_fault("[1]"), "it is not a JSON object");
  EXPECT_EQ(tick_fault("{}"), "it has no `tick`");
  EXPECT_EQ(tick_fault(std::string(500000, '[')), "it is not JSON") << "deep nesting must not take the stack";
}

TEST(TraceDiffer, shows_the_ticks_before_and_the_first_that_differ) {
  TraceDiffer differ;
  for (int i = 1; i <= 4; ++i) differ.compare(tick(i), tick(i));
  differ.compare(tick(5, R"("a")"), tick(5));
  for (int i = 6; i <= 12; ++i) differ.compare(tick(i, "", R"("X":1)"), tick(i));
  EXPECT_EQ(differ.report(),
            "  tick 3, as expected: runs nothing\n"
            "  tick 4, as expected: runs nothing\n"
            "  tick 5 differs:\n"
            "    - `a` did not fire, which was expected\n"
            "    expected: fired `a`; runs nothing\n"
            "    happened: runs nothing\n"
            "  tick 6 differs:\n"
            "    - `X` was not set, expected 1\n"
            "    expected: set `X` 1; runs nothing\n"
            "    happened: runs nothing\n"
            "  tick 7 differs:\n"
            "    - `X` was not set, expected 1\n"
            "    expected: set `X` 1; runs nothing\n"
            "    happened: runs nothing\n"
            "  and 5 more ticks differ\n");
}

TEST(TraceDiffer, says_which_trace_ended_first) {
  TraceDiffer shorter, longer;
  shorter.compare(tick(1), tick(1));
  shorter.compare(tick(2), std::nullopt);
  EXPECT_EQ(shorter.report(), "  the run ended after 1 tick; 1 more expected\n");
  longer.compare(tick(1), tick(1));
  longer.compare(std::nullopt, tick(2));
  longer.compare(std::nullopt, tick(3));
  EXPECT_EQ(longer.report(), "  1 tick expected; the run went on for 2 more\n");
}

}  // namespace
}  // namespace kb::trace
