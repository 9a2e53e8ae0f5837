// Finds rules of one level that can fire together and disagree.
//
// note [conflict buckets]
// Two rules disagree about a cell if one writes it high and the other low; both may do so through an exclusive group.
// Comparing all writers of a cell with each other would be quadratic, and there are knowledge bases in which a rule has
// an instance for each of 10,000 legs, all of which write one cell. But nearly all of them demand a member of one
// exclusive group (the current leg), and rules that demand different members never fire together. So the writers of a
// contested cell or group are put into buckets by the member that they demand, of the group that separates most of them.
// Only writers in one bucket are compared with each other, and all writers with the few that demand no member. For each
// pair the demands that follow without search are compared first (compatible); only then a search looks for a moment at
// which both can fire (Satisfier). If a contested cell has too many pairs, the analysis reports that and gives up on the cell. If all
// cells together have, or more rules were found to disagree than are shown, it gives up on the rest and reports that once for each level.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "compiler/analysis/conflict_findings.h"
#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/subject.h"
#include "compiler/program/conditions.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::CellId;
using program::Program;
using program::Rule;
using program::RuleId;
using program::Write;

constexpr std::uint64_t kMostPairs = 4'000'000;  ///< of one contested cell or group
constexpr std::uint64_t kMostPairsInAll = 12'000'000;
constexpr std::size_t kMostFindings = 1'000; ///< pairs of rules as written; far more than are shown
constexpr std::size_t kMostDemands = 2'000'000;  ///< of the rules of one level; once there are more, `no` over a long group demands nothing
constexpr std::size_t kFewParts = 64;

/// A rule that writes a thing. Of two that disagree about it at least one raises it.
struct Writer {
  std::uint32_t rule = 0;
  bool raises = false;
};

/// What the rules of one level write to one thing: a cell, or an exclusive group as a whole.
struct Contest {
  std::vector<Writer> writers;  ///< by rule, ascending, each once
  bool raised = false;
  bool lowered = false;
};

class ConflictQuestions {
 public:
  explicit ConflictQuestions(Subject& subject)
      : subject_(subject), program_(subject.program), satisfier_(subject.satisfier()) {}

  void run() {
    contested_.resize(program_.cells.size() + program_.exclusive.size());
    for (std::uint32_t level = 0; level < program_.levels.size(); ++level) {
      const auto [begin, end] = program::rules_of(program_, level);
      search_level(begin, end);
    }
    report_conflicts(subject_, satisfier_, found_);
  }

 private:
  /// Things are numbered: cells first, then exclusive groups. A write to a member is a write to its group.
  [[nodiscard]] std::uint32_t thing_of(CellId cell) const {
    const std::uint32_t group = subject_.group_of[program::index(cell)];
    return group == program::kNoGroup ? static_cast<std::uint32_t>(program::index(cell)) : thing_of_group(group);
  }
  [[nodiscard]] std::uint32_t thing_of_group(std::uint32_t group) const {
    return static_cast<std::uint32_t>(program_.cells.size()) + group;
  }

  /// Calls `f(thing, raises, lowers)` for all that the rule writes by name or clears, and for those cells of its reset that another reset
  /// may contradict.
  template <class F>
  void for_each_write(const Rule& rule, F&& f) const {
    for (const Write& write : rule.writes) f(thing_of(write.cell), write.value > 0.0f, write.value < 0.0f);
    for (const std::uint32_t group : rule.clears) f(thing_of_group(group), false, true);
    if (!rule.reset) return;
    for (const CellId cell : reset_) {
      const float value = program::net_value(program_, subject_.group_of, rule, cell).value_or(0.0f);
      f(thing_of(cell), value > 0.0f, value < 0.0f);
    }
  }

  /// Calls `f(rule, thing, raises, lowers)` for all writes of rules in [begin, end), except rules that the compiler made.
  template <class F>
  void for_each_write_of(std::uint32_t begin, std::uint32_t end, F&& f) const {
    for (std::uint32_t i = begin; i < end; ++i) {
      if (Subject::generated(program_.rules[i])) continue;
      for_each_write(program_.rules[i], [&](std::uint32_t thing, bool raises, bool lowers) { f(i, thing, raises, lowers); });
    }
  }

  /// Finds what rules with `reset` also write in this level: another reset puts the same cells back.
  void find_reset(std::uint32_t begin, std::uint32_t end) {
    reset_.clear();
    for (std::uint32_t i = begin; i < end; ++i) {
      if (!program_.rules[i].reset) continue;
      for (const Write& write : program_.rules[i].writes) reset_.push_back(write.cell);
    }
    source::sort_unique(reset_);
  }

