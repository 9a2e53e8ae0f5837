// What perception costs: one fact, and Route1 with perception from 14 readings (line[5], range[8], compass; and two texts).
//
//   Fact     one reading with noise and age against one prototype, and the fact of it: from a value in hand to a certainty
//   Look     a whole recorded drive; every tick all readings are set, looked at, and the mind decides
//   Still    the same readings again: nothing but time has changed
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <waymark/runtime/certainty.h>
#include "bench/allocations.h"
#include "senses.kb.h"

namespace {

using bench::allocations;

/// A row of the recording, texts as their numbers.
struct Row { float number[14]; bool there[14]; std::string tag, memory; float start, azimuth; std::int64_t at_us; };

std::vector<Row> recording() {
  std::ifstream file(RECORDING);
  std::vector<Row> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::vector<std::string> fields;
    std::istringstream stream(line + ',');
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    Row row{};
    row.at_us = static_cast<std::int64_t>(std::strtod(fields[0].c_str(), nullptr) * 1e6 + 0.5);
    row.start = std::strtof(fields[1].c_str(), nullptr);
    row.azimuth = std::strtof(fields[2].c_str(), nullptr);
    for (int i = 0; i < 14; ++i) {
      row.there[i] = !fields[static_cast<std::size_t>(3 + i)].empty();
      row.number[i] = std::strtof(fields[static_cast<std::size_t>(3 + i)].c_str(), nullptr);
    }
    row.tag = fields[17];
    row.memory = fields[18];
    rows.push_back(std::move(row));
  }
  return rows;
}

void set(senses::Readings& readings, const Row& row, mts::Instant now) {
  for (std::uint32_t i = 0; i < 5; ++i) if (row.there[i]) readings.line[i] = {row.number[i], now};
  for (std::uint32_t i = 0; i < 8; ++i) if (row.there[5 + i]) readings.range[i] = {row.number[5 + i], now};
  if (row.there[13]) readings.compass = {row.number[13], now};
  if (!row.tag.empty()) readings.tag = {row.tag.c_str(), now};
  if (!row.memory.empty()) readings.memory = {row.memory.c_str(), now};
}

void Fact(benchmark::State& state) {
  const mts::Membership near = mts::gaussian(0.25f, 0.25f, 0.1f, 0.08f);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> value(0.0f, 0.6f), age(0.0f, 0.2f);
  std::vector<std::pair<float, float>> data(1024);
  for (auto& [x, a] : data) x = value(random), a = age(random);
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& [x, a] = data[i++ & 1023];
    benchmark::DoNotOptimize(mts::certainty(near, x, mts::aged_spread(0.02f, 20.0f, a)));
  }
}

void Look(benchmark::State& state) {
  const std::vector<Row> rows = recording();
  senses::Readings readings;
  senses::Perception perception;
  senses::Mind mind;
  std::size_t allocated = 0;
  std::size_t ticks = 0;
  std::uint64_t fits = 0;
  std::int64_t start_us = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (auto _ : state) {
    const std::size_t before = allocations;
    for (const Row& row : rows) {
      const mts::Instant now{start_us + row.at_us};
      set(readings, row, now);
      senses::Facts& facts = perception.look(readings, now, mind);
      facts.Start1 = row.start;
      facts.Track.azimuth = row.azimuth;
      benchmark::DoNotOptimize(mind.tick(facts, mts::milliseconds(200)).status());
      fits += perception.report().fits;
    }
    allocated += allocations - before;
    ticks += rows.size();
    start_us += 60'000'000;
  }
  const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - begin;
  state.counters["ns/tick"] = taken.count() / static_cast<double>(ticks);   // as a plain number: an inverted rate would be printed in seconds
  state.counters["fits/tick"] = static_cast<double>(fits) / static_cast<double>(ticks);
  state.counters["allocations"] = static_cast<double>(allocated);
}

void Still(benchmark::State& state) {
  const std::vector<Row> rows = recording();
  senses::Readings readings;
  senses::Perception perception;
  senses::Mind mind;
  std::int64_t now_us = 0;
  set(readings, rows.front(), mts::Instant{now_us});
  for (auto _ : state) {
    now_us += 1'000;
    senses::Facts& facts = perception.look(readings, mts::Instant{now_us}, mind);
    benchmark::DoNotOptimize(mind.tick(facts, mts::milliseconds(1)).status());
  }
}

BENCHMARK(Fact);
BENCHMARK(Look);
BENCHMARK(Still);

}  // namespace

BENCHMARK_MAIN();
