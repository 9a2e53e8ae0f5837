// Conditions that are kept in rows (`when`). They are read when all rows exist: `exit` and `leg` in them are those of the row's leg.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "compiler/model/conditions.h"
#include "compiler/model/field_reads.h"
#include "compiler/source/kinds.h"
#include "compiler/syntax/syntax.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

/// A condition with `exit` and `leg` in it, for many legs.
class KeptReader {
 public:
  KeptReader(Draft& draft, const syntax::Tree& tree, syntax::CondId cond, bool of_leg)
      : draft_(draft), tree_(tree), cond_(cond), references_(draft, tree, binders_), conditions_(draft, tree, references_) {
    if (of_leg) {
      binders_.push_back({{{}, "exit"}, RelationId::kNone, false, false});
      binders_.push_back({{{}, "leg"}, *find_relation(draft, "Leg"), false, false});
      conditions_.of_road();
    }
    pattern_ = conditions_.compile(cond);
  }

  [[nodiscard]] bool reads(const syntax::Tree& tree, syntax::CondId cond) const { return &tree_ == &tree && cond_ == cond; }
  /// Whether the condition depends on the leg.
  [[nodiscard]] bool depends() const { return binders_[0].used || binders_[1].used; }

  std::optional<CondId> of_leg(std::uint32_t leg) {
    CondId made{};
    return of_leg(leg, made) == Outcome::kMade ? std::optional(made) : std::nullopt;
  }
  Outcome of_leg(std::uint32_t leg, CondId& made) {
    std::vector<Operand> values(binders_.size());
    if (leg != kNone32) {
      const LegInfo& info = draft_.legs[leg];
      const std::uint32_t exit = draft_.roads[info.road].exit;
      values[0].kind = exit != kNone32 ? Operand::Kind::kMember : Operand::Kind::kMissing;
      if (exit != kNone32) values[0].member = {draft_.exits, exit};
      values[1].kind = Operand::Kind::kRow;
      values[1].row = info.row;
    }
    return conditions_.evaluate(pattern_, values, made);
  }

 private:
  Draft& draft_;
  const syntax::Tree& tree_;
  syntax::CondId cond_;
  std::vector<Binder> binders_;
  References references_;
  Conditions conditions_;
  std::uint32_t pattern_ = 0;
};

/// note [written out]
/// A row's condition may ask for what other rows say, and these for what others say. Each is kept once, but what goes through a condition part
/// by part meets a shared part as often as it is asked for: 40 rows of which each asks twice for the one before make 2^40. So it has limits.
struct Extent {
  std::uint32_t parts = 0;   ///< each `and`, `or`, `not` and `for`, as often as it would be written
  std::uint32_t depth = 0;   ///< of those, with an `and` in an `and` taken as one, and a small `or` in an `or`
  std::uint32_t width = 1;   ///< the parts of an `and` or `or` taken so
};

constexpr std::uint32_t kDeepest = static_cast<std::uint32_t>(syntax::kMaxNesting);

bool too_large(const Extent& extent) { return extent.parts > kMostWrittenOut || extent.depth > kDeepest; }

class Extents {
 public:
  explicit Extents(const std::vector<Cond>& conds) : conds_(conds) {}
  /// The condition must be the newest of those that are kept: later ones may be withdrawn.
  Extent of(CondId condition) {
    while (known_.size() < conds_.size()) known_.push_back(measure(conds_[known_.size()]));
    return known_[index(condition)];
  }

 private:
  [[nodiscard]] Extent measure(const Cond& cond) const {
    if (cond.cell != CellId::kNone) return {};
    Extent all{1, 1, 0};
    for (const CondId id : cond.children) {
      const Extent& part = known_[index(id)];
      const Cond::Op op = conds_[index(id)].op;
      const bool joins = op == cond.op && (op == Cond::Op::kAnd || (op == Cond::Op::kOr && part.width <= kSmallOr));
      all.parts = std::min(all.parts + part.parts, kMostWrittenOut + 1);
      all.width += joins ? part.width : 1;
      all.depth = std::max(all.depth, joins ? part.depth : part.depth + 1);
    }
    return all;
  }

  const std::vector<Cond>& conds_;
  std::vector<Extent> known_;
};