  /// Most things are contested by nobody. Those are sorted out first, with a few bits for each thing.
  void search_level(std::uint32_t begin, std::uint32_t end) {
    find_reset(begin, end);
    constexpr std::uint8_t kRaised = 1, kLowered = 2, kContested = kRaised | kLowered;
    for_each_write_of(begin, end, [&](std::uint32_t, std::uint32_t thing, bool raises, bool lowers) {
      contested_[thing] = static_cast<std::uint8_t>(contested_[thing] | (raises ? kRaised : 0) | (lowers ? kLowered : 0));
    });
    std::map<std::uint32_t, Contest> contests;
    for_each_write_of(begin, end, [&](std::uint32_t rule, std::uint32_t thing, bool raises, bool lowers) {
      if (contested_[thing] != kContested || !demands(rule).possible) return;
      Contest& contest = contests[thing];
      if (contest.writers.empty() || contest.writers.back().rule != rule) contest.writers.push_back({rule, false});
      contest.writers.back().raises = contest.writers.back().raises || raises;
      contest.raised = contest.raised || raises;
      contest.lowered = contest.lowered || lowers;
    });
    for (const auto& [thing, contest] : contests) {
      if (contest.raised && contest.lowered && contest.writers.size() > 1) search_contest(thing, contest.writers);
    }
    if (!gave_up_.empty()) report_incomplete(program_.rules[begin].level, gave_up_);
    gave_up_ = {};
    for_each_write_of(begin, end, [&](std::uint32_t, std::uint32_t thing, bool, bool) { contested_[thing] = 0; });
    demands_.clear();
    demanded_ = 0;
  }

  /// What follows from the rule's condition. The reference is valid until the level is done.
  const Demands& demands(std::uint32_t rule) {
    const auto [at, fresh] = demands_.try_emplace(rule);
    if (!fresh) return at->second;
    at->second = satisfier_.demands(program_.rules[rule].condition, program_.rules[rule].level, demanded_ < kMostDemands ? Satisfier::kAllParts : kFewParts);
    demanded_ += at->second.each.size();
    return at->second;
  }

