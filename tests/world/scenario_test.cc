// Every scenario, as a test of its own: interpreter and engine in lock-step (KB_MIND chooses one alone).
#include "tests/world/scenario.h"

#include <gtest/gtest.h>

#include <set>

namespace kb::world {

/// GoogleTest prints parameters of failed tests: the name says all.
void PrintTo(const Scenario& scenario, std::ostream* out) { *out << scenario.name; }

namespace {

class InTheWorld : public testing::TestWithParam<Scenario> {};

TEST_P(InTheWorld, It) { EXPECT_EQ(GetParam().run({mind_from_environment()}), Finding{}); }

INSTANTIATE_TEST_SUITE_P(Scenarios, InTheWorld, testing::ValuesIn(all_scenarios()),
                         [](const auto& scenario) { return scenario.param.name; });

TEST(ListOfScenarios, HasEightySixOfThemEachWithANameOfItsOwn) {
  const Scenarios scenarios = all_scenarios();
  std::set<std::string> names;
  for (const Scenario& scenario : scenarios) names.insert(scenario.name);
  EXPECT_EQ(scenarios.size(), 86u);
  EXPECT_EQ(names.size(), 86u);
}

}  // namespace
}  // namespace kb::world
