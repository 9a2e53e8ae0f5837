// The parts that import.cc reads. Private to this folder.
#pragma once

#include <map>
#include <set>
#include <utility>

#include "tools/kbc/fll/fll.h"

namespace kb::fll {

/// Things in the order of the file, found by `name`; of several with one name, only the first is found.
template <typename One>
class Named {
 public:
  [[nodiscard]] auto begin() const { return all_.begin(); }
  [[nodiscard]] auto end() const { return all_.end(); }
  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] bool empty() const { return all_.empty(); }
  [[nodiscard]] One& back() { return all_.back(); }
  /// Null if there is none. O(log size).
  [[nodiscard]] const One* find(std::string_view name) const {
    const auto found = places_.find(name);
    return found == places_.end() ? nullptr : &all_[found->second];
  }
  /// Whether something has this name in the language.
  [[nodiscard]] bool has_kb(const std::string& kb) const { return kb_names_.contains(kb); }
  void add(One one) {
    places_.try_emplace(one.name, all_.size());
    kb_names_.insert(one.kb);
    all_.push_back(std::move(one));
  }

 private:
  std::vector<One> all_;
  std::map<std::string, std::size_t, std::less<>> places_;
  std::set<std::string> kb_names_;
};

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
  std::string_view description;
  std::optional<double> low, high;
  bool lock_range = false;
  bool range_told = false;          ///< inputs: a line says whether it is locked
  std::string defuzzifier;          ///< outputs: "WeightedAverage", "WeightedSum"
  std::optional<double> fallback;
  Named<Term> terms;
};
struct Block {
  std::string_view description;
  std::string conjunction, disjunction;   ///< "min", "product"; "max", "sum"; empty: none
  std::vector<Line> rules;
};
struct Engine {
  std::string name;
  Line line;                        ///< the beginning of the file if no line names it
  std::string_view description;
  Named<Variable> variables;
  std::vector<Block> blocks;
};

/// Reads lines into an engine; reports what it cannot convert.
class Reader {
 public:
  Reader(const source::Sources& sources, source::FileId file, diagnostics::Diagnostics& diagnostics);
  [[nodiscard]] Engine run();
  [[nodiscard]] bool good() const { return good_; }
  /// Whether the first line is not FLL; then nothing else was read.
  [[nodiscard]] bool foreign() const { return !good_ && !begun_; }

 private:
  [[nodiscard]] std::optional<Line> next_line();
  void take(const Line& line);
  void take_description(std::string_view text);
  void take_input(Variable& variable, const Line& line);
  void take_output(Variable& variable, const Line& line);
  void take_block(Block& block, const Line& line);
  void take_term(Variable& variable, const Line& line);
  void take_range(Variable& variable, const Line& line);
  void refuse(const Line& line, std::string_view why);
  void adapt(const Line& line, std::string_view how);
  template <typename One>
  [[nodiscard]] std::string name_beside(const Named<One>& others, const Line& line, std::string_view text);
  [[nodiscard]] std::optional<double> number_of(const Line& line, std::string_view text);
  [[nodiscard]] bool boolean(const Line& line);
  struct Norm { std::string_view fll, kb; };
  [[nodiscard]] std::string norm(const Line& line, std::string_view word, const Norm& one, const Norm& other);

  const source::Sources& sources_;
  source::FileId file_;
  diagnostics::Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  enum class Section : std::uint8_t { kNone, kEngine, kVariable, kBlock } section_ = Section::kNone;
  std::set<std::string_view> told_;   ///< the keys of this variable or block, except those that may stand in it several times
  Engine engine_;
  bool good_ = true, begun_ = false;
};

/// A number as FLL writes it, all of `text`.
[[nodiscard]] std::optional<double> number(std::string_view text);
/// `text` as a name of the language that is no word of it; characters that cannot stand in a name become `_`.
[[nodiscard]] std::string kb_name(std::string_view text);

}  // namespace kb::fll
