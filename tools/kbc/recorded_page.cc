#include "tools/kbc/recorded_page.h"

#include <limits>
#include <utility>

#include "sim/report/report.h"

namespace kb::cli {

RecordedPage::RecordedPage(const program::Program& program, std::string title)
    : program_(program), recording_{.title = std::move(title), .outcome = {}, .picture = {}, .names = sim::names_of(program), .frames = {}, .legs = {}, .stays = {}}, changes_(recording_.names) {}

bool RecordedPage::add(const program::Tick& tick, const trace::Engine& engine) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  if (recording_.frames.size() == kMostTicks) return false;
  sim::Frame frame;
  frame.t_s = static_cast<double>(tick.time_us) / 1e6;
  frame.pose = {kNowhere, kNowhere, kNowhere};
  const auto ask = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) changes_.put(i, engine.value(static_cast<program::CellId>(i)), frame);
  };
  ask(0, program_.facts);
  for (const program::CellValue& set : tick.set) changes_.put(program::index(set.cell), set.value, frame);
  ask(changes_.cells() - program_.strategies, changes_.cells());
  if (tick.strategy != program::CellId::kNone) frame.strategy = static_cast<std::int32_t>(tick.strategy);
  frame.status = program::status_text(tick.status);
  sim::tell(tick, program_, frame);
  recording_.frames.push_back(std::move(frame));
  return true;
}

std::string RecordedPage::html(std::string outcome) {
  recording_.outcome = std::move(outcome);
  return sim::report::html(recording_);
}

}  // namespace kb::cli
