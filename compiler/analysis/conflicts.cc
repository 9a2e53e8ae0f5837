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
//
// note [put back]
// A reset silences all rules but other resets, and puts back what it does not write, so it disagrees with a reset that writes that. If each
// of many resets writes a cell of its own, each of these cells is contested by all of them. So they are no writers of the cell; those that write it
// are compared with the others, which stand in buckets once for all cells.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "compiler/analysis/apart_in_time.h"
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
constexpr std::string_view kTooMany = "too many of them write the same cells";

// What the rules of a level do to a thing.
constexpr std::uint8_t kRaised = 1, kLowered = 2, kContested = kRaised | kLowered;

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
    put_back_.resize(contested_.size());
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

  /// Calls `f(rule, thing, raises, lowers)` for all that rules in [begin, end) write by name or clear, except rules that the compiler made.
  template <class F>
  void for_each_write_of(std::uint32_t begin, std::uint32_t end, F&& f) const {
    for (std::uint32_t i = begin; i < end; ++i) {
      const Rule& rule = program_.rules[i];
      if (Subject::generated(rule)) continue;
      for (const Write& write : rule.writes) f(i, thing_of(write.cell), write.value > 0.0f, write.value < 0.0f);
      for (const std::uint32_t group : rule.clears) f(i, thing_of_group(group), false, true);
    }
  }

  /// Finds what some rules with `reset` write in this level and others only put back: see note [put back].
  void find_put_back(std::uint32_t begin, std::uint32_t end) {
    std::vector<std::uint32_t> cleared;
    std::vector<CellId> written;   // without the members of groups that the same rule clears
    resets_.clear();
    for (std::uint32_t i = begin; i < end; ++i) {
      const Rule& rule = program_.rules[i];
      if (!rule.reset) continue;
      resets_.push_back(i);
      cleared.insert(cleared.end(), rule.clears.begin(), rule.clears.end());
      for (const Write& write : rule.writes) {
        if (!std::ranges::binary_search(rule.clears, subject_.group_of[program::index(write.cell)])) written.push_back(write.cell);
        reset_.push_back(write.cell);
      }
    }
    source::sort_unique(reset_);
    std::ranges::sort(cleared);
    std::ranges::sort(written);
    const auto count = [](const auto& sorted, auto x) {
      const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), x);
      return static_cast<std::size_t>(last - first);
    };
    for (const CellId cell : reset_) {
      const std::size_t by_name = count(written, cell), with_group = count(cleared, subject_.group_of[program::index(cell)]);
      const float back = program_[cell].keep ? 0.0f : program_[cell].initial;
      if (by_name + with_group == resets_.size() || back == 0.0f) continue;
      put_back_[thing_of(cell)] |= back > 0.0f ? kRaised : kLowered;
      if (back > 0.0f) put_up_.emplace(thing_of(cell), cell);
    }
  }

  /// Most things are contested by nobody. Those are sorted out first, with a few bits for each thing.
  void search_level(std::uint32_t begin, std::uint32_t end) {
    find_put_back(begin, end);
    for (const CellId cell : reset_) contested_[thing_of(cell)] |= put_back_[thing_of(cell)];
    for_each_write_of(begin, end, [&](std::uint32_t, std::uint32_t thing, bool raises, bool lowers) {
      contested_[thing] = static_cast<std::uint8_t>(contested_[thing] | (raises ? kRaised : 0) | (lowers ? kLowered : 0));
    });
    std::map<std::uint32_t, Contest> contests;
    for_each_write_of(begin, end, [&](std::uint32_t rule, std::uint32_t thing, bool raises, bool lowers) {
      if (contested_[thing] != kContested || !demands(rule).possible) return;
      Contest& contest = contests[thing];
      const std::uint8_t back = program_.rules[rule].reset ? put_back_[thing] : 0;
      if (contest.writers.empty() || contest.writers.back().rule != rule) contest.writers.push_back({rule, (back & kRaised) != 0});
      contest.writers.back().raises = contest.writers.back().raises || raises;
      contest.raised = contest.raised || raises || (back & kRaised) != 0;
      contest.lowered = contest.lowered || lowers || (back & kLowered) != 0;
    });
    for (const auto& [thing, contest] : contests) {
      if (contest.raised && contest.lowered && contest.writers.size() > 1) search_contest(thing, contest.writers);
      if (put_back_[thing] != 0) search_put_back(thing, contest.writers);
    }
    if (!gave_up_.empty()) report_incomplete(program_.rules[begin].level, gave_up_);
    gave_up_ = {};
    for_each_write_of(begin, end, [&](std::uint32_t, std::uint32_t thing, bool, bool) { contested_[thing] = put_back_[thing] = 0; });
    reset_.clear();
    put_up_.clear();
    kept_apart_.reset();
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

  /// Writers by the member of `choice` that they demand, and those that demand none.
  struct Buckets {
    std::optional<std::uint32_t> choice;
    std::map<std::uint32_t, std::vector<Writer>> by_member;
    std::vector<Writer> unkeyed;
  };

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
      gave_up_ = kTooMany;
      return;
    }
    pairs_ += key.pairs;
    const Buckets buckets = in_buckets(writers, key);
    for (const auto& [member, bucket] : buckets.by_member) {
      compare_all(thing, bucket);
      for (const Writer& keyed : bucket) {
        for (const Writer& free : buckets.unkeyed) {
          if (keyed.raises || free.raises) compare(thing, std::min(keyed.rule, free.rule), std::max(keyed.rule, free.rule));
        }
      }
    }
    compare_all(thing, buckets.unkeyed);
  }

  [[nodiscard]] Buckets in_buckets(const std::vector<Writer>& writers, const Key& key) {
    Buckets buckets{key.choice, {}, {}};
    for (const Writer& writer : writers) {
      const auto member = demanded_of(writer.rule, key.choice);
      (member ? buckets.by_member[*member] : buckets.unkeyed).push_back(writer);
    }
    return buckets;
  }

  /// The member of the choice that the rule demands.
  [[nodiscard]] std::optional<std::uint32_t> demanded_of(std::uint32_t rule, const std::optional<std::uint32_t>& choice) {
    const std::vector<Holder>& holders = demands(rule).holders;
    const auto holder = std::ranges::find_if(holders, [&](const Holder& h) { return h.choice == choice; });
    return holder == holders.end() ? std::nullopt : std::optional(holder->variable);
  }

  /// Each reset that writes the thing with the resets that may put it back. See note [put back].
  void search_put_back(std::uint32_t thing, const std::vector<Writer>& writers) {
    if (!kept_apart_) {
      std::vector<Writer> resets;
      for (const std::uint32_t rule : resets_) {
        if (demands(rule).possible) resets.push_back({rule, true});
      }
      kept_apart_ = in_buckets(resets, best_key(resets));
    }
    const auto compare_with = [&](const Writer& writer, const std::vector<Writer>& others) {
      pairs_ += others.size();
      for (const Writer& other : others) {
        if (other.rule != writer.rule) compare(thing, std::min(writer.rule, other.rule), std::max(writer.rule, other.rule));
      }
    };
    for (const Writer& writer : writers) {
      if (!program_.rules[writer.rule].reset || (!writer.raises && (put_back_[thing] & kRaised) == 0)) continue;
      if (pairs_ > kMostPairsInAll) gave_up_ = kTooMany;
      if (!gave_up_.empty()) return;
      const auto member = demanded_of(writer.rule, kept_apart_->choice);
      for (const auto& [of, bucket] : kept_apart_->by_member) {
        if (!member || *member == of) compare_with(writer, bucket);
      }
      compare_with(writer, kept_apart_->unkeyed);
    }
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

  /// A cell of the thing that one of two resets puts back to high and the other lowers.
  [[nodiscard]] std::optional<Disagreement> between_resets(std::uint32_t thing, const Rule& a, const Rule& b) const {
    for (auto [at, end] = put_up_.equal_range(thing); at != end; ++at) {
      const float x = program::net_value(program_, subject_.group_of, a, at->second).value_or(0.0f);
      const float y = program::net_value(program_, subject_.group_of, b, at->second).value_or(0.0f);
      if (x * y < 0.0f) return Disagreement{at->second, CellId::kNone};
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
    if (!about && a.reset) about = between_resets(thing, a, b);
    if (!about || apart_in_time(subject_, a, b) || !can_fire_together(a, b)) return;
    Finding& finding = known != found_.end() ? known->second : found_.emplace(families, Finding{RuleId{first}, RuleId{second}, *about, {}}).first->second;
    finding.pairs.emplace(first, second);
  }

  /// A question that cannot be settled within the budget counts as yes.
  [[nodiscard]] bool can_fire_together(const Rule& a, const Rule& b) {
    const Goal goals[] = {{a.condition, true}, {b.condition, true}};
    return satisfier_.together(goals, a.level) != Answer::kNo;
  }

  Subject& subject_;
  const Program& program_;
  Satisfier& satisfier_;
  std::unordered_map<std::uint32_t, Demands> demands_;   // of rules of one level; looked up, never iterated
  std::size_t demanded_ = 0;                             // the number of single demands in it
  std::vector<std::uint8_t> contested_;                  // by thing: whether a rule of the level raises it, and lowers it
  std::vector<std::uint8_t> put_back_;                   // by thing: the same for resets that do not write it
  std::vector<std::uint32_t> resets_;                    // rules of the level with `reset`
  std::vector<CellId> reset_;                            // ascending: what they also write
  std::multimap<std::uint32_t, CellId> put_up_;          // by thing: those cells that a reset puts back to high
  std::optional<Buckets> kept_apart_;                    // `resets_`, once they are asked for
  std::uint64_t pairs_ = 0;
  std::string_view gave_up_;                             // why conflicts of this level that may be left are not looked for; empty if none are
  Findings found_;
};

}  // namespace

void diagnose_conflicts(Subject& subject) { ConflictQuestions(subject).run(); }

}  // namespace kb::analysis
