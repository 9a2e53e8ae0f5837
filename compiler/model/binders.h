// Variables: what `[l in Landmark, d in Direction]` ranges over, for rules and for what is perceived.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "compiler/model/references.h"

namespace kb::model {

/// The values of one variable, and how instances are named after them. Rows are looked up on use, as there may be millions.
class Range {
 public:
  explicit Range(const Model& model) : model_(&model) {}
  void add(Operand value, std::string_view name) {
    values_.push_back(std::move(value));
    names_.push_back(name);
  }
  void add_rows_of(RelationId relation) { relation_ = relation; }

  [[nodiscard]] std::size_t size() const { return relation_ == RelationId::kNone ? values_.size() : rows().size(); }
  [[nodiscard]] Operand value(std::size_t i) const {
    return relation_ == RelationId::kNone ? values_[i] : Operand::of(rows()[i]);
  }
  [[nodiscard]] std::string_view name(std::size_t i) const {
    return relation_ == RelationId::kNone ? names_[i] : std::string_view((*model_)[rows()[i]].name);
  }

 private:
  [[nodiscard]] const std::vector<RowId>& rows() const { return (*model_)[relation_].rows; }

  const Model* model_;
  RelationId relation_ = RelationId::kNone;
  std::vector<Operand> values_;
  std::vector<std::string_view> names_;
};

/// Looks up what the variables range over: a relation's rows, a group's cells, or a set's members; the members of a group
/// over one set stand for its cells too. False if anything was reported.
bool read_binders(Draft& draft, const std::vector<syntax::Rule::Binder>& written, std::vector<Binder>& binders,
                  std::vector<Range>& ranges);

/// How many combinations of values there are. Nothing if there are too many, which is reported for `owner`.
[[nodiscard]] std::optional<std::size_t> combinations(Draft& draft, const std::vector<Range>& ranges, syntax::Name owner);

}  // namespace kb::model
