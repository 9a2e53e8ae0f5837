// Conditions, read in two steps as references are (references.h).
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "compiler/model/references.h"

namespace kb::model {

class Conditions {
 public:
  Conditions(Draft& draft, const syntax::Tree& tree, References& references)
      : draft_(draft), tree_(tree), references_(references) {}
  /// The condition is about one road, whose exit it may name `exit`: of a group over exits that one is probably meant.
  void of_road() { of_road_ = true; }

  /// The compiled form of a condition; parts that are the same in all instances are resolved here, once.
  std::uint32_t compile(syntax::CondId cond) { return compile(cond, {}); }
  /// The condition of one instance, added to the model's. Recursion is bounded by the nesting of the source.
  Outcome evaluate(std::uint32_t pattern, Environment values, CondId& made);

 private:
  struct Pattern {
    enum class Op : std::uint8_t { kConstant, kBroken, kAnd, kOr, kNot, kFor, kEvent, kIs, kAny };
    Op op = Op::kBroken;
    Cond::Op event = Cond::Op::kIs;            ///< kEvent: which of the three; kAny: or none of them
    syntax::Term term = syntax::Term::kHigh;   ///< kIs
    bool sat = false;                          ///< kIs, kAny
    bool plain = false;                        ///< kIs: neither `is` nor `sat`
    bool same = false;                         ///< the same in all instances
    std::uint8_t nesting = 0;                  ///< in how many others it stands, at most syntax::kMaxNesting
    source::Span loose;                        ///< kFor: its time, if it is loose: see note [loose timers]
    std::uint32_t duration_us = 0;
    std::uint32_t ref = 0;
    CondId constant{};
    std::vector<std::uint32_t> children;
  };

  std::uint32_t add(Pattern pattern);
  std::uint32_t compile(syntax::CondId cond, source::Span loose);
  [[nodiscard]] source::Span loose_time(const syntax::Cond& around, syntax::CondId part);
  bool read_term(const syntax::Cond& cond, Pattern& pattern);
  void report_term(const syntax::Cond& cond, std::uint32_t ref);
  Pattern read(const syntax::Cond& cond);
  bool check_row(const Pattern& pattern);
  void read_children(const syntax::Cond& cond, Pattern& pattern);
  Outcome evaluate_event(const Pattern& pattern, Environment values, CondId& made);
  Outcome evaluate_is(const Pattern& pattern, Environment values, CondId& made);
  Outcome evaluate_any(const Pattern& pattern, Environment values, CondId& made);
  [[nodiscard]] std::string all_of(const std::vector<CellId>& cells, bool sat) const;
  [[nodiscard]] bool all_facts(const std::vector<CellId>& cells) const;
  Outcome report_non_fact(const Pattern& pattern, const Operand& operand);
  Outcome report_many(const Pattern& pattern, const Operand& operand);
  Outcome satellites_of(const Pattern& pattern, CellId cell, std::vector<CellId>& out);
  CondId ask(Cond::Op op, CellId cell, syntax::Term term = syntax::Term::kHigh);
  CondId ask_any(Cond::Op op, const std::vector<CellId>& cells, syntax::Term term = syntax::Term::kHigh);
  CondId negate(CondId part);

  Draft& draft_;
  const syntax::Tree& tree_;
  References& references_;
  bool of_road_ = false;
  std::uint32_t nesting_ = 0;
  std::vector<Pattern> patterns_;
};

/// The most parts of a row's condition, with all that it asks of fields of other rows written out: see note [written out].
inline constexpr std::uint32_t kMostWrittenOut = 4'096;
/// Reports that `asked`, a field of a row, has more parts, or nests too deep where it is asked for.
void report_written_out(Draft& draft, source::Span at, std::string_view asked);

/// A new condition of the model.
CondId add_cond(Model& model, Cond cond);
/// `cell is term`
CondId is_cond(Model& model, CellId cell, syntax::Term term = syntax::Term::kHigh);
CondId not_cond(Model& model, CondId cond);
/// The `and` or `or` of several; a single one is returned as it is.
CondId join_conds(Model& model, Cond::Op op, std::vector<CondId> conds);

}  // namespace kb::model
