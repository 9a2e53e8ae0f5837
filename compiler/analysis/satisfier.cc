#include "compiler/analysis/satisfier.h"

#include <algorithm>

#include "compiler/program/conditions.h"

namespace kb::analysis {
namespace {

using program::CellId;
using program::CellKind;
using program::Cond;
using program::CondId;

constexpr std::uint32_t kNobody = 0xFFFFFFFFu;
constexpr std::size_t kNothingOpen = static_cast<std::size_t>(-1);
constexpr std::uint64_t kStepsPerQuestion = 50'000;
constexpr std::uint8_t kHigh = kRegionHigh | kRegionHighZero;

/// Whether a fact is certainly high while it is seen. An exclusive group promises only that two facts are not high at once; facts that are
/// seen from a lower certainty on may be seen at once.
bool high_while_seen(const program::Program& program, CellId fact) {
  return program::thresholds(program[fact]).attended >= static_cast<float>(program.settings.firing);
}

}  // namespace

Satisfier::Choices Satisfier::find_choices(const program::Program& program) {
  Choices choices{exclusive_at_all_times(program), std::vector<std::uint32_t>(program.cells.size() + program.facts, kNoChoice)};
  for (std::size_t i = 0; i < program.exclusive.size(); ++i) {
    if (!choices.exclusive[i]) continue;
    const std::vector<CellId>& group = program.exclusive[i];
    const bool facts = program[group.front()].kind == CellKind::kFact;
    for (const CellId member : group) {
      choices.of[program::index(member)] = choices.count;
      if (facts && high_while_seen(program, member)) choices.of[program.cells.size() + program::index(member)] = choices.count + 1;
    }
    choices.count += facts ? 2 : 1;
  }
  for (const CellId strategy : program.priority) choices.of[program::index(strategy)] = choices.count;
  ++choices.count;
  return choices;
}

Satisfier::Satisfier(const program::Program& program, const Domains& domains, std::shared_ptr<const Choices> choices, Confusions* confusions)
    : program_(program), domains_(domains), confusions_(program.perception.perceived.size() > 1 ? confusions : nullptr), exclusive_choices_(std::move(choices)) {
  values_ = domains.cells;
  values_.insert(values_.end(), domains.facts.begin(), domains.facts.end());
  values_.resize(values_.size() + program.conds.size(), kTimerTrue | kTimerFalse);
  holder_.assign(exclusive_choices_->count, kNobody);
  find_timed_events();
}

Satisfier::Satisfier(const program::Program& program, const Domains& domains, Confusions* confusions)
    : Satisfier(program, domains, std::make_shared<const Choices>(find_choices(program)), confusions) {}

Satisfier::Satisfier(const Satisfier& other, const Domains& domains) : Satisfier(other.program_, domains, other.exclusive_choices_, other.confusions_) {}

std::uint32_t Satisfier::sighting_of(CellId fact) const {
  return static_cast<std::uint32_t>(program_.cells.size() + program::index(fact));
}

std::uint32_t Satisfier::timer_of(CondId condition) const {
  return static_cast<std::uint32_t>(program_.cells.size() + program_.facts + program::index(condition));
}

Satisfier::Question Satisfier::question(CondId condition) const {
  const Cond& cond = program_[condition];
  switch (cond.op) {
    case Cond::Op::kSeen: return {sighting_of(cond.cell), kSeen};
    case Cond::Op::kEvent: return {sighting_of(cond.cell), kJustSeen};
    case Cond::Op::kLost: return {sighting_of(cond.cell), kJustLost};
    case Cond::Op::kFor: return {timer_of(condition), kTimerTrue};
    default: return {static_cast<std::uint32_t>(program::index(cond.cell)), regions_of(cond.term)};
  }
}

/// The values that the variable may have, given which variable holds its exclusive choice.
std::uint8_t Satisfier::allowed(std::uint32_t variable) const {
  std::uint8_t values = values_[variable];
  const std::size_t cells = program_.cells.size();
  if (variable >= cells + program_.facts) return static_cast<std::uint8_t>(values & left_by_others(variable));
  if (control_level_ && variable < cells && program_.cells[variable].kind == CellKind::kStrategy) values &= kRegionLow;
  const std::uint32_t choice = choice_of(variable);
  if (choice == kNoChoice || holder_[choice] == kNobody || holder_[choice] == variable) return values;
  return static_cast<std::uint8_t>(values & ~(variable < cells ? kHigh : kSeen));
}

bool Satisfier::narrow(std::uint32_t variable, std::uint8_t wanted) {
  const auto left = static_cast<std::uint8_t>(allowed(variable) & wanted);
  if (left == 0) return false;
  if (left != values_[variable]) {
    trail_.push_back({variable, values_[variable]});
    values_[variable] = left;
    if (variable >= timer_of(CondId{0})) note_elapsed(variable);
    if (confusions_ != nullptr && !may_be_sure(variable)) return false;
  }
  const std::uint32_t choice = choice_of(variable);
  const std::uint8_t chosen = variable < program_.cells.size() ? kHigh : kSeen;
  if (choice != kNoChoice && (left & ~chosen) == 0 && holder_[choice] == kNobody) {
    trail_.push_back({static_cast<std::uint32_t>(values_.size() + choice), kNobody});
    holder_[choice] = variable;
  }
  return true;
}

/// Whether a fact, if it is now certain to be high or seen, goes with the others that are.
bool Satisfier::may_be_sure(std::uint32_t variable) {
  const std::size_t cells = program_.cells.size();
  const bool sighting = variable >= cells;
  const std::size_t place = sighting ? variable - cells : variable;
  if (place >= program_.facts || (values_[variable] & ~(sighting ? kSeen : kHigh)) != 0) return true;
  const CellId fact{static_cast<std::uint32_t>(place)};
  const double limit = sighting ? program::thresholds(program_[fact]).attended : program_.settings.firing;
  if (limit < 0.0) return true;
  steps_ += sure_.size();
  for (const Sure& other : sure_) {
    if (other.fact != fact && confusions_->exclusive(std::min(fact, other.fact), std::max(fact, other.fact), std::min(limit, other.limit))) return false;
  }
  sure_.push_back({fact, limit, trail_.size()});
  return true;
}

/// Makes the certainty of a fact and whether it is seen agree.
bool Satisfier::couple(std::uint32_t fact) {
  const std::uint32_t sighting = sighting_of(CellId{fact});
  const std::uint8_t seen = allowed(sighting);
  if ((seen & kSeen) == 0 && !narrow(fact, seen == kJustLost ? domains_.when_lost[fact] : domains_.when_unseen[fact])) return false;
  if ((seen & ~kSeen) == 0 && !narrow(fact, domains_.when_seen[fact])) return false;
  const std::uint8_t regions = allowed(fact);
  Sightings possible = kAnySighting;
  if ((regions & domains_.when_seen[fact]) == 0) possible &= kUnseen | kJustLost;
  if ((regions & domains_.when_lost[fact]) == 0) possible &= static_cast<Sightings>(~kJustLost);
  if ((regions & domains_.when_unseen[fact]) == 0) possible &= kSeen;
  return possible == kAnySighting || narrow(sighting, possible);
}

bool Satisfier::restrict_to(std::uint32_t variable, std::uint8_t wanted) {
  if (!narrow(variable, wanted)) return false;
  const auto cells = static_cast<std::uint32_t>(program_.cells.size());
  if (variable < program_.facts) return couple(variable);
  if (variable >= cells && variable < cells + program_.facts) return couple(variable - cells);
  return true;
}

bool Satisfier::assume_leaf(Goal goal) {
  const Question asked = question(goal.condition);
  return restrict_to(asked.variable, goal.wanted ? asked.allowed : static_cast<std::uint8_t>(~asked.allowed));
}

bool Satisfier::assume_held(CondId timer) {
  const auto held = held_.find(timer);
  if (held == held_.end()) return true;
  return std::ranges::all_of(held->second, [this](const Restriction& one) { return restrict_to(one.variable, one.allowed); });
}

/// Assumes a goal and everything that follows from it directly. Goals that leave a choice go to `open_`.
bool Satisfier::assume(Goal first) {
  pending_.assign(1, first);
  while (!pending_.empty() && !exhausted()) {   // a part may stand in many others
    const Goal goal = pending_.back();
    pending_.pop_back();
    ++steps_;
    const Cond& cond = program_[goal.condition];
    switch (cond.op) {
      case Cond::Op::kNot: pending_.push_back({cond.children.front(), !goal.wanted}); break;
      case Cond::Op::kAnd:
      case Cond::Op::kOr:
        if (cond.children.size() > most_parts_) break;
        if ((cond.op == Cond::Op::kAnd) != goal.wanted) {
          open_.push_back(goal);
          closed_.push_back(false);
          break;
        }
        steps_ += cond.children.size();
        for (const CondId part : cond.children) pending_.push_back({part, goal.wanted});
        break;
      case Cond::Op::kFor:
        if (!assume_leaf(goal) || (goal.wanted && !assume_held(goal.condition))) return false;
        if (goal.wanted || cond.duration_us == 0) pending_.push_back({cond.children.front(), goal.wanted});
        break;
      default:
        if (!assume_leaf(goal)) return false;
    }
  }
  return true;
}

Satisfier::Truth Satisfier::leaf_truth(CondId condition) const {
  const Question asked = question(condition);
  const std::uint8_t values = allowed(asked.variable);
  if ((values & asked.allowed) == 0) return Truth::kFalse;
  return (values & ~asked.allowed) == 0 ? Truth::kTrue : Truth::kOpen;
}

Satisfier::Truth Satisfier::truth_of_several(const Cond& cond) {
  const Truth decisive = cond.op == Cond::Op::kAnd ? Truth::kFalse : Truth::kTrue;
  bool open = false;
  for (const CondId part : cond.children) {
    const Truth one = truth(part);
    if (one == decisive) return decisive;
    open = open || one == Truth::kOpen;
  }
  if (open) return Truth::kOpen;
  return decisive == Truth::kTrue ? Truth::kFalse : Truth::kTrue;
}

/// Recursion as deep as conditions nest, which is limited; how often a part is visited is not.
Satisfier::Truth Satisfier::truth(CondId condition) {
  ++steps_;
  if (exhausted()) return Truth::kOpen;
  const Cond& cond = program_[condition];
  switch (cond.op) {
    case Cond::Op::kAnd:
    case Cond::Op::kOr: return truth_of_several(cond);
    case Cond::Op::kNot: {
      const Truth part = truth(cond.children.front());
      if (part == Truth::kOpen) return part;
      return part == Truth::kTrue ? Truth::kFalse : Truth::kTrue;
    }
    case Cond::Op::kFor: {
      const Truth timer = leaf_truth(condition);
      return timer == Truth::kOpen && truth(cond.children.front()) == Truth::kFalse ? Truth::kFalse : timer;
    }
    default: return leaf_truth(condition);
  }
}

/// How many alternatives of an open goal may still hold, and the last of them; `done` if one holds already.
Satisfier::Left Satisfier::alternatives_left(Goal goal) {
  const Truth good = goal.wanted ? Truth::kTrue : Truth::kFalse;
  Left left;
  for (const CondId part : program_[goal.condition].children) {
    const Truth one = truth(part);
    if (one == good) {
      left.done = true;
      return left;
    }
    if (one != Truth::kOpen) continue;
    ++left.count;
    left.last = part;
  }
  return left;
}

void Satisfier::close(std::size_t open_goal) {
  trail_.push_back({static_cast<std::uint32_t>(values_.size() + holder_.size() + open_goal), 0});
  closed_[open_goal] = true;
}

/// Assumes every alternative that is the only one left of its goal; false if a goal has none left. `branch` becomes the index in `open_`
/// of a goal with the fewest alternatives, or the size of `open_` if no goal is open.
bool Satisfier::settle(std::size_t& branch) {
  for (bool changed = true; changed && !exhausted();) {
    changed = false;
    branch = kNothingOpen;
    std::size_t fewest = 0;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (closed_[i]) continue;
      const Left left = alternatives_left(open_[i]);
      if (left.done) {
        close(i);
      } else if (left.count == 0) {
        return false;
      } else if (left.count == 1) {
        close(i);
        if (!assume({left.last, open_[i].wanted})) return false;
        changed = true;
      } else if (branch == kNothingOpen || left.count < fewest) {
        branch = i;
        fewest = left.count;
      }
    }
  }
  return true;
}

