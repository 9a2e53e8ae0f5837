// Runs an emitted perception beside the plain reading of the program: the same facts, the very same numbers, from random readings with
// noise and age, missing ones, NaN, out of range, from the future, and with time that goes backwards. Then once more after a reset.
#pragma once

#include <cstdio>
#include <type_traits>
#include <vector>

#include "tests/unit/tables/random_perceiver.h"

namespace kb::emitted {

template <class Perception, class Mind>
bool sees_a_day_alike(std::uint64_t seed, Perception& perception, Mind& mind) {
  const program::Program program = tables::testing::random_perceiver(seed);
  const tables::PerceptionForm form = tables::build_perception(program);
  const auto plain = tables::make_plain_looker(program, form);
  typename Perception::Readings readings;
  tables::ReadingTable table(form.shape.readings);
  tables::testing::Dice dice(seed + 1);
  std::vector<float> given(program.facts, 0.0f);
  std::int64_t now_us = 0;
  // Random programs have no names that a template could use, so the store is written to.
  using Store = std::remove_cvref_t<decltype(readings.store())>;
  Store& store = const_cast<Store&>(readings.store());
  for (int tick = 0; tick < 80; ++tick) {
    now_us += dice.below(30) == 0 ? -static_cast<std::int64_t>(dice.below(2'000'000)) : static_cast<std::int64_t>(dice.below(200'000));
    tables::testing::random_readings(dice, program.perception, table, now_us);
    for (std::uint32_t r = 0; r < form.shape.readings; ++r) {
      store.value[r] = table.value[r];
      store.at_us[r] = table.at_us[r];
      store.there[r] = table.there[r];
    }
    for (float& x : given) {
      if (dice.below(4) == 0) x = static_cast<float>(dice.between(-1.0, 1.0));
    }
    std::vector<float> expected = given;
    for (std::uint32_t f = 0; f < program.facts; ++f) perception.facts().store().set(f, given[f]);
    const float* const certainties = mind.certainties();
    const std::vector<float> cells(certainties, certainties + program.cells.size());
    plain->look(table, now_us, cells, expected);
    auto& facts = perception.look(readings, mts::Instant{now_us}, mind);
    for (std::uint32_t f = 0; f < program.facts; ++f) {
      if (facts.store().value[f] == expected[f]) continue;
      std::printf("seed %llu, tick %d, fact %u: %.9g, expected %.9g\n", static_cast<unsigned long long>(seed), tick, f,
                  static_cast<double>(facts.store().value[f]), static_cast<double>(expected[f]));
      return false;
    }
    if (tick == 0 && perception.report().sight == mts::Sight::kTimeBackwards) {
      std::printf("seed %llu: it remembers a time\n", static_cast<unsigned long long>(seed));
      return false;
    }
    static_cast<void>(mind.tick(facts, mts::milliseconds(50)));
  }
  return true;
}

template <class Perception, class Mind>
bool sees_alike(std::uint64_t seed) {
  Perception perception;
  Mind mind;
  if (!sees_a_day_alike(seed, perception, mind)) return false;
  perception.reset();
  mind.reset();
  return sees_a_day_alike(seed, perception, mind);
}

}  // namespace kb::emitted
