// Rows of results are read back as they were printed, or not at all.
#include <gtest/gtest.h>

#include "sim/batch/batch.h"

namespace kb::sim::batch {
namespace {

class RowTest : public ::testing::Test {
 protected:
  RowTest() {
    std::vector<NamedScenario> scenarios(1);
    scenarios.front().name = "crate";
    scenarios.front().scenario.limit_s = 60.0;
    scenarios.front().scenario.events.resize(2);
    batch_.emplace(knowledge_, std::move(scenarios), BatchOptions());
  }
  [[nodiscard]] bool reads(std::string_view end) const { return batch_->parse("crate,1,0,1," + std::string(end), 0).has_value(); }

  Knowledge knowledge_;
  std::optional<Batch> batch_;
};

TEST_F(RowTest, are_read_back) {
  batch::Run run = batch_->run(0);
  run.outcome = "stopped";
  run.reports = "Help.lost+Help.blocked";
  run.time_s = 60.98;   // a tick of a second that began just before the time was up
  run.length_m = -0.0;
  run.collisions = 3;
  run.lost_unaware = true;
  run.touched_s = 1.0 / 3.0;
  run.impact_m_s = 0.125;
  run.closest_m = 0.0004;
  run.missed = 2;
  run.last_moved_s = 60.94;
  for (const double closest_m : {run.closest_m, kNothingNear, 12345.6789}) {
    run.closest_m = closest_m;
    const std::string line = batch_->print(run);
    const auto read = batch_->parse(line, 0);
    ASSERT_TRUE(read) << line;
    EXPECT_EQ(batch_->print(*read), line);
  }
}

TEST_F(RowTest, are_read_only_as_they_are_printed) {
  EXPECT_TRUE(reads("arrived,,48.2,9.76,0,0,0,0,0.00,0.00,,0,0.0"));
  for (const char* end : {"arrived,,48.20,9.76,0,0,0,0,0.00,0.00,,0,0.0", "arrived,,48,9.76,0,0,0,0,0.00,0.00,,0,0.0", "arrived,,4e1,9.76,0,0,0,0,0.00,0.00,,0,0.0",
                          "arrived,,048.2,9.76,0,0,0,0,0.00,0.00,,0,0.0", "arrived,,48.2,9.76,00,0,0,0,0.00,0.00,,0,0.0", "arrived,,48.2,9.76,0,0,0,0,0.00,0.00,-1.000,0,0.0",
                          "arrived,,48.2,9.76,0,0,0,0,0.00,0.00,,0,0.0 ", "arrived,,48.2,9.76,0,0,0,0,0.00,0.00,,0,0,0.0", "arrived,,48.2,9.76,0,0,0,0,0.00,0.00,,,0.0", "arrived,,48.2,9.76,0,0,0,0,0.00,0.00,,0,48"}) {
    EXPECT_FALSE(reads(end)) << end;
  }
}

TEST_F(RowTest, are_refused_if_no_drive_can_have_led_to_them) {
  for (const char* end : {"arrived,,-1e300,9.76,0,0,0,0,0.00,0.00,,0,0.0", "arrived,,-48.2,9.76,0,0,0,0,0.00,0.00,,0,0.0", "arrived,,4820.0,9.76,0,0,0,0,0.00,0.00,,0,0.0",
                          "arrived,,48.2,-9.76,0,0,0,0,0.00,0.00,,0,0.0", "arrived,,48.2,9760000.00,0,0,0,0,0.00,0.00,,0,0.0", "arrived,,48.2,9.76,-1,0,0,0,0.00,0.00,,0,0.0",
                          "arrived,,48.2,9.76,0,0,0,0,-0.10,0.00,,0,0.0", "arrived,,48.2,9.76,0,0,0,0,0.00,-0.10,,0,0.0", "arrived,,48.2,9.76,0,0,0,0,0.00,0.00,-0.500,0,0.0",
                          "arrived,,48.2,9.76,0,0,0,0,0.00,0.00,,3,0.0", "arrived,,48.2,9.76,0,0,2,0,0.00,0.00,,0,0.0", "arrived,,inf,9.76,0,0,0,0,0.00,0.00,,0,0.0",
                          "arrived,,48.2,9.76,0,0,0,0,0.00,0.00,,0,48.3", "arrived,,48.2,9.76,0,0,0,0,0.00,0.00,,0,-0.1"}) {
    EXPECT_FALSE(reads(end)) << end;
  }
}

}  // namespace
}  // namespace kb::sim::batch