void Satisfier::undo(std::size_t trail, std::size_t open) {
  while (trail_.size() > trail) {
    const Change change = trail_.back();
    trail_.pop_back();
    if (change.place < values_.size()) {
      values_[change.place] = static_cast<std::uint8_t>(change.before);
    } else if (change.place < values_.size() + holder_.size()) {
      holder_[change.place - values_.size()] = change.before;
    } else {
      closed_[change.place - values_.size() - holder_.size()] = false;
    }
  }
  while (!sure_.empty() && sure_.back().trail > trail_.size()) sure_.pop_back();
  for (; !timed_.empty() && timed_.back().trail > trail_.size(); timed_.pop_back()) elapsed_[timed_.back().condition] = timed_.back().before;
  open_.resize(open);
  closed_.resize(open);
}

/// Goes back to the last choice with an alternative that has not been tried, and assumes that. False if there is none.
bool Satisfier::next_alternative() {
  while (!choices_.empty() && !exhausted()) {
    Choice& choice = choices_.back();
    undo(choice.trail, choice.open);
    const Goal goal = open_[choice.goal];
    const auto& parts = program_[goal.condition].children;
    if (choice.alternative == parts.size()) {
      choices_.pop_back();
      continue;
    }
    const CondId part = parts[choice.alternative++];
    close(choice.goal);
    if (assume({part, goal.wanted})) return true;
  }
  return false;
}

Answer Satisfier::search() {
  while (!exhausted()) {
    std::size_t branch = kNothingOpen;
    if (settle(branch)) {
      if (exhausted()) break;
      if (branch == kNothingOpen) return Answer::kYes;
      choices_.push_back({branch, 0, trail_.size(), open_.size()});
    }
    if (!next_alternative() && !exhausted()) return Answer::kNo;
  }
  return Answer::kUnknown;
}

void Satisfier::begin(std::uint32_t level) {
  choices_.clear();
  undo(0, 0);
  control_level_ = level + 1 == program_.levels.size();
  limit_ = std::min(kTotalSteps, steps_ + kStepsPerQuestion);
}

Answer Satisfier::together(std::span<const Goal> goals, std::uint32_t level) {
  begin(level);
  if (exhausted()) return Answer::kUnknown;
  for (const Goal goal : goals) {
    if (!assume(goal)) return Answer::kNo;
  }
  return search();
}

}  // namespace kb::analysis
