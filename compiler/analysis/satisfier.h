// Can these conditions hold together? A small search over what cells can be at one moment.
//
// It knows that:
// - a cell is in one region at a time;
// - at most one member of an exclusive group is high, and, among facts that are seen only while they are high, at most one is seen;
// - at most one strategy runs;
// - a fact's sighting limits its certainty, and its certainty the sighting;
// - a condition that has held for a while holds now, held on the tick before, and has held for any shorter while; an event never holds
//   for a while, nor does it come for what has been seen for a while;
// - two perceived facts that no readings make certain at once are not both high, or both seen (a host that gives such facts itself can
//   make them so).
// It knows nothing of earlier ticks, so `kYes` means "it cannot be ruled out".
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "compiler/analysis/confusion.h"
#include "compiler/analysis/domains.h"
#include "compiler/program/program.h"

namespace kb::analysis {

enum class Answer : std::uint8_t { kNo, kYes, kUnknown };  ///< kUnknown: the budget was spent

struct Goal {
  program::CondId condition = program::CondId::kNone;
  bool wanted = true;
};

/// What a condition demands of one variable (a cell, a sighting, a timer), whatever the other variables are.
struct Restriction {
  std::uint32_t variable = 0;
  std::uint8_t allowed = 0;
  friend bool operator==(const Restriction&, const Restriction&) = default;
};
/// A condition demands that `variable` is the one member of `choice` (an exclusive group) that is high, or seen.
struct Holder {
  std::uint32_t choice = 0;
  std::uint32_t variable = 0;
};
struct Demands {
  std::vector<Restriction> each;  ///< ascending by variable
  std::vector<Holder> holders;  ///< ascending by choice
  bool possible = true;         ///< false: they contradict each other
};
/// Whether two sets of demands leave every variable at least one value. Cheap; `false` is certain.
[[nodiscard]] bool compatible(const Demands& a, const Demands& b);

/// By group: whether one member at most is above 0 at any time, whichever rules fire. (In exclusivity.cc; see note [two members up].)
[[nodiscard]] std::vector<bool> exclusive_at_all_times(const program::Program& program);

class Satisfier {
 public:
  /// All must outlive it. Without `confusions` all facts are as if the host gave them.
  Satisfier(const program::Program& program, const Domains& domains, Confusions* confusions = nullptr);
  /// Like another, but for other domains.
  Satisfier(const Satisfier& other, const Domains& domains);
  Satisfier(const Satisfier&) = delete;
  Satisfier& operator=(const Satisfier&) = delete;

  /// Whether all goals can hold at one moment while `level` is evaluated (on the control level no strategy is high).
  [[nodiscard]] Answer together(std::span<const Goal> goals, std::uint32_t level);
  static constexpr std::size_t kAllParts = static_cast<std::size_t>(-1);
  /// What a condition demands, as far as that is known without trying alternatives. What an `and` or `or` of more than `most_parts` demands
  /// is left out.
  [[nodiscard]] Demands demands(program::CondId condition, std::uint32_t level, std::size_t most_parts = kAllParts);
  /// Whether what is demanded holds on no two ticks in a row: that something comes into view or goes out of it.
  [[nodiscard]] bool is_moment(std::span<const Restriction> demanded) const;
  /// Whether the condition is a `for` over something that never holds on two ticks in a row, so that the `for` never holds.
  [[nodiscard]] bool is_timed_event(program::CondId condition) const;
  /// By group: see `exclusive_at_all_times`.
  [[nodiscard]] const std::vector<bool>& exclusive() const { return exclusive_choices_->exclusive; }
  /// Steps taken by all questions since it was made or `renew` was called; once this exceeds `kTotalSteps` every answer is kUnknown.
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  void renew() { steps_ = 0; }
  static constexpr std::uint8_t kTimerTrue = 1, kTimerFalse = 2;   ///< the values of the variable of a timer
  static constexpr std::uint64_t kTotalSteps = 40'000'000;

 private:
  static constexpr std::uint32_t kNoChoice = 0xFFFFFFFFu;
  enum class Truth : std::uint8_t { kFalse, kTrue, kOpen };
  struct Change {
    std::uint32_t place;
    std::uint32_t before;
  };
  struct Sure {
    program::CellId fact;
    double limit;                         // which its certainty must reach
    std::size_t trail;                    // how long that was
  };
  struct Choice {
    std::size_t goal;
    std::size_t alternative;
    std::size_t trail;
    std::size_t open;
  };

