#include <nlohmann/json.hpp>

#include <cmath>
#include <string_view>

#include "sim/report/report.h"
#include "sim/report/spans.h"
#include "sim/report/text.h"

namespace kb::sim::report {
namespace {

using nlohmann::ordered_json;

// The tracks, from top to bottom.
enum Track : int { kStrategies = 1, kLegs, kStatuses, kNotes, kRules };

// Writes events as JSON, one line for each: the file stays readable, and diffs stay small.
class Writer {
 public:
  explicit Writer(const Recording& recording) : recording_(recording) {}

  std::string run() {
    name("process_name", 0, recording_.title.empty() ? "drive" : recording_.title);
    constexpr std::string_view kNames[] = {"strategy", "leg", "status", "notes", "rules"};
    for (int track = kStrategies; track <= kRules; ++track) name("thread_name", track, kNames[track - 1]);
    slices(kStrategies, [&](const Frame& frame) -> const std::string& { return strategy_name(recording_, frame); });
    slices(kLegs, [](const Frame& frame) -> const std::string& { return frame.leg; });
    slices(kStatuses, [](const Frame& frame) -> const std::string& { return frame.status; });
    notes();
    rules();
    facts();
    return "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[" + out_ + "\n]}\n";
  }

 private:
  static std::int64_t us(double seconds) { return std::isfinite(seconds) ? std::llround(seconds * 1e6) : 0; }

  void put(const ordered_json& event) {
    if (!out_.empty()) out_ += ',';
    out_ += '\n';
    out_ += event.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  }
  void name(const char* what, int track, std::string_view text) {
    put({{"ph", "M"}, {"pid", 1}, {"tid", track}, {"name", what}, {"args", {{"name", text}}}});
    if (track > 0) put({{"ph", "M"}, {"pid", 1}, {"tid", track}, {"name", "thread_sort_index"}, {"args", {{"sort_index", track}}}});
  }

  template <class Of>
  void slices(int track, const Of& of) {
    for (const Span span : equal_spans(recording_.frames, of)) {
      const std::string& text = of(recording_.frames[span.first]);
      if (text.empty()) continue;
      const std::int64_t begin = us(recording_.frames[span.first].t_s);
      put({{"ph", "X"}, {"pid", 1}, {"tid", track}, {"ts", begin}, {"dur", us(end_s(recording_, span.last - 1)) - begin}, {"name", text},
           {"args", {{"first_tick", span.first + 1}, {"last_tick", span.last}}}});
    }
  }

  void notes() {
    for (const Frame& frame : recording_.frames) {
      for (const std::string& note : frame.notes) {
        put({{"ph", "i"}, {"s", "p"}, {"pid", 1}, {"tid", kNotes}, {"ts", us(frame.t_s)}, {"name", note}});
      }
    }
  }

  void rules() {
    for (const Firing& firing : firings(recording_, {0, static_cast<std::uint32_t>(recording_.frames.size())})) {
      const MindNames::Rule& rule = recording_.names.rules[firing.rule];
      put({{"ph", "i"}, {"s", "t"}, {"pid", 1}, {"tid", kRules}, {"ts", us(recording_.frames[firing.span.first].t_s)}, {"name", rule.name}, {"cat", rule.level},
           {"args", {{"at", rule.at}, {"tick", firing.span.first + 1}, {"ticks", firing.span.last - firing.span.first}}}});
    }
  }

  void fact(std::int64_t at, std::uint32_t cell, float value) {
    if (!std::isfinite(value)) return;
    put({{"ph", "C"}, {"pid", 1}, {"ts", at}, {"name", recording_.names.cells[cell].name}, {"args", {{"certainty", std::round(static_cast<double>(value) * 1e6) / 1e6}}}});
  }
  void facts() {
    const auto& cells = recording_.names.cells;
    const auto is_fact = [&](std::uint32_t cell) { return cell < cells.size() && cells[cell].kind == MindNames::Cell::Kind::kFact; };
    std::vector<bool> told(cells.size(), false);
    for (const Frame& frame : recording_.frames) {
      for (const Frame::Change& change : frame.changed) {
        if (!is_fact(change.cell)) continue;
        // A viewer shows a counter only from its first value on, so the initial value is written before the first change.
        if (!told[change.cell] && &frame != recording_.frames.data()) fact(us(recording_.frames.front().t_s), change.cell, cells[change.cell].initial);
        told[change.cell] = true;
        fact(us(frame.t_s), change.cell, change.value);
      }
    }
  }

  const Recording& recording_;
  std::string out_;
};

}  // namespace

std::string chrome_trace(const Recording& recording) { return Writer(recording).run(); }

}  // namespace kb::sim::report
