// Perception as packed tables (runtime/perception.h), and two implementations of looking: the runtime's engine on the tables, and
// a plain interpreter of the program that it is tested against.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <waymark/runtime/perception.h>
#include "compiler/program/program.h"

namespace kb::tables {

struct PerceptionForm {
  using I = std::uint32_t;
  mts::PerceptionShape shape;
  std::vector<mts::Sensor> sensors;
  std::vector<I> sensor_of;
  std::vector<mts::Membership> prototypes;
  std::vector<I> fits_begin;
  std::vector<mts::FitRow<I>> fits;
  std::vector<I> fact;
  std::vector<I> steps_begin;
  std::vector<mts::PerceptStep<I>> steps;
  std::vector<std::uint8_t> lazy;           ///< empty if no fact is lazy
  std::vector<I> uses_begin, uses;
  std::vector<I> alternatives_begin, demands_begin;
  std::vector<mts::Demand<I>> demands;

  [[nodiscard]] bool empty() const { return shape.facts == 0 && shape.readings == 0; }
};

/// Pure; O(perception, and for each lazy fact O(program)).
[[nodiscard]] PerceptionForm build_perception(const program::Program& program);
/// Valid for as long as `form` is neither moved nor changed.
[[nodiscard]] mts::PerceptionTables<std::uint32_t> view(const PerceptionForm& form);
/// One item a line, stable: for `kbc dump tables`.
[[nodiscard]] std::string print(const PerceptionForm& form, const program::Program& program);

/// The last reading of every element, like mts::ReadingStore but with a length known only at run time.
struct ReadingTable {
  explicit ReadingTable(std::size_t count) : value(count, 0.0f), at_us(count, 0), there(count, 0) {}
  std::vector<float> value;
  std::vector<std::int64_t> at_us;
  std::vector<std::uint8_t> there;
  void set(std::size_t reading, float v, std::int64_t at) { value[reading] = v, at_us[reading] = at, there[reading] = 1; }
};

/// Looks, tick after tick. `program` and `form` must outlive it.
class Looker {
 public:
  virtual ~Looker() = default;
  /// Writes the perceived facts into `facts`, which already holds the given ones. `cells`: every cell as the last tick left it.
  virtual void look(const ReadingTable& readings, std::int64_t now_us, std::span<const float> cells, std::span<float> facts) = 0;
  [[nodiscard]] virtual const mts::SightReport& report() const = 0;
  /// The certainty of one reading against one thing (kFits, kReads) at the last look; for explanations. The plain one only.
  [[nodiscard]] virtual float certainty(const program::Percept&) const { return 0.0f; }
  /// Whether nobody waited for the perceived fact at this place at the last look; for explanations. The plain one only.
  [[nodiscard]] virtual bool asleep(std::size_t) const { return false; }
};

/// The engine that runs on the robot.
[[nodiscard]] std::unique_ptr<Looker> make_looker(const program::Program& program, const PerceptionForm& form);
/// The oracle: on every look it computes every fact from the program's definitions, then masks those that nobody waits for. It
/// shares with the engine only the certainty of one reading (`mts::certainty`, `mts::aged_spread`).
[[nodiscard]] std::unique_ptr<Looker> make_plain_looker(const program::Program& program, const PerceptionForm& form);

}  // namespace kb::tables
