// References, read in two steps. `compile` looks up names once, folds what is the same in all instances of a rule and checks what
// can be checked without an instance. `evaluate` finds what a reference stands for in one instance.
#pragma once

#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "compiler/model/draft.h"

namespace kb::model {

/// What a reference stands for.
struct Operand {
  enum class Kind : std::uint8_t {
    kBroken,     ///< reported
    kMissing,    ///< a field that this row does not have: the rule has no instance here
    kMember, kCell, kRow, kCondition, kPoint,
    kCells,      ///< `Cross[t, *]`
    kGroup, kRelation,  ///< as a whole; `whole` is the index
    kOther,      ///< a name that is none of these (a set, a table, a map); `other` says what
  };
  Kind kind = Kind::kBroken;
  Entity::Kind other = Entity::Kind::kBroken;
  Member member;
  CellId cell = CellId::kNone;   ///< kCell; kMember: the cell of the group that the binder ranges over, if it is one
  RowId row = RowId::kNone;
  CondId condition{};
  std::uint8_t depth = 0;        ///< kCondition: as the row keeps it
  std::uint32_t whole = 0;
  std::vector<CellId> cells;

  [[nodiscard]] static Operand of(Kind kind) {
    Operand operand;
    operand.kind = kind;
    return operand;
  }
  [[nodiscard]] static Operand of(Member member, CellId cell = CellId::kNone) {
    Operand operand = of(Kind::kMember);
    operand.member = member;
    operand.cell = cell;
    return operand;
  }
  [[nodiscard]] static Operand of(CellId cell) {
    Operand operand = of(Kind::kCell);
    operand.cell = cell;
    return operand;
  }
  [[nodiscard]] static Operand of(RowId row) {
    Operand operand = of(Kind::kRow);
    operand.row = row;
    return operand;
  }
};

/// How the making of an instance of a rule ended.
enum class Outcome : std::uint8_t {
  kMade,
  kMissing,  ///< a field that it needs is not there: no instance
  kBroken,   ///< reported
};

using Environment = std::span<const Operand>;

/// A variable that a reference may use beside the names of the knowledge base.
struct Binder {
  syntax::Name name;
  RelationId relation = RelationId::kNone;  ///< if it ranges over rows
  bool used = false;
  bool broken = false;                      ///< what it ranges over is unknown; reported
  SetId set = SetId::kNone;                 ///< if it ranges over members
};

class References {
 public:
  /// `rule` is the name of the rule that the references stand in; empty if they stand elsewhere.
  References(Draft& draft, const syntax::Tree& tree, std::vector<Binder>& binders, std::string_view rule = {})
      : draft_(draft), tree_(tree), binders_(binders), rule_(rule) {}

  /// The compiled form of a reference. Errors are reported and give a form that evaluates to kBroken.
  std::uint32_t compile(syntax::RefId ref);
  /// What it stands for when the binders have these values.
  [[nodiscard]] Operand evaluate(std::uint32_t pattern, Environment values);
  /// Of the fields found missing since the last call, the one that the fewest variables decide: how many, from the first. Whatever
  /// values the others have, it is missing. kAllBinders if none was.
  [[nodiscard]] std::size_t take_missing() { return std::exchange(missing_, kAllBinders); }
  static constexpr std::size_t kAllBinders = std::numeric_limits<std::size_t>::max();
  /// Does it stand for the same in all instances?
  [[nodiscard]] bool constant(std::uint32_t pattern) const { return patterns_[pattern].op == Pattern::Op::kConstant; }
  [[nodiscard]] const Operand& value(std::uint32_t pattern) const { return patterns_[pattern].constant; }
  [[nodiscard]] source::Span span(std::uint32_t pattern) const { return patterns_[pattern].span; }
  /// What cell the rows have that a pattern will stand for, if that is known before any row exists.
  enum class RowState : std::uint8_t { kUnknown, kNone, kSatellite, kFact };
  [[nodiscard]] RowState row_state(std::uint32_t pattern) const;
  [[nodiscard]] static RowState row_state(const Relation& relation);
  /// "a row of `Leg`", when row_state is known.
  [[nodiscard]] std::string describe_row(std::uint32_t pattern) const;
  /// How `name` is written if it is a member, or a variable over the members, of the group that a pattern stands for, or a row of the
  /// relation; empty if it is none of these.
  [[nodiscard]] std::string named_member(std::uint32_t pattern, std::string_view name) const;
  /// As written.
  [[nodiscard]] std::string_view text(std::uint32_t pattern) const { return text(patterns_[pattern].span); }

