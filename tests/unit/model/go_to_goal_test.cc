// The fuzzy planner of the library against its specification, written out by brute force: for every pattern of free
// directions and every degree of the bearing the 72 rules give what the plain search gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "compiler/tables/fuzzy.h"
#include "planners/fuzzy_rules.h"
#include "tests/unit/model/knowing.h"
#include "tests/unit/stride.h"

namespace kb::model::testing {
namespace {

double wrap(double degrees) { return std::remainder(degrees, 360.0); }

/// What one direction of the goal answers: the direction to take, 0 to 7; nothing if none is free.
/// Candidates in order of deviation: 0, s, -s, 2s, -2s, 3s, -3s, 4; s = 1 if the goal lies past the middle of its sector,
/// counter-clockwise, or in it.
std::optional<int> choose(int goal, double bearing, unsigned free) {
  const int s = wrap(bearing - 45.0 * goal) >= 0.0 ? 1 : -1;
  for (const int offset : {0, s, -s, 2 * s, -2 * s, 3 * s, -3 * s, 4}) {
    const int direction = (goal + offset + 8) % 8;
    if ((free >> direction & 1u) != 0) return direction;
  }
  return std::nullopt;
}

struct Answer { double turn = 0.0, speed = 0.0; bool known = false; };

Answer brute_force(double bearing, unsigned free) {
  struct Group { double weight, turn; int direction; };
  std::vector<Group> groups;
  for (int goal = 0; goal < 8; ++goal) {
    const double weight = std::max(0.0, 1.0 - std::fabs(wrap(bearing - 45.0 * goal)) / 45.0);
    if (!(weight > 0.0)) continue;
    if (const auto direction = choose(goal, bearing, free)) groups.push_back({weight, 45.0 * *direction, *direction});
  }
  if (groups.empty()) return {};
  const Group& strongest = *std::max_element(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.weight < b.weight; });
  double sum = 0.0, weight = 0.0;
  for (const Group& group : groups) {
    const double apart = wrap(group.turn - strongest.turn);
    if (std::fabs(apart) > 45.0 + 1e-9) continue;   // it would be steered between the two, into what is in the way
    sum += group.weight * apart;
    weight += group.weight;
  }
  return {wrap(strongest.turn + sum / weight), strongest.direction == 0 ? 1.0 : 0.0, true};
}

/// Asks the rules about every set of free directions and bearings 0.7 degrees apart: check(bearing, free, answer).
template <class Check>
void for_each_sight(const Check& check) {
  const Known known("import std.go_to_goal\n");
  ASSERT_EQ(known.model().fuzzy.size(), 1u);
  const tables::FuzzyForm form = tables::pack(known.model().fuzzy.front());
  for (unsigned free = 0; free < 256; ++free) {
    for (int tenth = -1800; tenth < 1800; tenth += 7 * static_cast<int>(kb::testing::stride())) {
      const double bearing = tenth / 10.0;
      if (std::fmod(std::fabs(bearing), 45.0) == 22.5) continue;   // both equally strong: either may win
      std::array<float, 9> x = {static_cast<float>(bearing)};
      for (unsigned k = 0; k < 8; ++k) x[1 + k] = static_cast<float>(free >> k & 1u);
      check(bearing, free, tables::evaluate(form, x));
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(GoToGoal, Has72RulesNineForEachDirectionOfTheGoal) {
  const Known known("import std.go_to_goal\n");
  ASSERT_EQ(known.said(), "");
  ASSERT_EQ(known.model().fuzzy.size(), 1u);
  const fuzzy::Controller& controller = known.model().fuzzy.front();
  EXPECT_EQ(controller.rules.size(), 72u);
  ASSERT_EQ(controller.nests.size(), 8u);
  for (const fuzzy::Nest& nest : controller.nests) EXPECT_EQ(nest.end_rule - nest.first_rule, 9u);
}

TEST(GoToGoal, ItsRulesAreTheSearchByBruteForce) {
  for_each_sight([](double bearing, unsigned free, const auto& found) {
    const Answer expected = brute_force(bearing, free);
    ASSERT_EQ(found.status, expected.known ? mts::FuzzyStatus::kOk : mts::FuzzyStatus::kNoRule) << bearing << " " << free;
    ASSERT_NEAR(wrap(static_cast<double>(found.outputs[1]) - expected.turn), 0.0, 1e-4) << bearing << " " << free;
    ASSERT_EQ(found.outputs[0], static_cast<float>(expected.speed)) << bearing << " " << free;
  });
}

// The planners drive a million robots by a table; a robot drives by the rules of the library. They take the same turns.
TEST(GoToGoal, TurnsAsThePlannersTableDoes) {
  for_each_sight([](double bearing, unsigned free, const auto& rules) {
    const auto table = planners::steer(bearing * planners::kPi / 180.0, static_cast<std::uint8_t>(~free));
    ASSERT_EQ(table.stop, rules.status == mts::FuzzyStatus::kNoRule) << bearing << " " << free;
    if (table.stop) return;
    const double apart = wrap(static_cast<double>(rules.outputs[1]) - table.turn_rad * 180.0 / planners::kPi);
    ASSERT_NEAR(apart, 0.0, 1e-4) << bearing << " " << free;
  });
}

// "Search by the variable `goal` first": in one of the eight words, or between two of them, nine or eighteen rules.
TEST(GoToGoal, LooksAtTheNestsOfOneOrTwoWords) {
  const Known known("import std.go_to_goal\n");
  ASSERT_EQ(known.model().fuzzy.size(), 1u);
  const fuzzy::Controller& controller = known.model().fuzzy.front();
  for (int degree = -180; degree < 180; ++degree) {
    int open = 0;
    for (const fuzzy::Nest& nest : controller.nests) {
      const fuzzy::Degree& asked = controller.degrees[controller.nodes[nest.condition].degree];
      if (fuzzy::mu(controller.shape_of(asked), degree) > 0.0) ++open;
    }
    EXPECT_EQ(open, degree % 45 == 0 ? 1 : 2) << degree;
  }
}

}  // namespace
}  // namespace kb::model::testing
