// How a drive ended, in a few fields of CSV, and totals over many drives.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/drive/judge.h"

namespace kb::sim::batch {

/// In the order of Summary::Outcome.
inline constexpr std::array<std::string_view, 8> kOutcomes{"arrived", "astray", "aborted", "given_up", "stopped", "stuck", "time_up", "never_started"};

inline constexpr double kNothingNear = -1.0;   ///< no obstacle stood anywhere

/// What the judge saw of one drive; only `reports` is what the robot itself says.
struct Ending {
  std::string outcome;                    ///< one of kOutcomes
  std::string reports;                    ///< `Help.lost+Help.blocked`: reported when it ended
  double time_s = 0.0, length_m = 0.0;    ///< see Summary
  std::uint32_t collisions = 0;
  std::uint32_t bans_broken = 0;          ///< closed roads taken, unsafe crossings entered
  bool lost_unaware = false;              ///< see Summary::lost_unaware
  std::uint32_t standing_contacts = 0;    ///< for this and those below see Summary
  double touched_s = 0.0, impact_m_s = 0.0;
  double closest_m = kNothingNear;
  std::uint32_t missed = 0;               ///< events of the scenario that never happened
  double last_moved_s = 0.0;              ///< see Summary
};
[[nodiscard]] Ending ending_of(const Summary& summary);

/// What all results say of a drive besides its outcome, time and length: the names of the columns, and their fields in a row.
inline constexpr std::string_view kMeasures = "collisions,bans_broken,lost_unaware,standing_contacts,touched_s,impact_m_s,closest_m,missed,last_moved_s";
inline constexpr std::size_t kMeasureCount = 9;
[[nodiscard]] std::string print_measures(const Ending& ending);
/// Reads `print_measures` back from its fields. False if one of them is no number of its kind.
[[nodiscard]] bool read_measures(std::span<const std::string_view, kMeasureCount> fields, Ending& ending);
/// Whether a drive of at most `limit_s` seconds and of so many events can have ended so: then a row that was damaged on disk does not spoil
/// the quantiles of all others.
[[nodiscard]] bool is_possible(const Ending& ending, double limit_s, std::size_t events);
/// Whether it stands, has not arrived, and reports why. A robot that still drove when the time was up says nothing by its reports.
[[nodiscard]] bool says_why(const Ending& ending);

/// What may have happened to a run, by the name under which it is counted.
struct Happening {
  std::string_view name;
  bool (*is)(const Ending& ending);
};
inline bool arrives(const Ending& ending) { return ending.outcome == kOutcomes[0]; }
inline bool collides(const Ending& ending) { return ending.collisions > 0; }
inline bool breaks_bans(const Ending& ending) { return ending.bans_broken > 0; }
inline bool is_lost_unaware(const Ending& ending) { return ending.lost_unaware; }
inline bool is_touched_standing(const Ending& ending) { return ending.standing_contacts > 0; }
inline constexpr std::array kHappenings{Happening{"arrived", arrives}, Happening{"collisions", collides}, Happening{"bans_broken", breaks_bans},
                                        Happening{"lost_unaware", is_lost_unaware}, Happening{"standing_contacts", is_touched_standing}};

/// Counts of endings.
struct Tally {
  std::size_t runs = 0, arrived = 0;
  std::size_t says_why = 0;                ///< see batch::says_why
  std::size_t silent = 0;                  ///< all others that did not arrive
  std::size_t collided = 0;                ///< runs with a collision
  std::size_t broke_bans = 0;              ///< runs in which a closed road was taken or an unsafe crossing entered
  std::size_t lost_unaware = 0;
  std::vector<double> times, lengths;      ///< of those that arrived

  /// `time` and `length` are kept if it arrived: in seconds and metres, or as multiples of the shortest, as the caller wishes.
  void add(const Ending& ending, double time, double length);
};

/// The quantile by nearest rank: a `share` of all values is not above it. 0 if there are no values. O(n log n).
[[nodiscard]] double quantile(std::vector<double> values, double share);
/// Those of 5, 50 and 95 %, as the tables have them: `1.20 / 2.50 / 3.10`; `-` if there are no values.
[[nodiscard]] std::string quantiles(const std::vector<double>& values, int digits);
/// `12.5 %`; `-` if `all` is 0. One decimal place, and more only where it would print some as 0.0 or less than all as 100.0: `99.96 %`.
[[nodiscard]] std::string percent(std::size_t part, std::size_t all);
/// `98.8 % (96.4 to 99.6)`: the share, and the range of shares that so many runs cannot distinguish from it: the 95 % score
/// interval (Wilson, Probable inference, the law of succession, and statistical inference, 1927), which holds for few
/// runs and for shares near 0 and 1 too.
[[nodiscard]] std::string percent_between(std::size_t part, std::size_t all);

}  // namespace kb::sim::batch
