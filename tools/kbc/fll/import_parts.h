// What import.cc takes apart. Private to this folder.
#pragma once

#include "tools/kbc/fll/fll.h"

namespace kb::fll {

/// An FLL engine as read, its lines kept for messages.
struct Term {
  std::string name;                 ///< as it stands in FLL
  std::string kb;                   ///< in the language
  std::string kind;                 ///< "Triangle"
  std::vector<double> numbers;
  Line line;
};
struct Variable {
  bool output = false;
  std::string name;                 ///< as it stands in FLL
  std::string kb;                   ///< in the language
  Line line;
  std::optional<double> low, high;
  bool lock_range = false;
  bool range_told = false;          ///< inputs: a line says whether it is locked
  std::string defuzzifier;          ///< outputs: "WeightedAverage", "WeightedSum"
  std::optional<double> fallback;
  std::vector<Term> terms;
};
struct Block {
  std::string conjunction, disjunction;   ///< "min", "product"; "max", "sum"; empty: none
  std::vector<Line> rules;
};
struct Engine {
  std::string name;
  Line line;                        ///< the begin of the file if nothing names it
  std::vector<Variable> variables;
  std::vector<Block> blocks;
};

/// Reads lines into an engine; reports what it cannot take.
class Reader {
 public:
  Reader(const source::Sources& sources, source::FileId file, diagnostics::Diagnostics& diagnostics);
  [[nodiscard]] Engine run();
  [[nodiscard]] bool good() const { return good_; }
  /// The first line is none of FLL: nothing else was read.
  [[nodiscard]] bool foreign() const { return !good_ && !begun_; }

 private:
  [[nodiscard]] std::optional<Line> next_line();
  void take(const Line& line);
  void take_input(Variable& variable, const Line& line);
  void take_output(Variable& variable, const Line& line);
  void take_block(Block& block, const Line& line);
  void take_term(Variable& variable, const Line& line);
  void take_range(Variable& variable, const Line& line);
  void refuse(const Line& line, std::string_view why);
  void adapt(const Line& line, std::string_view how);
  template <typename All>
  [[nodiscard]] std::string name_beside(const All& others, const Line& line, std::string_view text);
  [[nodiscard]] std::optional<double> number_of(const Line& line, std::string_view text);
  [[nodiscard]] bool boolean(const Line& line);

  const source::Sources& sources_;
  source::FileId file_;
  diagnostics::Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  enum class Section : std::uint8_t { kNone, kEngine, kVariable, kBlock } section_ = Section::kNone;
  Engine engine_;
  bool good_ = true, begun_ = false;
};

/// A number as FLL writes it, all of `text`.
[[nodiscard]] std::optional<double> number(std::string_view text);
/// `text` as a name of the language, and no word of it: what cannot stand in one becomes `_`.
[[nodiscard]] std::string kb_name(std::string_view text);

}  // namespace kb::fll
