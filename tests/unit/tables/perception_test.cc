// Perception on tables beside the plain reading of the program: random definitions, random recordings, and what is wrong with
// readings.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "compiler/tables/perception.h"
#include "compiler/tables/tables.h"
#include "tests/unit/stride.h"
#include "tests/unit/tables/random_perceiver.h"

namespace kb::tables {
namespace {

using program::CellId;
using program::Percept;
using program::PerceptId;
using program::Program;

using testing::Dice;
using testing::random_perceiver;
using testing::random_readings;

struct Work { std::uint64_t fits = 0, asleep = 0, differing = 0; };

/// Both look at the same recording, while a machine runs the program on what they see.
Work compare(std::uint64_t seed, bool lazy) {
  Program program = random_perceiver(seed);
  for (program::Perceived& perceived : program.perception.perceived) perceived.lazy = perceived.lazy && lazy;
  EXPECT_TRUE(program::verify(program).empty()) << program::verify(program).front();
  const PerceptionForm form = build_perception(program);
  const Tables tables = build(program);
  Machine machine(program, tables);
  const auto engine = make_looker(program, form), plain = make_plain_looker(program, form);
  ReadingTable readings(form.shape.readings);
  Dice dice(seed + 1);
  std::vector<float> cells(program.cells.size(), 0.0f), seen(program.facts), expected(program.facts);
  std::int64_t now_us = 0;
  Work work;
  for (int tick = 0; tick < 60; ++tick) {
    now_us += dice.below(30) == 0 ? -static_cast<std::int64_t>(dice.below(2'000'000)) : static_cast<std::int64_t>(dice.below(200'000));
    random_readings(dice, program.perception, readings, now_us);
    for (std::uint32_t i = 0; i < cells.size(); ++i) cells[i] = machine.value(CellId{i});
    for (float& fact : seen) fact = static_cast<float>(dice.between(-1.2, 1.2));
    expected = seen;
    engine->look(readings, now_us, cells, seen);
    plain->look(readings, now_us, cells, expected);
    for (std::size_t f = 0; f < seen.size(); ++f) work.differing += seen[f] != expected[f] ? 1 : 0;
    work.fits += engine->report().fits;
    work.asleep += engine->report().asleep;
    (void)machine.tick(seen, 100'000);
  }
  return work;
}

TEST(Perception, sees_what_the_program_says_bit_by_bit) {
  std::uint64_t fits = 0, lazy_fits = 0, asleep = 0;
  for (std::uint64_t seed = 1; seed <= 120; seed += kb::testing::stride()) {
    const Work all = compare(seed, false), lazy = compare(seed, true);
    ASSERT_EQ(all.differing, 0u) << "seed " << seed;
    ASSERT_EQ(lazy.differing, 0u) << "seed " << seed << ", with lazy facts";
    ASSERT_EQ(all.asleep, 0u);
    fits += all.fits;
    lazy_fits += lazy.fits;
    asleep += lazy.asleep;
  }
  EXPECT_GT(asleep * kb::testing::stride(), 400u) << "lazy facts never slept";
  EXPECT_LT(lazy_fits, fits) << "lazy facts saved no work";
  RecordProperty("fits", std::to_string(fits));
  RecordProperty("fits_with_lazy_facts", std::to_string(lazy_fits));
}

/// One sensor of 0..4 m, noise 0.02, stale 0.2 s, and `near = gaussian(0.25, left inf, right 0.08)`.
class OneSensor : public ::testing::Test {
 protected:
  OneSensor() {
    program::Sensor sensor;
    sensor.name = "range";
    sensor.high = 4.0;
    sensor.noise = 0.02;
    sensor.stale_s = 0.2;
    sensor.growth = program::growth_of(sensor);
    program_.perception.sensors.push_back(sensor);
    fuzzy::Shape near;
    near.kind = fuzzy::ShapeKind::kGaussian;
    near.p = {0.25, 0.25, fuzzy::kInfinity, 0.08};
    program_.perception.prototypes.push_back({near, "near"});
    program_.perception.percepts.push_back({Percept::Op::kFits, 0, 0, {}, CellId::kNone, {}});
    program_.cells.push_back({"Wall", program::CellKind::kFact, 0.0f, 0.75, 0.25, false, false, false, {}, {}});
    program_.facts = 1;
    program_.perception.perceived.push_back({CellId{0}, PerceptId{0}, false, {}});
    form_ = build_perception(program_);
    looker_ = make_looker(program_, form_);
  }
  float look(std::int64_t now_us) {
    std::vector<float> facts(1, 0.0f);
    looker_->look(readings_, now_us, std::vector<float>(1), facts);
    return facts[0];
  }
  const mts::SightReport& report() { return looker_->report(); }

  Program program_;
  PerceptionForm form_;
  std::unique_ptr<Looker> looker_;
  ReadingTable readings_{1};
};

TEST_F(OneSensor, says_nothing_before_its_first_reading) {
  EXPECT_EQ(look(0), 0.0f);
  EXPECT_EQ(report().sight, mts::Sight::kSilent);
}

TEST_F(OneSensor, ages_towards_unknown_and_is_counted_as_stale) {
  readings_.set(0, 0.1f, 0);
  const float fresh = look(0);
  EXPECT_GT(fresh, 0.95f);
  EXPECT_LT(look(100'000), fresh);
  EXPECT_EQ(report().sight, mts::Sight::kClear);
  EXPECT_LT(std::fabs(look(300'000)), 0.3f);
  EXPECT_EQ(report().sight, mts::Sight::kStale);
  EXPECT_NEAR(look(3'600'000'000), 0.0f, 0.01f);
}

TEST_F(OneSensor, takes_nan_and_infinity_as_no_reading) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}) {
    readings_.set(0, bad, 0);
    EXPECT_EQ(look(0), 0.0f);
    EXPECT_EQ(report().sight, mts::Sight::kNotANumber);
    EXPECT_EQ(report().not_a_number, 1u);
  }
}

TEST_F(OneSensor, takes_what_is_out_of_range_as_the_nearest_end) {
  readings_.set(0, 1e30f, 0);
  const float beyond = look(0);
  EXPECT_EQ(report().sight, mts::Sight::kBeyondRange);
  readings_.set(0, 4.0f, 0);
  EXPECT_EQ(look(0), beyond);
}

TEST_F(OneSensor, knows_nothing_when_it_disappears) {
  readings_.set(0, 0.1f, 0);
  EXPECT_GT(look(0), 0.9f);
  readings_.there[0] = 0;
  EXPECT_EQ(look(0), 0.0f);
}

TEST_F(OneSensor, goes_on_when_time_goes_backwards) {
  readings_.set(0, 0.1f, 1'000'000);
  const float fresh = look(1'000'000), aged = look(1'100'000);
  ASSERT_LT(aged, fresh);
  EXPECT_EQ(look(500'000), aged) << "a reading keeps the age that it had";
  EXPECT_EQ(report().sight, mts::Sight::kTimeBackwards);
  EXPECT_EQ(report().from_the_future, 0u);
  EXPECT_LT(look(550'000), aged) << "and ages on with the new clock";
  EXPECT_EQ(report().sight, mts::Sight::kClear);
  readings_.set(0, 0.1f, 550'000);
  EXPECT_EQ(look(550'000), fresh) << "a new reading goes by the new clock";
  EXPECT_EQ(look(650'000), aged);
}

TEST_F(OneSensor, does_not_come_to_life_by_a_clock_that_is_set_back) {
  constexpr std::int64_t kHour_us = 3'600'000'000;
  readings_.set(0, 0.1f, kHour_us);
  (void)look(kHour_us);
  const float old = look(kHour_us + 1'000'000);
  ASSERT_LT(old, 0.2f);
  EXPECT_EQ(look(1'000'000), old);
  for (std::int64_t now_us = 2'000'000; now_us <= 3 * kHour_us; now_us += 60'000'000) {
    ASSERT_LE(look(now_us), old) << "also when the clock says again what it said when the sensor died";
    ASSERT_EQ(report().sight, mts::Sight::kStale);
  }
}

TEST_F(OneSensor, takes_a_reading_that_is_a_little_ahead_as_measured_now) {
  readings_.set(0, 0.1f, 0);
  const float fresh = look(0);
  readings_.set(0, 0.1f, 190'000);
  EXPECT_EQ(look(10'000), fresh) << "180 ms, and it is stale after 200 ms";
  EXPECT_EQ(report().sight, mts::Sight::kFromTheFuture);
  EXPECT_EQ(report().from_the_future, 1u);
  EXPECT_EQ(look(190'000), fresh);
  EXPECT_EQ(report().sight, mts::Sight::kClear);
}

TEST_F(OneSensor, refuses_a_reading_that_is_far_ahead_until_another_comes) {
  readings_.set(0, 0.1f, 3'600'000'000);
  EXPECT_EQ(look(0), 0.0f);
  EXPECT_EQ(report().from_the_future, 1u);
  EXPECT_EQ(look(3'600'000'000), 0.0f) << "the clock has caught up, but nothing tells how old the reading is";
  EXPECT_EQ(report().sight, mts::Sight::kFromTheFuture);
  readings_.set(0, 0.1f, 3'600'000'001);
  EXPECT_GT(look(3'600'000'001), 0.9f);
  readings_.there[0] = 0;
  EXPECT_EQ(look(3'600'000'002), 0.0f);
  EXPECT_EQ(report().sight, mts::Sight::kSilent);
}

TEST_F(OneSensor, takes_any_two_times) {
  constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min(), kLast = std::numeric_limits<std::int64_t>::max();
  readings_.set(0, 0.1f, kFirst);
  EXPECT_NEAR(look(kLast), 0.0f, 1e-3f) << "as old as can be: it says nothing any more";
  EXPECT_EQ(report().from_the_future, 0u);
  readings_.set(0, 0.1f, kLast);
  EXPECT_EQ(look(kFirst), 0.0f);
  EXPECT_EQ(report().from_the_future, 1u);
  readings_.set(0, 0.1f, 0);
  EXPECT_EQ(look(kLast), look(kLast)) << "the clock runs for twice as long as it can count";
}

TEST_F(OneSensor, is_not_looked_at_twice_for_the_same_reading) {
  program_.perception.sensors[0].stale_s.reset();
  program_.perception.sensors[0].growth = 0.0;
  form_ = build_perception(program_);
  looker_ = make_looker(program_, form_);
  readings_.set(0, 0.1f, 0);
  (void)look(0);
  EXPECT_EQ(report().fits, 1u);
  readings_.set(0, 0.1f, 100'000);
  (void)look(100'000);
  EXPECT_EQ(report().fits, 0u);
}

}  // namespace
}  // namespace kb::tables
