// The compiled mind in memory: the runtime's engine on the tables, fed by perception.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <waymark/controllers/road_watch.h>
#include "compiler/program/tick.h"
#include "sim/mind/knowledge.h"

namespace kb::sim {

inline constexpr float kSure = mts::RoadWatch::kSure;

/// What is perceived for a tick.
struct Perceived {
  std::span<const float> facts;         ///< of the standard library; 0 for all others
  const mts::Senses* senses = nullptr;
  const std::string* tag = nullptr;     ///< for the sensors `tag` and `memory` of a knowledge base: the landmark's name, and `cross mark`,
  const std::string* memory = nullptr;  ///< `move dist`; null: nothing
};

class Mind {
 public:
  /// `knowledge` must outlive it.
  explicit Mind(const Knowledge& knowledge);
  /// Takes another knowledge base between two ticks, which must outlive the mind instead of the first: the state carries over by name.
  /// Both need an image, and the same facts and strategies in the same order: see `can_take`.
  void take(const Knowledge& next);

  /// Sets a fact for the next ticks, whatever is perceived: a button that is pressed. The last call for a fact counts.
  void press(program::CellId fact, int ticks, float certainty = kSure);
  static constexpr int kHeld = std::numeric_limits<int>::max();   ///< as `ticks`: until it is released
  void release(program::CellId fact);

  /// A reading of a sensor of the knowledge base. It counts until it is stale, or replaced. Those of `Knowledge::feeds` are replaced on each tick.
  void measure(std::uint32_t reading, float value, std::int64_t now_us) { readings_.set(reading, value, now_us); }
  /// The same of a sensor of texts; null: it reads nothing.
  void read(std::uint32_t reading, const std::string* text, std::int64_t now_us);
  /// Readings of later than now were given a wrong time: they are of now.
  void set_clock(std::int64_t now_us);
  /// From now on the sensor is silent.
  void silence(std::uint32_t reading) { readings_.there[reading] = 0; }
  /// One tick. Facts that the knowledge base defines itself come from the senses; they replace what was perceived.
  const program::Tick& tick(const Perceived& perceived, std::int64_t now_us, std::uint32_t dt_us);

  [[nodiscard]] float value(program::CellId cell) const { return machine_.value(cell); }
  [[nodiscard]] bool high(program::CellId cell) const { return machine_.value(cell) >= firing_; }
  [[nodiscard]] bool seen(program::CellId fact) const { return machine_.seen(fact); }
  /// The facts of the last tick.
  [[nodiscard]] std::span<const float> facts() const { return facts_; }
  /// The strategy that is to drive, as an index into the knowledge's strategies; -1 if none.
  [[nodiscard]] int strategy() const { return strategy_; }

 private:
  void perceive(const Perceived& perceived, std::int64_t now_us);

  const Knowledge* knowledge_;
  tables::Machine machine_;
  std::unique_ptr<tables::Looker> looker_;
  tables::ReadingTable readings_;
  std::map<std::uint32_t, std::string> texts_;   // by reading: what was read last
  std::vector<float> facts_, cells_, before_;
  struct Button { program::CellId fact{}; int ticks = 0; float certainty = kSure; };
  std::vector<Button> pressed_;
  program::Tick tick_;
  int strategy_ = -1;
  float firing_ = 0.5f;
};

}  // namespace kb::sim
