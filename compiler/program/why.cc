#include "compiler/program/why.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compiler/program/conditions.h"
#include "compiler/program/text.h"

namespace kb::program {
namespace {

/// An `or` with more parts than this is summed up.
constexpr std::size_t kFewAlternatives = 4;

/// With two digits, or as many as are needed to distinguish it from `other`.
std::string number(float value, float other) {
  std::string text = fmt::format("{:.2f}", value);
  if (value != other && text == fmt::format("{:.2f}", other)) text = fmt::format("{}", value);
  return text == "-0.00" ? "0.00" : text;
}

/// The same for a time.
std::string seconds(std::int64_t time_us, std::int64_t other_us) {
  const auto two_digits = [](std::int64_t us) { return fmt::format("{:.2f}", static_cast<double>(us) / 1e6); };
  std::string text = two_digits(time_us);
  if (time_us != other_us && text == two_digits(other_us)) text = fmt::format("{}", static_cast<double>(time_us) / 1e6);
  return text + " s";
}

/// The threshold that the fact had to pass on this tick to be seen.
float limit_of(const Program& program, const Record& record, CellId fact) {
  const Thresholds limits = thresholds(program[fact]);
  return seen_before(record, fact) || attending(program, record, fact) != CellId::kNone ? limits.attended : limits.plain;
}

class Explainer {
 public:
  Explainer(const Program& program, const Record& record, std::uint32_t level, Detail detail)
      : program_(program),
        record_(record),
        detail_(detail),
        level_(record.levels[level]),
        firing_(static_cast<float>(program.settings.firing)) {}

  /// Why the condition holds or not and, if it is not as wanted, what is needed. Recursion as deep as conditions nest.
  [[nodiscard]] std::string explain(CondId id, bool wanted) const {
    const Cond& cond = program_[id];
    switch (cond.op) {
      case Cond::Op::kIs: return term(cond, wanted);
      case Cond::Op::kSeen:
      case Cond::Op::kEvent:
      case Cond::Op::kLost: return record_.seen[index(cond.cell)] ? in_view(cond, wanted) : out_of_view(cond, wanted);
      case Cond::Op::kNot: return explain(cond.children.front(), !wanted);
      case Cond::Op::kFor: return timer(id, wanted);
      case Cond::Op::kAnd:
      case Cond::Op::kOr: return parts(id, wanted);
    }
    return {};
  }

  [[nodiscard]] bool holds(CondId id) const { return level_.truth[index(id)]; }

 private:
  [[nodiscard]] float value(CellId cell) const { return level_.cf[index(cell)]; }
  [[nodiscard]] std::string name(CellId cell) const { return std::string(program_[cell].name); }
  [[nodiscard]] std::string words(CondId id) const { return "`" + print_condition(program_, id) + "`"; }

  /// "`Safe` is 0.10, needs 0.50"; without "needs" if it is as wanted.
  [[nodiscard]] std::string term(const Cond& cond, bool wanted) const {
    const float cf = value(cond.cell);
    const float limit = cond.term == Term::kLow ? -firing_ : cond.term == Term::kZero ? 1.0f - firing_ : firing_;
    const float measured = cond.term == Term::kZero ? std::fabs(cf) : cf;
    const bool true_of_cell = program::holds(cond.term, cf, firing_);
    std::string text =
        fmt::format("`{}` is {}", name(cond.cell), number(cf, cf < 0.0f && measured != cf ? -limit : limit));
    if (true_of_cell == wanted) return text;
    const std::string bound = number(limit, measured);
    switch (cond.term) {
      case Term::kHigh: return text + (wanted ? ", needs " : ", must be below ") + bound;
      case Term::kLow: return text + (wanted ? ", needs " : ", must be above ") + bound + (wanted ? " or less" : "");
      case Term::kZero:
        return text + (wanted ? ", must be no farther from 0 than " : ", must be farther from 0 than ") + bound;
    }
    return text;
  }

