#include "tools/kbc/trace/why_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "compiler/diagnostics/display.h"
#include "compiler/program/text.h"

namespace kb::trace {
namespace {

constexpr Nearness kFar{UINT32_MAX, 0.0};   // no rule could bring it about

using program::CellId;
using program::CellKind;
using program::Program;
using program::RuleId;

struct Words {
  const char *happened, *did_not;
};
Words words_of(const Program& program, CellId cell) {
  if (cell == CellId::kNone) return {"fired", "did not fire"};
  switch (program[cell].kind) {
    case CellKind::kFact: return {"was seen", "was not seen"};
    case CellKind::kSatellite: return {"changed", "did not change"};
    case CellKind::kStrategy: return {"ran", "did not run"};
  }
  return {};
}

// "7, 9-12", or with values "7 to 1.00, 9 to -1.00": at most ten such pieces, the others counted.
std::string list(const std::vector<std::uint64_t>& ticks, const std::vector<float>& values) {
  constexpr std::size_t kMost = 10;
  std::string out;
  std::size_t pieces = 0;
  for (std::size_t from = 0, to = 0; from < ticks.size(); from = to, ++pieces) {
    if (pieces == kMost) return out + fmt::format(", and {} more", ticks.size() - from);
    to = from + 1;
    while (values.empty() && to < ticks.size() && ticks[to] == ticks[to - 1] + 1) ++to;
    out += fmt::format("{}{}", pieces == 0 ? "" : ", ", ticks[from]);
    if (!values.empty()) out += fmt::format(" to {:.2f}", values[from]);
    if (to - from > 1) out += fmt::format("-{}", ticks[to - 1]);
  }
  return out;
}

}  // namespace

WhySearch::WhySearch(const Program& program, const Question& question)
    : program_(program), cell_(question.strategy != CellId::kNone ? question.strategy : question.cell), rules_(question.rules) {
  if (cell_ == CellId::kNone) return;
  if (program[cell_].kind != CellKind::kStrategy) {
    satellites_.push_back({cell_, raisers(program, cell_)});
    return;
  }
  rules_ = raisers(program, cell_);
  for (const CellId satellite : program[cell_].satellites) satellites_.push_back({satellite, raisers(program, satellite)});
}

bool WhySearch::happened(const program::Tick& tick, const program::Recorder& recorder) {
  if (cell_ == CellId::kNone) return std::ranges::find_first_of(tick.fired, rules_) != tick.fired.end();
  switch (program_[cell_].kind) {
    case CellKind::kFact:
      if (tick.number == 1) seen_ = recorder.record().seen[program::index(cell_)];   // the first tick makes no events
      return seen_ = (seen_ && !std::ranges::binary_search(tick.lost, cell_)) || std::ranges::binary_search(tick.events, cell_);
    case CellKind::kSatellite: return change(tick) != nullptr;
    case CellKind::kStrategy: return tick.strategy == cell_;
  }
  return false;
}

const program::CellValue* WhySearch::change(const program::Tick& tick) const {
  const auto at = std::ranges::lower_bound(tick.set, cell_, {}, &program::CellValue::cell);
  return at != tick.set.end() && at->cell == cell_ ? &*at : nullptr;
}

Nearness WhySearch::least(const std::vector<RuleId>& rules, const program::Record& record) const {
  Nearness least = kFar;
  for (const RuleId rule : rules) least = std::min(least, trace::nearness(program_, record, rule));
  return least;
}

/// A strategy needs that its satellite rises first, so that distance counts as well.
Nearness WhySearch::nearness(const program::Record& record) const {
  const std::vector<float>& cf = record.levels.back().cf;
  Nearness rising = kFar;
  for (const auto& [satellite, raisers] : satellites_) {
    const float value = cf[program::index(satellite)];
    if (program_[satellite].kind == CellKind::kFact) return {0, 1.0 - static_cast<double>(value)};
    const bool high = value >= static_cast<float>(program_.settings.firing);
    if (high && !rules_.empty()) return least(rules_, record);
    if (!high) rising = std::min(rising, least(raisers, record));
  }
  if (rules_.empty() || rising == kFar) return rising;
  const Nearness running = least(rules_, record);
  return {running.lacking + rising.lacking, running.gap + rising.gap};
}

/// The nearest of the rules asked for. Notes of each what alone kept it from firing.
Nearness WhySearch::nearest_rule(const program::Record& record) {
  Nearness least = kFar;
  alone_.resize(rules_.size());
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    const Nearness near = trace::nearness(program_, record, rules_[i]);
    least = std::min(least, near);
    if (near.lacking != 1) continue;
    const auto known = std::ranges::find_if(alone_[i], [&](const Alone& one) { return one.near.last == near.last; });
    if (known == alone_[i].end()) alone_[i].push_back({near, record.tick.number});
    else if (near < known->near) *known = {near, record.tick.number};
  }
  return least;
}

