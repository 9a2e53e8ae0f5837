#include "sim/batch/compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace kb::sim::batch {
namespace {

/// Columns that tell one run from others that are counted with it.
constexpr std::array<std::string_view, 6> kOfOneRun{"seed", "robot", "noise", "labyrinth", "route", "kinds"};

bool happens(const Ending& ending, std::size_t what) {
  switch (what) {
    case 0: return ending.outcome == kOutcomes[0];
    case 1: return ending.collisions > 0;
    case 2: return ending.bans_broken > 0;
    case 3: return ending.lost_unaware;
    default: return ending.standing_contacts > 0;
  }
}

/// One of the two results, without the column that says which side a row is on.
struct Side {
  const Results& results;
  std::optional<std::size_t> column;   // of Between
  std::string value;                   // what it must be there

  [[nodiscard]] std::vector<std::string> without(const std::vector<std::string>& which) const {
    std::vector<std::string> rest = which;
    if (column) rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(*column));
    return rest;
  }
  [[nodiscard]] bool has(const ResultRow& row) const { return !column || row.which[*column] == value; }
  [[nodiscard]] std::string values() const {
    std::set<std::string> all;
    for (const ResultRow& row : results.rows) all.insert(row.which[*column]);
    return fmt::format("{}", fmt::join(all, "`, `"));
  }
};

std::variant<Side, std::string> side_of(const Results& results, const Between& between, const std::string& value) {
  Side side{results, std::nullopt, value};
  if (between.column.empty()) return side;
  const auto found = std::find(results.which.begin(), results.which.end(), between.column);
  if (found == results.which.end()) return fmt::format("there is no column `{}`; runs are told apart by `{}`", between.column, fmt::join(results.which, "`, `"));
  side.column = static_cast<std::size_t>(found - results.which.begin());
  if (std::any_of(results.rows.begin(), results.rows.end(), [&](const ResultRow& row) { return side.has(row); })) return side;
  return fmt::format("no run has {} `{}`; there are `{}`", between.column, value, side.values());
}

std::vector<std::string> differences(const Results& before, const Results& after) {
  const std::map<std::string, std::string> old(before.made_of.begin(), before.made_of.end()), now(after.made_of.begin(), after.made_of.end());
  std::vector<std::string> differ;
  for (const auto& [name, value] : before.made_of) {
    if (!now.contains(name) || now.at(name) != value) differ.push_back(name);
  }
  for (const auto& [name, value] : after.made_of) {
    if (!old.contains(name)) differ.push_back(name);
  }
  return differ;
}

class Pairing {
 public:
  Pairing(Side before, Side after) : before_(std::move(before)), after_(std::move(after)) { out_.which = before_.without(before_.results.which); }

  std::variant<Comparison, std::string> run() {
    const std::vector<std::string> other = after_.without(after_.results.which);
    if (out_.which != other) return fmt::format("their runs are told apart by other columns, `{}` and `{}`", fmt::join(out_.which, "`, `"), fmt::join(other, "`, `"));
    out_.measured = before_.results.measured;
    if (out_.measured != after_.results.measured) return "one is of `kbc fleet`, the other of `kbc experiment`, or they are of different versions of kbc";
    out_.differ = differences(before_.results, after_.results);
    find_columns();
    for (const ResultRow& row : after_.results.rows) {
      if (!after_.has(row)) continue;
      if (!waiting_.emplace(after_.without(row.which), &row).second) return fmt::format("a run stands twice in the new results: {}", fmt::join(row.which, ", "));
    }
    for (const ResultRow& row : before_.results.rows) {
      if (before_.has(row)) take(row);
    }
    out_.only_after = waiting_.size();
    if (out_.pairs.empty()) return "they have no run in common: scenarios, settings and seeds must be the same";
    return std::move(out_);
  }

 private:
  void find_columns() {
    const bool experiment = std::find(out_.which.begin(), out_.which.end(), "class") != out_.which.end();
    for (std::size_t i = 0; i < out_.which.size(); ++i) {
      const std::string& name = out_.which[i];
      const bool of_one_run = std::find(kOfOneRun.begin(), kOfOneRun.end(), name) != kOfOneRun.end() || (experiment && name == "scenario");
      if (of_one_run) continue;
      out_.columns.push_back(name);
      named_by_.push_back(i);
    }
  }
  void take(const ResultRow& old) {
    std::vector<std::string> which = before_.without(old.which);
    const auto found = waiting_.find(which);
    if (found == waiting_.end()) return void(++out_.only_before);
    std::vector<std::string> values;
    for (const std::size_t i : named_by_) values.push_back(which[i]);
    const auto [row, is_new] = numbers_.emplace(values, out_.rows.size());
    if (is_new) out_.rows.push_back({std::move(values), 0, {}, {}, {}});
    out_.pairs.push_back({std::move(which), &old, found->second, row->second});
    out_.rows[row->second].add(out_.pairs.back());
    waiting_.erase(found);
  }

  Side before_, after_;
  Comparison out_;
  std::vector<std::size_t> named_by_;   // the columns that name a row of the table
  std::map<std::vector<std::string>, const ResultRow*> waiting_;
  std::map<std::vector<std::string>, std::size_t> numbers_;
};

}  // namespace

void ComparedRow::add(const Pair& pair) {
  const Ending &old = pair.before->ending, &now = pair.after->ending;
  ++pairs;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const bool then = happens(old, i), today = happens(now, i);
    counts[i].before += then ? 1 : 0;
    counts[i].after += today ? 1 : 0;
    counts[i].only_before += then && !today ? 1 : 0;
    counts[i].only_after += today && !then ? 1 : 0;
  }
  if (!happens(old, 0) || !happens(now, 0)) return;
  if (old.time_s > 0.0) times.push_back(now.time_s / old.time_s);
  if (old.length_m > 0.0) lengths.push_back(now.length_m / old.length_m);
}

std::variant<Comparison, std::string> compare(const Results& before, const Results& after, const Between& between) {
  auto old = side_of(before, between, between.before), now = side_of(after, between, between.after);
  for (auto* side : {&old, &now}) {
    if (auto* fault = std::get_if<std::string>(side)) return std::move(*fault);
  }
  return Pairing(std::get<Side>(std::move(old)), std::get<Side>(std::move(now))).run();
}

double chance_of(std::size_t only_before, std::size_t only_after) {
  const auto n = static_cast<double>(only_before + only_after), fewer = static_cast<double>(std::min(only_before, only_after));
  double sum = 0.0;
  for (double i = fewer, term = std::exp(std::lgamma(n + 1.0) - std::lgamma(fewer + 1.0) - std::lgamma(n - fewer + 1.0) - n * std::log(2.0)); i >= 0.0; i -= 1.0) {
    sum += term;
    term *= i / (n - i + 1.0);   // n over i - 1
    if (term < 1e-18 * sum) break;
  }
  return std::min(1.0, 2.0 * sum);
}

std::vector<Unmet> unmet(const std::vector<Demand>& demands, const Comparison& comparison) {
  std::vector<Unmet> all;
  for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
    const ComparedRow& row = comparison.rows[i];
    for (const Demand& demand : demands) {
      const bool gained = demand.kind == kHappenings;
      const ComparedRow::Count& count = row.counts[gained ? 0 : demand.kind];
      const std::size_t found = demand.kind == 0 ? count.only_before : count.only_after;
      if (!holds(demand, found, row.pairs)) all.push_back(unmet_by(demand, i, found, row.pairs));
    }
  }
  return all;
}

}  // namespace kb::sim::batch
