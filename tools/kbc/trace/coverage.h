// Which parts of a knowledge base a set of runs has exercised, and which not.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiler/model/model.h"
#include "compiler/program/interpret.h"
#include "compiler/program/program.h"
#include "compiler/program/tick.h"

namespace kb::trace {

/// Counts over any number of runs of one program. Runs are driven by the interpreter, which it observes:
///
///   interpreter.observe(&coverage);
///   coverage.begin_run();
///   for (each row) { coverage.before(interpreter); coverage.after(interpreter.tick(row.facts, row.dt_us),
///   interpreter); }
class Coverage final : public program::Interpreter::Observer {
 public:
  struct Rule {
    std::uint64_t fired = 0, held = 0;
  };  ///< ticks: it fired; its condition was true
  struct Fact {
    std::uint64_t attended = 0, unattended = 0, seen = 0;
  };  ///< events with a satellite high, without; ticks in view
  struct Strategy {
    std::uint64_t starts = 0, ticks = 0;
  };

  /// `program` must outlive it.
  explicit Coverage(const program::Program& program);

  void begin_run();
  void before(const program::Interpreter& interpreter);
  void level_evaluated(const program::Interpreter& interpreter, std::uint32_t level) override;
  void after(const program::Tick& tick, const program::Interpreter& interpreter);
  /// Adds the counts of another one of the same program.
  void add(const Coverage& other);

  [[nodiscard]] std::uint64_t runs() const { return runs_; }
  [[nodiscard]] std::uint64_t ticks() const { return ticks_; }
  [[nodiscard]] const Rule& rule(program::RuleId id) const { return rules_[index(id)]; }
  [[nodiscard]] const Fact& fact(program::CellId id) const { return facts_[index(id)]; }
  /// How often a rule raised a satellite (made it high when it was not).
  [[nodiscard]] std::uint64_t raised(program::CellId satellite) const { return raised_[index(satellite)]; }
  [[nodiscard]] const Strategy& strategy(program::CellId id) const { return strategies_[index(id)]; }

 private:
  void count_raised(const program::Interpreter& interpreter);

  const program::Program& program_;
  std::vector<Rule> rules_;
  std::vector<Fact> facts_;
  std::vector<std::uint64_t> raised_;  // by cell
  std::vector<Strategy> strategies_;   // by cell
  std::vector<bool> attended_;         // by fact, at the beginning of the tick
  std::vector<bool> high_;             // by cell: as the last level left it
  program::CellId last_strategy_ = program::CellId::kNone;
  std::uint64_t runs_ = 0, ticks_ = 0;
};

/// The counts, grouped for reports.
struct CoverageReport {
  struct Instance {
    std::string name;
    std::uint64_t fired = 0, held = 0;
  };
  struct Template {
    std::string name, at, level;
    std::uint64_t fired = 0;  ///< firings of all instances
    std::size_t fired_instances = 0, held_instances = 0;
    std::vector<Instance> instances;
    bool library = false;     ///< from the standard library
    bool dead = false;        ///< the analysis knows that it can never fire
    [[nodiscard]] bool covered() const { return fired > 0; }
  };
  struct Sight {
    std::string name;
    std::uint64_t attended = 0, unattended = 0, seen = 0;
    bool landmark = false;
    bool library = false;
    [[nodiscard]] bool covered() const { return seen > 0; }
  };
  struct Raised {
    std::string name;
    std::uint64_t raised = 0;
    bool initially = false;
    bool library = false;
    [[nodiscard]] bool covered() const { return raised > 0 || initially; }
  };
  struct Ran {
    std::string name;
    std::uint64_t starts = 0, ticks = 0;
    bool library = false;
    [[nodiscard]] bool covered() const { return ticks > 0; }
  };
  std::string program;  ///< path of the knowledge base
  std::uint64_t runs = 0, ticks = 0;
  std::vector<Template> templates;  ///< by level, then as declared
  std::vector<Sight> facts;
  std::vector<Raised> satellites;  ///< those that some rule raises
  std::vector<Ran> strategies;
  std::string library;  ///< what was exercised of the standard library, in words, if `without_library` left it out
};

/// What a report is made of. All must outlive the call.
struct Covered {
  const source::Sources& sources;
  const model::Model& model;         ///< its maps say what is a landmark
  const program::Program& program;
  const std::vector<bool>& dead;     ///< by rule: it can never fire; empty if that is not known
};

/// `path` is the name of the knowledge base.
[[nodiscard]] CoverageReport summarise(std::string path, const Covered& covered, const Coverage& coverage);
/// The report without what the standard library declares, which is counted in a sentence.
[[nodiscard]] CoverageReport without_library(CoverageReport report);

/// One statement a line; things not exercised are listed by name.
[[nodiscard]] std::string print_text(const CoverageReport& report);
/// One object for each report, in an array.
[[nodiscard]] std::string print_json(const std::vector<CoverageReport>& reports);
/// A page that needs nothing else: no scripts, no network. States are shown by words and signs, not by colour alone.
[[nodiscard]] std::string print_html(const std::vector<CoverageReport>& reports);

}  // namespace kb::trace
