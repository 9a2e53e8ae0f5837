// Runs are compared in pairs, and chance is told from change.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sim/batch/compare.h"

namespace kb::sim::batch {
namespace {

const std::string kHeader = fmt::format("scenario,seed,robot,noise,outcome,reports,time_s,length_m,{}\n", kMeasures);

/// Results with a run for each letter: `a` arrives, `s` is stuck, ` ` was not driven. Seeds count from 1.
Results results_of(std::string_view ends, std::string& text) {
  text = kHeader;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i] != ' ') text += fmt::format("plain,{0},0,{0},{1},,40.0,9.76,0,0,0,0,0.00,0.00,,0,0.0\n", i + 1, ends[i] == 'a' ? "arrived" : "stuck");
  }
  return std::get<Results>(read_results(text));
}

TEST(CompareTest, the_chance_is_that_of_a_fair_coin) {
  EXPECT_DOUBLE_EQ(chance_of(0, 0), 1.0);
  EXPECT_DOUBLE_EQ(chance_of(1, 0), 1.0);
  EXPECT_NEAR(chance_of(0, 5), 2.0 / 32.0, 1e-12);
  EXPECT_NEAR(chance_of(6, 1), 2.0 * (1.0 + 7.0) / 128.0, 1e-12);
  EXPECT_DOUBLE_EQ(chance_of(4, 4), 1.0);
  EXPECT_NEAR(chance_of(60, 40), 0.0568879, 1e-6);   // R: binom.test(40, 100)$p.value
  EXPECT_NEAR(chance_of(5'000'000, 5'004'000), 0.2060, 1e-3);   // as of a normal distribution
}

TEST(CompareTest, pairs_are_runs_that_both_have) {
  std::string old_text, new_text;
  const Results before = results_of("aasa ", old_text), after = results_of("sa aa", new_text);
  const auto compared = compare(before, after, {});
  const auto& comparison = std::get<Comparison>(compared);
  EXPECT_EQ(comparison.pairs.size(), 3u);
  EXPECT_EQ(comparison.only_before, 1u);
  EXPECT_EQ(comparison.only_after, 1u);
  ASSERT_EQ(comparison.rows.size(), 1u);
  EXPECT_EQ(comparison.rows[0].counts[0].only_before, 1u);
  EXPECT_EQ(comparison.rows[0].counts[0].only_after, 0u);
  EXPECT_EQ(comparison.rows[0].times.size(), 2u);
}

TEST(CompareTest, results_are_read_by_the_names_of_columns) {
  const std::string more = fmt::format("# kbc fleet, batch 7, 1 runs, knowledge base 12, seeds 1-1\nscenario,seed,outcome,shade,reports,time_s,length_m,{},noise\n"
                                       "plain,1,arrived,dark,,40.0,9.76,0,0,0,0,0.00,0.00,,0,0.0,1\n", kMeasures);
  const auto read = read_results(more);
  const auto& results = std::get<Results>(read);
  ASSERT_EQ(results.rows.size(), 1u);
  EXPECT_EQ(results.which, (std::vector<std::string>{"scenario", "seed"}));
  EXPECT_EQ(results.made_of, (std::vector<std::pair<std::string, std::string>>{{"knowledge base", "12"}, {"seeds", "1-1"}}));
  EXPECT_EQ(results.rows[0].ending.time_s, 40.0);
}

/// Why two experiments cannot be compared whose only runs have these noises; empty if they can.
std::string why_not(std::string_view first, std::string_view old_noise, std::string_view second, std::string_view new_noise) {
  const std::string header = fmt::format("scenario,method,class,outcome,reports,time_s,length_m,{},noise\n", kMeasures), row = "0,mts,none,arrived,,40.0,9.76,0,0,0,0,0.00,0.00,,0,0.0,";
  const std::string before = fmt::format("{}\n{}{}{}\n", first, header, row, old_noise), after = fmt::format("{}\n{}{}{}\n", second, header, row, new_noise);
  const auto old_results = read_results(before), new_results = read_results(after);
  const auto compared = compare(std::get<Results>(old_results), std::get<Results>(new_results), {});
  const auto* why = std::get_if<std::string>(&compared);
  return why != nullptr ? *why : "";
}

TEST(CompareTest, experiments_on_other_floors_are_not_compared) {
  EXPECT_EQ(why_not("# kbc 0.1.0 7, seed 1, labyrinths 2", "11", "# kbc 0.1.0 8, seed 1, labyrinths 2", "11"), "");
  EXPECT_NE(why_not("# kbc 0.1.0 7, seed 1, labyrinths 2", "11", "# kbc 0.1.0 7, seed 2, labyrinths 2", "11"), "");
  EXPECT_NE(why_not("# kbc 0.1.0 7, seed 1, labyrinths 2", "11", "# kbc 0.1.0 7, seed 1, labyrinths 3", "11"), "");
  EXPECT_NE(why_not("# no word", "11", "# of it", "12"), "");
}

TEST(CompareTest, a_column_may_stand_anywhere) {
  for (const std::string_view header : {"setting,scenario,seed", "scenario,setting,seed", "scenario,seed,setting"}) {
    std::string text = fmt::format("{},outcome,reports,time_s,length_m,{}\n", header, kMeasures);
    for (const std::string_view setting : {"x", "y"}) {
      for (int seed = 1; seed < 4; ++seed) {
        std::string row(header);
        for (const auto& [name, value] : {std::pair<std::string, std::string>{"setting", setting}, {"scenario", "plain"}, {"seed", fmt::format("{}", seed)}}) row.replace(row.find(name), name.size(), value);
        text += fmt::format("{},{},,40.0,9.76,0,0,0,0,0.00,0.00,,0,0.0\n", row, setting == "x" || seed == 2 ? "arrived" : "stuck");
      }
    }
    const auto read = read_results(text);
    const auto& results = std::get<Results>(read);
    const auto compared = compare(results, results, {"setting", "x", "y"});
    const auto& comparison = std::get<Comparison>(compared);
    EXPECT_EQ(comparison.pairs.size(), 3u) << header;
    EXPECT_EQ(comparison.rows.at(0).counts[0].only_before, 2u) << header;
    EXPECT_EQ(comparison.rows.at(0).values, std::vector<std::string>{"plain"}) << header;
    EXPECT_EQ(which_of(comparison, comparison.pairs[1]), "plain,2") << header;
  }
}

TEST(CompareTest, a_fault_is_where_its_line_stands) {
  const std::string text = kHeader + "plain,1,0,1,arrived,,forty,9.76,0,0,0,0,0.00,0.00,,0,0.0\n";
  const auto read = read_results(text);
  const auto& fault = std::get<ResultsFault>(read);
  EXPECT_EQ(fault.begin, kHeader.size());
  EXPECT_EQ(fault.end, text.size() - 1);
}

}  // namespace
}  // namespace kb::sim::batch
