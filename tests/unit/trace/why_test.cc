#include "tools/kbc/trace/why.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/unit/trace/sample.h"
#include "tools/kbc/trace/cell_names.h"

namespace kb::trace {
namespace {

using program::testing::cell;
using Facts = std::map<std::string, float>;

// A run whose last tick is asked about.
struct Story {
  explicit Story(const std::vector<Facts>& ticks) : recorder(program, ticks.size()), interpreter(program) {
    interpreter.observe(&recorder);
    for (const Facts& facts : ticks)
      recorder.tick_ended(interpreter.tick(program::testing::facts(program, facts), 100'000), interpreter);
  }
  Story(const Story&) = delete;
  [[nodiscard]] Answer ask(const Question& question) const { return answer(program, recorder.record(), question); }
  [[nodiscard]] std::string text(const Question& question) const {
    return print(program, recorder.record(), ask(question));
  }

  program::Program program = testing::sample_program();
  program::Recorder recorder;
  program::Interpreter interpreter;
};

const std::vector<Facts> kAtTheGate{{}, {{"Start", 1.0f}}, {{"Line", 1.0f}}, {{"In.N", 1.0f}, {"Safe", 0.1f}}};

TEST(Why, lists_the_instances_of_a_rule_the_nearest_to_firing_first) {
  const Story story(kAtTheGate);
  const Answer answer = story.ask({.rules = find_rules(story.program, "pass")});
  ASSERT_EQ(answer.rules.size(), 2u);
  EXPECT_EQ(story.program[answer.rules[0].story.rule].name, "pass[N]");
  EXPECT_EQ(answer.rules[0].near.lacking, 2u) << "`Safe`, and a tick more of `In.N`";
  EXPECT_EQ(answer.rules[1].near.lacking, 2u);
  EXPECT_LT(answer.rules[0].near.gap, answer.rules[1].near.gap);
}

TEST(Why, says_with_numbers_what_a_rule_lacks) {
  std::vector<Facts> ticks = kAtTheGate;
  for (int i = 0; i < 3; ++i) ticks.push_back({{"In.N", 1.0f}, {"Safe", 0.1f}});
  const Story story(ticks);
  const std::string text = story.text({.rules = find_rules(story.program, "pass[N]")});
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "`pass[N]` did not fire at tick 7: `Safe` is 0.10, needs 0.50; all else holds");
}

TEST(Why, tells_of_a_low_satellite_who_lowered_it_and_who_would_raise_it) {
  const Story story(kAtTheGate);
  const Answer answer = story.ask({.cell = cell(story.program, "Driving")});
  ASSERT_EQ(answer.cells.size(), 1u);
  EXPECT_EQ(answer.cells[0].raisers.size(), 3u);
  const std::string text = story.text({.cell = cell(story.program, "Driving")});
  EXPECT_NE(text.find("`wait`"), std::string::npos) << text;
  EXPECT_NE(text.find("3 rules would raise it, the nearest first:"), std::string::npos) << text;
}

TEST(Why, says_that_no_rule_raises_a_satellite) {
  const Story story(kAtTheGate);
  EXPECT_NE(story.text({.cell = cell(story.program, "sat Safe")}).find("no rule raises it"), std::string::npos);
}

TEST(Why, says_what_a_fact_had_to_pass_and_why) {
  const Story unattended({{}, {{"Line", 0.6f}}});
  EXPECT_EQ(unattended.text({.cell = cell(unattended.program, "Line")}),
            "`Line` is 0.60 after tick 2: given from outside; it is not seen\n"
            "  seen above 0.75, as no satellite of it was high when the tick began (above 0.50 if one were)\n");
  const Story attended({{}, {{"Start", 0.6f}}});
  EXPECT_NE(attended.text({.cell = cell(attended.program, "Start")}).find("seen above 0.50, as `sat Start` was high"),
            std::string::npos);
  const Story kept({{}, {{"Line", 0.9f}}, {{"Line", 0.6f}}});
  EXPECT_NE(kept.text({.cell = cell(kept.program, "Line")}).find("seen above 0.50, as it was seen on the tick before"),
            std::string::npos);
}

TEST(Why, names_the_strategy_that_goes_before) {
  Story story(kAtTheGate);
  const Answer stop = story.ask({.strategy = cell(story.program, "Stop")});
  ASSERT_TRUE(stop.strategy);
  EXPECT_TRUE(stop.strategy->story.dispatched);
  const Answer move = story.ask({.strategy = cell(story.program, "Move")});
  EXPECT_FALSE(move.strategy->story.dispatched);
  EXPECT_EQ(move.strategy->before, std::vector{cell(story.program, "Stop")});
}

TEST(Why, tells_a_whole_tick_if_nothing_else_is_asked) {
  const Story story({{}, {{"Start", 1.0f}}});
  const Answer answer = story.ask({});
  ASSERT_EQ(answer.rules.size(), 2u);
  EXPECT_EQ(story.program[answer.rules[0].story.rule].name, "obey");
  EXPECT_EQ(story.program[answer.rules[1].story.rule].name, "run[Move]");
  const Story quiet(std::vector<Facts>(1));
  EXPECT_EQ(quiet.text({}), "no rule fired at tick 1\nnothing ran at tick 1\n");
}

TEST(Why, answers_in_json_with_reasons_and_the_values_that_were_read) {
  const Story story(kAtTheGate);
  const auto json = nlohmann::json::parse(
      print_json(story.program, story.recorder.record(), story.ask({.rules = find_rules(story.program, "pass[S]")})));
  const auto& rule = json.at("rules").at(0);
  EXPECT_EQ(json.at("tick"), 4);
  EXPECT_EQ(rule.at("outcome"), "false");
  EXPECT_EQ(rule.at("reads").at("Safe"), 0.1);
  EXPECT_EQ(rule.at("reasons").size(), 3u);
}

TEST(Nearness, of_alternatives_is_that_of_the_nearest_and_of_all_is_the_sum) {
  const Story story({{}, {{"In.S", 0.4f}, {"Near[left,far]", -0.1f}}});
  const Nearness near = nearness(story.program, story.recorder.record(), find_rules(story.program, "pass[S]").front());
  EXPECT_EQ(near.lacking, 3u) << "`Gate`, `Safe`, and `In.S`, which is nearer than `Near`";
  EXPECT_NEAR(near.gap, 1.5 + 0.5 + 0.1, 1e-6);
}

}  // namespace
}  // namespace kb::trace
