// Random programs with perception, and random readings for them, good and bad.
#pragma once

#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "compiler/tables/perception.h"
#include "tests/unit/program/random_program.h"

namespace kb::tables::testing {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

 private:
  std::mt19937_64 random_;
};

inline fuzzy::Shape random_shape(Dice& dice, const program::Sensor& sensor) {
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

inline void add_sensors(Dice& dice, program::Perception& to) {
  for (std::uint32_t i = 0; i < 1 + dice.below(4); ++i) {
    program::Sensor sensor;
    sensor.name = "s" + std::to_string(i);
    sensor.text = dice.below(4) == 0;
    sensor.array = dice.below(2) == 0;
    sensor.count = sensor.array ? 1 + dice.below(5) : 1;
    sensor.first = to.readings();
    sensor.high = dice.below(2) == 0 ? 360.0 : 4.0;
    sensor.circular = !sensor.text && sensor.high == 360.0;
    sensor.strict = !sensor.text && dice.below(3) == 0;
    sensor.noise = dice.below(3) == 0 ? 0.0 : 0.01 * sensor.high;
    if (dice.below(2) == 0) sensor.stale_s = dice.between(0.05, 1.0);
    sensor.growth = program::growth_of(sensor);
    if (sensor.text) sensor.texts = {"LM1", "LM2", "LM7"};
    to.sensors.push_back(sensor);
  }
}

inline program::PerceptId random_percept(Dice& dice, program::Program& program, const std::vector<program::CellId>& facts, int depth) {
  program::Perception& to = program.perception;
  program::Percept percept;
  const std::uint32_t kind = depth <= 0 ? dice.below(2) : dice.below(5);
  if (kind < 2) {
    percept.reading = dice.below(to.readings());
    const program::Sensor& sensor = to.sensor_of(percept.reading);
    percept.op = sensor.text ? program::Percept::Op::kReads : program::Percept::Op::kFits;
    if (sensor.text) {
      percept.text = sensor.texts[dice.below(3)];
    } else {
      percept.prototype = static_cast<std::uint32_t>(to.prototypes.size());
      to.prototypes.push_back({random_shape(dice, sensor), "p"});
    }
    if (kind == 0 && !facts.empty()) {
      percept = program::Percept{};
      percept.op = program::Percept::Op::kFact;
      percept.cell = facts[dice.below(static_cast<std::uint32_t>(facts.size()))];
    }
  } else {
    percept.op = kind == 2 ? program::Percept::Op::kNot : kind == 3 ? program::Percept::Op::kAnd : program::Percept::Op::kOr;
    const std::uint32_t parts = kind == 2 ? 1 : 2 + dice.below(2);
    for (std::uint32_t i = 0; i < parts; ++i) percept.children.push_back(random_percept(dice, program, facts, depth - 1));
  }
  to.percepts.push_back(percept);
  return program::PerceptId{static_cast<std::uint32_t>(to.percepts.size() - 1)};
}

/// A random program some of whose facts are perceived, the later by the earlier, a third of them lazy.
inline program::Program random_perceiver(std::uint64_t seed) {
  auto program = program::testing::random_program(seed);
  Dice dice(seed);
  add_sensors(dice, program.perception);
  std::vector<program::CellId> known;
  for (std::uint32_t f = 0; f < program.facts; ++f) {
    if (dice.below(3) != 0) {
      const program::PerceptId percept = random_percept(dice, program, known, 3);
      program.perception.perceived.push_back({program::CellId{f}, percept, dice.below(3) == 0, {}});
    }
    known.push_back(program::CellId{f});
  }
  return program;
}

inline void random_readings(Dice& dice, const program::Perception& perception, ReadingTable& readings, std::int64_t now_us) {
  for (std::uint32_t r = 0; r < perception.readings(); ++r) {
    const program::Sensor& sensor = perception.sensor_of(r);
    switch (dice.below(12)) {
      case 0: case 1: case 2: case 3: case 4: break;  // nothing new
      case 5: readings.there[r] = 0; break;
      case 6: readings.set(r, std::numeric_limits<float>::quiet_NaN(), now_us); break;
      case 7: {                                                                               // out of range, from the future
        const std::int64_t ahead_us = dice.below(2) == 0 ? 50'000 : static_cast<std::int64_t>(dice.below(4'000'000));
        readings.set(r, static_cast<float>(sensor.high * 3.0), now_us + ahead_us);
        break;
      }
      default: readings.set(r, sensor.text ? static_cast<float>(dice.below(4)) : static_cast<float>(dice.between(sensor.low, sensor.high)), now_us);
    }
  }
}

}  // namespace kb::tables::testing
