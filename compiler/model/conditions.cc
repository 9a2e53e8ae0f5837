#include "compiler/model/conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "compiler/model/units.h"
#include "compiler/syntax/syntax.h"

namespace kb::model {

using diagnostics::Kind;

CondId add_cond(Model& model, Cond cond) {
  model.conds.push_back(std::move(cond));
  return CondId{static_cast<std::uint32_t>(model.conds.size() - 1)};
}

CondId is_cond(Model& model, CellId cell, syntax::Term term) {
  Cond cond;
  cond.op = Cond::Op::kIs;
  cond.cell = cell;
  cond.term = term;
  return add_cond(model, std::move(cond));
}

CondId not_cond(Model& model, CondId inner) {
  Cond cond;
  cond.op = Cond::Op::kNot;
  cond.children.push_back(inner);
  return add_cond(model, std::move(cond));
}

CondId join_conds(Model& model, Cond::Op op, std::vector<CondId> conds) {
  if (conds.size() == 1) return conds.front();
  Cond cond;
  cond.op = op;
  cond.children.assign(conds.begin(), conds.end());
  return add_cond(model, std::move(cond));
}

void report_written_out(Draft& draft, source::Span at, std::string_view asked) {
  draft.diagnostics.report(Kind::kWrittenOutTooLarge, at, {asked, std::to_string(kMostWrittenOut), std::to_string(syntax::kMaxNesting)});
}

namespace {

std::optional<syntax::Term> term_of(std::string_view word) {
  if (word.empty()) return syntax::Term::kHigh;
  const auto found = std::find(kTermWords.begin(), kTermWords.end(), word);
  if (found == kTermWords.end()) return std::nullopt;
  return static_cast<syntax::Term>(found - kTermWords.begin());
}

Cond::Op event_of(syntax::Cond::Kind kind) {
  if (kind == syntax::Cond::Kind::kEvent) return Cond::Op::kEvent;
  if (kind == syntax::Cond::Kind::kLost) return Cond::Op::kLost;
  return kind == syntax::Cond::Kind::kSeen ? Cond::Op::kSeen : Cond::Op::kIs;
}

std::string_view word_for(Cond::Op op) {
  if (op == Cond::Op::kEvent) return "event";
  return op == Cond::Op::kLost ? "lost" : "seen";
}

}  // namespace

std::uint32_t Conditions::add(Pattern pattern) {
  patterns_.push_back(std::move(pattern));
  return static_cast<std::uint32_t>(patterns_.size() - 1);
}

std::uint32_t Conditions::compile(syntax::CondId id, source::Span loose) {
  ++nesting_;
  const std::uint32_t made = add(read(tree_[id]));
  patterns_[made].nesting = static_cast<std::uint8_t>(--nesting_);
  patterns_[made].loose = loose;
  if (!patterns_[made].same) return made;
  CondId cond{};
  switch (evaluate(made, {}, cond)) {
    case Outcome::kMade:
      patterns_[made].constant = cond;
      patterns_[made].op = Pattern::Op::kConstant;
      break;
    case Outcome::kBroken: patterns_[made].op = Pattern::Op::kBroken; break;
    case Outcome::kMissing: break;
  }
  return made;
}

/// The time of a loose timer, else none.
source::Span Conditions::loose_time(const syntax::Cond& around, syntax::CondId part) {
  const syntax::Cond& timer = tree_[part];
  if (around.kind != syntax::Cond::Kind::kAnd || timer.kind != syntax::Cond::Kind::kFor) return {};
  return timer.parenthesised || tree_[timer.children.front()].parenthesised ? source::Span() : timer.time;
}

void Conditions::read_children(const syntax::Cond& cond, Pattern& pattern) {
  pattern.same = true;
  for (const syntax::CondId child : cond.children) {
    pattern.children.push_back(compile(child, loose_time(cond, child)));
    pattern.same = pattern.same && patterns_[pattern.children.back()].same;
  }
}

/// `Step is one`, `Line is hihg`
void Conditions::report_term(const syntax::Cond& cond, std::uint32_t ref) {
  auto message = draft_.diagnostics.report(Kind::kUnknownTerm, cond.term.span, {cond.term.text});
  const std::string member = references_.named_member(ref, cond.term.text);
  if (member.empty()) {
    message.suggest(diagnostics::closest(cond.term.text, kTermWords));
    return;
  }
  const std::string asked = fmt::format("{}{}{}", cond.negated ? "not " : "", cond.sat ? "sat " : "", member);
  message.note(Kind::kMemberAsked, {}, {cond.term.text, references_.text(ref), asked});
}

/// `X is low`, `X`. False after a message.
bool Conditions::read_term(const syntax::Cond& cond, Pattern& pattern) {
  const auto term = term_of(cond.term.text);
  if (!term) {
    report_term(cond, references_.compile(cond.ref));
    return false;
  }
  pattern.term = *term;
  pattern.plain = cond.term.text.empty() && !cond.sat;
  return true;
}

/// `negated` and `none` are wrapped in a `not` here.
Conditions::Pattern Conditions::read(const syntax::Cond& cond) {
  Pattern pattern;
  bool negated = false;
  switch (cond.kind) {
    case syntax::Cond::Kind::kError: return pattern;
    case syntax::Cond::Kind::kOr: pattern.op = Pattern::Op::kOr; break;
    case syntax::Cond::Kind::kAnd: pattern.op = Pattern::Op::kAnd; break;
    case syntax::Cond::Kind::kNot: pattern.op = Pattern::Op::kNot; break;
    case syntax::Cond::Kind::kFor: {
      pattern.op = Pattern::Op::kFor;
      const auto duration = to_microseconds(cond.duration, draft_.diagnostics);
      pattern.duration_us = duration.value_or(0);
      if (!duration) pattern.op = Pattern::Op::kBroken;
      break;
    }
    case syntax::Cond::Kind::kEvent:
    case syntax::Cond::Kind::kLost:
    case syntax::Cond::Kind::kSeen:
      pattern.op = Pattern::Op::kEvent;
      pattern.event = event_of(cond.kind);
      break;
    case syntax::Cond::Kind::kIs:
      pattern.op = Pattern::Op::kIs;
      if (!read_term(cond, pattern)) return {};
      negated = cond.negated;
      break;
    case syntax::Cond::Kind::kAny:
      pattern.op = Pattern::Op::kAny;
      pattern.event = event_of(cond.asked);
      negated = cond.none;
      break;
  }
  pattern.sat = cond.sat;
  if (!cond.children.empty()) {
    read_children(cond, pattern);
    return pattern;
  }
  pattern.ref = references_.compile(cond.ref);
  pattern.same = references_.constant(pattern.ref);
  if (!check_row(pattern)) return {};
  if (!negated) return pattern;
  Pattern wrapper;
  wrapper.op = Pattern::Op::kNot;
  wrapper.same = pattern.same;
  wrapper.children.push_back(add(std::move(pattern)));
  return wrapper;
}

/// Reports what is wrong with a pattern over rows, even if the relation has no rows.
bool Conditions::check_row(const Pattern& pattern) {
  const References::RowState state = references_.row_state(pattern.ref);
  const source::Span at = references_.span(pattern.ref);
  const std::string_view text = references_.text(pattern.ref);
  if (state == References::RowState::kUnknown) return true;
  if (pattern.event != Cond::Op::kIs && state != References::RowState::kFact) {
    draft_.diagnostics.report(Kind::kEventOfNonFact, at, {text, references_.describe_row(pattern.ref), word_for(pattern.event)});
    return false;
  }
  if (state == References::RowState::kNone) {
    if (!draft_.library_missing) draft_.diagnostics.report(Kind::kNoState, at, {text, references_.describe_row(pattern.ref)});
    return false;
  }
  if (pattern.sat && state == References::RowState::kSatellite) {
    draft_.diagnostics.report(Kind::kSatOfSatellite, at, {text});
    return false;
  }
  return true;
}

Outcome Conditions::evaluate(std::uint32_t id, Environment values, CondId& made) {
  // The reference stays valid: everything is compiled before anything is evaluated, so the vector no longer grows.
  const Pattern& pattern = patterns_[id];
  switch (pattern.op) {
    case Pattern::Op::kConstant: made = pattern.constant; return Outcome::kMade;
    case Pattern::Op::kBroken: return Outcome::kBroken;
    case Pattern::Op::kEvent: return evaluate_event(pattern, values, made);
    case Pattern::Op::kIs: return evaluate_is(pattern, values, made);
    case Pattern::Op::kAny: return evaluate_any(pattern, values, made);
    case Pattern::Op::kAnd:
    case Pattern::Op::kOr:
    case Pattern::Op::kNot:
    case Pattern::Op::kFor: break;
  }
  Cond cond;
  cond.op = pattern.op == Pattern::Op::kAnd   ? Cond::Op::kAnd
            : pattern.op == Pattern::Op::kOr  ? Cond::Op::kOr
            : pattern.op == Pattern::Op::kNot ? Cond::Op::kNot
                                              : Cond::Op::kFor;
  cond.duration_us = pattern.duration_us;
  cond.loose = pattern.loose.known();
  cond.children.reserve(pattern.children.size());
  Outcome worst = Outcome::kMade;
  for (const std::uint32_t child : pattern.children) {
    CondId part{};
    worst = std::max(worst, evaluate(child, values, part));
    cond.children.push_back(part);
    const bool joins = worst == Outcome::kMade && (cond.op == Cond::Op::kAnd || cond.op == Cond::Op::kOr);
    cond.loose = cond.loose || (joins && draft_.model[part].loose);
  }
  if (worst != Outcome::kMade) return worst;
  made = pattern.op == Pattern::Op::kNot ? negate(cond.children.front()) : add_cond(draft_.model, std::move(cond));
  if (pattern.loose.known()) draft_.model.loose_timers.insert_or_assign(made, pattern.loose);
  return worst;
}

/// The condition that asks for `term` of one cell.
CondId Conditions::ask(Cond::Op op, CellId cell, syntax::Term term) {
  Cond cond;
  cond.op = op;
  cond.cell = cell;
  cond.term = term;
  const std::size_t question = static_cast<std::size_t>(op) - static_cast<std::size_t>(Cond::Op::kEvent) + (op == Cond::Op::kIs ? static_cast<std::size_t>(term) : 0);
  std::vector<CondId>& shared = draft_.shared_conds.asked[question];
  const std::vector<Cond>& conds = draft_.model.conds;
  shared.resize(draft_.model.cells.size());
  CondId& known = shared[index(cell)];
  const bool good = index(known) < conds.size() && conds[index(known)].op == op && conds[index(known)].cell == cell &&
                    conds[index(known)].term == term;
  if (!good) known = add_cond(draft_.model, std::move(cond));
  return known;
}

CondId Conditions::negate(CondId part) {
  const std::vector<Cond>& conds = draft_.model.conds;
  std::vector<CondId>& shared = draft_.shared_conds.negated;
  if (shared.size() <= index(part)) shared.resize(conds.size());
  CondId& known = shared[index(part)];
  const bool good = index(known) < conds.size() && conds[index(known)].op == Cond::Op::kNot &&
                    conds[index(known)].children.front() == part;
  if (!good) known = not_cond(draft_.model, part);
  return known;
}

/// Whether one of the cells is so. Rules by thousands may each ask `any` of one large group.
CondId Conditions::ask_any(Cond::Op op, const std::vector<CellId>& cells, syntax::Term term) {
  constexpr std::size_t kWorthSharing = 8;
  std::vector<CondId> parts;
  parts.reserve(cells.size());
  for (const CellId cell : cells) parts.push_back(ask(op, cell, term));
  if (parts.size() < kWorthSharing) return join_conds(draft_.model, Cond::Op::kOr, std::move(parts));
  const std::vector<Cond>& conds = draft_.model.conds;
  CondId& known = draft_.shared_conds.any[parts];
  const bool good = index(known) < conds.size() && conds[index(known)].op == Cond::Op::kOr && std::ranges::equal(conds[index(known)].children, parts);
  if (!good) known = join_conds(draft_.model, Cond::Op::kOr, std::move(parts));
  return known;
}

Outcome Conditions::evaluate_event(const Pattern& pattern, Environment values, CondId& made) {
  const Operand operand = references_.evaluate(pattern.ref, values);
  if (operand.kind == Operand::Kind::kBroken) return Outcome::kBroken;
  if (operand.kind == Operand::Kind::kMissing) return Outcome::kMissing;
  const auto cell = references_.cell_of(operand);
  const auto cells = cell ? std::nullopt : references_.cells_of(operand);
  if (cells && all_facts(*cells)) {
    draft_.diagnostics.report(Kind::kEventOfGroup, references_.span(pattern.ref),
                              {references_.text(pattern.ref), references_.describe(operand), word_for(pattern.event)});
    return Outcome::kBroken;
  }
  if (!cell || !all_facts({*cell})) return report_non_fact(pattern, operand);
  made = ask(pattern.event, *cell);
  return Outcome::kMade;
}

bool Conditions::all_facts(const std::vector<CellId>& cells) const {
  return std::ranges::all_of(cells, [this](CellId cell) { return draft_.model[cell].kind == CellKind::kFact; });
}

Outcome Conditions::report_non_fact(const Pattern& pattern, const Operand& operand) {
  const std::string_view text = references_.text(pattern.ref);
  const auto cell = references_.cell_of(operand);
  auto message = draft_.diagnostics.report(Kind::kEventOfNonFact, references_.span(pattern.ref), {text, references_.describe(operand), word_for(pattern.event)});
  if (cell && draft_.model[*cell].kind == CellKind::kSatellite) message.note(Kind::kAskedAlone, {}, {text});
  return Outcome::kBroken;
}

/// `In.N and In.S`, or the first two of more.
std::string Conditions::all_of(const std::vector<CellId>& cells, bool sat) const {
  std::string all;
  for (std::size_t i = 0; i < std::min<std::size_t>(cells.size(), 2); ++i) all += fmt::format("{}{}{}", i > 0 ? " and " : "", sat ? "sat " : "", draft_.model[cells[i]].name);
  return all + (cells.size() > 2 ? " and ..." : "");
}

Outcome Conditions::report_many(const Pattern& pattern, const Operand& operand) {
  const std::string_view text = references_.text(pattern.ref);
  const Entity* named = draft_.names.find(text);
  if (named != nullptr && named->twice) return Outcome::kBroken;   // perhaps the other one is meant
  const auto cells = references_.cells_of(operand);
  const bool satellites = cells && !cells->empty() && draft_.model[cells->front()].kind == CellKind::kSatellite;   // `sat` would be a mistake
  const std::string name = (pattern.sat && !satellites ? "sat " : "") + std::string(text);
  const bool of_exits = of_road_ && named != nullptr && named->kind == Entity::Kind::kGroup && draft_.model.groups[named->id].dimensions == std::vector{draft_.exits};
  const std::string one = of_exits ? fmt::format("`{}[exit]`", name) : fmt::format("`any {0}` or `no {0}`, or {1}", name, operand.kind == Operand::Kind::kRelation ? "name a row" : "index it");
  auto message = draft_.diagnostics.report(Kind::kWholeGroup, references_.span(pattern.ref), {text, references_.describe(operand), one});
  if (!of_exits && cells && cells->size() > 1) message.note(Kind::kAllOfThem, {}, {all_of(*cells, pattern.sat && !satellites)});
  return Outcome::kBroken;
}

/// `sat X` is true if anything draws attention to X.
Outcome Conditions::satellites_of(const Pattern& pattern, CellId cell, std::vector<CellId>& out) {
  const Cell& known = draft_.model[cell];
  if (known.kind == CellKind::kSatellite) {
    draft_.diagnostics.report(Kind::kSatOfSatellite, references_.span(pattern.ref), {references_.text(pattern.ref)})
        .note(Kind::kNameDeclaredHere, known.declared, {known.name});
    return Outcome::kBroken;
  }
  out.insert(out.end(), known.satellites.begin(), known.satellites.end());
  return Outcome::kMade;
}

Outcome Conditions::evaluate_is(const Pattern& pattern, Environment values, CondId& made) {
  const Operand operand = references_.evaluate(pattern.ref, values);
  if (operand.kind == Operand::Kind::kBroken) return Outcome::kBroken;
  if (operand.kind == Operand::Kind::kMissing) return Outcome::kMissing;
  if (operand.kind == Operand::Kind::kCondition) {
    if (!pattern.plain) {
      draft_.diagnostics.report(Kind::kTermOfCondition, references_.span(pattern.ref), {references_.text(pattern.ref)});
      return Outcome::kBroken;
    }
    if (pattern.nesting + operand.depth > syntax::kMaxNesting) {
      report_written_out(draft_, references_.span(pattern.ref), references_.text(pattern.ref));
      return Outcome::kBroken;
    }
    made = operand.condition;
    return Outcome::kMade;
  }
  const auto cell = references_.cell_of(operand);
  if (!cell && operand.kind != Operand::Kind::kRow && references_.cells_of(operand)) return report_many(pattern, operand);
  if (!cell) return references_.report_no_cell(pattern.ref, operand);
  if (!pattern.sat) {
    made = ask(Cond::Op::kIs, *cell, pattern.term);
    return Outcome::kMade;
  }
  std::vector<CellId> satellites;
  if (satellites_of(pattern, *cell, satellites) == Outcome::kBroken) return Outcome::kBroken;
  made = ask_any(Cond::Op::kIs, satellites, pattern.term);
  return Outcome::kMade;
}

Outcome Conditions::evaluate_any(const Pattern& pattern, Environment values, CondId& made) {
  const Operand operand = references_.evaluate(pattern.ref, values);
  if (operand.kind == Operand::Kind::kBroken) return Outcome::kBroken;
  if (operand.kind == Operand::Kind::kMissing) return Outcome::kMissing;
  if (references_.cell_of(operand)) {
    draft_.diagnostics.report(Kind::kAnyOfOne, references_.span(pattern.ref), {references_.text(pattern.ref)});
    return Outcome::kBroken;
  }
  const auto cells = references_.cells_of(operand);
  if (!cells) return references_.report_no_cell(pattern.ref, operand);
  if (pattern.event != Cond::Op::kIs && !all_facts(*cells)) return report_non_fact(pattern, operand);
  std::vector<CellId> asked;
  for (const CellId cell : *cells) {
    if (!pattern.sat) asked.push_back(cell);
    else if (satellites_of(pattern, cell, asked) == Outcome::kBroken) return Outcome::kBroken;
  }
  made = ask_any(pattern.event, asked);
  return Outcome::kMade;
}

}  // namespace kb::model
