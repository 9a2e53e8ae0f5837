// What facts are defined by: readings that are like something, other facts, `and`, `or`, `not`.
#pragma once

#include <string_view>
#include <vector>

#include "compiler/model/binders.h"
#include "compiler/model/conditions.h"

namespace kb::model {

/// Reads definitions of one statement. With variables: once for each combination of their values.
class Percepts {
 public:
  Percepts(Draft& draft, const syntax::Tree& tree, References& references, std::vector<Binder>& binders)
      : draft_(draft), tree_(tree), references_(references), binders_(binders) {}

  /// The definition when the variables have these values and names; added to the model, parts before the whole.
  /// Recurses as deep as definitions nest, which the parser limits.
  Outcome read(syntax::PerceptId id, Environment values, const std::vector<std::string_view>& names, PerceptId& made);

 private:
  /// Where an element of a sensor is named.
  struct Element { std::uint32_t sensor = 0, reading = 0; };

  Outcome read(syntax::PerceptId id, PerceptId& made);
  Outcome put(Percept percept, PerceptId& made);
  Outcome read_several(const syntax::Percept& from, Percept::Op op, PerceptId& made);
  Outcome read_fact(const syntax::Percept& from, PerceptId& made);
  Outcome read_named(const syntax::Percept& from, PerceptId& made);
  Outcome read_fits(const syntax::Percept& from, const syntax::Shape& shape, std::string text, PerceptId& made);
  Outcome read_text(const syntax::Percept& from, std::string_view text, PerceptId& made);
  [[nodiscard]] std::optional<std::size_t> variable(std::string_view name) const;
  [[nodiscard]] std::string_view text(source::Span span) const { return draft_.diagnostics.sources().text(span); }
  std::optional<Element> element(syntax::RefId id);
  std::optional<std::uint32_t> index_of(const syntax::Ref& ref, const Sensor& sensor);
  std::uint32_t place(const fuzzy::Shape& shape, std::string text);

  Draft& draft_;
  const syntax::Tree& tree_;
  References& references_;
  std::vector<Binder>& binders_;
  Environment values_;
  std::vector<std::string_view> names_;
};

}  // namespace kb::model
