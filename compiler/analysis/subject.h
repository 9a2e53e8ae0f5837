// The program that all checks of this folder look at, and findings that several of them need, computed once.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compiler/analysis/analysis.h"
#include "compiler/analysis/confusion.h"
#include "compiler/analysis/domains.h"
#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/writers.h"
#include "compiler/diagnostics/diagnostics.h"
#include "compiler/model/model.h"
#include "compiler/program/program.h"

namespace kb::analysis {

/// Cells that were declared together: a group, the rows of a relation, or the own satellites of these. A message names one of
/// them and counts the others.
struct Clan {
  source::Few<program::CellId, 4> cells;
  /// Indexed by sets that it did not name itself (`Out[Direction]`, rows): then a member that nobody needs is a mistake only
  /// if nobody needs any of the others.
  bool indexed = false;
};

struct Subject {
  Subject(const model::Model& studied, const program::Program& lowered, diagnostics::Diagnostics& messages);
  Subject(const Subject&) = delete;      // parts refer to each other
  Subject& operator=(const Subject&) = delete;

  static constexpr std::uint8_t kAsksSight = 1, kAsksHigh = 2;

  const model::Model& model;
  const program::Program& program;
  diagnostics::Diagnostics& diagnostics;

  Domains domains;
  Domains written;                       ///< what cells could be if every rule could fire
  Domains widest;                        ///< ... or if rules wrote whatever can be written
  Writers writers;
  std::vector<std::uint32_t> family;     ///< by rule: the rule as written that it is an instance of
  std::vector<std::uint32_t> instances;  ///< by family: how many
  std::vector<std::uint32_t> group_of;   ///< by cell: its exclusive group
  std::vector<Clan> clans;
  std::vector<program::RuleId> reader;  ///< by cell: a rule that asks for it (one of the user's if there is one)
  std::vector<std::uint8_t> asked;      ///< by cell: what rules ask of it, `kAsksSight` and `kAsksHigh`
  std::vector<program::RuleId> raiser;  ///< by cell: a rule that writes a positive value to it
  std::vector<bool> reported;           ///< by cell: a message has said that it never changes, or is never seen
  std::unique_ptr<Confusions> confusions;

  /// The one that knows `domains`, and the one that knows `widest`, with a new budget: for one list of questions after another.
  [[nodiscard]] Satisfier& satisfier() const { return renewed(narrow_); }
  [[nodiscard]] Satisfier& wide_satisfier() const { return renewed(wide_); }

  /// Whether one member of the group at most is above 0 at any time.
  [[nodiscard]] bool exclusive(std::uint32_t group) const { return narrow_.exclusive()[group]; }

  /// Whether a rule asks if the fact is seen, newly seen or lost; whether a rule asks if it is high.
  [[nodiscard]] bool asks_sight(program::CellId fact) const { return (asked[program::index(fact)] & kAsksSight) != 0; }
  [[nodiscard]] bool asks_high(program::CellId cell) const { return (asked[program::index(cell)] & kAsksHigh) != 0; }

  /// Whether rules write other values to the cell than it has from the start, but none of them can fire.
  [[nodiscard]] bool written_only_in_vain(program::CellId cell) const {
    const Regions reached = domains.cells[program::index(cell)];
    return reached != written.cells[program::index(cell)] && reached == region_of(program[cell].initial, static_cast<float>(program.settings.firing));
  }

  [[nodiscard]] static bool generated(const program::Rule& rule) { return !rule.span.known(); }
  [[nodiscard]] bool in_library(source::Span span) const {
    return span.known() && diagnostics.sources().standard(span.file);
  }

 private:
  [[nodiscard]] static Satisfier& renewed(Satisfier& satisfier) {
    satisfier.renew();
    return satisfier;
  }

  mutable Satisfier narrow_, wide_;   // answers do not depend on what was asked before
};

/// Findings about rules, one for each rule as written: the first instance speaks for all.
template <class Finding>
class ByFamily {
 public:
  explicit ByFamily(const Subject& subject) : subject_(subject), found_(subject.instances.size()) {}

  void add(program::RuleId rule, Finding finding) {
    Entry& entry = found_[subject_.family[program::index(rule)]];
    if (entry.count++ == 0) {
      entry.rule = rule;
      entry.finding = std::move(finding);
    }
  }
  /// `f(rule, finding, count)`, in the order of the rules.
  template <class F>
  void for_each(F&& f) const {
    for (const Entry& entry : found_) {
      if (entry.count > 0) f(entry.rule, entry.finding, entry.count);
    }
  }

 private:
  struct Entry {
    program::RuleId rule = program::RuleId::kNone;
    Finding finding{};
    std::uint32_t count = 0;
  };
  const Subject& subject_;
  std::vector<Entry> found_;
};

/// " (and 11 more of its instances)", or nothing for one.
[[nodiscard]] std::string more(std::uint32_t count, const char* of_what = "of its instances");

struct Demands;
/// A cell that must be as `demands` says and that `rule` makes otherwise, if there is one. (In effects.cc.)
[[nodiscard]] std::optional<program::CellId> undone(const Subject& subject, const Demands& demands, const program::Rule& rule);

/// Adds a note to a message about two rules that disagree if they can meet only at an event, or at two at once. (In event_notes.cc.)
void note_events(const Subject& subject, Satisfier& satisfier, const program::Rule& a, const program::Rule& b, diagnostics::Builder& message);

// The questions, each in a file of its own kind; they report in this order.
void diagnose_cells(Subject& subject);       ///< cells.cc: never set, read, seen, wanted; thresholds; `keep`
void diagnose_strategies(Subject& subject);  ///< cells.cc
void diagnose_circles(Subject& subject);     ///< circles.cc: satellites that are never raised because rules wait for each other
void diagnose_arguments(const Subject& subject, const KnownArguments& known);   ///< arguments.cc: of `control` lines
void diagnose_look_alikes(const Subject& subject);   ///< look_alikes.cc: names that a reader takes for one another
void diagnose_lasting(const Subject& subject);   ///< lasting.cc: strategies wanted for ever that stand before others
void diagnose_priority(Subject& subject);    ///< priority.cc: pairs of strategies that nothing orders
void diagnose_conditions(Subject& subject);  ///< conditions.cc: can never, or must always, fire
void diagnose_effects(Subject& subject);     ///< effects.cc: overridden, void, repeated, self-defeating
void diagnose_already_so(const Subject& subject);   ///< already_so.cc: rules that write what is so already
void diagnose_silenced(const Subject& subject);   ///< silenced.cc: rules that lose what they wait for to a `reset`
void diagnose_taken_back(const Subject& subject);   ///< taken_back.cc: rules that wait for a satellite which is lowered before they see it
void diagnose_gaps(const Subject& subject);   ///< gaps.cc: timers that miss that what they time has ended and begun again
void diagnose_conflicts(Subject& subject);   ///< conflicts.cc: can fire together and disagree
void diagnose_loose_timers(const Subject& subject);   ///< loose_timers.cc: `A and B for T` where the time may be over before A comes
void diagnose_lost_to_reset(const Subject& subject);   ///< lost_to_reset.cc: rules that follow a kept state and do not write again what a `reset` takes back
void diagnose_perception(Subject& subject);  ///< perception.cc: confusable facts, facts that are never sure
void diagnose_lazy(Subject& subject);        ///< lazy.cc: edges of lazy facts, and conditions that hold for a fact nobody has looked at
void diagnose_fuzzy(const program::Program& program, diagnostics::Diagnostics& diagnostics);   // fuzzy.cc

}  // namespace kb::analysis
