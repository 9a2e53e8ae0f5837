#include "compiler/program/interpret.h"

#include <algorithm>
#include <cmath>

#include "compiler/program/conditions.h"
#include "compiler/program/net_effects.h"

namespace kb::program {
namespace {

constexpr std::int64_t kNotHeld = -1;

void worsen(Tick& tick, Status status) { tick.status = std::max(tick.status, status); }

float membership(Term term, float cf) {
  switch (term) {
    case Term::kHigh: return std::max(0.0f, cf);
    case Term::kLow: return std::max(0.0f, -cf);
    case Term::kZero: return 1.0f - std::fabs(cf);
  }
  return 0.0f;
}

}  // namespace

Interpreter::Interpreter(const Program& program)
    : program_(program), firing_(static_cast<float>(program.settings.firing)) {
  for (std::uint32_t i = 0; i < program.facts; ++i) thresholds_.push_back(thresholds(program.cells[i]));
  for (std::uint32_t level = 0; level < program.levels.size(); ++level) {
    const auto [begin, end] = rules_of(program, level);
    std::vector<CondId> roots;
    for (std::uint32_t rule = begin; rule < end; ++rule) roots.push_back(program.rules[rule].condition);
    levels_.push_back({begin, end, reachable(program.conds, roots), {}});
  }
  reset();
}

void Interpreter::reset() {
  ticks_ = 0;
  time_us_ = last_active_us_ = 0;
  last_strategy_ = CellId::kNone;
  cf_.clear();
  for (const Cell& cell : program_.cells) cf_.push_back(cell.initial);
  seen_.assign(program_.facts, false);
  event_.assign(program_.facts, false);
  lost_.assign(program_.facts, false);
  armed_.assign(program_.rules.size(), true);
  truth_.assign(program_.conds.size(), false);
  for (Level& level : levels_) level.since.assign(level.conds.size(), kNotHeld);
}

Tick Interpreter::tick(std::span<const float> facts, std::uint32_t dt_us) {
  if (ticks_ > 0) time_us_ += dt_us;
  Tick tick;
  tick.number = ticks_ + 1;
  tick.time_us = time_us_;
  const std::vector<float> before = cf_;

  take_facts(facts, tick);
  settle_sightings(tick);
  for (std::uint32_t level = 0; level < levels_.size(); ++level) run_level(level, tick);
  dispatch(tick);

  for (std::uint32_t i = program_.facts; i < program_.first_strategy(); ++i) {
    if (cf_[i] != before[i]) tick.set.push_back({CellId{i}, cf_[i]});
  }
  ++ticks_;
  return tick;
}

void Interpreter::take_facts(std::span<const float> facts, Tick& tick) {
  for (std::uint32_t i = 0; i < program_.facts; ++i) {
    const float given = i < facts.size() ? facts[i] : 0.0f;
    if (!is_certainty(given)) ++tick.bad_facts;
    cf_[i] = std::isnan(given) ? 0.0f : std::clamp(given, -1.0f, 1.0f);
  }
  if (tick.bad_facts > 0) worsen(tick, Status::kBadFact);
}

void Interpreter::settle_sightings(Tick& tick) {
  for (std::uint32_t i = 0; i < program_.facts; ++i) {
    bool attended = seen_[i];  // what is seen counts as attended
    for (const CellId satellite : program_.cells[i].satellites) attended = attended || value(satellite) >= firing_;
    const bool now = cf_[i] > (attended ? thresholds_[i].attended : thresholds_[i].plain);
    event_[i] = now && !seen_[i] && ticks_ > 0;
    lost_[i] = !now && seen_[i];
    seen_[i] = now;
    if (event_[i]) tick.events.push_back(CellId{i});
    if (lost_[i]) tick.lost.push_back(CellId{i});
  }
}

void Interpreter::run_level(std::uint32_t number, Tick& tick) {
  Level& level = levels_[number];
  if (number + 1 == levels_.size()) {
    for (const CellId strategy : program_.priority) cf_[index(strategy)] = -1.0f;
  }
  evaluate(level, true);
  if (observer_ != nullptr) observer_->level_evaluated(*this, number);

  std::vector<std::uint32_t> firing;
  bool resets = false;
  for (std::uint32_t i = level.begin; i < level.end; ++i) {
    const Rule& rule = program_.rules[i];
    if (!truth_[index(rule.condition)]) {
      armed_[i] = true;
    } else if (armed_[i]) {
      firing.push_back(i);
      resets = resets || rule.reset;
    }
  }
  if (firing.empty()) return;
  if (resets) std::erase_if(firing, [&](std::uint32_t i) { return !program_.rules[i].reset; });

  std::vector<bool> contradicted(level.end - level.begin, false);
  for (const std::uint32_t i : firing) tick.fired.push_back(RuleId{i});
  commit(firing, tick, contradicted);
  evaluate(level, false);
  for (const std::uint32_t i : firing) {
    const Rule& rule = program_.rules[i];
    if (rule.mode == Mode::kWhen && !contradicted[i - level.begin]) armed_[i] = !truth_[index(rule.condition)];
  }
}

void Interpreter::evaluate(Level& level, bool settle_timers) {
  for (std::size_t place = 0; place < level.conds.size(); ++place) {
    const CondId id = level.conds[place];
    const Cond& cond = program_[id];
    // For the control level every strategy is -1, also when its rules are evaluated again after its commit.
    if (!settle_timers && cond.op == Cond::Op::kIs && program_[cond.cell].kind == CellKind::kStrategy) continue;
    if (cond.op != Cond::Op::kFor) {
      truth_[index(id)] = evaluate(cond);
    } else if (settle_timers) {  // otherwise timers keep their value
      truth_[index(id)] = time(level.since[place], cond);
    }
  }
}

bool Interpreter::evaluate(const Cond& cond) const {
  const auto holds_part = [this](CondId part) { return truth_[index(part)]; };
  switch (cond.op) {
    case Cond::Op::kAnd: return std::all_of(cond.children.begin(), cond.children.end(), holds_part);
    case Cond::Op::kOr: return std::any_of(cond.children.begin(), cond.children.end(), holds_part);
    case Cond::Op::kNot: return !holds_part(cond.children.front());
    case Cond::Op::kEvent: return event_[index(cond.cell)];
    case Cond::Op::kLost: return lost_[index(cond.cell)];
    case Cond::Op::kSeen: return seen_[index(cond.cell)];
    case Cond::Op::kIs: return membership(cond.term, value(cond.cell)) >= firing_;
    case Cond::Op::kFor: break;
  }
  return false;
}

bool Interpreter::time(std::int64_t& since, const Cond& cond) const {
  if (!truth_[index(cond.children.front())]) {
    since = kNotHeld;
    return false;
  }
  if (since == kNotHeld) since = time_us_;
  return time_us_ - since >= static_cast<std::int64_t>(cond.duration_us);
}

std::optional<std::int64_t> Interpreter::held_us(CondId for_condition, std::uint32_t number) const {
  const Level& level = levels_[number];
  const auto found = std::lower_bound(level.conds.begin(), level.conds.end(), for_condition);
  if (found == level.conds.end() || *found != for_condition) return std::nullopt;
  const std::int64_t since = level.since[static_cast<std::size_t>(found - level.conds.begin())];
  if (since == kNotHeld) return std::nullopt;
  return time_us_ - since;
}

/// The language limits how deep conditions nest, so the recursion is bounded.
float Interpreter::strength(CondId condition) const {
  const Cond& cond = program_[condition];
  switch (cond.op) {
    case Cond::Op::kAnd: {
      float least = 1.0f;
      for (const CondId part : cond.children) least = std::min(least, strength(part));
      return least;
    }
    case Cond::Op::kOr: {
      float most = 0.0f;
      for (const CondId part : cond.children) most = std::max(most, strength(part));
      return most;
    }
    case Cond::Op::kIs: return membership(cond.term, value(cond.cell));
    default: return truth_[index(condition)] ? 1.0f : 0.0f;
  }
}

void Interpreter::commit(const std::vector<std::uint32_t>& firing, Tick& tick, std::vector<bool>& contradicted) {
  std::vector<Writer> writers;
  for (const std::uint32_t i : firing) {
    for_each_net_write(program_, program_.rules[i], [&](CellId cell, float written) {
      writers.push_back({cell, i, written});
    });
  }
  std::stable_sort(writers.begin(), writers.end(), [](const Writer& a, const Writer& b) { return a.cell < b.cell; });
  // Strengths are computed from the cells as the level found them, so all values are computed first and written afterwards.
  std::vector<CellValue> settled;
  const std::uint32_t first = levels_[program_.rules[firing.front()].level].begin;
  for (std::size_t begin = 0, end = 0; begin < writers.size(); begin = end) {
    while (end < writers.size() && writers[end].cell == writers[begin].cell) ++end;
    const std::span<const Writer> same{writers.data() + begin, end - begin};
    settled.push_back({same.front().cell, combine(same, first, tick, contradicted)});
  }
  for (const CellValue& cell : settled) cf_[index(cell.cell)] = cell.value;
}

float Interpreter::combine(std::span<const Writer> writers, std::uint32_t first_rule, Tick& tick,
                           std::vector<bool>& contradicted) const {
  const float one = writers.front().value;
  if (std::all_of(writers.begin(), writers.end(), [&](const Writer& w) { return w.value == one; })) return one;

  double weighted = 0.0;
  double weight = 0.0;
  bool positive = false;
  bool negative = false;
  for (const Writer& writer : writers) {
    const double alpha = std::max(firing_, strength(program_.rules[writer.rule].condition));
    weighted += alpha * static_cast<double>(writer.value);
    weight += alpha;
    positive = positive || writer.value > 0.0f;
    negative = negative || writer.value < 0.0f;
  }
  if (positive && negative) {
    Conflict conflict;
    conflict.cell = writers.front().cell;
    for (const Writer& writer : writers) {
      conflict.rules.push_back(RuleId{writer.rule});
      contradicted[writer.rule - first_rule] = true;
    }
    tick.conflicts.push_back(std::move(conflict));
    worsen(tick, Status::kConflict);
  }
  return static_cast<float>(weighted / weight);
}

void Interpreter::dispatch(Tick& tick) {
  for (const CellId strategy : program_.priority) {
    if (value(strategy) >= firing_) tick.active.push_back(strategy);
  }
  if (!tick.active.empty()) {
    tick.strategy = last_strategy_ = tick.active.front();
    last_active_us_ = time_us_;
    if (tick.active.size() > 1) worsen(tick, Status::kTwoStrategies);
    return;
  }
  const Settings& settings = program_.settings;
  switch (settings.idle) {
    case Idle::kStop: worsen(tick, Status::kNoStrategy); break;
    case Idle::kStrategy:
      tick.strategy = settings.idle_strategy;
      worsen(tick, Status::kNoStrategy);
      break;
    case Idle::kHold:
      if (last_strategy_ == CellId::kNone) {
        worsen(tick, Status::kNoStrategy);
      } else if (time_us_ - last_active_us_ <= static_cast<std::int64_t>(settings.hold_limit_us)) {
        tick.strategy = last_strategy_;
        worsen(tick, Status::kHolding);
      } else {
        worsen(tick, Status::kHoldExpired);
      }
      break;
  }
}

}  // namespace kb::program
