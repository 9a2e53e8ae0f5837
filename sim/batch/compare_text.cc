// Prints comparisons, as Markdown for people and as CSV for programs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "sim/batch/compare.h"

namespace kb::sim::batch {
namespace {

std::string chance(const ComparedRow::Count& count) {
  if (count.only_before + count.only_after == 0) return "-";
  const double p = chance_of(count.only_before, count.only_after);
  return p < 0.0005 ? "< 0.001" : fmt::format("{:.3f}", p);
}

std::string table_row(const std::string& name, const ComparedRow& row) {
  const ComparedRow::Count& arrive = row.counts[0];
  std::string out = fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |", name, row.pairs, percent(arrive.before, row.pairs), percent(arrive.after, row.pairs),
                                arrive.only_before, arrive.only_after, chance(arrive), quantiles(row.times, 2), quantiles(row.lengths, 2));
  for (std::size_t i = 1; i < row.counts.size(); ++i) out += fmt::format(" {}, {} |", row.counts[i].before, row.counts[i].after);
  return out + "\n";
}

ComparedRow together(const Comparison& comparison) {
  ComparedRow all;
  for (const Pair& pair : comparison.pairs) all.add(pair);
  return all;
}

std::string ending_text(const Ending& ending) {
  std::string text = ending.outcome + (ending.reports.empty() ? "" : ": " + ending.reports);
  if (arrives(ending)) text += fmt::format(", {:.1f} s", ending.time_s);
  return collides(ending) ? text + fmt::format(", {} collision{}", ending.collisions, ending.collisions == 1 ? "" : "s") : text;
}

std::string list_row(const Comparison& comparison, const Pair& pair) {
  const std::string which = which_of(comparison, pair);
  std::string cells = "|";
  for (std::size_t i = 0; i < comparison.which.size(); ++i) cells += fmt::format(" {} |", field(which, i));
  return fmt::format("{} {} | {} |\n", cells, ending_text(pair.before->ending), ending_text(pair.after->ending));
}

/// A list of runs of which something holds on one side only.
struct Kind {
  std::string_view title;
  std::size_t what;   ///< of kHappenings
  bool in_new;

  [[nodiscard]] bool has(const Pair& pair) const {
    const auto is = kHappenings[what].is;
    return is(pair.after->ending) == in_new && is(pair.before->ending) != in_new;
  }
};
constexpr std::array kKinds{Kind{"arrive in OLD only", 0, false}, Kind{"arrive in NEW only", 0, true}, Kind{"collide in NEW only", 1, true},
                            Kind{"break bans in NEW only", 2, true}, Kind{"are lost without knowing it in NEW only", 3, true}};

std::string list(const Comparison& comparison, const Kind& kind, std::size_t most) {
  std::string rows;
  std::size_t count = 0;
  for (const Pair& pair : comparison.pairs) {
    if (kind.has(pair) && ++count <= most) rows += list_row(comparison, pair);
  }
  if (count == 0) return {};
  std::string out = fmt::format("\nRuns that {}: {}\n\n| {} | OLD | NEW |\n|", kind.title, count, fmt::join(comparison.which, " | "));
  for (std::size_t i = 0; i < comparison.which.size() + 2; ++i) out += "---|";
  out += "\n" + rows;
  return count > most ? out + fmt::format("\n... and {} more\n", count - most) : out;
}

}  // namespace

std::string name_of(const Comparison& comparison, const ComparedRow& row) {
  std::string name;
  for (std::size_t i = 0; i < row.values.size(); ++i) {
    const bool setting = comparison.columns[i].find_first_of(".") != std::string::npos || comparison.columns[i] == "limit";
    name += (name.empty() ? "" : ", ") + (setting ? comparison.columns[i] + "=" : std::string()) + row.values[i];
  }
  return name;
}

std::string summarise(const Comparison& comparison, std::size_t most) {
  std::string out = fmt::format("| {} | runs | arrive in OLD | in NEW | in OLD only | in NEW only | p | time, NEW / OLD: 5 % / median / 95 % | length, NEW / OLD | with collisions: "
                                "OLD, NEW | bans broken | lost without knowing it | touched while they stand |\n|", fmt::join(comparison.columns, " | "));
  for (std::size_t i = 0; i < comparison.columns.size(); ++i) out += "---|";
  for (std::size_t i = 0; i < 8 + kHappenings.size() - 1; ++i) out += "---:|";
  out += "\n";
  for (const ComparedRow& row : comparison.rows) out += table_row(fmt::format("{}", fmt::join(row.values, " | ")), row);
  if (comparison.rows.size() > 1) {
    std::string name = "all";
    for (std::size_t i = 1; i < comparison.columns.size(); ++i) name += " | ";
    out += table_row(name, together(comparison));
  }
  const std::string before_lists = out;
  for (const Kind& kind : kKinds) out += list(comparison, kind, most);
  return out.size() == before_lists.size() ? out + "\nNo run ends otherwise.\n" : out;
}

std::string print_pairs(const Comparison& comparison) {
  std::string out = fmt::format("{}", fmt::join(comparison.which, ","));
  for (const std::string_view side : {"old", "new"}) {
    for (const std::string& name : comparison.measured) out += fmt::format(",{}_{}", side, name);
  }
  out += "\n";
  for (const Pair& pair : comparison.pairs) {
    out += fmt::format("{},{},{}\n", which_of(comparison, pair), pair.before->measured, pair.after->measured);
  }
  return out;
}

}  // namespace kb::sim::batch
