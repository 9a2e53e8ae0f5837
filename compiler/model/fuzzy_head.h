// The head of a fuzzy block: its methods, inputs and outputs, with units converted to SI and groups written out, and the
// lookup of names for its rules.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "compiler/model/draft.h"
#include "compiler/model/shapes.h"

namespace kb::model {

/// Reads the head of one block into `to_`; the reader of its rules derives from this class. A variable that could not be read
/// is still known by name, so that rules can be checked all the same. `good_` is false as soon as anything was reported.
class FuzzyHead {
 protected:
  FuzzyHead(Draft& draft, const syntax::Tree& tree, const syntax::Fuzzy& from) : draft_(draft), tree_(tree), from_(from) {}

  void read_head();

  struct Variable {
    bool output = false;
    bool broken = false;
    std::uint32_t id = 0;
    source::Span declared;
  };

  /// The input or output of that name. nullptr if it could not be read, or if there is none, which is reported; `wanted` says
  /// what a name must be here.
  const Variable* find(const syntax::Name& name, bool output, std::string_view wanted);

  /// The slot of an input, or of one of a group.
  std::optional<std::uint32_t> slot(const syntax::FuzzyRef& ref, std::string_view wanted);

  /// The term of that name of an input or output; if there is none, reports it and returns nullptr.
  template <class Of>
  auto find_term(const Of& of, const syntax::Name& name) -> decltype(of.terms.data()) {
    std::vector<std::string_view> candidates;
    for (const auto& term : of.terms) {
      if (term.name == name.text) return &term;
      candidates.push_back(term.name);
    }
    constexpr std::size_t kShown = 12;
    const std::string known = candidates.empty() ? "none" : diagnostics::listed(candidates, kShown);
    diagnostics().report(diagnostics::Kind::kFuzzyUnknownTerm, name.span, {of.name, name.text, known}).suggest(diagnostics().nearest(name.text, candidates));
    good_ = false;
    return nullptr;
  }

  /// The number in SI, as a quantity of the domain; 0 if it is none, which is reported.
  double number(const syntax::Number& from, const Domain& domain);

  diagnostics::Diagnostics& diagnostics() { return draft_.diagnostics; }
  void fail(diagnostics::Kind kind, source::Span at, std::initializer_list<std::string_view> arguments);

  Draft& draft_;
  const syntax::Tree& tree_;
  const syntax::Fuzzy& from_;
  fuzzy::Controller to_;
  std::unordered_map<std::string_view, Variable> variables_;
  std::vector<std::optional<Domain>> domains_;   // of the outputs
  bool good_ = true;

 private:
  void read_methods();
  void fail_method(const syntax::Name& word, std::string_view what, std::initializer_list<std::string_view> known);
  void declare(const syntax::Name& name, Variable variable);
  std::uint32_t read_count(const syntax::Fuzzy::Input& input);
  void read_input(const syntax::Fuzzy::Input& from);
  void add_slots(const syntax::Name& name, const fuzzy::Input& input, std::uint32_t id);
  void read_terms(const syntax::Fuzzy::Input& from, const Domain& domain, fuzzy::Input& input);
  template <class Terms>
  void check_new(std::string_view variable, const Terms& terms, const syntax::Name& name);
  void read_output(const syntax::Fuzzy::Output& from);
  void read_options(const syntax::Fuzzy::Output& from, const Domain& domain, fuzzy::Output& output);

  bool too_large_ = false;
};

}  // namespace kb::model