/// Conditions written in rows, each after those of other rows that it reads.
class WrittenConditions {
 public:
  explicit WrittenConditions(Draft& draft) : draft_(draft), extents_(draft.model.conds), place_of_(draft.model.kept.size(), kNone32) {
    ids_.reserve(draft.kept.size());
    for (const KeptPlace& place : draft.kept) {
      ids_.push_back(std::get<KeptId>(*draft.model.field(draft.model[place.row], place.field)));
      place_of_[index(ids_.back())] = static_cast<std::uint32_t>(ids_.size() - 1);
    }
  }
  void resolve() {
    make_in_order_of_need(ids_.size(), [&](std::uint32_t i) { return need(i); }, [&](std::uint32_t i) { make(i); }, [&](std::uint32_t i) { report_circle(i); });
  }

 private:
  [[nodiscard]] KeptCondition& kept(std::uint32_t i) { return draft_.model.kept[index(ids_[i])]; }
  [[nodiscard]] std::vector<FieldPlace> reads_of(std::uint32_t i) {
    const RowId leg = draft_.kept[i].leg != kNone32 ? draft_.legs[draft_.kept[i].leg].row : RowId::kNone;
    return fields_read(draft_, *kept(i).tree, kept(i).condition, leg);
  }
  [[nodiscard]] std::uint32_t need(std::uint32_t i) {
    const KeptCondition& one = kept(i);
    if (one.tree == nullptr || (one.tree == alone_tree_ && one.condition == alone_)) return kNone32;
    const std::vector<FieldPlace> reads = reads_of(i);
    if (reads.empty()) alone_tree_ = one.tree, alone_ = one.condition;
    for (const auto& [row, field] : reads) {
      const KeptId* const id = std::get_if<KeptId>(&draft_.model.fields(draft_.model[row])[field]);
      if (id != nullptr && place_of_[index(*id)] != kNone32) return place_of_[index(*id)];
    }
    return kNone32;
  }
  void make(std::uint32_t i) {
    const KeptPlace& place = draft_.kept[i];
    place_of_[index(ids_[i])] = kNone32;
    if (kept(i).tree == nullptr) return;   // its row has been refused
    if (!reader_ || !reader_->reads(*kept(i).tree, kept(i).condition)) {
      reader_ = std::make_unique<KeptReader>(draft_, *kept(i).tree, kept(i).condition, place.leg != kNone32);
    }
    CondId made{};
    const Outcome outcome = reader_->of_leg(place.leg, made);
    if (outcome == Outcome::kMissing) return set_field(draft_, place.row, place.field, {});   // what it reads is not there, so it is not either
    if (outcome != Outcome::kMade) return;
    const Extent extent = extents_.of(made);
    if (too_large(extent) && !reads_of(i).empty()) return report_too_large(i);   // one that asks no rows is as large as it was written
    kept(i).depth = static_cast<std::uint8_t>(std::min(extent.depth, kDeepest));
    kept(i).resolved = made;
    kept(i).is_resolved = true;
  }
  void report_too_large(std::uint32_t i) {
    report_written_out(draft_, (*kept(i).tree)[kept(i).condition].span, fmt::format("{}.{}", draft_.model[draft_.kept[i].row].name, draft_.kept[i].field));
  }
  void report_circle(std::uint32_t i) {
    place_of_[index(ids_[i])] = kNone32;
    draft_.diagnostics.report(Kind::kRowCircle, (*kept(i).tree)[kept(i).condition].span, {draft_.kept[i].field, draft_.model[draft_.kept[i].row].name});
  }

  Draft& draft_;
  Extents extents_;
  std::vector<KeptId> ids_;                            // beside draft.kept
  std::vector<std::uint32_t> place_of_;                // by kept condition: index into ids_, until it is resolved
  const syntax::Tree* alone_tree_ = nullptr;           // the last condition that reads no row
  syntax::CondId alone_{};
  std::unique_ptr<KeptReader> reader_;                 // reused, because the rows of one statement follow each other
};