  /// How long a condition has held, as far as the timers over it say.
  struct Elapsed {
    std::int64_t at_least = -1;
    std::int64_t below = INT64_MAX;
  };
  struct Timed {
    program::CondId condition;
    Elapsed before;
    std::size_t trail;                    // how long that was
  };

  /// What at most one of several variables can be at a time.
  struct Choices {
    std::vector<bool> exclusive;            // by group
    std::vector<std::uint32_t> of;          // by cell, then by sighting; kNoChoice
    std::uint32_t count = 0;
  };

  Satisfier(const program::Program& program, const Domains& domains, std::shared_ptr<const Choices> choices, Confusions* confusions);
  [[nodiscard]] static Choices find_choices(const program::Program& program);
  [[nodiscard]] std::uint32_t choice_of(std::uint32_t variable) const { return variable < exclusive_choices_->of.size() ? exclusive_choices_->of[variable] : kNoChoice; }
  void find_timed_events();
  [[nodiscard]] std::uint8_t left_by_others(std::uint32_t timer) const;
  void note_elapsed(std::uint32_t timer);
  void begin(std::uint32_t level);
  [[nodiscard]] bool assume(Goal goal);
  [[nodiscard]] bool assume_leaf(Goal goal);
  [[nodiscard]] bool assume_held(program::CondId timer);
  [[nodiscard]] bool restrict_to(std::uint32_t variable, std::uint8_t allowed);
  [[nodiscard]] bool narrow(std::uint32_t variable, std::uint8_t allowed);
  [[nodiscard]] bool couple(std::uint32_t fact);
  [[nodiscard]] bool may_be_sure(std::uint32_t variable);
  [[nodiscard]] std::uint8_t allowed(std::uint32_t variable) const;
  [[nodiscard]] Truth truth(program::CondId condition);
  [[nodiscard]] Truth truth_of_several(const program::Cond& cond);
  [[nodiscard]] Truth leaf_truth(program::CondId condition) const;
  struct Left {
    std::size_t count = 0;
    program::CondId last = program::CondId::kNone;
    bool done = false;
  };
  [[nodiscard]] Left alternatives_left(Goal goal);
  void close(std::size_t open_goal);
  [[nodiscard]] bool settle(std::size_t& branch);
  [[nodiscard]] Answer search();
  [[nodiscard]] bool next_alternative();
  [[nodiscard]] bool exhausted() const { return steps_ >= limit_; }
  void undo(std::size_t trail, std::size_t open);
  [[nodiscard]] std::uint32_t sighting_of(program::CellId fact) const;
  [[nodiscard]] bool is_sighting(std::uint32_t variable) const { return variable >= program_.cells.size() && variable < program_.cells.size() + program_.facts; }
  [[nodiscard]] std::uint32_t timer_of(program::CondId condition) const;
  /// The variable that a leaf (or `for`) asks about, and the values for which it is true.
  struct Question {
    std::uint32_t variable;
    std::uint8_t allowed;
  };
  [[nodiscard]] Question question(program::CondId condition) const;

  const program::Program& program_;
  const Domains& domains_;
  Confusions* confusions_;
  std::vector<std::uint8_t> values_;      // by variable: what it may still be
  std::shared_ptr<const Choices> exclusive_choices_;
  std::vector<std::uint32_t> holder_;     // by choice: the variable that has it, or kNobody
  std::vector<Change> trail_;             // to undo: places of values, then of holders, then of `closed_`
  std::vector<Sure> sure_;                // perceived facts that must be high, or seen
  std::unordered_map<program::CondId, Elapsed> elapsed_;   // by condition under a timer
  std::vector<Timed> timed_;              // timers that are certain, to undo
  std::vector<Goal> open_;                // goals of which one part must hold (or fail)
  std::vector<bool> closed_;              // by open goal: met, or a part of it was taken
  std::vector<Goal> pending_;
  std::vector<Choice> choices_;
  std::vector<program::CondId> timed_events_;   // ascending
  std::map<program::CondId, std::vector<Restriction>> held_;   // by `for` condition: what it demands of sightings beyond its part
  bool control_level_ = false;
  std::size_t most_parts_ = kAllParts;   // wider conditions are taken to demand nothing
  std::uint64_t steps_ = 0;
  std::uint64_t limit_ = 0;
};

}  // namespace kb::analysis
