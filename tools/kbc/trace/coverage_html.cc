// Coverage as one HTML page.
#include <fmt/format.h>

#include <algorithm>

#include "compiler/source/utf8.h"
#include "tools/kbc/trace/coverage.h"

namespace kb::trace {
namespace {

// Everybody can distinguish blue from orange, and signs and words say the same.
constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Coverage</title>
<style>
body { font: 15px/1.5 system-ui, sans-serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; color: #1a1a1a; background: #fff; }
h2 { margin-top: 2.5rem; border-bottom: 2px solid #444; }
table { border-collapse: collapse; width: 100%; margin: .5rem 0 1rem; }
th, td { text-align: left; padding: .2rem .6rem; border-bottom: 1px solid #ccc; vertical-align: top; }
th { background: #f0f0f0; }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; }
.yes { color: #00508c; } .part { color: #6b4b00; } .no { color: #9a3c00; font-weight: 600; }
code { font: 13px/1.4 ui-monospace, monospace; }
.bar { display: inline-block; width: 8rem; height: .7rem; border: 1px solid #444; background: #fff; }
.bar span { display: block; height: 100%; background: #00508c; }
ul.i { columns: 2; margin: .2rem 0; padding-left: 1.2rem; }
@media (prefers-color-scheme: dark) {
  body { background: #16181b; color: #e8e8e8; } th { background: #26292e; } th, td { border-color: #444; }
  .yes { color: #7cc4ff; } .part { color: #e9c46a; } .no { color: #ffa36b; } .bar { background: #16181b; border-color: #aaa; } .bar span { background: #7cc4ff; }
}
@media print { details > * { display: block; } }
</style>
</head>
<body>
<h1>Coverage</h1>
)";

struct State {
  std::string_view css, sign, word;
};
constexpr State kYes{"yes", "✓", "all"}, kPart{"part", "◐", "in part"}, kNo{"no", "✗", "never"};

State state_of(std::size_t covered, std::size_t all) { return covered == 0 ? kNo : covered == all ? kYes : kPart; }

std::string mark(State state) {
  return fmt::format("<span class=\"{}\">{} {}</span>", state.css, state.sign, state.word);
}

std::string code(std::string_view text) { return "<code>" + source::escape_markup(text) + "</code>"; }

std::string bar(std::string_view what, std::size_t covered, std::size_t all) {
  const double share = all == 0 ? 0.0 : 100.0 * static_cast<double>(covered) / static_cast<double>(all);
  return fmt::format(
      "<tr><td>{}</td><td class=\"n\">{} of {}</td><td class=\"n\">{:.0f} %</td><td><span class=\"bar\"><span "
      "style=\"width:{:.0f}%\"></span></span></td></tr>\n",
      what, covered, all, share, share);
}

template <class Items, class Which>
std::size_t count(const Items& items, const Which& which) {
  return static_cast<std::size_t>(std::count_if(items.begin(), items.end(), which));
}

void print_summary(const CoverageReport& report, std::string& out) {
  std::size_t instances = 0, fired_instances = 0;
  for (const auto& one : report.templates) {
    instances += one.instances.size();
    fired_instances += one.fired_instances;
  }
  const auto landmark = [](const auto& fact) { return fact.landmark; };
  const auto covered = [](const auto& one) { return one.covered(); };
  const auto seen_landmark = [](const auto& fact) { return fact.landmark && fact.seen > 0; };
  out += fmt::format(
      "<p>{} runs, {} ticks.</p>\n<table><tr><th>what</th><th class=\"n\">covered</th><th "
      "class=\"n\">share</th><th></th></tr>\n",
      report.runs, report.ticks);
  out += bar("rules that fired", count(report.templates, covered), report.templates.size());
  out += bar("instances of rules that fired", fired_instances, instances);
  out += bar("landmarks seen", count(report.facts, seen_landmark), count(report.facts, landmark));
  out += bar("satellites raised", count(report.satellites, covered), report.satellites.size());
  out += bar("strategies that ran", count(report.strategies, covered), report.strategies.size());
  out += "</table>\n";
  if (!report.library.empty()) out += fmt::format("<p>Standard library: {}; {} lists it as well.</p>\n", report.library, code("--coverage-library"));
}

void print_instances(const CoverageReport::Template& one, std::string& out) {
  if (one.instances.size() < 2) {
    if (one.fired == 0) out += one.dead ? "never can" : one.held_instances == 0 ? "condition never true" : "condition was true";
    return;
  }
  out += fmt::format("<details><summary>{} of {} instances fired</summary><ul class=\"i\">", one.fired_instances,
                     one.instances.size());
  for (const auto& instance : one.instances) {
    const std::string_view note = instance.fired > 0  ? ""
                                  : instance.held > 0 ? ", condition was true"
                                                      : ", condition never true";
    out += fmt::format("<li>{} {}: {}{}</li>", mark(instance.fired > 0 ? State{"yes", "✓", ""} : State{"no", "✗", ""}),
                       code(instance.name), instance.fired == 0 ? "never" : fmt::format("{} ×", instance.fired), note);
  }
  out += "</ul></details>";
}

void print_rules(const CoverageReport& report, std::string& out) {
  out +=
      "<h3>Rules</h3>\n<table><tr><th>rule</th><th>level</th><th>fired</th><th "
      "class=\"n\">times</th><th>instances</th><th>declared</th></tr>\n";
  for (const auto& one : report.templates) {
    out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td><td>", code(one.name),
                       source::escape_markup(one.level), mark(state_of(one.fired_instances, one.instances.size())), one.fired);
    print_instances(one, out);
    out += fmt::format("</td><td>{}</td></tr>\n", code(one.at));
  }
  out += "</table>\n";
}

void print_facts(const CoverageReport& report, bool landmarks, std::string& out) {
  if (count(report.facts, [&](const auto& fact) { return fact.landmark == landmarks; }) == 0) return;
  out += fmt::format(
      "<h3>{}</h3>\n<table><tr><th>fact</th><th>seen</th><th class=\"n\">ticks in view</th><th class=\"n\">events with "
      "attention</th>"
      "<th class=\"n\">events without</th></tr>\n",
      landmarks ? "Landmarks" : "Other facts");
  for (const auto& fact : report.facts) {
    if (fact.landmark == landmarks) {
      out += fmt::format(
          "<tr><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
          code(fact.name), mark(fact.seen > 0 ? State{"yes", "✓", "yes"} : kNo), fact.seen, fact.attended,
          fact.unattended);
    }
  }
  out += "</table>\n";
}

void print_outputs(const CoverageReport& report, std::string& out) {
  out +=
      "<h3>Strategies</h3>\n<table><tr><th>strategy</th><th>ran</th><th class=\"n\">times</th><th "
      "class=\"n\">ticks</th></tr>\n";
  for (const auto& one : report.strategies) {
    out += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
                       code(one.name), mark(one.covered() ? State{"yes", "✓", "yes"} : kNo), one.starts, one.ticks);
  }
  out += "</table>\n<h3>Satellites</h3>\n<table><tr><th>satellite</th><th>raised</th><th class=\"n\">times</th></tr>\n";
  for (const auto& one : report.satellites) {
    out += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"n\">{}</td></tr>\n", code(one.name),
                       mark(one.raised > 0  ? State{"yes", "✓", "yes"}
                            : one.initially ? State{"yes", "✓", "from the start"}
                                            : kNo),
                       one.raised);
  }
  out += "</table>\n";
}

}  // namespace

std::string print_html(const std::vector<CoverageReport>& reports) {
  std::string out(kHead);
  for (const CoverageReport& report : reports) {
    out += "<h2>" + code(report.program) + "</h2>\n";
    print_summary(report, out);
    print_rules(report, out);
    print_facts(report, true, out);
    print_facts(report, false, out);
    print_outputs(report, out);
  }
  return out + "</body>\n</html>\n";
}

}  // namespace kb::trace