/// note [which road is closed]
/// A planned detour is taken when the road of the plan and those of the detours before it are closed and its own is open, unless a detour
/// that is written out for the leg is taken: a mission must not set out on two legs.
/// What "closed" means is the condition after `when`, or else `Closed[exit]`; it is evaluated for each road with its `exit` and `leg`.
class PlanReader {
 public:
  PlanReader(Draft& draft, const PlanStatement& plan) : draft_(draft) {
    if (plan.when) {
      const std::size_t errors = draft.diagnostics.errors();
      reader_ = std::make_unique<KeptReader>(draft, *plan.tree, *plan.when, true);
      if (draft.diagnostics.errors() == errors) check_alternatives(*plan.tree, *plan.when);
      return;
    }
    const Entity* closed = draft.names.find("Closed");
    if (closed != nullptr && closed->kind == Entity::Kind::kGroup) closed_ = &draft.model.groups[closed->id];
    if (closed_ != nullptr && (closed_->dimensions.size() != 1 || closed_->dimensions.front() != draft.exits)) closed_ = nullptr;
    if (closed_ == nullptr && !draft.library_missing) draft.diagnostics.report(Kind::kDetoursWithoutClosed, plan.span, {plan.route});
  }

  std::optional<CondId> condition(const PlannedCondition& planned) {
    std::vector<CondId> parts;
    for (const std::uint32_t leg : planned.closed) {
      const auto closed = closed_of(leg);
      if (!closed) return std::nullopt;
      parts.push_back(*closed);
    }
    const auto open = open_of(planned.open);
    if (!open) return std::nullopt;
    parts.push_back(*open);
    if (const auto& written = draft_.legs[planned.instead].detour) {
      const KeptCondition& kept = draft_.model[written->when];
      if (!kept.is_resolved) return std::nullopt;
      parts.push_back(not_cond(draft_.model, kept.resolved));
    }
    return join_conds(draft_.model, Cond::Op::kAnd, std::move(parts));
  }

 private:
  /// Each alternative of the condition must depend on the road: one that does not closes the ways round as well.
  void check_alternatives(const syntax::Tree& tree, syntax::CondId when) {
    const syntax::Cond& cond = tree[when];
    if (cond.kind == syntax::Cond::Kind::kOr) {
      for (const syntax::CondId part : cond.children) check_alternatives(tree, part);
    } else if (!KeptReader(draft_, tree, when, true).depends()) {
      draft_.diagnostics.report(Kind::kDetoursForAllExits, cond.span);
    }
  }

  std::optional<CondId> closed_of(std::uint32_t leg) {
    if (const auto known = closed_of_leg_.find(leg); known != closed_of_leg_.end()) return known->second;
    std::optional<CondId> made;
    if (reader_) made = reader_->of_leg(leg);
    const std::uint32_t exit = draft_.roads[draft_.legs[leg].road].exit;
    if (closed_ != nullptr && exit != kNone32) made = is_cond(draft_.model, closed_->cells[exit]);
    return closed_of_leg_[leg] = made;
  }

  std::optional<CondId> open_of(std::uint32_t leg) {
    if (const auto known = open_of_leg_.find(leg); known != open_of_leg_.end()) return known->second;
    const auto closed = closed_of(leg);
    return open_of_leg_[leg] = closed ? std::optional(not_cond(draft_.model, *closed)) : std::nullopt;
  }

  Draft& draft_;
  std::unique_ptr<KeptReader> reader_;
  const Group* closed_ = nullptr;
  std::unordered_map<std::uint32_t, std::optional<CondId>> closed_of_leg_;  // looked up, never iterated
  std::unordered_map<std::uint32_t, std::optional<CondId>> open_of_leg_;
};

void resolve_planned(Draft& draft) {
  std::vector<std::unique_ptr<PlanReader>> readers;
  for (const PlanStatement& plan : draft.plans) readers.push_back(std::make_unique<PlanReader>(draft, plan));
  for (const PlannedCondition& planned : draft.planned_conditions) {
    const auto made = readers[planned.statement]->condition(planned);
    if (!made) continue;
    KeptCondition kept;
    kept.resolved = *made;
    kept.is_resolved = true;
    set_field(draft, planned.row, "when", add_kept(draft.model, kept));
  }
}

}  // namespace

void resolve_kept_conditions(Draft& draft) {
  WrittenConditions(draft).resolve();
  resolve_planned(draft);
}

}  // namespace kb::model
