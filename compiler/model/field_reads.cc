#include "compiler/model/field_reads.h"

namespace kb::model {
namespace {

class Reads {
 public:
  Reads(const Draft& draft, const syntax::Tree& tree, RowId leg) : draft_(draft), tree_(tree), leg_(leg) {}

  void add(syntax::RefId id) {
    const syntax::Ref& ref = tree_[id];
    RowId row = base(ref);
    for (const syntax::Postfix& postfix : ref.postfixes) {
      for (const syntax::Index& argument : postfix.arguments) {
        if (!argument.star && !argument.number) add(argument.ref);
      }
      row = row == RowId::kNone || postfix.kind != syntax::Postfix::Kind::kField ? RowId::kNone : step(row, postfix.field.text);
    }
  }
  void add(syntax::CondId id) {
    using Op = syntax::Cond::Kind;
    const syntax::Cond& cond = tree_[id];
    for (const syntax::CondId child : cond.children) add(child);
    if (cond.kind >= Op::kEvent && cond.kind <= Op::kAny) add(cond.ref);
  }

  std::vector<FieldPlace> places;

 private:
  [[nodiscard]] RowId base(const syntax::Ref& ref) const {
    if (leg_ != RowId::kNone && ref.base.text == "leg") return leg_;
    const Entity* entity = draft_.names.find(ref.base.text);
    if (entity == nullptr) return RowId::kNone;
    const auto kind = entity->kind;
    const bool row = kind == Entity::Kind::kRow || kind == Entity::Kind::kLandmark || kind == Entity::Kind::kCommand || kind == Entity::Kind::kRoute;
    return row ? RowId{entity->id} : RowId::kNone;
  }
  /// The row that the field of a row holds, if it holds one.
  RowId step(RowId row, std::string_view field) {
    const auto place = find_field(draft_.model[draft_.model[row].relation], field);
    if (!place) return RowId::kNone;
    places.push_back({row, *place});
    const Value& value = draft_.model.fields(draft_.model[row])[*place];
    const RowId* const next = std::get_if<RowId>(&value);
    return next != nullptr ? *next : RowId::kNone;
  }

  const Draft& draft_;
  const syntax::Tree& tree_;
  RowId leg_;
};

}  // namespace

std::vector<FieldPlace> fields_read(const Draft& draft, const syntax::Tree& tree, syntax::RefId ref, RowId leg) {
  Reads reads(draft, tree, leg);
  reads.add(ref);
  return std::move(reads.places);
}

std::vector<FieldPlace> fields_read(const Draft& draft, const syntax::Tree& tree, syntax::CondId cond, RowId leg) {
  Reads reads(draft, tree, leg);
  reads.add(cond);
  return std::move(reads.places);
}

}  // namespace kb::model