  [[nodiscard]] std::string in_view(const Cond& cond, bool wanted) const {
    const bool came = record_.event[index(cond.cell)];
    const float cf = value(cond.cell), limit = limit_of(program_, record_, cond.cell);
    const std::string text =
        fmt::format("`{}` {}, at {}", name(cond.cell), came ? "came into view" : "is seen", number(cf, limit));
    if (cond.op == Cond::Op::kSeen) return wanted ? text : text + ", must not be above " + number(limit, cf);
    if (cond.op == Cond::Op::kLost) return wanted ? text + ", but must go out of view" : text;
    if (came) return wanted ? text : text + ", but must not";
    return text + (record_.tick.number == 1 ? ", but the first tick makes no events" : ", but it was seen before");
  }

  [[nodiscard]] std::string out_of_view(const Cond& cond, bool wanted) const {
    const bool went = record_.lost[index(cond.cell)], for_lost = cond.op == Cond::Op::kLost;
    if (for_lost && !went) return fmt::format("`{}` is not seen, and was not before", name(cond.cell));
    const float cf = value(cond.cell), limit = limit_of(program_, record_, cond.cell);
    const std::string text = fmt::format("`{}` {}, at {}", name(cond.cell), went ? "went out of view" : "is not seen", number(cf, limit));
    if (wanted && !for_lost) return text + ", needs above " + number(limit, cf);
    return fmt::format("{} (seen above {}){}", text, number(limit, cf), for_lost && !wanted ? ", but must not" : "");
  }

  [[nodiscard]] std::string timer(CondId id, bool wanted) const {
    const CondId part = program_[id].children.front();
    const std::optional<std::int64_t> held = level_.held_us[index(id)];
    const std::int64_t limit = program_[id].duration_us;
    if (!held) return explain(part, wanted) + (wanted ? fmt::format(", and that for {}", seconds(limit, 0)) : "");
    const std::string text = fmt::format("{} held for {}", words(part), seconds(*held, limit));
    const std::string asked = seconds(limit, *held);
    if (!holds(id)) return fmt::format("{} of {}", text, asked);
    return wanted ? fmt::format("{} (asked: {})", text, asked) : fmt::format("{}, must be less than {}", text, asked);
  }

  [[nodiscard]] std::string parts(CondId id, bool wanted) const {
    const Cond& cond = program_[id];
    const bool conjunction = cond.op == Cond::Op::kAnd, good = holds(id) == wanted;
    if (cond.children.empty()) return conjunction ? "always" : "there is nothing to choose from";
    if (detail_ == Detail::kBrief && !conjunction && !holds(id) && cond.children.size() > kFewAlternatives) {
      return fmt::format("none of {} alternatives holds, neither {} nor ... (`--all` spells them out)", cond.children.size(), words(cond.children.front()));
    }
    return conjunction == wanted ? every(cond, good, wanted) : some(cond, good, wanted);
  }

  /// All parts must be as wanted: those of an `and`, or of an `or` that must not hold.
  [[nodiscard]] std::string every(const Cond& cond, bool good, bool wanted) const {
    std::string text;
    Commas commas(good ? ", " : "; ");
    for (const CondId part : cond.children) {
      if ((holds(part) == wanted) != good) continue;
      commas.next(text);
      text += explain(part, wanted);
    }
    return text;
  }

  /// One part must be as wanted: of those of an `or`, or of an `and` that must not hold.
  [[nodiscard]] std::string some(const Cond& cond, bool good, bool wanted) const {
    if (good) {
      const auto first = std::find_if(cond.children.begin(), cond.children.end(),
                                      [&](CondId part) { return holds(part) == wanted; });
      return explain(*first, wanted);
    }
    std::string text;
    Commas between(wanted ? ", nor: " : ", or: ");
    for (const CondId part : cond.children) {
      between.next(text);
      text += explain(part, wanted);
    }
    return text;
  }

