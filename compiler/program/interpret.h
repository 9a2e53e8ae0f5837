// The oracle: the tick of the model, slow and plain, straight from the program. Between ticks it keeps only the state that the
// model itself has. Tables and emitted C++ must give the same `Tick`s.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/program/tick.h"

namespace kb::program {

class Interpreter {
 public:
  /// `program` must be sound (`verify`) and outlive the interpreter.
  explicit Interpreter(const Program& program);

  /// One tick. `facts`: a value for each fact (by cell index), 0 for "no data"; NaN and out-of-range values are
  /// allowed; values missing at the end are 0. `dt_us`: time since the last tick in microseconds; ignored on the first tick
  /// (time begins there). Cost: every rule is evaluated.
  Tick tick(std::span<const float> facts, std::uint32_t dt_us);

  /// Returns to the state at start-up.
  void reset();

  [[nodiscard]] float value(CellId cell) const { return cf_[index(cell)]; }
  /// For tests and tools: sets a satellite from outside, between two ticks.
  void poke(CellId satellite, float value) { cf_[index(satellite)] = value; }
  [[nodiscard]] bool seen(CellId fact) const { return seen_[index(fact)]; }
  [[nodiscard]] bool event(CellId fact) const { return event_[index(fact)]; }
  [[nodiscard]] bool lost(CellId fact) const { return lost_[index(fact)]; }
  /// How many ticks are over; inside an observer, the tick under way does not count.
  [[nodiscard]] std::uint64_t ticks() const { return ticks_; }
  /// A `when` rule fires when it is armed and finds its condition true. `while` rules are always armed.
  [[nodiscard]] bool armed(RuleId rule) const { return armed_[index(rule)]; }

  /// Called when a level's conditions have been evaluated and nothing has been written yet, so that all that can be asked here
  /// (values, `holds`, `held_us`, `armed`) is what the rules of `level` decide by. For `why` and for coverage.
  class Observer {
   public:
    virtual ~Observer() = default;
    virtual void level_evaluated(const Interpreter& interpreter, std::uint32_t level) = 0;
  };
  /// Null: nobody. Not owned.
  void observe(Observer* observer) { observer_ = observer; }
  /// Whether a condition (a rule's, or a part of one) of the level that was evaluated last held there. Meaningful
  /// only inside an observer.
  [[nodiscard]] bool holds(CondId condition) const { return truth_[index(condition)]; }
  /// How long the condition inside a `for` had held at its level's last evaluation, in microseconds; nothing if it did not
  /// hold, or no rule of the level asks. Timers belong to a level: two levels that ask the same have one each.
  [[nodiscard]] std::optional<std::int64_t> held_us(CondId for_condition, std::uint32_t level) const;

 private:
  /// One level: its rules [begin, end) and all conditions in them, parts before the whole.
  struct Level {
    std::uint32_t begin = 0, end = 0;
    std::vector<CondId> conds;
    std::vector<std::int64_t> since;  // by place in `conds`, for `for`: since when its part has held; kNotHeld
  };
  struct Writer {
    CellId cell;
    std::uint32_t rule;
    float value;
  };

  void take_facts(std::span<const float> facts, Tick& tick);
  void settle_sightings(Tick& tick);
  void run_level(std::uint32_t level, Tick& tick);
  void evaluate(Level& level, bool settle_timers);
  [[nodiscard]] bool evaluate(const Cond& cond) const;
  [[nodiscard]] bool time(std::int64_t& since, const Cond& cond) const;
  [[nodiscard]] float strength(CondId condition) const;
  void commit(const std::vector<std::uint32_t>& firing, Tick& tick, std::vector<bool>& contradicted);
  [[nodiscard]] float combine(std::span<const Writer> writers, std::uint32_t first_rule, Tick& tick,
                              std::vector<bool>& contradicted) const;
  void dispatch(Tick& tick);

  const Program& program_;
  Observer* observer_ = nullptr;
  float firing_ = 0.5f;
  std::vector<Thresholds> thresholds_;  // by fact
  std::vector<Level> levels_;
  std::uint64_t ticks_ = 0;
  std::int64_t time_us_ = 0;
  std::vector<float> cf_;
  std::vector<bool> seen_, event_, lost_;  // by fact
  std::vector<bool> armed_;                // by rule
  std::vector<bool> truth_;                // by condition; of the level that was evaluated last
  CellId last_strategy_ = CellId::kNone;   // the last that was active, and when
  std::int64_t last_active_us_ = 0;
};

}  // namespace kb::program
