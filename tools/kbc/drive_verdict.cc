#include "tools/kbc/drive_verdict.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "compiler/diagnostics/display.h"
#include "sim/batch/ending.h"

namespace kb::cli {

using diagnostics::Kind;
using Ban = sim::Summary::Fault::Ban;
using Contact = sim::Summary::Contact;
using Json = nlohmann::ordered_json;

namespace {

/// Rounds to a millimetre or a millisecond.
double rounded(double value) { return std::round(value * 1000.0) / 1000.0; }

std::string print_contact(const Contact& contact, double scale) {
  return fmt::format("    {:.1f} s: {} at ({:.2f}, {:.2f}), {:.2f} m/s\n", contact.t_s, contact.what, contact.at.x_m / scale, contact.at.y_m / scale, contact.speed_m_s);
}

Json contacts_json(const std::vector<Contact>& contacts, double scale) {
  Json all = Json::array();
  for (const Contact& one : contacts) {
    all.push_back({{"t_s", rounded(one.t_s)}, {"what", one.what}, {"x", rounded(one.at.x_m / scale)}, {"y", rounded(one.at.y_m / scale)}, {"speed_m_s", rounded(one.speed_m_s)}});
  }
  return all;
}

std::string collisions_of(const sim::Summary& summary) {
  if (summary.collisions.empty()) return {};
  const auto& first = summary.collisions.front();
  const std::size_t count = summary.collisions.size();
  return fmt::format("hit {} at {:.1f} s{}", first.what, first.t_s, count == 1 ? std::string() : fmt::format(", the first of {} collisions", count));
}

std::string broken(const sim::Summary& summary, Ban ban) {
  std::string all;
  for (const auto& fault : summary.faults) {
    if (fault.broken == ban) all += (all.empty() ? "" : ", ") + fault.what;
  }
  return all;
}

std::string lost_of(const sim::Summary& summary) {
  const bool told = summary.outcome == sim::Summary::Outcome::kAstray;   // the ending says it already
  if (!summary.lost_unaware() || told) return {};
  if (summary.mistaken_crossings == 0) return fmt::format("drove for {:.1f} s elsewhere than it believed", summary.unaware_s);
  return fmt::format("drove over {} crossing{} that it took for another", summary.mistaken_crossings, summary.mistaken_crossings == 1 ? "" : "s");
}

/// Something that no drive should do: the word that allows it, and what was done; empty if nothing was.
struct Blemish {
  std::string_view word;
  std::string (*done)(const sim::Summary&);
};
constexpr Blemish kBlemishes[] = {
    {"collisions", collisions_of},
    {"closed", [](const sim::Summary& summary) { return broken(summary, Ban::kClosedRoad); }},
    {"unsafe", [](const sim::Summary& summary) { return broken(summary, Ban::kUnsafeCrossing); }},
    {"lost", lost_of},
};
constexpr std::string_view kMissed = "missed";
constexpr std::size_t kShownOfWay = 20;   // at either end: a drive of hours passes thousands of exits

}  // namespace

std::string print_summary(const sim::Summary& summary, double scale, double limit_s) {
  std::string out = diagnostics::visible(sim::describe(summary)) + "\n";   // a driver of another program reports by itself
  if (scale != 1.0) out += fmt::format("  scale       {:g} m for a metre of the map\n", scale);
  if (summary.outcome == sim::Summary::Outcome::kTimeUp) out += fmt::format("  limit       {:g} s; --set limit=SECONDS gives it more\n", limit_s);
  if (!summary.outputs.empty()) out += fmt::format("  outputs     {}\n", fmt::join(summary.outputs, " "));
  out += fmt::format("  time        {:.1f} s\n  length      {:.2f} m\n  way        ", summary.time_s, summary.length_m);
  for (std::size_t i = 0; i < summary.way.size(); ++i) {
    if (i == kShownOfWay && summary.way.size() > 2 * kShownOfWay) {
      i = summary.way.size() - kShownOfWay;
      out += fmt::format(" ... {} more ...", i - kShownOfWay);
    }
    out += " " + summary.way[i];
  }
  out += fmt::format("\n  collisions  {}\n", summary.collisions.size());
  for (const Contact& hit : summary.collisions) out += print_contact(hit, scale);
  if (!summary.standing_contacts.empty()) out += fmt::format("  contacts while it stood: {}\n", summary.standing_contacts.size());
  for (const Contact& contact : summary.standing_contacts) out += print_contact(contact, scale);
  if (summary.touched_s > 0.0) out += fmt::format("  touched     something for {:.2f} s\n", summary.touched_s);
  if (summary.closest) out += fmt::format("  closest     {:.2f} m to {} at {:.1f} s\n", summary.closest->gap_m, summary.closest->what, summary.closest->t_s);
  for (const auto& fault : summary.faults) out += fmt::format("  fault       {}\n", fault.what);
  for (const auto& missed : summary.missed) out += fmt::format("  never happened: {}\n", missed.what);
  const bool unpressed = std::ranges::any_of(summary.missed, [](const auto& event) { return event.what.ends_with(" pressed"); });
  if (summary.outcome == sim::Summary::Outcome::kNeverStarted && unpressed) {
    out += "  no command was pressed: since the scenario presses one itself, the first one is not pressed after 1 s; add an event for it\n";
  }
  out += fmt::format("  lost without knowing it: {}\n", summary.lost_unaware() ? fmt::format("yes, for {:.1f} s", summary.unaware_s) : "no");
  return out;
}

std::string summary_json(const sim::Summary& summary, double scale, std::uint64_t seed) {
  Json missed = Json::array(), faults = Json::array(), closest = nullptr;
  if (const auto& near = summary.closest) closest = {{"gap_m", rounded(near->gap_m)}, {"t_s", rounded(near->t_s)}, {"what", near->what}};
  for (const auto& fault : summary.faults) {
    faults.push_back({{"ban", fault.broken == Ban::kClosedRoad ? "closed" : "unsafe"}, {"what", fault.what}});
  }
  for (const auto& event : summary.missed) missed.push_back(event.what);
  const Json all{{"ending", sim::describe(summary)},
                 {"outcome", sim::batch::ending_of(summary).outcome},
                 {"reports", summary.reports},
                 {"outputs", summary.outputs},
                 {"time_s", rounded(summary.time_s)},
                 {"length_m", rounded(summary.length_m)},
                 {"way", summary.way},
                 {"collisions", contacts_json(summary.collisions, scale)},
                 {"standing_contacts", contacts_json(summary.standing_contacts, scale)},
                 {"touched_s", rounded(summary.touched_s)},
                 {"impact_m_s", rounded(summary.impact_m_s())},
                 {"closest", closest},
                 {"faults", faults},
                 {"never_happened", missed},
                 {"lost_unaware", summary.lost_unaware()},
                 {"unaware_s", rounded(summary.unaware_s)},
                 {"last_moved_s", rounded(summary.last_moved_s)},
                 {"scale", scale},
                 {"seed", seed}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::string> blemishes() {
  std::vector<std::string> words;
  for (const Blemish& blemish : kBlemishes) words.emplace_back(blemish.word);
  words.emplace_back(kMissed);
  return words;
}

bool ends_as(std::string_view ending, std::string_view words) {
  if (words.empty() || !ending.starts_with(words)) return false;
  if (ending.size() == words.size() || ending[words.size()] == ' ') return true;
  return ending[words.size()] == ',' && ending.find(": ") == std::string_view::npos;   // after a colon, reports
}

void compare(const sim::Summary& summary, const Expectation& expected, diagnostics::Diagnostics& messages) {
  const auto allowed = [&](std::string_view word) { return std::find(expected.allowed.begin(), expected.allowed.end(), word) != expected.allowed.end(); };
  const std::string ending = sim::describe(summary);
  if (!ends_as(ending, expected.ending)) messages.report(Kind::kSimUnexpected, {}, {ending, expected.ending});
  for (const Blemish& blemish : kBlemishes) {
    const std::string done = blemish.done(summary);
    if (!done.empty() && !allowed(blemish.word)) messages.report(Kind::kSimBlemish, {}, {done, blemish.word});
  }
  if (allowed(kMissed)) return;
  for (const auto& event : summary.missed) messages.report(Kind::kSimMissed, event.at, {event.what, kMissed});
}

}  // namespace kb::cli
