#include "sim/batch/ending.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kb::sim::batch {

Ending ending_of(const Summary& summary) {
  Ending ending;
  ending.outcome = kOutcomes[static_cast<std::size_t>(summary.outcome)];
  ending.reports = fmt::format("{}", fmt::join(summary.reports, "+"));
  ending.time_s = summary.time_s;
  ending.length_m = summary.length_m;
  ending.collisions = static_cast<std::uint32_t>(summary.collisions.size());
  ending.bans_broken = static_cast<std::uint32_t>(summary.faults.size());
  ending.lost_unaware = summary.lost_unaware();
  ending.standing_contacts = static_cast<std::uint32_t>(summary.standing_contacts.size());
  ending.touched_s = summary.touched_s;
  ending.impact_m_s = summary.impact_m_s();
  if (summary.closest) ending.closest_m = summary.closest->gap_m;
  ending.missed = static_cast<std::uint32_t>(summary.missed.size());
  return ending;
}

bool says_why(const Ending& ending) { return ending.outcome != "arrived" && ending.outcome != "time_up" && !ending.reports.empty(); }

void Tally::add(const Ending& ending, double time, double length) {
  ++runs;
  collided += ending.collisions > 0 ? 1 : 0;
  broke_bans += ending.bans_broken > 0 ? 1 : 0;
  lost_unaware += ending.lost_unaware ? 1 : 0;
  if (ending.outcome == "arrived") {
    ++arrived;
    times.push_back(time);
    lengths.push_back(length);
  } else if (batch::says_why(ending)) {
    ++says_why;
  } else {
    ++silent;
  }
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

namespace {

/// With as many decimal places, at least one, as keep some from looking like none, and most from looking like all.
std::string figure(double percent) {
  const auto misleads = [](const std::string& text) { return text.starts_with("100") || text.find_first_not_of("0.") == std::string::npos; };
  std::string text = fmt::format("{:.1f}", percent);
  if (percent <= 0.0 || percent >= 100.0) return text;
  for (int places = 2; misleads(text); ++places) text = fmt::format("{:.{}f}", percent, places);
  return text;
}

}  // namespace

std::string percent(std::size_t part, std::size_t all) {
  return all == 0 ? "-" : figure(100.0 * static_cast<double>(part) / static_cast<double>(all)) + " %";
}

std::string percent_between(std::size_t part, std::size_t all) {
  if (all == 0) return "-";
  constexpr double kZ = 1.959963984540054;   // 97.5 % of a normal distribution lie below
  const auto n = static_cast<double>(all);
  const double share = static_cast<double>(part) / n, scale = 1.0 + kZ * kZ / n;
  const double middle = (share + kZ * kZ / (2.0 * n)) / scale;
  const double half = kZ / scale * std::sqrt(share * (1.0 - share) / n + kZ * kZ / (4.0 * n * n));
  const double low = part == 0 ? 0.0 : middle - half, high = part == all ? 1.0 : middle + half;   // rounding would come near these two only
  return fmt::format("{} ({} to {})", percent(part, all), figure(100.0 * low), figure(100.0 * high));
}

}  // namespace kb::sim::batch
