#include "compiler/analysis/domains.h"

#include <algorithm>
#include <cmath>

#include "compiler/program/net_effects.h"

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

std::vector<Range> written_ranges(const Program& program) {
  std::vector<Range> ranges(program.cells.size());
  std::vector<bool> cleared(program.exclusive.size(), false);
  bool resets = false;
  for (const Rule& rule : program.rules) {
    for (const program::Write& write : rule.writes) ranges[program::index(write.cell)].add(write.value);
    for (const std::uint32_t group : rule.clears) cleared[group] = true;
    resets = resets || rule.reset;
  }
  for (std::size_t group = 0; group < program.exclusive.size(); ++group) {
    if (!cleared[group]) continue;
    for (const CellId member : program.exclusive[group]) ranges[program::index(member)].add(-1.0f);
  }
  for (std::size_t i = 0; resets && i < program.cells.size(); ++i) {
    const program::Cell& cell = program.cells[i];
    if (cell.kind == CellKind::kSatellite && !cell.keep) ranges[i].add(cell.initial);
  }
  return ranges;
}

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

Domains find_domains(const Program& program) {
  const auto firing = static_cast<float>(program.settings.firing);
  Domains domains = widest_domains(program);
  Intervals intervals(firing);
  const std::vector<Range> ranges = written_ranges(program);
  for (std::size_t i = 0; i < program.cells.size(); ++i) {
    if (program.cells[i].kind != CellKind::kSatellite) continue;
    Regions regions = region_of(program.cells[i].initial, firing);
    if (ranges[i].least <= ranges[i].most) {
      regions = static_cast<Regions>(regions | intervals.between(ranges[i].least, ranges[i].most));
    }
    domains.cells[i] = regions;
  }
  // Only `run[...]` writes a strategy, if one of its satellites is high. The strategy that runs because of `idle` is not written.
  for (std::size_t i = 0; i < program.cells.size(); ++i) {
    if (program.cells[i].kind != CellKind::kStrategy) continue;
    if (!attended_at_times(program, domains, CellId{static_cast<std::uint32_t>(i)})) domains.cells[i] = region_of(-1.0f, firing);
  }
  return domains;
}

}  // namespace kb::analysis
