// Commands that work on one batch at once.
#include "tools/kbc/fleet_shards.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "tests/unit/scratch_folder.h"
#include "tools/kbc/support.h"

namespace kb::cli {
namespace {

using sim::batch::Batch;

class FleetShards : public ::testing::Test {
 protected:
  FleetShards() {
    std::vector<sim::batch::NamedScenario> scenarios(1);
    scenarios.front().name = "plain";
    sim::batch::BatchOptions options;
    options.first_seed = 1;
    options.last_seed = 12;
    batch_.emplace(knowledge_, std::move(scenarios), options);
  }

  [[nodiscard]] std::unique_ptr<BatchFiles> opened() {
    auto files = std::make_unique<BatchFiles>(folder_ + "/results", *batch_, BatchParts{{"kbc", "0123456789abcdef"}, {"seeds", "1-12"}});
    std::vector<std::size_t> all(batch_->shards());
    std::iota(all.begin(), all.end(), 0);
    EXPECT_TRUE(files->open(session_, all));
    return files;
  }
  /// Writes the shards that are missing, all robots having arrived.
  void drive(BatchFiles& files) const {
    for (const std::size_t shard : files.missing()) {
      std::string rows;
      for (std::size_t number = batch_->block(shard).first; number < batch_->block(shard).last; ++number) {
        sim::batch::Run run = batch_->run(number);
        run.outcome = "arrived";
        rows += batch_->print(run) + "\n";
      }
      EXPECT_EQ(files.write(shard, rows), "");
    }
  }

  sim::Knowledge knowledge_;
  std::optional<Batch> batch_;
  ScratchFolder scratch_;
  std::string folder_ = scratch_.path();
  Session session_{{}};
};

TEST_F(FleetShards, ABatchThatAnotherCommandHasFinishedMeanwhileIsFinished) {
  const auto late = opened();
  ASSERT_GT(late->missing().size(), 1u);
  {
    const auto first = opened();
    ASSERT_TRUE(first->claim(session_));
    drive(*first);
    ASSERT_TRUE(first->merge(session_));
  }
  ASSERT_TRUE(late->claim(session_));
  EXPECT_TRUE(late->missing().empty());
  EXPECT_TRUE(late->claimed_all(session_));
  const auto merged = late->merge(session_);
  ASSERT_TRUE(merged);
  EXPECT_EQ(merged->runs.size(), batch_->runs());
  EXPECT_FALSE(std::filesystem::exists(folder_ + "/results/shards"));
}

TEST_F(FleetShards, OfTwoThatMergeTheSecondFindsWhatTheFirstHasMade) {
  const auto driver = opened();
  ASSERT_TRUE(driver->claim(session_));
  drive(*driver);
  const auto late = opened();
  EXPECT_TRUE(late->missing().empty());
  ASSERT_TRUE(driver->merge(session_));
  ASSERT_TRUE(late->merge(session_));
}

}  // namespace
}  // namespace kb::cli
