// Demands on a batch are compared exactly.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sim/batch/gate.h"

namespace kb::sim::batch {
namespace {

std::vector<NamedScenario> one_scenario() {
  std::vector<NamedScenario> scenarios(1);
  scenarios.front().name = "plain";
  return scenarios;
}

/// Whether a batch of `all` runs, of which `arrived` arrived, meets the demand.
bool meets(std::string_view demand, std::size_t arrived, std::size_t all) {
  const Knowledge knowledge;
  BatchOptions options;
  options.last_seed = all;
  const Batch batch(knowledge, one_scenario(), options);
  std::vector<Run> runs;
  for (std::size_t number = 0; number < all; ++number) {
    runs.push_back(batch.run(number));
    runs.back().outcome = number < arrived ? "arrived" : "stuck";
  }
  std::string why;
  const auto demands = read_demands(demand, countable(), why);
  EXPECT_TRUE(demands) << why;
  return demands && unmet(*demands, batch, runs).empty();
}

bool is_read(std::string_view demand) {
  std::string why;
  return read_demands(demand, countable(), why).has_value();
}

TEST(GateTest, compares_shares_that_no_double_holds) {
  EXPECT_TRUE(meets("arrived>=64.4%", 322, 500));
  EXPECT_TRUE(meets("arrived=16.1%", 161, 1000));
  EXPECT_TRUE(meets("arrived>=64.9%", 649, 1000));
  EXPECT_FALSE(meets("arrived>32.3%", 323, 1000));
  EXPECT_FALSE(meets("arrived<32.30%", 323, 1000));
  EXPECT_TRUE(meets("arrived<32.300000001%", 323, 1000));
  EXPECT_FALSE(meets("arrived=33.333333333%", 1, 3));
  EXPECT_TRUE(meets("arrived>33.333333333%,arrived<33.333333334%", 1, 3));
}

TEST(GateTest, compares_every_share_of_a_thousand_with_itself) {
  for (std::size_t arrived = 0; arrived <= 1000; arrived += 7) {
    EXPECT_TRUE(meets(fmt::format("arrived={}.{}%", arrived / 10, arrived % 10), arrived, 1000)) << arrived;
  }
}

TEST(GateTest, counts_runs) {
  EXPECT_TRUE(meets("arrived=3,arrived<=3.0,arrived>2,arrived<18446744073709551615", 3, 5));
  EXPECT_FALSE(meets("arrived>=4", 3, 5));
}

TEST(GateTest, refuses_what_is_no_number_of_runs_and_no_percentage) {
  EXPECT_TRUE(is_read("arrived>=100.000%"));
  EXPECT_TRUE(is_read("arrived>=99.1234567890000%"));
  for (const char* demand : {"arrived>=100.000000001%", "arrived>=99.1234567891%", "arrived>=2.5", "arrived>=%", "arrived>=.%", "arrived>=1.-5%", "arrived>=-5%",
                             "arrived>=5.0.0%", "arrived>=1 0", "arrived>=18446744073709551616", "arrived>=nan%", "arrived>=inf"}) {
    EXPECT_FALSE(is_read(demand)) << demand;
  }
}

}  // namespace
}  // namespace kb::sim::batch
