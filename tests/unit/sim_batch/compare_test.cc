// Runs are compared in pairs, and chance is told from change.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sim/batch/compare.h"

namespace kb::sim::batch {
namespace {

const std::string kHeader = fmt::format("scenario,seed,robot,noise,outcome,reports,time_s,length_m,{}\n", kMeasures);

/// Results with a run for each letter: `a` arrives, `s` is stuck, ` ` was not driven. Seeds count from 1.
Results results_of(std::string_view ends) {
  std::string text = kHeader;
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
  const Results before = results_of("aasa "), after = results_of("sa aa");
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

TEST(CompareTest, a_fault_is_where_its_line_stands) {
  const std::string text = kHeader + "plain,1,0,1,arrived,,forty,9.76,0,0,0,0,0.00,0.00,,0,0.0\n";
  const auto read = read_results(text);
  const auto& fault = std::get<ResultsFault>(read);
  EXPECT_EQ(fault.begin, kHeader.size());
  EXPECT_EQ(fault.end, text.size() - 1);
}

}  // namespace
}  // namespace kb::sim::batch
