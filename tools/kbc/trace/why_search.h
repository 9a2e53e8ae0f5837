// The tick for `kbc why` to explain if none is named.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/program/why.h"
#include "tools/kbc/trace/why.h"

namespace kb::trace {

/// Finds the ticks on which what a question asks about happened: one of its rules fired, its strategy ran, its satellite changed, its fact was
/// seen. Explained is the first of them; if it never happened, the tick on which it came nearest.
class WhySearch {
 public:
  /// `question` must ask about something. `program` must outlive it.
  WhySearch(const program::Program& program, const Question& question);

  /// To be called after each tick. `recorder` watches a satellite asked for, and has recorded this tick if nothing has happened yet; is told to
  /// go on until something does. O(program) until then.
  void consider(const program::Tick& tick, program::Recorder& recorder);
  /// What to explain, after at least one tick. `recorder`: as above.
  [[nodiscard]] const program::Record& record(const program::Recorder& recorder) const { return ticks_.empty() ? nearest_ : recorder.record(); }
  /// The ticks on which it happened, ascending.
  [[nodiscard]] const std::vector<std::uint64_t>& ticks() const { return ticks_; }
  /// For a satellite: what it changed to on each of them. Empty for all else.
  [[nodiscard]] const std::vector<float>& values() const { return values_; }
  /// For a satellite: those on which it changed, and back before they ended.
  [[nodiscard]] const std::vector<std::uint64_t>& within() const { return passing_; }
  /// The line above the explanation: "`enter` fired on 3 of 40 ticks: 7, 12-13. The first:". `name`: what was asked for.
  [[nodiscard]] std::string print(std::string_view name, std::uint64_t ticks) const;

 private:
  [[nodiscard]] bool happened(const program::Tick& tick, const program::Recorder& recorder);
  [[nodiscard]] const program::CellValue* change(const program::Tick& tick) const;   // of the satellite asked for; null if there was none
  Nearness nearest_rule(const program::Record& record);
  [[nodiscard]] std::string print_alone() const;
  [[nodiscard]] Nearness least(const std::vector<program::RuleId>& rules, const program::Record& record) const;
  [[nodiscard]] Nearness nearness(const program::Record& record) const;

  const program::Program& program_;
  program::CellId cell_;                 // the cell or strategy asked for
  struct Satellite {
    program::CellId cell;
    std::vector<program::RuleId> raisers;
  };
  std::vector<program::RuleId> rules_;   // those asked for, or the one that runs the strategy; none if the question is about a cell
  std::vector<Satellite> satellites_;    // those of the strategy, or the cell asked for (without raisers if it is a fact)
  program::Record nearest_;
  Nearness near_{UINT32_MAX, 0.0};
  struct Alone {
    Nearness near;
    std::uint64_t tick;
  };
  std::vector<std::vector<Alone>> alone_;   // by place in `rules_`, for each condition: the tick on which nothing else lacked, the nearest of several
  std::vector<std::uint64_t> ticks_;
  std::vector<float> values_;
  std::vector<std::uint64_t> passing_;
  bool seen_ = false;                    // the fact asked for, on the last tick
};

}  // namespace kb::trace