  /// "a satellite", "a group of 12 cells", "a row of `Leg`".
  [[nodiscard]] std::string describe(const Operand& operand) const;
  /// All cells that an operand stands for; nothing if it is no cell, or its rows belong to a relation without cells.
  [[nodiscard]] std::optional<std::vector<CellId>> cells_of(const Operand& operand) const;
  /// The one cell that it stands for, if it is one.
  [[nodiscard]] std::optional<CellId> cell_of(const Operand& operand) const;
  /// Reports that a pattern stands for no cell. Always kBroken.
  Outcome report_no_cell(std::uint32_t pattern, const Operand& operand) const;

 private:
  struct Argument { bool star = false; std::uint32_t pattern = 0; };
  struct Pattern {
    enum class Op : std::uint8_t { kConstant, kBinder, kField, kIndex, kCall };
    Op op = Op::kConstant;
    source::Span span;
    Operand constant;                 ///< kConstant
    std::uint32_t binder = 0;         ///< kBinder
    std::size_t depends_on = 0;       ///< so many binders, from the first
    std::uint32_t object = 0;         ///< kField
    syntax::Name field;
    RelationId relation = RelationId::kNone;  ///< of the row that it stands for, if that is known beforehand
    std::uint32_t target = 0;         ///< kIndex: group; kCall: table
    std::vector<Argument> arguments;
    RelationId cached_relation = RelationId::kNone;  ///< kField: where the field was found last
    std::size_t cached_field = 0;
  };

  [[nodiscard]] std::string_view text(source::Span span) const { return draft_.diagnostics.sources().text(span); }
  std::uint32_t add(Pattern pattern);
  std::uint32_t add_constant(Operand operand, source::Span span, RelationId relation = RelationId::kNone);
  std::uint32_t add_broken(source::Span span) { return add_constant({}, span); }
  std::uint32_t fold(std::uint32_t pattern);

  std::uint32_t compile_base(const syntax::Ref& ref, std::size_t& postfix);
  std::uint32_t compile_entity(const Entity& entity, const syntax::Ref& ref, std::size_t& postfix);
  void report_unknown(const syntax::Name& name);
  void report_unknown_index(const syntax::Name& name, SetId set);
  std::uint32_t compile_field(std::uint32_t object, const syntax::Postfix& postfix, source::Span span);
  std::uint32_t compile_member_field(std::uint32_t group, const syntax::Postfix& postfix, source::Span span);
  std::uint32_t compile_index(std::uint32_t object, const syntax::Postfix& postfix, source::Span span);
  std::uint32_t compile_call(std::uint32_t table, const syntax::Postfix& postfix, source::Span span);
  std::uint32_t compile_argument(const syntax::Index& argument, SetId set);
  void report_index_count(const Group& group, std::size_t given, source::Span at, bool dotted = false);
  /// Whether the operand is a relation with a row of that name.
  [[nodiscard]] bool has_row(const Operand& relation, std::string_view name) const;
  [[nodiscard]] std::optional<Operand> member_of(std::uint32_t object, const syntax::Name& name) const;
  void check_filled(RelationId relation, const syntax::Name& field);

  [[nodiscard]] Operand evaluate_field(std::uint32_t pattern, Environment values);
  [[nodiscard]] Operand field_of(const Operand& object, Pattern& pattern);
  [[nodiscard]] Operand evaluate_index(std::uint32_t pattern, Environment values);
  [[nodiscard]] Operand evaluate_call(std::uint32_t pattern, Environment values);
  /// The member of `set` that an argument stands for; reports an argument that is no member.
  [[nodiscard]] Operand evaluate_argument(const Argument& argument, SetId set, std::string_view owner, bool table,
                                          Environment values);

  Draft& draft_;
  const syntax::Tree& tree_;
  std::vector<Binder>& binders_;
  std::string_view rule_;
  std::vector<Pattern> patterns_;
  std::size_t missing_ = kAllBinders;
};

}  // namespace kb::model
