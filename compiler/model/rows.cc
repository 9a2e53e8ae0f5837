// `row [name] in R(field: value, ...)`: rows written out.
#include <fmt/format.h>

#include "compiler/model/field_reads.h"
#include "compiler/model/references.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

class RowReader {
 public:
  RowReader(Draft& draft, const syntax::Tree& tree, const syntax::Row& row)
      : draft_(draft), tree_(tree), from_(row), references_(draft, tree, binders_) {}

  void run() {
    const auto relation = find_relation(draft_, from_.relation.text);
    if (!relation) return report_unknown();
    const std::string name = from_.name ? std::string(from_.name->text)
                                        : fmt::format("{}.{}", from_.relation.text, draft_.model[*relation].rows.size());
    const Entity entity{Entity::Kind::kRow, static_cast<std::uint32_t>(draft_.model.rows.size()), {}};
    if (from_.name && !draft_.names.declare(*from_.name, entity, draft_.diagnostics)) return;
    row_ = add_row(draft_, *relation, name, from_.name ? from_.name->span : from_.relation.span);
  }

  /// To be called when all rows have names, so that rows may refer to each other. Fields that say what fields of other rows say are left for
  /// `fill(field)`: `later` gets their places.
  void fill(std::vector<std::pair<RowReader*, const syntax::Row::Field*>>& later) {
    if (row_ == RowId::kNone) return;
    const Relation& relation = draft_.model[draft_.model[row_].relation];
    std::vector<bool> given(relation.fields.size(), false);
    for (const syntax::Row::Field& field : from_.fields) {
      const auto place = find_field(relation, field.name.text);
      if (!place) {
        report_unknown_field(draft_, relation, field.name);
      } else if (given[*place]) {
        draft_.diagnostics.report(Kind::kFieldTwice, field.name.span, {field.name.text, draft_.model[row_].name});
      } else {
        given[*place] = true;
        draft_.field_spans.emplace(field_key(row_, *place), tree_[field.value].span);
        if (reads(field).empty()) set_field(draft_, row_, *place, value_of(field));
        else later.emplace_back(this, &field);
      }
    }
  }
  void fill(const syntax::Row::Field& field) { set_field(draft_, row_, field.name.text, value_of(field)); }
  void report_circle(const syntax::Row::Field& field) {
    draft_.diagnostics.report(Kind::kRowCircle, tree_[field.value].span, {field.name.text, draft_.model[row_].name});
  }
  /// The fields of rows that a bare reference reads, as far as they are known. What a condition reads does not matter before it is resolved.
  [[nodiscard]] std::vector<FieldPlace> reads(const syntax::Row::Field& field) const {
    return bare(field) ? fields_read(draft_, tree_, tree_[field.value].ref) : std::vector<FieldPlace>();
  }
  [[nodiscard]] std::uint64_t key(const syntax::Row::Field& field) const {
    return field_key(row_, *find_field(draft_.model[draft_.model[row_].relation], field.name.text));
  }

 private:
  [[nodiscard]] bool bare(const syntax::Row::Field& field) const {
    const syntax::Cond& cond = tree_[field.value];
    return cond.kind == syntax::Cond::Kind::kIs && !cond.sat && !cond.negated && cond.term.text.empty();
  }
  void report_unknown() {
    const Entity* entity = draft_.names.find(from_.relation.text);
    if (entity != nullptr && entity->kind == Entity::Kind::kBroken) return;
    model::report_unknown(draft_, Kind::kUnknownRelation, from_.relation, draft_.names.nearest(from_.relation.text, Entity::Kind::kRelation, draft_.diagnostics));
  }

  /// A bare reference has the value that it stands for; anything else is a condition, which is kept.
  Value value_of(const syntax::Row::Field& field) {
    if (!bare(field)) return keep(field);
    const syntax::Cond& cond = tree_[field.value];
    for (const auto& [row, place] : reads(field)) {
      if (std::holds_alternative<KeptId>(draft_.model.fields(draft_.model[row])[place])) return keep(field);   // which is not yet resolved
    }
    const syntax::Ref& ref = tree_[cond.ref];
    if (ref.postfixes.empty() && draft_.names.find(ref.base.text) == nullptr) {
      if (const auto member = draft_.member_anywhere(ref.base.text)) return *member;
    }
    const Operand operand = references_.evaluate(references_.compile(cond.ref), {});
    switch (operand.kind) {
      case Operand::Kind::kMember: return operand.member;
      case Operand::Kind::kCell: return operand.cell;
      case Operand::Kind::kRow: return operand.row;
      case Operand::Kind::kBroken:
      case Operand::Kind::kMissing: return {};
      default: return keep(field);
    }
  }

  Value keep(const syntax::Row::Field& field) {
    draft_.kept.push_back({row_, field.name.text, kNone32});
    KeptCondition kept;
    kept.tree = &tree_;
    kept.condition = field.value;
    return add_kept(draft_.model, kept);
  }

  Draft& draft_;
  const syntax::Tree& tree_;
  const syntax::Row& from_;
  std::vector<Binder> binders_;
  References references_;
  RowId row_ = RowId::kNone;
};

/// Whether the rows would have too many fields; found out before memory is taken for them.
bool too_many_rows(Draft& draft) {
  std::size_t values = 0;
  bool too_many = false;
  draft.each<syntax::Row>([&](const auto&, const auto&, const syntax::Row& row) {
    const auto relation = find_relation(draft, row.relation.text);
    if (!relation || too_many) return;
    values += draft.model[*relation].fields.size();
    too_many = too_many_values(draft, values, draft.model[*relation], row.relation.span);
  });
  return too_many;
}

}  // namespace

void write_rows(Draft& draft) {
  if (too_many_rows(draft)) return;
  std::vector<std::unique_ptr<RowReader>> readers;
  draft.each<syntax::Row>([&](const syntax::Tree& tree, const auto&, const syntax::Row& row) {
    readers.push_back(std::make_unique<RowReader>(draft, tree, row));
    readers.back()->run();
  });
  std::vector<std::pair<RowReader*, const syntax::Row::Field*>> later;
  for (const auto& reader : readers) reader->fill(later);
  std::unordered_map<std::uint64_t, std::uint32_t> waits;   // by place: which of those that are left
  for (std::uint32_t i = 0; i < later.size(); ++i) waits.emplace(later[i].first->key(*later[i].second), i);
  const auto need = [&](std::uint32_t i) {
    for (const FieldPlace& place : later[i].first->reads(*later[i].second)) {
      if (const auto at = waits.find(field_key(place.row, place.field)); at != waits.end()) return at->second;
    }
    return kNone32;
  };
  const auto make = [&](std::uint32_t i) {
    later[i].first->fill(*later[i].second);
    waits.erase(later[i].first->key(*later[i].second));
  };
  const auto circle = [&](std::uint32_t i) {
    later[i].first->report_circle(*later[i].second);
    waits.erase(later[i].first->key(*later[i].second));
  };
  make_in_order_of_need(later.size(), need, make, circle);
  draft.rows_written = true;
}

}  // namespace kb::model
