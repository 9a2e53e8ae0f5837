#include "compiler/analysis/domains.h"

#include <algorithm>
#include <cmath>


namespace kb::analysis {
namespace {

using program::CellId;
using program::CellKind;
using program::Program;
using program::Rule;

/// The regions of intervals. The last answer is kept: cells are declared in groups, so most have the same interval as the one before.
class Intervals {
 public:
  explicit Intervals(float firing) : firing_(firing) {}

  /// The regions of all values in [least, most].
  Regions between(float least, float most) {
    if (least != least_ || most != most_) regions_ = find(least, most);
    least_ = least;
    most_ = most;
    return regions_;
  }

 private:
  /// The regions of the interval's ends, and of the places within it where a term begins to hold.
  [[nodiscard]] Regions find(float least, float most) const {
    Regions regions = region_of(least, firing_) | region_of(most, firing_);
    for (const float edge : {0.0f, firing_, 1.0f - firing_, 1.0f}) {
      for (const float near : {edge, std::nextafter(edge, -2.0f), std::nextafter(edge, 2.0f)}) {
        for (const float value : {near, -near}) {
          if (value >= least && value <= most) regions = static_cast<Regions>(regions | region_of(value, firing_));
        }
      }
    }
    return regions;
  }

  float firing_;
  float least_ = 2.0f, most_ = -2.0f;   // the last interval; at first none
  Regions regions_ = 0;
};

/// The least and the most value that anything writes to a cell; nothing does if `least > most`.
struct Range {
  float least = 2.0f, most = -2.0f;
  void add(float value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

/// Finds the regions that cells can reach: see note [reached regions] in domains.h.
class Reach {
 public:
  /// `all`: whether every rule counts as one that can fire.
  explicit Reach(const Program& program, bool all = false)
      : program_(program), all_(all), firing_(static_cast<float>(program.settings.firing)), intervals_(firing_), domains_(widest_domains(program)),
        written_(program.cells.size()), cleared_(program.exclusive.size(), false) {
    const bool resets = std::any_of(program.rules.begin(), program.rules.end(), [](const Rule& rule) { return rule.reset; });
    for (std::size_t i = 0; i < program.cells.size(); ++i) {
      const program::Cell& cell = program.cells[i];
      if (cell.kind != CellKind::kSatellite) continue;
      domains_.cells[i] = region_of(cell.initial, firing_);
      if (resets && !cell.keep) written_[i].add(cell.initial);
    }
  }

  Domains run() {
    std::vector<const Rule*> waiting;
    waiting.reserve(program_.rules.size());
    for (const Rule& rule : program_.rules) waiting.push_back(&rule);
    const auto fires = [this](const Rule* rule) {
      const bool can = all_ || steps_ > kMostSteps || can_be(rule->condition, true);
      if (can) take(*rule);
      return can;
    };
    while (std::erase_if(waiting, fires) > 0) {}
    // Only `run[...]` writes a strategy, if one of its satellites is high. The strategy that runs because of `idle` is not written.
    for (std::uint32_t i = 0; i < program_.cells.size(); ++i) {
      if (program_.cells[i].kind == CellKind::kStrategy) domains_.cells[i] = regions(CellId{i});
    }
    return std::move(domains_);
  }

 private:
  static constexpr std::uint64_t kMostSteps = 50'000'000;
  static constexpr std::size_t kMostParts = 64;   // a longer condition, such as `no` over a large group, stands in many rules

  [[nodiscard]] Regions regions(CellId cell) const {
    const bool idle = program_[cell].kind == CellKind::kStrategy && !attended_at_times(program_, domains_, cell);
    return idle ? region_of(-1.0f, firing_) : domains_.cells[program::index(cell)];
  }

  /// Whether the condition can be `wanted`, as far as its cells tell one by one. Recursion as deep as conditions nest, which is limited.
  bool can_be(program::CondId id, bool wanted) {
    using Op = program::Cond::Op;
    const program::Cond& cond = program_[id];
    ++steps_;
    const auto part_can = [&](program::CondId part) { return can_be(part, wanted); };
    switch (cond.op) {
      case Op::kNot: return can_be(cond.children.front(), !wanted);
      case Op::kAnd:
      case Op::kOr:
        if (cond.children.size() > kMostParts) return true;
        return (cond.op == Op::kAnd) == wanted ? std::all_of(cond.children.begin(), cond.children.end(), part_can)
                                               : std::any_of(cond.children.begin(), cond.children.end(), part_can);
      case Op::kFor: return !wanted || can_be(cond.children.front(), true);
      case Op::kIs: return (regions(cond.cell) & (wanted ? regions_of(cond.term) : static_cast<Regions>(~regions_of(cond.term)))) != 0;
      default: return !wanted || domains_.facts[program::index(cond.cell)] != kUnseen;
    }
  }

  void take(const Rule& rule) {
    for (const program::Write& write : rule.writes) add(write.cell, write.value);
    for (const std::uint32_t group : rule.clears) {
      if (cleared_[group]) continue;
      cleared_[group] = true;
      for (const CellId member : program_.exclusive[group]) add(member, -1.0f);
    }
  }

  void add(CellId cell, float value) {
    const std::size_t i = program::index(cell);
    Range& range = written_[i];
    if (program_[cell].kind != CellKind::kSatellite || (range.least <= value && value <= range.most)) return;
    range.add(value);
    domains_.cells[i] = static_cast<Regions>(region_of(program_[cell].initial, firing_) | intervals_.between(range.least, range.most));
  }

  const Program& program_;
  bool all_;
  float firing_;
  Intervals intervals_;
  Domains domains_;               // strategies: as if each were wanted at times, until the end
  std::vector<Range> written_;    // by cell
  std::vector<bool> cleared_;     // by group
  std::uint64_t steps_ = 0;
};

}  // namespace

Regions regions_of(program::Term term) {
  switch (term) {
    case program::Term::kHigh: return kRegionHigh | kRegionHighZero;
    case program::Term::kZero: return kRegionHighZero | kRegionZero | kRegionLowZero;
    case program::Term::kLow: return kRegionLow | kRegionLowZero;
  }
  return 0;
}

Regions region_of(float value, float firing) {
  const bool zero = 1.0f - std::fabs(value) >= firing;
  if (value >= firing) return zero ? kRegionHighZero : kRegionHigh;
  if (value <= -firing) return zero ? kRegionLowZero : kRegionLow;
  return zero ? kRegionZero : kRegionNone;
}

bool can_be_high(const Domains& domains, CellId cell) {
  return (domains.cells[program::index(cell)] & regions_of(program::Term::kHigh)) != 0;
}

bool attended_at_times(const Program& program, const Domains& domains, CellId cell) {
  const auto& satellites = program[cell].satellites;
  return std::any_of(satellites.begin(), satellites.end(), [&](CellId s) { return can_be_high(domains, s); });
}

Domains widest_domains(const Program& program) {
  const auto firing = static_cast<float>(program.settings.firing);
  Domains domains;
  Intervals seen(firing), lost(firing), unseen(firing);
  domains.all = Intervals(firing).between(-1.0f, 1.0f);
  for (const program::Cell& cell : program.cells) {
    const bool runs = cell.kind == CellKind::kStrategy;
    domains.cells.push_back(runs ? static_cast<Regions>(region_of(-1.0f, firing) | region_of(1.0f, firing))
                                 : domains.all);
    if (cell.kind != CellKind::kFact) continue;
    const program::Thresholds limits = program::thresholds(cell);
    const bool visible = limits.attended < 1.0f;
    domains.facts.push_back(visible ? kAnySighting : kUnseen);
    domains.when_seen.push_back(visible ? seen.between(std::nextafter(limits.attended, 2.0f), 1.0f) : Regions{0});
    domains.when_lost.push_back(visible ? lost.between(-1.0f, limits.attended) : Regions{0});
    domains.when_unseen.push_back(unseen.between(-1.0f, std::min(limits.plain, 1.0f)));
  }
  return domains;
}

Domains find_domains(const Program& program) { return Reach(program).run(); }

Domains written_domains(const Program& program) { return Reach(program, true).run(); }

}  // namespace kb::analysis
