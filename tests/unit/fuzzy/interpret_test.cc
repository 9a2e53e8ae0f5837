#include "compiler/fuzzy/interpret.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "compiler/tables/fuzzy.h"
#include "tests/unit/fuzzy/float_interpreter.h"
#include "tests/unit/fuzzy/random_controller.h"

namespace kb::fuzzy {
namespace {

using testing::random_controller;
using testing::random_inputs;

TEST(RandomControllers, AreSound) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) EXPECT_TRUE(verify(random_controller(seed)).empty()) << seed;
}

// The walk of the tables, which is the very code of the robot, and the float interpreter: the same bits.
TEST(Evaluator, GivesTheBitsOfTheFloatInterpreter) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Controller controller = random_controller(seed);
    const tables::FuzzyForm form = tables::pack(controller);
    for (std::uint64_t n = 0; n < 60; ++n) {
      const std::vector<double> wide = random_inputs(controller, seed * 1'000 + n, n % 2 == 1);
      const std::vector<float> x(wide.begin(), wide.end());
      const auto expected = testing::interpret_float(controller, form, x);
      const auto found = tables::evaluate(form, x);
      ASSERT_EQ(static_cast<int>(found.status), static_cast<int>(expected.status)) << seed << " " << n;
      for (std::size_t o = 0; o < found.outputs.size(); ++o) {
        ASSERT_EQ(std::bit_cast<std::uint32_t>(found.outputs[o]), std::bit_cast<std::uint32_t>(expected.outputs[o])) << seed << " " << n;
      }
    }
  }
}

// See note [errors of a fuzzy controller]. Left out are points where a choice between rules hangs on the last bits.
TEST(Evaluator, IsNearExactArithmetic) {
  double worst = 0.0;
  std::size_t compared = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Controller controller = random_controller(seed, {.circles = seed % 2 == 0, .nests = true, .reach = false, .negations = true});
    const tables::FuzzyForm form = tables::pack(controller);
    for (std::uint64_t n = 0; n < 60; ++n) {
      const std::vector<double> x = random_inputs(controller, seed * 1'000 + n);
      const auto exact = interpret(controller, x);
      const auto found = tables::evaluate(form, std::vector<float>(x.begin(), x.end()));
      for (std::uint32_t o = 0; o < controller.outputs.size(); ++o) {
        const Output& output = controller.outputs[o];
        double weight = 0.0, size = output.high - output.low;
        for (std::size_t r = 0; r < controller.rules.size(); ++r) {
          for (const Consequent& one : controller.rules[r].consequents) {
            if (one.output == o) weight += exact.strengths[r];
            for (const auto& part : one.linear) size += std::fabs(part.second * x[part.first]);
          }
        }
        if (output.circular || weight < 0.05) continue;
        const double error = std::fabs(static_cast<double>(found.outputs[o]) - exact.outputs[o]);
        worst = std::max(worst, error * std::min(weight, 1.0) / size);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 5'000u);
  EXPECT_LE(worst, 3e-6);
}

Controller one_rule() {
  Controller c;
  c.name = "One";
  c.slots = 1;
  Input in;
  in.name = "x";
  in.low = 0.0;
  in.high = 4.0;
  Shape near;
  near.kind = ShapeKind::kRamp;
  near.p = {2.0, 1.0, 0.0, 0.0};
  in.terms.push_back({"near", near});
  c.inputs.push_back(in);
  c.degrees.push_back({0, 0, 0});
  Output out;
  out.name = "speed";
  out.low = 0.0;
  out.high = 1.0;
  out.fallback = 0.5;
  c.outputs.push_back(out);
  c.nodes.emplace_back();
  Rule rule;
  rule.consequents.push_back({0, 2.0, {}, kNone, {}});
  c.rules.push_back(rule);
  return c;
}

// Whatever comes in, a number of the output's range comes out, with a status.
TEST(Status, SaysTheWorstThatApplies) {
  const Controller c = one_rule();
  const tables::FuzzyForm form = tables::pack(c);
  const auto ask = [&](float x) { return tables::evaluate(form, std::vector<float>{x}); };
  EXPECT_EQ(ask(1.0f).status, mts::FuzzyStatus::kOutputClamped);
  EXPECT_EQ(ask(1.0f).outputs[0], 1.0f);
  EXPECT_EQ(ask(3.0f).status, mts::FuzzyStatus::kNoRule);
  EXPECT_EQ(ask(3.0f).outputs[0], 0.5f);
  EXPECT_EQ(ask(-1.0f).status, mts::FuzzyStatus::kOutputClamped) << "the input was clamped too";
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), mts::kInfinity, -mts::kInfinity}) {
    EXPECT_EQ(ask(bad).status, mts::FuzzyStatus::kBadInput);
    EXPECT_EQ(ask(bad).outputs[0], 0.5f);
    EXPECT_EQ(interpret(c, {static_cast<double>(bad)}).status, Status::kBadInput);
  }
}

}  // namespace
}  // namespace kb::fuzzy
