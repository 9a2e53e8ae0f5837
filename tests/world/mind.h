// A mind: what turns facts into a decision. One face for everything that can run a knowledge base.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>

#include "compiler/program/tick.h"
#include "tests/world/knowledge.h"

namespace kb::world {

class Mind {
 public:
  virtual ~Mind() = default;
  /// One tick: a value for each fact (by cell index, 0 is "no data"), microseconds since the last tick.
  virtual program::Tick tick(std::span<const float> facts, std::uint32_t dt_us) = 0;
  [[nodiscard]] virtual float value(program::CellId cell) const = 0;
  /// Sets a satellite from outside, between two ticks.
  virtual void poke(program::CellId satellite, float value) = 0;
  /// State of start-up again.
  virtual void reset() = 0;
};

enum class MindKind : std::uint8_t {
  kInterpreter,  ///< program::Interpreter, the oracle
  kMachine,      ///< the runtime's engine on tables in memory
  kBoth,         ///< both in lock-step; the first difference throws MindsDiffer
  kLazyLandmarks,  ///< the engine, if every landmark were a lazy fact: it is 0 while nobody waits for it
};

/// Oracle and engine disagree; what() prints both ticks.
class MindsDiffer : public std::runtime_error { using std::runtime_error::runtime_error; };

/// `knowledge` must outlive the mind.
[[nodiscard]] std::unique_ptr<Mind> make_mind(MindKind kind, const Knowledge& knowledge);

/// Two minds in lock-step: what `oracle` does is what `engine` must do. Answers are the engine's.
[[nodiscard]] std::unique_ptr<Mind> make_lock_step(const Knowledge& knowledge, std::unique_ptr<Mind> oracle,
                                                   std::unique_ptr<Mind> engine);

/// What the environment variable KB_MIND names (`interpreter`, `machine`, `both`), else `kBoth`: to look at one alone.
[[nodiscard]] MindKind mind_from_environment();

}  // namespace kb::world
