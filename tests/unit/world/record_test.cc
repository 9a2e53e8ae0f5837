#include "tests/world/record.h"

#include <gtest/gtest.h>

namespace kb::world {
namespace {

TEST(FactsCsv, HoldsOnlyColumnsThatEverHaveData) {
  const auto knowledge = Knowledge::of_text(
      "levels only > control\nfact A\nfact B\nfact C\nsatellite S\nstrategy U\n"
      "rule r at only when A and B and C then +S\nrule s at only when S then +sat U\n");
  Recording recording{knowledge, {}, {}};
  recording.rows.push_back({0, {0.0f, 0.0f, 0.9f}});
  recording.rows.push_back({1'250'000, {-1.0f, 0.0f, 0.0f}});
  EXPECT_EQ(facts_csv(recording), "t,A,C\n0,,0.9\n1.25,-1,\n");
}

}  // namespace
}  // namespace kb::world
