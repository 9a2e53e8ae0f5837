// Points in time as the formats of other programs write them.
#pragma once

#include <chrono>
#include <cstddef>
#include <string_view>

namespace kb::json {

/// Whether it is a date and a time of day with its zone, by ISO 8601 as JSON schemas want it (RFC 3339): `2026-03-02T07:45:00.00Z`.
[[nodiscard]] inline bool is_date_time(std::string_view text) {
  std::size_t at = 0;
  bool good = true;
  const auto number = [&](std::size_t digits, int least, int most) {
    int value = 0;
    for (std::size_t i = 0; i < digits; ++i, ++at) {
      good = good && at < text.size() && text[at] >= '0' && text[at] <= '9';
      if (good) value = 10 * value + (text[at] - '0');
    }
    good = good && value >= least && value <= most;
    return value;
  };
  const auto sign = [&](std::string_view any) { good = good && at < text.size() && any.find(text[at]) != std::string_view::npos; ++at; };
  const int year = number(4, 0, 9999);
  sign("-");
  const int month = number(2, 1, 12);
  sign("-");
  const int day = number(2, 1, 31);
  sign("Tt"), number(2, 0, 23), sign(":"), number(2, 0, 59), sign(":"), number(2, 0, 60);   // with leap seconds
  if (good && at < text.size() && text[at] == '.') {
    const std::size_t digits = text.find_first_not_of("0123456789", at + 1);
    good = digits != std::string_view::npos && digits > at + 1;
    at = good ? digits : text.size();
  }
  const bool utc = good && at < text.size() && (text[at] == 'Z' || text[at] == 'z');
  if (utc) ++at;
  else sign("+-"), number(2, 0, 23), sign(":"), number(2, 0, 59);
  using namespace std::chrono;
  return good && at == text.size() && year_month_day{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)), std::chrono::day(static_cast<unsigned>(day))}.ok();
}

}  // namespace kb::json
