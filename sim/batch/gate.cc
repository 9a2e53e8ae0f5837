#include "sim/batch/gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "compiler/source/encoding.h"
#include "compiler/source/numbers.h"
#include "sim/batch/fields.h"

namespace kb::sim::batch {
namespace {

/// What a run can be counted for besides its outcome; computed from the columns of its row.
struct Counted {
  std::string_view name;
  bool (*is)(const Run& run);
};
constexpr std::array kCounted{
    Counted{"says_why", [](const Run& run) { return says_why(run); }},
    Counted{"silent", [](const Run& run) { return run.outcome != kOutcomes[0] && !says_why(run); }},
    Counted{"collisions", [](const Run& run) { return run.collisions > 0; }},
    Counted{"bans_broken", [](const Run& run) { return run.bans_broken > 0; }},
    Counted{"lost_unaware", [](const Run& run) { return run.lost_unaware; }},
    Counted{"standing_contacts", [](const Run& run) { return run.standing_contacts > 0; }},
    Counted{"missed", [](const Run& run) { return run.missed > 0; }},
};

bool is(const Run& run, std::size_t kind) { return kind < kOutcomes.size() ? run.outcome == kOutcomes[kind] : kCounted[kind - kOutcomes.size()].is(run); }

std::optional<std::size_t> find_kind(std::string_view name) {
  for (std::size_t i = 0; i < kOutcomes.size(); ++i) {
    if (name == kOutcomes[i]) return i;
  }
  for (std::size_t i = 0; i < kCounted.size(); ++i) {
    if (name == kCounted[i].name) return kOutcomes.size() + i;
  }
  return std::nullopt;
}

std::string all_kinds() {
  std::string all;
  for (const std::string_view name : kOutcomes) all += fmt::format("{}`{}`", all.empty() ? "" : ", ", name);
  for (const Counted& counted : kCounted) all += fmt::format(", `{}`", counted.name);
  return all;
}

struct Written { std::string_view text; Demand::Sign sign; };
constexpr std::array kSigns{Written{">=", Demand::Sign::kAtLeast}, Written{"<=", Demand::Sign::kAtMost}, Written{">", Demand::Sign::kAbove},
                            Written{"<", Demand::Sign::kBelow}, Written{"=", Demand::Sign::kExactly}};

// A percentage of so many decimal places, multiplied by kMostRuns, still fits in 64 bits.
constexpr std::size_t kMostPlaces = 9;
static_assert(kMostRuns * 100u <= UINT64_MAX / 1'000'000'000u);

/// Reads `64.4` as 644 and 10: no double is that number.
bool read_decimal(std::string_view text, std::uint64_t& number, std::uint64_t& scale) {
  const std::size_t point = text.find('.');
  std::string_view places = point == std::string_view::npos ? std::string_view() : text.substr(point + 1);
  while (places.ends_with('0')) places.remove_suffix(1);
  if (places.size() > kMostPlaces) return false;
  for (std::size_t i = 0; i < places.size(); ++i) scale *= 10;
  return source::read_number(fmt::format("{}{}", text.substr(0, point), places), number);
}

std::optional<Demand> read_demand(std::string_view text, std::string& why) {
  const std::size_t at = text.find_first_of("<>=");
  if (at == std::string_view::npos) {
    why = fmt::format("`{}` has no number behind `>=`, `<=`, `>`, `<` or `=`", text);
    return std::nullopt;
  }
  const Written& sign = *std::find_if(kSigns.begin(), kSigns.end(), [&](const Written& one) { return text.substr(at).starts_with(one.text); });
  const std::string_view name = source::trimmed(text.substr(0, at));
  std::string_view number = source::trimmed(text.substr(at + sign.text.size()));
  Demand demand{sign.sign, std::string(text), 0, 0, 1, number.ends_with('%')};
  if (demand.share) number = source::trimmed(number.substr(0, number.size() - 1));
  const auto kind = find_kind(name);
  const bool good = read_decimal(number, demand.number, demand.scale) && (demand.share ? demand.number <= 100 * demand.scale : demand.scale == 1);
  if (!kind) why = fmt::format("nothing is counted that is called `{}`, but {}", name, all_kinds());
  else if (!good) why = fmt::format("`{}` wants a whole number of runs, or percent up to 100% with at most {} decimal places", text, kMostPlaces);
  if (!kind || !good) return std::nullopt;
  demand.kind = *kind;
  return demand;
}

bool holds(const Demand& demand, std::size_t count, std::size_t runs) {
  // Both sides are multiplied by the number of runs, so that they are whole numbers: a share such as 1/3 has no exact decimals.
  const std::uint64_t found = count * (demand.share ? 100 * demand.scale : 1);
  const std::uint64_t wanted = demand.number * (demand.share ? runs : 1);
  switch (demand.sign) {
    case Demand::Sign::kAtLeast: return found >= wanted;
    case Demand::Sign::kAtMost: return found <= wanted;
    case Demand::Sign::kAbove: return found > wanted;
    case Demand::Sign::kBelow: return found < wanted;
    case Demand::Sign::kExactly: return found == wanted;
  }
  return false;
}

}  // namespace

std::optional<std::vector<Demand>> read_demands(std::string_view text, std::string& why) {
  std::vector<Demand> demands;
  while (true) {
    const std::size_t comma = text.find(',');
    auto demand = read_demand(source::trimmed(text.substr(0, comma)), why);
    if (!demand) return std::nullopt;
    demands.push_back(std::move(*demand));
    if (comma == std::string_view::npos) return demands;
    text.remove_prefix(comma + 1);
  }
}

std::vector<Unmet> unmet(const std::vector<Demand>& demands, const Batch& batch, const std::vector<Run>& runs) {
  const std::size_t scenarios = batch.scenarios().size();
  std::vector<std::size_t> of(scenarios, 0), counts(scenarios * demands.size(), 0);   // by scenario, then by demand
  for (const Run& run : runs) {
    ++of[run.scenario];
    for (std::size_t d = 0; d < demands.size(); ++d) counts[run.scenario * demands.size() + d] += is(run, demands[d].kind) ? 1 : 0;
  }
  std::vector<Unmet> all;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const Demand& demand = demands[i % demands.size()];
    const std::size_t scenario = i / demands.size(), runs_there = of[scenario];
    if (!holds(demand, counts[i], runs_there)) all.push_back({scenario, demand.text, fmt::format("{} of {} runs ({})", counts[i], runs_there, percent(counts[i], runs_there))});
  }
  return all;
}

}  // namespace kb::sim::batch
