// The program: core rules over cells. This is what the engine does, and nothing else; it can be printed, verified and
// interpreted (interpret.h is the oracle that tables and emitted code are held against).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/fuzzy/controller.h"
#include "compiler/program/perception.h"
#include "compiler/source/kinds.h"
#include "compiler/source/source.h"
#include "compiler/source/texts.h"

namespace kb::model {
struct Model;
}

namespace kb::program {

enum class CellId : std::uint32_t { kNone = 0xFFFFFFFFu };
enum class RuleId : std::uint32_t { kNone = 0xFFFFFFFFu };
enum class CondId : std::uint32_t { kNone = 0xFFFFFFFFu };

template <class Id>
[[nodiscard]] constexpr std::size_t index(Id id) {
  return static_cast<std::size_t>(id);
}

using kb::CellKind;
using kb::Idle;
using kb::Term;
enum class Mode : std::uint8_t { kWhen, kWhile };

/// Cells are ordered: all facts, then all satellites, then all strategies.
struct Cell {
  std::string_view name;           ///< in `Program::texts`
  CellKind kind = CellKind::kFact;
  float initial = 0.0f;
  double event = 0.0, attention = 0.0;  ///< facts, as written
  bool command = false;
  bool keep = false;               ///< satellites
  bool output = false;             ///< satellites: the host program reads it
  source::Few<CellId, 2> satellites;  ///< facts and strategies: those that draw attention to it
  source::Span declared;
};

struct Settings {
  double event = 0.75, attention = 0.25, firing = 0.5;
  Idle idle = Idle::kStop;
  CellId idle_strategy = CellId::kNone;
  std::uint32_t hold_limit_us = 5'000'000;
};

/// `and` of none is true, `or` of none is false. Children always have smaller ids than their parent, so a loop over the
/// ids evaluates them all; equal conditions are one node (conditions.h).
struct Cond {
  enum class Op : std::uint8_t { kAnd, kOr, kNot, kFor, kEvent, kLost, kSeen, kIs };
  Op op = Op::kAnd;
  Term term = Term::kHigh;
  CellId cell = CellId::kNone;
  std::uint32_t duration_us = 0;
  source::Few<CondId, 4> children;
};

struct Write {
  CellId cell = CellId::kNone;
  float value = 0.0f;
  friend bool operator==(const Write&, const Write&) = default;
};

/// note [net effects]
/// The effects of a rule, in order, folded to what they leave behind. A cell gets its value in `writes`, if it is there; else -1,
/// if it is a member of a group in `clears`; else its initial value, if `reset` is set and it is a satellite not declared `keep`;
/// else it is not written. The effects are kept folded because a route of 10,000 legs has as many rules that each write one leg
/// and silence all others. `for_each_net_write` (net_effects.h) expands them.
struct Rule {
  std::string_view name;              ///< in `Program::texts`
  source::Few<Write, 2> writes;       ///< net values of single cells: each cell once, ascending; see note [net effects]
  source::Few<std::uint32_t, 1> clears;  ///< exclusive groups whose other members become -1; indexes, ascending
  source::Span span;                  ///< unknown for generated rules
  std::uint32_t place = 0;            ///< index into `Program::places`
  std::uint32_t level = 0;
  CondId condition = CondId::kNone;
  Mode mode = Mode::kWhen;
  bool reset = false;                 ///< every other satellite not declared `keep` takes its initial value
  bool standard = false;              ///< from the standard library

  /// The rule as written: `enter` for `enter[right,mark]`, `run` for generated ones.
  [[nodiscard]] std::string_view tmpl() const { return name.substr(0, name.find('[')); }
};

struct Control {
  struct Argument {
    std::string name;
    double number = 0.0;
    std::string unit;
    std::string word;
    bool is_number = false;
    source::Span span;
    [[nodiscard]] source::Span name_span() const { return {span.file, span.begin, span.begin + static_cast<std::uint32_t>(name.size())}; }
    [[nodiscard]] source::Span word_span() const { return {span.file, span.end - static_cast<std::uint32_t>(word.size()), span.end}; }
  };
  CellId strategy = CellId::kNone;
  std::string controller;
  std::vector<Argument> arguments;
  std::uint32_t fuzzy = fuzzy::kNone;   ///< the fuzzy controller that it names, if it names one
  source::Span span;              ///< where the strategy stands
  source::Span controller_span;
};

/// A timer that a rule's condition, or that of a row in it, has as a part of an `and`, without parentheses: see note [loose timers] in compiler/model/model.h.
struct LooseTimer {
  RuleId rule = RuleId::kNone;
  CondId timer = CondId::kNone;
  std::vector<CondId> beside;   ///< the other parts of the `and`
  source::Span at;              ///< `for 300 ms`
};

/// How fast the robot may drive while the satellite of a leg is high.
struct LegLimit {
  CellId leg = CellId::kNone;
  float limit_m_per_s = 0.0f;
};

struct Program {
  std::shared_ptr<source::Texts> texts = std::make_shared<source::Texts>();   ///< names of cells and rules; in a lowered program, those of the model
  Settings settings;
  std::vector<Cell> cells;
  std::uint32_t facts = 0, satellites = 0, strategies = 0;  ///< how many of each
  std::vector<std::vector<CellId>>
      exclusive;  ///< each ascending, facts only or satellites only; a cell is in at most one
  std::vector<std::string> levels;
  std::vector<CellId> priority;  ///< every strategy, the highest first
  std::vector<Cond> conds;
  std::vector<Rule> rules;  ///< ordered by level, within a level as declared; the generated `run[...]` last
  std::vector<std::string> places;  ///< source places of rules, each once: "file:line:col"; "priority" for generated ones
  std::vector<Control> controls;
  std::vector<LegLimit> limits;           ///< of the legs whose road has one
  std::vector<LooseTimer> loose_timers;   ///< ascending by rule; only a program that comes from its text has them
  Perception perception;
  std::vector<fuzzy::Controller> fuzzy;   ///< in order of declaration