  /// The exclusive choice that leaves the fewest pairs to compare, and how many pairs; none if no rule demands a member of one.
  struct Key {
    std::optional<std::uint32_t> choice;
    std::uint64_t pairs = 0;
  };
  [[nodiscard]] Key best_key(const std::vector<Writer>& writers) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> demanded;  // choice, member
    for (const Writer& writer : writers) {
      for (const Holder& holder : demands(writer.rule).holders) demanded.emplace_back(holder.choice, holder.variable);
    }
    std::sort(demanded.begin(), demanded.end());
    const std::uint64_t all = writers.size();
    const auto raisers = static_cast<std::uint64_t>(std::ranges::count_if(writers, &Writer::raises));
    Key best{std::nullopt, std::min(all * all / 2, raisers * all)};
    for (std::size_t begin = 0; begin < demanded.size();) {
      const std::uint32_t choice = demanded[begin].first;
      std::uint64_t keyed = 0;
      std::uint64_t pairs = 0;
      while (begin < demanded.size() && demanded[begin].first == choice) {
        std::size_t end = begin;
        while (end < demanded.size() && demanded[end] == demanded[begin]) ++end;
        keyed += end - begin;
        pairs += std::uint64_t{end - begin} * (end - begin) / 2;
        begin = end;
      }
      pairs += (all - keyed) * all;
      if (pairs < best.pairs) best = {choice, pairs};
    }
    return best;
  }

  /// See note [conflict buckets].
  void search_contest(std::uint32_t thing, const std::vector<Writer>& writers) {
    const Key key = best_key(writers);
    if (key.pairs > kMostPairs) return report_incomplete(program_.rules[writers.front().rule].level, fmt::format("too many of them write `{}`", name_of(thing)));
    if (pairs_ + key.pairs > kMostPairsInAll) {
      gave_up_ = "too many of them write the same cells";
      return;
    }
    pairs_ += key.pairs;
    reset_here_.clear();
    std::ranges::copy_if(reset_, std::back_inserter(reset_here_), [&](CellId cell) { return thing_of(cell) == thing; });
    std::map<std::uint32_t, std::vector<Writer>> buckets;
    std::vector<Writer> unkeyed;
    for (const Writer& writer : writers) {
      const std::vector<Holder>& holders = demands(writer.rule).holders;
      const auto holder =
          std::find_if(holders.begin(), holders.end(), [&](const Holder& h) { return h.choice == key.choice; });
      (holder == holders.end() ? unkeyed : buckets[holder->variable]).push_back(writer);
    }
    for (const auto& [member, bucket] : buckets) {
      compare_all(thing, bucket);
      for (const Writer& keyed : bucket) {
        for (const Writer& free : unkeyed) {
          if (keyed.raises || free.raises) compare(thing, std::min(keyed.rule, free.rule), std::max(keyed.rule, free.rule));
        }
      }
    }
    compare_all(thing, unkeyed);
  }

  /// Each with all later ones, but those that do not raise with those that do only.
  void compare_all(std::uint32_t thing, const std::vector<Writer>& writers) {
    std::vector<std::size_t> raisers;
    for (std::size_t i = 0; i < writers.size(); ++i) {
      if (writers[i].raises) raisers.push_back(i);
    }
    auto next = raisers.begin();   // the first of them after the i-th writer
    for (std::size_t i = 0; i < writers.size(); ++i) {
      if (next != raisers.end() && *next == i) ++next;
      if (writers[i].raises) {
        for (std::size_t j = i + 1; j < writers.size(); ++j) compare(thing, writers[i].rule, writers[j].rule);
      } else {
        for (auto j = next; j != raisers.end(); ++j) compare(thing, writers[i].rule, writers[*j].rule);
      }
    }
  }

  /// The name of the cell, or of the first member of the group.
  [[nodiscard]] std::string_view name_of(std::uint32_t thing) const {
    const std::size_t cells = program_.cells.size();
    return program_[thing < cells ? CellId{thing} : program_.exclusive[thing - cells].front()].name;
  }

  void report_incomplete(std::uint32_t level, std::string_view why) {
    const auto place = level < subject_.model.level_spans.size() ? subject_.model.level_spans[level] : source::Span{};
    subject_.diagnostics.report(Kind::kAnalysisIncomplete, place, {program_.levels[level], why});
  }

  /// A cell of `thing` that `a` raises by name and `b` lowers. If `b` lowers it by raising another member, that is `other`.
  [[nodiscard]] std::optional<Disagreement> raised_against(std::uint32_t thing, const Rule& a, const Rule& b) const {
    for (const Write& write : a.writes) {
      if (write.value <= 0.0f || thing_of(write.cell) != thing) continue;
      const std::optional<float> against = program::net_value(program_, subject_.group_of, b, write.cell);
      if (!against || *against >= 0.0f) continue;
      for (const Write& other : b.writes) {
        if (other.value > 0.0f && thing_of(other.cell) == thing) return Disagreement{write.cell, other.cell};
      }
      return Disagreement{write.cell, CellId::kNone};
    }
    return std::nullopt;
  }

  /// Two members of an exclusive group, if each rule raises one and sets the other to unknown (`+A, B = 0`). No signs contradict each
  /// other, so a tick reports nothing, but the mean leaves both members half high.
  [[nodiscard]] std::optional<Disagreement> raised_apart(std::uint32_t thing, const Rule& a, const Rule& b) const {
    if (thing < program_.cells.size()) return std::nullopt;
    const auto raised = [&](const Rule& rule) -> std::optional<CellId> {
      for (const Write& write : rule.writes) {
        if (write.value > 0.0f && thing_of(write.cell) == thing) return write.cell;
      }
      return std::nullopt;
    };
    const std::optional<CellId> x = raised(a), y = raised(b);
    if (!x || !y || *x == *y) return std::nullopt;
    return Disagreement{*x, *y};
  }

  /// A cell of this contest that one of two resets raises and the other lowers, perhaps only by putting it back.
  [[nodiscard]] std::optional<Disagreement> between_resets(const Rule& a, const Rule& b) const {
    for (const CellId cell : reset_here_) {
      const float x = program::net_value(program_, subject_.group_of, a, cell).value_or(0.0f);
      const float y = program::net_value(program_, subject_.group_of, b, cell).value_or(0.0f);
      if (x * y < 0.0f) return Disagreement{cell, CellId::kNone};
    }
    return std::nullopt;
  }

  void compare(std::uint32_t thing, std::uint32_t first, std::uint32_t second) {
    const Rule& a = program_.rules[first];
    const Rule& b = program_.rules[second];
    if (a.reset != b.reset) return;  // a reset silences the others
    if (found_.size() >= kMostFindings) {
      gave_up_ = "more pairs of rules disagree than are shown";
      return;
    }
    const std::pair families{subject_.family[first], subject_.family[second]};
    const auto known = found_.find(families);
    if (known != found_.end() && (known->second.pairs.size() >= kMostCounted || known->second.pairs.contains({first, second}))) return;
    if (!compatible(demands(first), demands(second))) return;
    std::optional<Disagreement> about = raised_against(thing, a, b);
    if (!about) {
      about = raised_against(thing, b, a);
      if (about && about->other != CellId::kNone) std::swap(about->cell, about->other);
    }
    if (!about) about = raised_apart(thing, a, b);
    if (!about && a.reset) about = between_resets(a, b);
    if (!about || fired_before(a, b) || fired_before(b, a) || !can_fire_together(a, b)) return;
    Finding& finding = known != found_.end() ? known->second : found_.emplace(families, Finding{RuleId{first}, RuleId{second}, *about, {}}).first->second;
    finding.pairs.emplace(first, second);
  }

  /// Whether `rule` has fired before `timed` can: all that `rule` asks for must have held for a while for `timed` to fire, so it held on the
  /// tick before, when `rule` fired (`when F`, `when F for 1 s`). Not if `rule` writes what it asks for, since then it may be armed again.
  [[nodiscard]] bool fired_before(const Rule& rule, const Rule& timed) const {
    if (rule.mode != program::Mode::kWhen) return false;
    std::set<program::CondId> held;
    for (const program::CondId part : program::conjuncts(program_, timed.condition)) {
      const program::Cond& cond = program_[part];
      if (cond.op != program::Cond::Op::kFor || cond.duration_us == 0) continue;
      for (const program::CondId of_it : program::conjuncts(program_, cond.children.front())) held.insert(of_it);
    }
    const std::vector<program::CondId> asked = program::conjuncts(program_, rule.condition);
    return !held.empty() && std::all_of(asked.begin(), asked.end(), [&](program::CondId part) { return held.contains(part) && !asks_what_it_writes(rule, part); });
  }

  [[nodiscard]] bool asks_what_it_writes(const Rule& rule, program::CondId condition) const {
    const program::Cond& cond = program_[condition];
    if (!program::has_parts(cond.op)) return program::net_value(program_, subject_.group_of, rule, cond.cell).has_value();
    return std::any_of(cond.children.begin(), cond.children.end(), [&](program::CondId part) { return asks_what_it_writes(rule, part); });
  }

  /// Whether the rule fires on the first tick and never again: it asks for a satellite that begins high, lowers it, and nothing raises it.
  [[nodiscard]] bool fires_once(const Rule& rule) const {
    const program::Cond& asked = program_[rule.condition];
    const bool high = asked.op == program::Cond::Op::kIs && asked.term == program::Term::kHigh && static_cast<double>(program_[asked.cell].initial) >= program_.settings.firing;
    if (!high || subject_.raiser[program::index(asked.cell)] != RuleId::kNone || std::ranges::any_of(program_.rules, &Rule::reset)) return false;
    return program::net_value(program_, subject_.group_of, rule, asked.cell).value_or(1.0f) < 0.0f;
  }

  /// The first tick makes no events.
  [[nodiscard]] bool waits_for_event(const Rule& rule) const {
    const std::vector<program::CondId> asked = program::conjuncts(program_, rule.condition);
    return std::ranges::any_of(asked, [this](program::CondId part) { return program_[part].op == program::Cond::Op::kEvent || program_[part].op == program::Cond::Op::kLost; });
  }

  /// A question that cannot be settled within the budget counts as yes.
  [[nodiscard]] bool can_fire_together(const Rule& a, const Rule& b) {
    if ((fires_once(a) && waits_for_event(b)) || (fires_once(b) && waits_for_event(a))) return false;
    const Goal goals[] = {{a.condition, true}, {b.condition, true}};
    return satisfier_.together(goals, a.level) != Answer::kNo;
  }

  Subject& subject_;
  const Program& program_;
  Satisfier& satisfier_;
  std::unordered_map<std::uint32_t, Demands> demands_;   // of rules of one level; looked up, never iterated
  std::size_t demanded_ = 0;                             // the number of single demands in it
  std::vector<std::uint8_t> contested_;                  // by thing: whether a rule of the level raises it, and lowers it
  std::vector<CellId> reset_;                            // ascending: what rules with `reset` also write in this level
  std::vector<CellId> reset_here_;                       // those of this contest
  std::uint64_t pairs_ = 0;
  std::string_view gave_up_;                             // why conflicts of this level that may be left are not looked for; empty if none are
  Findings found_;
};

}  // namespace

void diagnose_conflicts(Subject& subject) { ConflictQuestions(subject).run(); }

}  // namespace kb::analysis
