#include "sim/batch/compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace kb::sim::batch {
namespace {

/// Columns that tell one run from others that are counted with it.
constexpr std::array<std::string_view, 6> kOfOneRun{"seed", "robot", "noise", "labyrinth", "route", "kinds"};

/// One of the two results, without the column that says which side a row is on.
struct Side {
  const Results& results;
  std::size_t column = kNoColumn;      // of Between
  std::string value;                   // what it must be there

  [[nodiscard]] std::vector<std::string> columns() const {
    std::vector<std::string> rest = results.which;
    if (column != kNoColumn) rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(column));
    return rest;
  }
  [[nodiscard]] bool has(const ResultRow& row) const { return column == kNoColumn || field(row.which, column) == value; }
  /// What pairs have in common.
  [[nodiscard]] std::string key(const ResultRow& row) const {
    std::string key = without(row.which, column);
    if (results.noise != kNoNoise) key += fmt::format(",{}", field(row.measured, results.noise));
    return key;
  }
  [[nodiscard]] std::string values() const {
    std::set<std::string_view> all;
    for (const ResultRow& row : results.rows) all.insert(field(row.which, column));
    return fmt::format("{}", fmt::join(all, "`, `"));
  }
  static std::string without(std::string_view fields, std::size_t column) {
    if (column == kNoColumn) return std::string(fields);
    const std::string_view cut = field(fields, column);
    const auto begin = static_cast<std::size_t>(cut.data() - fields.data()), end = begin + cut.size();
    return std::string(fields.substr(0, begin == 0 ? 0 : begin - 1)) + std::string(fields.substr(begin == 0 ? std::min(end + 1, fields.size()) : end));
  }
};

std::variant<Side, std::string> side_of(const Results& results, const Between& between, const std::string& value) {
  Side side{results, kNoColumn, value};
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

/// Experiments whose runs of one number are on other floors.
constexpr std::array<std::string_view, 3> kWorlds{"seed", "labyrinths", "maze"};

class Pairing {
 public:
  Pairing(Side before, Side after) : before_(std::move(before)), after_(std::move(after)) {}

  std::variant<Comparison, std::string> run() {
    out_.which = before_.columns();
    out_.between = before_.column;
    const std::vector<std::string> other = after_.columns();
    if (out_.which != other) return fmt::format("their runs are told apart by other columns, `{}` and `{}`", fmt::join(out_.which, "`, `"), fmt::join(other, "`, `"));
    out_.measured = before_.results.measured;
    if (out_.measured != after_.results.measured) return "one is of `kbc fleet`, the other of `kbc experiment`, or they are of different versions of kbc";
    out_.differ = differences(before_.results, after_.results);
    for (const std::string_view world : kWorlds) {
      if (std::find(out_.differ.begin(), out_.differ.end(), world) != out_.differ.end()) return fmt::format("they are experiments of another {}, so the same number means another run", world);
    }
    find_columns();
    for (const ResultRow& row : after_.results.rows) {
      if (after_.has(row) && !waiting_.emplace(after_.key(row), &row).second) return twice("new", row);
    }
    for (const ResultRow& row : before_.results.rows) {
      if (before_.has(row) && !take(row)) return twice("old", row);
    }
    out_.only_after = waiting_.size() - out_.pairs.size();
    if (out_.pairs.empty()) return "they have no run in common: scenarios, settings and seeds must be the same";
    return std::move(out_);
  }

 private:
  static std::string twice(std::string_view side, const ResultRow& row) { return fmt::format("a run stands twice in the {} results: {}", side, row.which); }
  void find_columns() {
    const bool experiment = std::find(out_.which.begin(), out_.which.end(), "class") != out_.which.end();
    for (std::size_t i = 0; i < out_.which.size(); ++i) {
      const std::string& name = out_.which[i];
      const bool of_one_run = std::find(kOfOneRun.begin(), kOfOneRun.end(), name) != kOfOneRun.end() || (experiment && name == "scenario");
      if (of_one_run) continue;
      out_.columns.push_back(name);
      named_by_.push_back(before_.column <= i ? i + 1 : i);
    }
  }
  /// False if it was taken before.
  bool take(const ResultRow& old) {
    const auto found = waiting_.find(before_.key(old));
    if (found == waiting_.end()) return ++out_.only_before, true;
    const ResultRow* const now = std::exchange(found->second, nullptr);
    if (now == nullptr) return false;
    std::vector<std::string> values;
    for (const std::size_t i : named_by_) values.emplace_back(field(old.which, i));
    const auto [row, is_new] = numbers_.emplace(values, out_.rows.size());
    if (is_new) out_.rows.push_back({std::move(values), 0, {}, {}, {}});
    out_.pairs.push_back({&old, now, row->second});
    out_.rows[row->second].add(out_.pairs.back());
    return true;
  }

  Side before_, after_;
  Comparison out_;
  std::vector<std::size_t> named_by_;   // the columns of the old results that name a row of the table
  std::unordered_map<std::string, const ResultRow*> waiting_;   // new runs; null: it has its partner
  std::map<std::vector<std::string>, std::size_t> numbers_;
};

}  // namespace

void ComparedRow::add(const Pair& pair) {
  const Ending &old = pair.before->ending, &now = pair.after->ending;
  ++pairs;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const bool then = kHappenings[i].is(old), today = kHappenings[i].is(now);
    counts[i].before += then ? 1 : 0;
    counts[i].after += today ? 1 : 0;
    counts[i].only_before += then && !today ? 1 : 0;
    counts[i].only_after += today && !then ? 1 : 0;
  }
  if (!arrives(old) || !arrives(now)) return;
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

std::string which_of(const Comparison& comparison, const Pair& pair) { return Side::without(pair.before->which, comparison.between); }

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
      const bool gained = demand.kind == kHappenings.size();
      const ComparedRow::Count& count = row.counts[gained ? 0 : demand.kind];
      const std::size_t found = demand.kind == 0 ? count.only_before : count.only_after;
      if (!holds(demand, found, row.pairs)) all.push_back(unmet_by(demand, i, found, row.pairs));
    }
  }
  return all;
}

}  // namespace kb::sim::batch