  const Program& program_;
  const Record& record_;
  Detail detail_;
  const LevelRecord& level_;
  float firing_;
};

bool contradicted(const Tick& tick, RuleId rule) {
  return std::any_of(tick.conflicts.begin(), tick.conflicts.end(), [&](const Conflict& conflict) {
    return std::find(conflict.rules.begin(), conflict.rules.end(), rule) != conflict.rules.end();
  });
}

Outcome outcome_of(const Program& program, const Record& record, RuleId rule) {
  const LevelRecord& level = record.levels[program[rule].level];
  const std::vector<RuleId>& fired = record.tick.fired;
  if (std::find(fired.begin(), fired.end(), rule) != fired.end()) {
    return contradicted(record.tick, rule) ? Outcome::kFiredContradicted : Outcome::kFired;
  }
  if (!level.truth[index(program[rule].condition)]) return Outcome::kFalse;
  return level.armed[index(rule)] ? Outcome::kSilenced : Outcome::kNotArmed;
}

/// "`Safe` is 0.10, needs 0.50; all else holds"
std::string what_fails(const std::vector<Reason>& reasons) {
  std::string text;
  Commas commas("; ");
  bool some_hold = false;
  for (const Reason& reason : reasons) {
    some_hold = some_hold || reason.holds;
    if (reason.holds) continue;
    commas.next(text);
    text += reason.text;
  }
  return some_hold ? text + "; all else holds" : text;
}

/// "`near`, `far`", or with values "`near` (0.20), `far` (0.80)"
std::string who(const Program& program, const std::vector<RuleId>& rules, const std::vector<float>& values = {}) {
  std::string text;
  Commas commas(", ");
  for (std::size_t i = 0; i < rules.size(); ++i) {
    commas.next(text);
    text.append("`").append(program[rules[i]].name) += '`';
    if (!values.empty()) text += fmt::format(" ({:.2f})", values[i]);
  }
  return text;
}

/// Which rules have reset the level; empty if none has.
std::string silenced(const Program& program, const Record& record, std::uint32_t level) {
  std::vector<RuleId> rules;
  for (const RuleId rule : record.tick.fired) {
    if (program[rule].level == level && program[rule].reset) rules.push_back(rule);
  }
  return rules.empty() ? "" : fmt::format("the `reset` of {} silenced level `{}`", who(program, rules), program.levels[level]);
}

std::string rule_text(const Program& program, const Record& record, const RuleStory& story) {
  const std::string_view name = program[story.rule].name;
  const std::uint64_t tick = record.tick.number;
  switch (story.outcome) {
    case Outcome::kFired: return fmt::format("`{}` fired at tick {}", name, tick);
    case Outcome::kFiredContradicted:
      return fmt::format("`{}` fired at tick {}, and another rule of its level wrote the opposite{}", name, tick,
                         program[story.rule].mode == Mode::kWhen ? ": it stays armed" : "");
    case Outcome::kFalse: return fmt::format("`{}` did not fire at tick {}: {}", name, tick, what_fails(story.reasons));
    case Outcome::kNotArmed:
      return fmt::format(
          "`{}` did not fire at tick {}: it is not armed, for it has fired at tick {} and its condition was not found false since",
          name, tick, record.fired_before[index(story.rule)]);
    case Outcome::kSilenced:
      return fmt::format("`{}` did not fire at tick {}: its condition holds, but {}", name, tick,
                         silenced(program, record, program[story.rule].level));
  }
  return {};
}

std::string strategy_text(const Program& program, const Record& record, const StrategyStory& story) {
  const auto control = static_cast<std::uint32_t>(program.levels.size() - 1);
  const bool active = story.rule.outcome == Outcome::kFired;
  if (story.dispatched && active) return "it is wanted, and nothing before it is";
  if (story.dispatched) {
    const std::string reset = silenced(program, record, control);
    return (reset.empty() ? "nothing is wanted" : reset) + (program.settings.idle == Idle::kHold ? ", and it goes on (`set idle = hold`)" : ", and it is the idle strategy");
  }
  if (record.tick.status == Status::kHoldExpired) {
    return fmt::format("{}, and no strategy goes on for longer than `hold_limit`, {}", what_fails(story.rule.reasons), seconds(program.settings.hold_limit_us, 0));
  }
  if (active) return "a strategy of higher priority is active too";
  if (story.rule.outcome == Outcome::kSilenced) return "it is wanted, but " + silenced(program, record, control);
  return what_fails(story.rule.reasons);
}

/// Where the certainty of a fact comes from.
std::string_view origin_of(const Program& program, const Record& record, CellId fact) {
  const bool defined = std::ranges::any_of(program.perception.perceived, [fact](const Perceived& one) { return one.fact == fact; });
  if (!defined || (!record.given.empty() && record.given[index(fact)])) return "given from outside";
  return record.given.empty() ? "perceived" : "it has no column, and from a recording of facts nothing is perceived";
}

}  // namespace

CellId attending(const Program& program, const Record& record, CellId fact) {
  const auto firing = static_cast<float>(program.settings.firing);
  const std::vector<float>& before = record.levels.front().cf;
  const auto& satellites = program[fact].satellites;
  const auto high = std::find_if(satellites.begin(), satellites.end(), [&](CellId satellite) { return before[index(satellite)] >= firing; });
  return high == satellites.end() ? CellId::kNone : *high;
}

RuleStory explain_rule(const Program& program, const Record& record, RuleId rule, Detail detail) {
  RuleStory story;
  story.rule = rule;
  story.outcome = outcome_of(program, record, rule);
  const Explainer explainer(program, record, program[rule].level, detail);
  for (const CondId part : conjuncts(program, program[rule].condition)) {
    story.reasons.push_back({print_condition(program, part), explainer.explain(part, true), explainer.holds(part)});
  }
  story.text = rule_text(program, record, story);
  return story;
}

CellStory explain_cell(const Program& program, const Record& record, CellId cell) {
  CellStory story;
  story.cell = cell;
  story.value = record.cf_after[index(cell)];
  const bool fact = program[cell].kind == CellKind::kFact;
  const float limit = fact ? limit_of(program, record, cell) : static_cast<float>(program.settings.firing);
  const std::string value = number(story.value, limit);
  story.text = fmt::format("`{}` is {} after tick {}: ", program[cell].name, value, record.tick.number);
  const LastWrite& last = record.last_write[index(cell)];
  if (fact) {
    const bool seen = record.seen[index(cell)];
    story.text += std::string(origin_of(program, record, cell)) + "; it is " + (seen ? "seen" : "not seen");
  } else if (program[cell].kind == CellKind::kStrategy && last.tick != record.tick.number) {
    story.text += "no rule of the control level called for it";
  } else if (last.tick == 0) {
    story.text += "no rule has written it since the start";
  } else {
    story.rules = last.rules;
    story.text += fmt::format("last written at tick {} by {}{}", last.tick, last.of_one_mind ? who(program, last.rules) : who(program, last.rules, last.values),
                              last.of_one_mind ? "" : ", which were not of one mind");
  }
  return story;
}

StrategyStory explain_strategy(const Program& program, const Record& record, CellId strategy, Detail detail) {
  StrategyStory story;
  story.strategy = strategy;
  story.dispatched = record.tick.strategy == strategy;
  for (std::uint32_t i = 0; i < program.rules.size(); ++i) {
    const Rule& rule = program.rules[i];
    const bool runs_it = rule.writes.size() == 1 && rule.writes[0].cell == strategy;   // no other rule writes a strategy
    if (runs_it) story.rule = explain_rule(program, record, RuleId{i}, detail);
  }
  story.text = fmt::format("`{}` {} at tick {}: {}", program[strategy].name, story.dispatched ? "ran" : "did not run",
                           record.tick.number, strategy_text(program, record, story));
  return story;
}

}  // namespace kb::program
