// Coverage as text and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compiler/diagnostics/display.h"
#include "tools/kbc/trace/coverage.h"

namespace kb::trace {
namespace {

using nlohmann::ordered_json;

// How many names a line spells out.
constexpr std::size_t kMostNames = 12;

std::string list(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size() && i < kMostNames; ++i) out += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kMostNames) out += fmt::format(", and {} more", names.size() - kMostNames);
  return out;
}

template <class Items>
void print_group(std::string& out, std::string_view what, std::string_view verb, const Items& items) {
  std::vector<std::string> missing;
  for (const auto& item : items)
    if (!item.covered()) missing.push_back(item.name);
  if (items.empty()) return;
  out += fmt::format("{}: {} of {} {}\n", what, items.size() - missing.size(), items.size(), verb);
  if (!missing.empty()) out += fmt::format("  not {}\n", list(missing));
}

std::string unfired(const CoverageReport::Template& one) {
  std::vector<std::string> names;
  for (const auto& instance : one.instances)
    if (instance.fired == 0) names.push_back(instance.name);
  return list(names);
}

std::string_view why_never(const CoverageReport::Template& one) {
  if (one.dead) return "it never can, as `kbc check` says";
  return one.held_instances == 0 ? "its condition was never true" : "its condition was true";
}

// Removes what the library declares. Returns "3 of 12 rules fired", if there was any.
template <class Items>
void leave_out(Items& items, std::string_view what, std::string_view verb, std::string& said) {
  const auto of_library = [](const auto& item) { return item.library; };
  const auto all = std::count_if(items.begin(), items.end(), of_library);
  if (all == 0) return;
  const auto done = std::count_if(items.begin(), items.end(), [&](const auto& item) { return item.library && item.covered(); });
  said += fmt::format("{}{} of {} {} {}", said.empty() ? "" : ", ", done, all, what, verb);
  std::erase_if(items, of_library);
}

void print_rules(std::string& out, const CoverageReport& report) {
  std::size_t fired = 0, instances = 0, fired_instances = 0;
  std::string never, partly;
  for (const auto& one : report.templates) {
    fired += one.fired > 0 ? 1 : 0;
    instances += one.instances.size();
    fired_instances += one.fired_instances;
    if (one.fired == 0) {
      never += fmt::format("  `{}` at {} ({}) never fired; {}\n", one.name, one.level, one.at,
                           why_never(one));
    } else if (one.fired_instances < one.instances.size()) {
      partly += fmt::format("  `{}` at {}: {} of {} instances fired; not {}\n", one.name, one.level,
                            one.fired_instances, one.instances.size(), unfired(one));
    }
  }
  out += fmt::format("rules: {} of {} fired, with {} of {} instances\n", fired, report.templates.size(),
                     fired_instances, instances);
  out += never + partly;
}

std::vector<CoverageReport::Sight> sights(const CoverageReport& report, bool landmarks) {
  std::vector<CoverageReport::Sight> out;
  std::copy_if(report.facts.begin(), report.facts.end(), std::back_inserter(out),
               [&](const auto& fact) { return fact.landmark == landmarks; });
  return out;
}

ordered_json json_report(const CoverageReport& report) {
  ordered_json out{{"program", report.program}, {"runs", report.runs}, {"ticks", report.ticks}};
  ordered_json rules = ordered_json::array(), facts = rules, satellites = rules, strategies = rules;
  for (const auto& one : report.templates) {
    ordered_json instances = ordered_json::array();
    for (const auto& instance : one.instances)
      instances.push_back({{"name", instance.name}, {"fired", instance.fired}, {"condition_true", instance.held}});
    rules.push_back({{"rule", one.name},
                     {"at", one.at},
                     {"level", one.level},
                     {"library", one.library},
                     {"never_can", one.dead},
                     {"fired", one.fired},
                     {"instances", std::move(instances)}});
  }
  for (const auto& fact : report.facts) {
    facts.push_back({{"name", fact.name},
                     {"landmark", fact.landmark},
                     {"library", fact.library},
                     {"ticks_seen", fact.seen},
                     {"events_with_attention", fact.attended},
                     {"events_without_attention", fact.unattended}});
  }
  for (const auto& satellite : report.satellites) {
    satellites.push_back(
        {{"name", satellite.name}, {"raised", satellite.raised}, {"initially_high", satellite.initially}, {"library", satellite.library}});
  }
  for (const auto& strategy : report.strategies)
    strategies.push_back({{"name", strategy.name}, {"starts", strategy.starts}, {"ticks", strategy.ticks}, {"library", strategy.library}});
  out["rules"] = std::move(rules);
  out["facts"] = std::move(facts);
  out["satellites"] = std::move(satellites);
  out["strategies"] = std::move(strategies);
  return out;
}

}  // namespace

CoverageReport without_library(CoverageReport report) {
  leave_out(report.templates, "rules", "fired", report.library);
  leave_out(report.facts, "facts", "seen", report.library);
  leave_out(report.satellites, "satellites", "raised", report.library);
  leave_out(report.strategies, "strategies", "ran", report.library);
  return report;
}

std::string print_text(const CoverageReport& report) {
  std::string out = fmt::format("coverage of {}: {}, {}\n", report.program, diagnostics::counted(report.runs, "case"), diagnostics::counted(report.ticks, "tick"));
  print_rules(out, report);
  print_group(out, "landmarks", "seen", sights(report, true));
  print_group(out, "other facts", "seen", sights(report, false));
  std::uint64_t attended = 0, unattended = 0;
  for (const auto& fact : report.facts) {
    attended += fact.attended;
    unattended += fact.unattended;
  }
  out += fmt::format("events: {} with attention, {} without\n", attended, unattended);
  print_group(out, "satellites", "raised", report.satellites);
  print_group(out, "strategies", "ran", report.strategies);
  if (!report.library.empty()) out += fmt::format("standard library: {}; `--coverage-library` lists these\n", report.library);
  return out;
}

std::string print_json(const std::vector<CoverageReport>& reports) {
  ordered_json out = ordered_json::array();
  for (const CoverageReport& report : reports) out.push_back(json_report(report));
  return out.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";   // a path may be no UTF-8
}

}  // namespace kb::trace
