// Programs by hand, by name, without the compiler's earlier phases: for tests of everything that comes after them.
//
//   ProgramBuilder b({"goal", "control"});
//   b.fact("Line");                                  // and `sat Line`
//   b.satellite("A").satellite("B").exclusive({"A", "B"});
//   b.strategy("Go");                                // and `sat Go`; strategies in order of priority
//   b.when("start", "goal", all({seen("Line"), no(high("A"))}), {raise("A"), raise("sat Go")});
//   const Program program = b.build();               // effects folded, `run[Go]` added, verified
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "compiler/program/interpret.h"
#include "compiler/program/program.h"

namespace kb::program::testing {

/// A condition by names.
struct Expression {
  Cond::Op op = Cond::Op::kAnd;
  Term term = Term::kHigh;
  std::string cell;
  std::uint32_t duration_us = 0;
  std::vector<Expression> parts;
};
Expression high(std::string cell);
Expression low(std::string cell);
Expression zero(std::string cell);
Expression seen(std::string fact);
Expression event(std::string fact);
Expression lost(std::string fact);
Expression all(std::vector<Expression> parts);
Expression any(std::vector<Expression> parts);
Expression no(Expression part);
Expression held(Expression part, std::uint32_t duration_us);

/// An effect by names, as the language writes it.
struct NamedEffect {
  std::string cell;
  float value = 0.0f;
  bool reset = false;
};
NamedEffect raise(std::string cell);
NamedEffect lower(std::string cell);
NamedEffect assign(std::string cell, float value);
NamedEffect reset_all();

class ProgramBuilder {
 public:
  /// The last level is the control level.
  explicit ProgramBuilder(std::vector<std::string> levels);

  Settings settings;  ///< to be changed before cells are declared: facts take their thresholds from it

  ProgramBuilder& fact(const std::string& name, float satellite_initial = -1.0f);
  ProgramBuilder& fact(const std::string& name, double event, double attention);
  ProgramBuilder& satellite(const std::string& name, float initial = -1.0f, bool keep = false);
  /// Also draws attention to `target`, a fact or a strategy.
  ProgramBuilder& of(const std::string& satellite, const std::string& target);
  ProgramBuilder& strategy(const std::string& name);
  ProgramBuilder& exclusive(std::vector<std::string> members);
  ProgramBuilder& when(std::string name, std::string level, Expression condition, std::vector<NamedEffect> effects);
  ProgramBuilder& while_true(std::string name, std::string level, Expression condition,
                             std::vector<NamedEffect> effects);
  /// What is idle: "stop", "hold", or a strategy.
  ProgramBuilder& idle(const std::string& policy);

  /// The program. Throws std::logic_error if it is not sound (a name that does not exist, a fault of `verify`).
  [[nodiscard]] Program build() const;

 private:
  struct NamedCell {
    Cell cell;
    std::vector<std::string> satellites;
  };
  struct NamedRule {
    std::string name, level;
    Mode mode;
    Expression condition;
    std::vector<NamedEffect> effects;
  };
  struct Building;
  NamedCell& declare(const std::string& name, CellKind kind, float initial);

  std::shared_ptr<source::Texts> texts_ = std::make_shared<source::Texts>();
  std::vector<std::string> levels_;
  std::vector<NamedCell> facts_, satellites_, strategies_;
  std::vector<std::vector<std::string>> exclusive_;
  std::vector<NamedRule> rules_;
  std::string idle_ = "stop";
};

/// A cell or rule by name; throws std::logic_error if there is none.
[[nodiscard]] CellId cell(const Program& program, const std::string& name);
[[nodiscard]] RuleId rule(const Program& program, const std::string& name);
/// The facts of a tick, by name; the others are 0.
[[nodiscard]] std::vector<float> facts(const Program& program, const std::map<std::string, float>& values);
/// Names of what a tick did.
[[nodiscard]] std::vector<std::string> names(const Program& program, const std::vector<RuleId>& rules);
[[nodiscard]] std::vector<std::string> names(const Program& program, const std::vector<CellId>& cells);

/// An interpreter that is spoken to by names.
class Trial {
 public:
  explicit Trial(Program program) : program_(std::move(program)), interpreter_(program_) {}
  Trial(const Trial&) = delete;
  /// 100 ms after the last tick unless told otherwise.
  Tick operator()(const std::map<std::string, float>& values = {}, std::uint32_t dt_us = 100'000) {
    return interpreter_.tick(facts(program_, values), dt_us);
  }
  [[nodiscard]] float value(const std::string& name) const { return interpreter_.value(cell(program_, name)); }
  [[nodiscard]] std::vector<std::string> fired(const std::map<std::string, float>& values = {},
                                               std::uint32_t dt_us = 100'000) {
    return names(program_, (*this)(values, dt_us).fired);
  }
  [[nodiscard]] Interpreter& interpreter() { return interpreter_; }
  [[nodiscard]] const Program& program() const { return program_; }

 private:
  Program program_;
  Interpreter interpreter_;
};

}  // namespace kb::program::testing
