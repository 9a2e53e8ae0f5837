#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <set>

#include "compiler/source/utf8.h"
#include "sim/report/report.h"
#include "sim/report/row.h"
#include "sim/report/spans.h"
#include "sim/report/text.h"

namespace kb::sim::report {

void Row::comma() {
  if (!first_) out_ += ',';
  first_ = false;
}

void Row::text(std::string_view words) {
  comma();
  if (words.find_first_of(",\"\n\r[") == std::string_view::npos) {
    out_ += source::valid_utf8(words);
    return;
  }
  out_ += '"';
  for (const char c : source::valid_utf8(words)) out_ += c == '"' ? "\"\"" : c == '\n' || c == '\r' ? " " : std::string(1, c);
  out_ += '"';
}

void Row::number(double value, bool known) {
  comma();
  if (known && std::isfinite(value)) out_ += fixed(value, 6);
}

void Row::fact(float value) {
  comma();
  out_ += std::isfinite(value) ? fixed(static_cast<double>(value), 6) : "nan";
}

void Row::certainty(float value) {
  comma();
  if (value != 0.0f) out_ += std::isfinite(value) ? fmt::format("{}", value) : "nan";
}

namespace {

std::vector<std::uint32_t> facts_of(const MindNames& names) {
  std::vector<std::uint32_t> facts;
  for (std::uint32_t i = 0; i < names.cells.size(); ++i) {
    if (names.cells[i].kind == MindNames::Cell::Kind::kFact) facts.push_back(i);
  }
  return facts;
}

/// The columns of the table other than facts: those before them, and those behind.
std::vector<std::string> columns_before() {
  std::vector<std::string> names{"t", "x_m", "y_m", "heading_rad"};
  for (std::size_t i = 0; i < mts::kLineSensors; ++i) names.push_back(fmt::format("line_{}", i));
  for (std::size_t i = 0; i < mts::kRangeFinders; ++i) names.push_back(fmt::format("range_{}_m", i));
  names.insert(names.end(), {"compass_rad", "odometry_x_m", "odometry_y_m", "odometry_m_s", "odometry_turned_rad", "touched"});
  return names;
}
constexpr std::array<std::string_view, 5> kColumnsBehind{"strategy", "leg", "status", "notes", "tick"};

void print_header(const Recording& recording, const std::vector<std::uint32_t>& facts, std::string& out) {
  const std::vector<std::string> before = columns_before();
  std::set<std::string_view> taken(before.begin(), before.end());
  taken.insert(kColumnsBehind.begin(), kColumnsBehind.end());
  Row row(out);
  for (const std::string& name : before) row.text(name);
  for (const std::uint32_t fact : facts) {
    const std::string& name = recording.names.cells[fact].name;
    row.text(taken.contains(name) ? "fact:" + name : name);   // no name has a colon
  }
  for (const std::string_view name : kColumnsBehind) row.text(name);
}

/// Without power, or waiting for a button, the mind does not tick and its clock stands still.
bool rests(const Frame& frame) { return frame.status == "off" || frame.status == "waits"; }

/// Whether the knowledge base decided in this frame. Of the mind of another program, whose frames have no status, nothing is known.
bool ticked(const Frame& frame) { return !rests(frame) && !frame.status.empty() && frame.status != "gone"; }

void print_senses(const mts::Senses& senses, Row& row) {
  for (const float line : senses.line) row.number(static_cast<double>(line), senses.line_known);
  for (const float range : senses.range_m) row.number(static_cast<double>(range), senses.range_known && !std::isnan(range));
  row.number(static_cast<double>(senses.heading_rad), senses.heading_known);
  for (const float odometry : {senses.x_m, senses.y_m, senses.speed_m_s}) {
    row.number(static_cast<double>(odometry), senses.odometry_known);
  }
  row.number(static_cast<double>(senses.turned_rad), senses.turned_known);
  row.text(senses.touched ? "1" : "0");
}

std::vector<float> initial_values(const MindNames& names) {
  std::vector<float> values;
  for (const MindNames::Cell& cell : names.cells) values.push_back(cell.initial);
  return values;
}

void apply(const Frame& frame, std::vector<float>& values) {
  for (const Frame::Change& change : frame.changed) {
    if (change.cell < values.size()) values[change.cell] = change.value;
  }
}

/// Facts that had a certainty other than 0 on some tick.
std::vector<std::uint32_t> facts_told(const Recording& recording) {
  std::vector<bool> told(recording.names.cells.size(), false);
  for (const Frame& frame : recording.frames) {
    for (const Frame::Change& change : frame.changed) {
      if (change.cell < told.size() && change.value != 0.0f) told[change.cell] = true;
    }
  }
  std::vector<std::uint32_t> facts = facts_of(recording.names);
  std::erase_if(facts, [&](std::uint32_t fact) { return !told[fact]; });
  return facts;
}

}  // namespace

std::string csv(const Recording& recording) {
  const std::vector<std::uint32_t> facts = facts_of(recording.names);
  std::vector<float> values = initial_values(recording.names);

  std::string out;
  print_header(recording, facts, out);
  std::uint64_t ticks = 0;
  for (const Frame& frame : recording.frames) {
    apply(frame, values);
    Row row(out);
    for (const double value : {frame.t_s, frame.pose.x_m, frame.pose.y_m, frame.pose.heading_rad}) row.number(value);
    print_senses(frame.senses, row);
    for (const std::uint32_t fact : facts) row.fact(values[fact]);
    row.text(strategy_name(recording, frame));
    row.text(frame.leg);
    row.text(frame.status);
    std::string notes;
    for (const std::string& note : frame.notes) notes += (notes.empty() ? "" : "; ") + note;
    row.text(notes);
    row.text(ticked(frame) ? fmt::format("{}", ++ticks) : std::string());
  }
  return out;
}

std::string facts(const Recording& recording) {
  const std::vector<std::uint32_t> told = facts_told(recording);
  std::vector<float> values = initial_values(recording.names);
  std::string out;
  {
    Row row(out);
    row.text("t");
    for (const std::uint32_t fact : told) row.text(recording.names.cells[fact].name);
  }
  double rested_s = 0.0, before_s = 0.0;
  for (const Frame& frame : recording.frames) {
    if (rests(frame)) rested_s += frame.t_s - before_s;
    before_s = frame.t_s;
    apply(frame, values);
    if (rests(frame)) continue;
    Row row(out);
    row.number(std::round((frame.t_s - rested_s) * 1e6) / 1e6);
    for (const std::uint32_t fact : told) row.certainty(values[fact]);
  }
  return out;
}

}  // namespace kb::sim::report