/// "At tick 243 nothing but `Arrived` was missing. ", of what else kept the rule that came nearest from firing; at most three.
std::string WhySearch::print_alone() const {
  const auto came_nearest = [this](const Alone& one) { return one.tick == nearest_.tick.number && one.near == near_; };
  const auto of_rule = std::ranges::find_if(alone_, [&](const std::vector<Alone>& all) { return std::ranges::any_of(all, came_nearest); });
  if (of_rule == alone_.end()) return {};
  const auto nearest = std::ranges::find_if(*of_rule, came_nearest);
  std::string out;
  std::size_t told = 0;
  for (const Alone& one : *of_rule) {
    if (one.near.last == nearest->near.last || told++ >= 3) continue;
    const std::string condition = program::print_condition(program_, one.near.last);
    out += fmt::format("At tick {} nothing but `{}{}` was missing. ", one.tick, one.near.wanted ? "" : "not ", condition);
  }
  return out;
}

void WhySearch::consider(const program::Tick& tick, program::Recorder& recorder) {
  if (happened(tick, recorder)) {
    ticks_.push_back(tick.number);
    if (const program::CellValue* now = change(tick)) values_.push_back(now->value);
  }
  const bool satellite = cell_ != CellId::kNone && program_[cell_].kind == CellKind::kSatellite;
  const bool passing = satellite && change(tick) == nullptr && !levels_in_passing(recorder.found()).empty();
  if (passing) passing_.push_back(tick.number);
  if (!ticks_.empty()) return;
  const Nearness near = cell_ == CellId::kNone ? nearest_rule(recorder.record()) : nearness(recorder.record());
  const bool nearer = passing_.empty() ? near < near_ : passing && passing_.size() == 1;
  if (nearest_.tick.number == 0 || nearer) {
    near_ = near;
    nearest_ = recorder.record();
  }
  recorder.go_on();
}

std::string WhySearch::print(std::string_view name, std::uint64_t ticks) const {
  const Words words = words_of(program_, cell_);
  const std::string of = diagnostics::counted(ticks, "tick");
  if (ticks_.empty() && !passing_.empty()) {
    return fmt::format("`{}` changed within {} of {}, and back before they ended: {}. The first:\n", name, passing_.size(), of, list(passing_, {}));
  }
  if (ticks_.empty()) return fmt::format("`{}` {} in {}. {}{} tick {}:\n", name, words.did_not, of, print_alone(), near_ == kFar ? "At" : "It came nearest at", nearest_.tick.number);
  const std::string also = passing_.empty() ? "" : fmt::format("It also changed within {}, and back: {}. ", diagnostics::counted(passing_.size(), "other tick"), list(passing_, {}));
  if (ticks_.size() == 1) return fmt::format("`{}` {} once in {}{}\n", name, words.happened, of, also.empty() ? ":" : ". " + also + "The first:");
  return fmt::format("`{}` {} on {} of {}: {}. {}The first:\n", name, words.happened, ticks_.size(), of, list(ticks_, values_), also);
}

}  // namespace kb::trace
