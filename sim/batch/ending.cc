#include "sim/batch/ending.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compiler/source/numbers.h"

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
  ending.last_moved_s = summary.last_moved_s;
  return ending;
}

std::string print_measures(const Ending& ending) {
  const std::string closest = ending.closest_m == kNothingNear ? std::string() : fmt::format("{:.3f}", ending.closest_m);
  return fmt::format("{},{},{},{},{:.2f},{:.2f},{},{},{:.1f}", ending.collisions, ending.bans_broken, ending.lost_unaware ? 1 : 0, ending.standing_contacts,
                     ending.touched_s, ending.impact_m_s, closest, ending.missed, ending.last_moved_s);
}

bool read_measures(std::span<const std::string_view, kMeasureCount> fields, Ending& ending) {
  using source::read_number;
  std::uint32_t unaware = 0;
  const bool good = read_number(fields[0], ending.collisions) && read_number(fields[1], ending.bans_broken) && read_number(fields[2], unaware) && unaware < 2 &&
                    read_number(fields[3], ending.standing_contacts) && read_number(fields[4], ending.touched_s) && read_number(fields[5], ending.impact_m_s) &&
                    (fields[6].empty() || read_number(fields[6], ending.closest_m)) && read_number(fields[7], ending.missed) &&
                    read_number(fields[8], ending.last_moved_s);
  ending.lost_unaware = unaware == 1;
  return good;
}

bool is_possible(const Ending& ending, double limit_s, std::size_t events) {
  constexpr double kMostSpeed = 1000.0;   // m/s; nothing in a scenario comes near it
  const double most_s = limit_s + 2.0;    // the tick in which the time is up, at most 1 s long, is driven to its end
  const auto within = [](double value, double most) { return value >= 0.0 && value <= most; };
  return within(ending.time_s, most_s) && within(ending.length_m, kMostSpeed * most_s) && within(ending.touched_s, most_s) && within(ending.impact_m_s, kMostSpeed) &&
         (ending.closest_m == kNothingNear || ending.closest_m >= 0.0) && ending.missed <= events && within(ending.last_moved_s, ending.time_s);
}

bool says_why(const Ending& ending) { return !arrives(ending) && ending.outcome != "time_up" && !ending.reports.empty(); }

void Tally::add(const Ending& ending, double time, double length) {
  ++runs;
  collided += collides(ending) ? 1 : 0;
  broke_bans += breaks_bans(ending) ? 1 : 0;
  lost_unaware += is_lost_unaware(ending) ? 1 : 0;
  if (arrives(ending)) {
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

std::string quantiles(const std::vector<double>& values, int digits) {
  if (values.empty()) return "-";
  return fmt::format("{1:.{0}f} / {2:.{0}f} / {3:.{0}f}", digits, quantile(values, 0.05), quantile(values, 0.5), quantile(values, 0.95));
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
