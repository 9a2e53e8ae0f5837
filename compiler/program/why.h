// Why a rule fired or did not, in words and numbers: answers for `kbc why`.
//
// A `Recorder` watches an interpreter and keeps what the rules of one tick decided by, and which rules last wrote each cell. The
// answers are pure functions of that record.
//
//   Recorder recorder(program, 14);
//   interpreter.observe(&recorder);
//   for (...) recorder.tick_ended(interpreter.tick(facts, dt), interpreter);   // up to tick 14
//   explain_rule(program, recorder.record(), rule).text;
//   // "`enter[right,mark]` did not fire at tick 14: `Safe` is 0.10, needs 0.50; all else holds"
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compiler/program/interpret.h"

namespace kb::program {

/// What the rules of one level decided by on the tick in question.
struct LevelRecord {
  std::vector<float> cf;                             ///< by cell
  std::vector<bool> truth;                           ///< by condition; meaningful for those of this level's rules, as all that follows
  std::vector<std::optional<std::int64_t>> held_us;  ///< by condition, `for` only: how long its part has held
  std::vector<bool> armed;                           ///< by rule
};

/// The last time that a cell was written, on or before the tick in question.
struct LastWrite {
  std::uint64_t tick = 0;     ///< 0: never
  std::vector<RuleId> rules;  ///< the rules that wrote it then, of the lowest level that did
  std::vector<float> values;  ///< what each of them wrote
  bool of_one_mind = true;    ///< they wrote the same
};

struct Record {
  Tick tick;  ///< `number` 0 until the tick in question has ended
  std::vector<LevelRecord> levels;
  std::vector<bool> seen, event, lost;      ///< by fact
  std::vector<bool> given;                  ///< by fact: the recording gives it; empty if the recording is one of readings, from which facts are perceived
  std::vector<std::uint64_t> fired_before;  ///< by rule: the last tick before this one on which it fired; 0: never
  std::vector<LastWrite> last_write;        ///< by cell
  std::vector<float> cf_after;              ///< by cell, when the tick was over
};

/// A fact was in view on the tick before the one in question.
[[nodiscard]] inline bool seen_before(const Record& record, CellId fact) {
  const std::size_t i = index(fact);
  return record.lost[i] || (record.seen[i] && !record.event[i] && record.tick.number > 1);
}

/// The satellite that drew attention to a fact on the tick in question: one that was high when it began, before any rule had written.
/// None if there is none.
[[nodiscard]] CellId attending(const Program& program, const Record& record, CellId fact);

class Recorder final : public Interpreter::Observer {
 public:
  /// Records tick `wanted` (the first is 1) of the interpreter that it observes. Both must outlive it.
  Recorder(const Program& program, std::uint64_t wanted);
  void level_evaluated(const Interpreter& interpreter, std::uint32_t level) override;
  /// Must be called after every tick up to the wanted one; later ticks are ignored.
  void tick_ended(const Tick& tick, const Interpreter& interpreter);
  [[nodiscard]] const Record& record() const { return record_; }
  /// The facts that the recording gives: see Record::given.
  void facts_are_given(std::vector<bool> given) { record_.given = std::move(given); }
  /// From now on follows this cell through every tick.
  void watch(CellId cell) {
    watched_ = cell;
    found_.assign(program_.levels.size() + 1, 0.0f);
  }
  /// What the rules of each level found in the watched cell on the last tick, and behind them what the tick left in it.
  [[nodiscard]] const std::vector<float>& found() const { return found_; }
  /// Wants the next tick, once the wanted one has ended.
  void go_on();

 private:
  void note_writes(const Tick& tick);
  const Program& program_;
  std::uint64_t wanted_;
  std::vector<std::vector<CondId>> conditions_;   // by level: those of its rules
  Record record_;
  CellId watched_ = CellId::kNone;
  std::vector<float> found_;
};

/// One condition, and why it holds or not: "`Safe` is 0.10, needs 0.50".
struct Reason {
  std::string condition;  ///< in the language's own words
  std::string text;
  bool holds = false;
};
/// How much is told of an `or` with many alternatives: they are listed one by one if they are few, or all are asked for.
enum class Detail : std::uint8_t { kBrief, kAll };

enum class Outcome : std::uint8_t {
  kFired,
  kFiredContradicted,  ///< fired, and another rule wrote the opposite: a `when` rule stays armed
  kFalse,              ///< its condition does not hold
  kNotArmed,           ///< its condition holds, and has held since it fired
  kSilenced,           ///< its condition holds, but a `reset` fired at its level
};
struct RuleStory {
  RuleId rule = RuleId::kNone;
  Outcome outcome = Outcome::kFalse;
  std::string text;             ///< one sentence with the decisive reasons
  std::vector<Reason> reasons;  ///< every conjunct of its condition, in order
};
[[nodiscard]] RuleStory explain_rule(const Program& program, const Record& record, RuleId rule, Detail detail = Detail::kBrief);

struct CellStory {
  CellId cell = CellId::kNone;
  float value = 0.0f;         ///< after the tick
  std::string text;           ///< the value and which rules gave it
  std::vector<RuleId> rules;  ///< the rules that wrote it last
};
[[nodiscard]] CellStory explain_cell(const Program& program, const Record& record, CellId cell);

struct StrategyStory {
  CellId strategy = CellId::kNone;
  bool dispatched = false;
  std::string text;
  RuleStory rule;  ///< its `run[...]`
};
[[nodiscard]] StrategyStory explain_strategy(const Program& program, const Record& record, CellId strategy, Detail detail = Detail::kBrief);

}  // namespace kb::program
