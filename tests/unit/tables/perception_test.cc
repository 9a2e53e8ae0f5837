// Perception on tables beside the plain reading of the program: random definitions, random recordings, and what is wrong with
// readings.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "compiler/tables/perception.h"
#include "compiler/tables/tables.h"
#include "tests/unit/program/random_program.h"

namespace kb::tables {
namespace {

using program::CellId;
using program::Percept;
using program::PerceptId;
using program::Program;

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

 private:
  std::mt19937_64 random_;
};

fuzzy::Shape random_shape(Dice& dice, const program::Sensor& sensor) {
  fuzzy::Shape shape;
  const double mean = dice.between(sensor.low, sensor.high), spread = dice.between(0.02, 0.3) * (sensor.high - sensor.low);
  shape.kind = fuzzy::ShapeKind::kGaussian;
  shape.p = {mean, mean, spread, dice.below(3) == 0 && !sensor.circular ? fuzzy::kInfinity : spread};
  if (sensor.circular) {
    shape.period = sensor.high - sensor.low;
    shape.range_low = sensor.low;
  } else if (dice.below(4) == 0) {
    shape.kind = fuzzy::ShapeKind::kRamp;
    shape.p = {mean, mean + spread, 0, 0};
  }
  return shape;
}

void add_sensors(Dice& dice, program::Perception& to) {
  for (std::uint32_t i = 0; i < 1 + dice.below(4); ++i) {
    program::Sensor sensor;
    sensor.name = "s" + std::to_string(i);
    sensor.text = dice.below(4) == 0;
    sensor.array = dice.below(2) == 0;
    sensor.count = sensor.array ? 1 + dice.below(5) : 1;
    sensor.first = to.readings();
    sensor.high = dice.below(2) == 0 ? 360.0 : 4.0;
    sensor.circular = !sensor.text && sensor.high == 360.0;
    sensor.noise = dice.below(3) == 0 ? 0.0 : 0.01 * sensor.high;
    if (dice.below(2) == 0) sensor.stale_s = dice.between(0.05, 1.0);
    sensor.growth = program::growth_of(sensor);
    if (sensor.text) sensor.texts = {"LM1", "LM2", "LM7"};
    to.sensors.push_back(sensor);
  }
}

PerceptId random_percept(Dice& dice, Program& program, const std::vector<CellId>& facts, int depth) {
  program::Perception& to = program.perception;
  Percept percept;
  const std::uint32_t kind = depth <= 0 ? dice.below(2) : dice.below(5);
  if (kind < 2 || (kind == 0 && facts.empty())) {
    percept.reading = dice.below(to.readings());
    const program::Sensor& sensor = to.sensor_of(percept.reading);
    percept.op = sensor.text ? Percept::Op::kReads : Percept::Op::kFits;
    if (sensor.text) {
      percept.text = sensor.texts[dice.below(3)];
    } else {
      percept.prototype = static_cast<std::uint32_t>(to.prototypes.size());
      to.prototypes.push_back({random_shape(dice, sensor), "p"});
    }
    if (kind == 0 && !facts.empty()) {
      percept = Percept{};
      percept.op = Percept::Op::kFact;
      percept.cell = facts[dice.below(static_cast<std::uint32_t>(facts.size()))];
    }
  } else {
    percept.op = kind == 2 ? Percept::Op::kNot : kind == 3 ? Percept::Op::kAnd : Percept::Op::kOr;
    const std::uint32_t parts = kind == 2 ? 1 : 2 + dice.below(2);
    for (std::uint32_t i = 0; i < parts; ++i) percept.children.push_back(random_percept(dice, program, facts, depth - 1));
  }
  to.percepts.push_back(percept);
  return PerceptId{static_cast<std::uint32_t>(to.percepts.size() - 1)};
}

/// A random program some of whose facts are perceived, the later by the earlier, a third of them lazy.
Program random_perceiver(std::uint64_t seed) {
  Program program = program::testing::random_program(seed);
  Dice dice(seed);
  add_sensors(dice, program.perception);
  std::vector<CellId> known;
  for (std::uint32_t f = 0; f < program.facts; ++f) {
    if (dice.below(3) != 0) {
      const PerceptId percept = random_percept(dice, program, known, 3);
      program.perception.perceived.push_back({CellId{f}, percept, dice.below(3) == 0, {}});
    }
    known.push_back(CellId{f});
  }
  return program;
}

void random_readings(Dice& dice, const program::Perception& perception, ReadingTable& readings, std::int64_t now_us) {
  for (std::uint32_t r = 0; r < perception.readings(); ++r) {
    const program::Sensor& sensor = perception.sensor_of(r);
    switch (dice.below(12)) {
      case 0: case 1: case 2: case 3: case 4: break;  // nothing new
      case 5: readings.there[r] = 0; break;
      case 6: readings.set(r, std::numeric_limits<float>::quiet_NaN(), now_us); break;
      case 7: readings.set(r, static_cast<float>(sensor.high * 3.0), now_us + 50'000); break;  // out of range, from the future
      default: readings.set(r, sensor.text ? static_cast<float>(dice.below(4)) : static_cast<float>(dice.between(sensor.low, sensor.high)), now_us);
    }
  }
}

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
    now_us += dice.below(30) == 0 ? -200'000 : dice.below(200'000);
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
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    const Work all = compare(seed, false), lazy = compare(seed, true);
    ASSERT_EQ(all.differing, 0u) << "seed " << seed;
    ASSERT_EQ(lazy.differing, 0u) << "seed " << seed << ", with lazy facts";
    ASSERT_EQ(all.asleep, 0u);
    fits += all.fits;
    lazy_fits += lazy.fits;
    asleep += lazy.asleep;
  }
  EXPECT_GT(asleep, 400u) << "lazy facts never slept";
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
    program_.cells.push_back({"Wall", program::CellKind::kFact, 0.0f, 0.75, 0.25, false, false, {}, {}});
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
  const float fresh = look(1'000'000);
  EXPECT_EQ(look(500'000), fresh) << "a reading from the future is as good as new";
  EXPECT_EQ(report().sight, mts::Sight::kTimeBackwards);
  EXPECT_EQ(report().from_the_future, 1u);
  EXPECT_EQ(look(600'000), fresh);
  EXPECT_EQ(report().sight, mts::Sight::kFromTheFuture);
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
