// Answers for `kbc why`: the explanations of program/why.h, combined for a question.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/program/why.h"
#include "tools/kbc/trace/sighting.h"

namespace kb::trace {

/// How far a rule was from firing: how many conditions on single cells would have to change at least, and by how much their
/// values in sum. Both are 0 if its condition holds.
struct Nearness {
  std::uint32_t lacking = 0;
  double gap = 0.0;
  /// If one condition lacks: which, and whether it would have to hold or not to.
  program::CondId last = program::CondId::kNone;
  bool wanted = true;
  /// Nearer is less: the fewer conditions first, then the smaller gap.
  friend auto operator<=>(const Nearness& a, const Nearness& b) { return std::pair(a.lacking, a.gap) <=> std::pair(b.lacking, b.gap); }
  friend bool operator==(const Nearness& a, const Nearness& b) { return a <=> b == 0; }
};
[[nodiscard]] Nearness nearness(const program::Program& program, const program::Record& record, program::RuleId rule);

/// The levels whose rules found a cell at a value that it had neither before the tick nor after it, ascending. `found`: see Recorder::found.
[[nodiscard]] std::vector<std::uint32_t> levels_in_passing(const std::vector<float>& found);

/// The rules that make the satellite or the strategy high, ascending; if none does, those that raise it most, if that is above `above`.
/// O(rules).
[[nodiscard]] std::vector<program::RuleId> raisers(const program::Program& program, program::CellId cell, float above = -1.0f);

/// The question. With nothing set, it asks about the tick as a whole: all rules that fired, and the strategy that ran.
struct Question {
  std::vector<program::RuleId> rules{};
  program::CellId cell = program::CellId::kNone;
  program::CellId strategy = program::CellId::kNone;
  program::Detail detail = program::Detail::kBrief;
};

struct RuleAnswer {
  program::RuleStory story;
  Nearness near;
  [[nodiscard]] bool fired() const {
    return story.outcome == program::Outcome::kFired || story.outcome == program::Outcome::kFiredContradicted;
  }
};

struct CellAnswer {
  program::CellStory story;
  std::string threshold;            ///< for a fact: the threshold that it had to pass to be seen, and why
  std::vector<std::uint32_t> passing{};   ///< of a satellite: see levels_in_passing
  bool lacks_raiser = false;        ///< a satellite that is not high, and no rule raises it above its value
  std::vector<RuleAnswer> writers{};   ///< of a satellite: the rules that wrote it last, if that was on this tick
  std::vector<RuleAnswer> raisers;  ///< a satellite that is not high: the rules that would raise it, the nearest first
};

struct StrategyAnswer {
  program::StrategyStory story;
  std::vector<program::CellId> before;  ///< strategies of higher priority that were wanted, the highest first
};

struct Answer {
  bool of_whole_tick = false;     ///< nothing in particular was asked for
  std::optional<std::vector<std::uint64_t>> ticks{};   ///< no tick was asked for: all on which it happened, see why_search.h
  std::vector<float> values{};    ///< what a satellite changed to on these ticks
  std::vector<std::uint64_t> within{};   ///< those on which a satellite changed, and back before they ended
  std::vector<RuleAnswer> rules;  ///< those asked for, the nearest to firing first; or those that fired, in order
  std::optional<StrategyAnswer> strategy;
  std::vector<CellAnswer> cells;  ///< the cell asked for; the satellites of the strategy asked for
  std::optional<Sighting> sighting{};   ///< of the fact asked for, if it is perceived or was badly given
};

/// `record` must be complete (its tick has ended). O(program).
[[nodiscard]] Answer answer(const program::Program& program, const program::Record& record, const Question& question);

/// The answer for people; the first `most` rules are spelt out, the others counted.
[[nodiscard]] std::string print(const program::Program& program, const program::Record& record, const Answer& answer,
                                std::size_t most = 5);
/// The answer for programs, on one line.
[[nodiscard]] std::string print_json(const program::Program& program, const program::Record& record,
                                     const Answer& answer);

}  // namespace kb::trace