  [[nodiscard]] const Cell& operator[](CellId id) const { return cells[index(id)]; }
  [[nodiscard]] const Rule& operator[](RuleId id) const { return rules[index(id)]; }
  [[nodiscard]] const Cond& operator[](CondId id) const { return conds[index(id)]; }
  /// The index of the first strategy among the cells.
  [[nodiscard]] std::uint32_t first_strategy() const { return facts + satellites; }
  [[nodiscard]] std::span<const Cell> cells_of(CellKind kind) const {
    const std::span all(cells);
    return kind == CellKind::kFact        ? all.first(facts)
           : kind == CellKind::kSatellite ? all.subspan(facts, satellites)
                                          : all.subspan(first_strategy());
  }
  [[nodiscard]] const std::string& at(const Rule& rule) const { return places[rule.place]; }
  /// The index of a place; a new one is added unless it equals that of the rule before.
  [[nodiscard]] std::uint32_t place(std::string text) {
    if (places.empty() || places.back() != text) places.push_back(std::move(text));
    return static_cast<std::uint32_t>(places.size() - 1);
  }
};

/// The indexes of a level's rules. O(log rules).
struct RuleRange {
  std::uint32_t begin = 0, end = 0;
};
[[nodiscard]] RuleRange rules_of(const Program& program, std::uint32_t level);

/// The thresholds of a fact as the engine compares them: computed in double from the written numbers and rounded to float
/// once. A fact is newly seen above `plain` (`attended` if a satellite of it is high) and stays seen above `attended`.
struct Thresholds {
  float plain = 0.0f, attended = 0.0f;
};
[[nodiscard]] Thresholds thresholds(const Cell& fact);

/// Whether a cell of value `x` is as the term says. Every strength of a term is one of these numbers against `firing`.
[[nodiscard]] constexpr bool holds(Term term, float x, float firing) {
  switch (term) {
    case Term::kHigh: return x >= firing;
    case Term::kLow: return x <= -firing;
    case Term::kZero: return 1.0f - (x < 0.0f ? -x : x) >= firing;
  }
  return false;
}

/// The model as core rules: net effects, exclusive groups, `reset`, the control level's `run[...]` rules (paper rule
/// (19)). Nothing is reported: a model without errors has a program.
[[nodiscard]] Program lower(const model::Model& model, const source::Sources& sources);

/// By cell of the model: its cell in the program.
[[nodiscard]] std::vector<CellId> cell_order(const model::Model& model);

/// Cells that stand beside each other.
struct CellRun { CellId first{}; std::uint32_t count = 0; };
/// The facts of the landmarks of all maps, ascending, each once. A landmark may have none. O(n log n).
[[nodiscard]] std::vector<CellRun> landmark_runs(const model::Model& model);

/// Checks what must hold of every program, whoever made it: one sentence for each fault, which is a bug of the compiler.
[[nodiscard]] std::vector<std::string> verify(const Program& program);

/// Which rules of a program to print; an empty field lets all pass.
struct Filter {
  std::string_view rule;  ///< full name, or the name of the rule as written: `enter[right,mark]`, `enter`
  std::string_view level;
};
/// The rules that pass, in the program's order.
[[nodiscard]] std::vector<RuleId> select(const Program& program, const Filter& filter);
/// Takes the printed text piece by piece. Printing expands what the program keeps folded (see note [net effects], and `any Leg`, one
/// condition for all rules), which is gigabytes for a route of 10,000 legs.
using Sink = std::function<void(std::string_view)>;
/// The whole program in the language's own words: settings, levels, cells, then the rules; stable.
void print(const Program& program, const Sink& sink);
[[nodiscard]] std::string print(const Program& program);
/// Some rules in the language's own words, three lines each: name and place, condition, net effects.
void print(const Program& program, const std::vector<RuleId>& rules, const Sink& sink);
/// How a fact is perceived, on a line.
[[nodiscard]] std::string print(const Program& program, const Perceived& perceived);
/// The documented JSON form (docs/program_json.md).
void print_json(const Program& program, const Sink& sink);
[[nodiscard]] std::string print_json(const Program& program);
/// One condition in the language's own words.
[[nodiscard]] std::string print_condition(const Program& program, CondId condition);

}  // namespace kb::program
