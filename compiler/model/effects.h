// Effects, read in two steps as references are (references.h).
#pragma once

#include <vector>

#include "compiler/model/conditions.h"

namespace kb::model {

class Effects {
 public:
  using Writes = decltype(Rule::effects);

  Effects(Draft& draft, References& references) : draft_(draft), references_(references) {}

  /// False if some effect makes no sense in any instance, which is reported.
  bool compile(const std::vector<syntax::Effect>& effects);
  /// The writes of one instance, in order.
  Outcome evaluate(Environment values, Writes& writes);

 private:
  struct Pattern {
    bool reset = false;
    bool sat = false;
    float value = 0.0f;
    std::uint32_t ref = 0;
    source::Span span;
  };
  bool check_row(const Pattern& pattern);
  Outcome evaluate_one(const Pattern& pattern, Environment values, Writes& writes);
  /// False after a message if an effect as written, `sat` or not, cannot write such a cell. `text` is what the message calls it.
  bool may_write(const Pattern& pattern, CellId cell, std::string_view text);
  void report_unwritable(const Pattern& pattern, const Cell& cell, std::string_view text);
  Outcome write(const Pattern& pattern, CellId cell, Writes& writes);

  Draft& draft_;
  References& references_;
  std::vector<Pattern> patterns_;
};

}  // namespace kb::model
