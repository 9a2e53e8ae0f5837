#include "sim/report/spans.h"

namespace kb::sim::report {

std::vector<Firing> firings(const Recording& recording, Span of) {
  constexpr std::uint32_t kNone = UINT32_MAX;
  std::vector<std::uint32_t> open(recording.names.rules.size(), kNone);   // by rule: its last firing
  std::vector<Firing> all;
  for (std::uint32_t i = of.first; i < of.last; ++i) {
    for (const std::uint32_t rule : recording.frames[i].fired) {
      if (rule >= open.size()) continue;
      if (open[rule] == kNone || all[open[rule]].span.last < i) {
        open[rule] = static_cast<std::uint32_t>(all.size());
        all.push_back({rule, {i, i}});
      }
      all[open[rule]].span.last = i + 1;
    }
  }
  return all;
}

double end_s(const Recording& recording, std::uint32_t frame) {
  const auto& frames = recording.frames;
  if (frame + 1 < frames.size()) return frames[frame + 1].t_s;
  return frame == 0 ? frames[frame].t_s : 2.0 * frames[frame].t_s - frames[frame - 1].t_s;
}

const std::string& strategy_name(const Recording& recording, const Frame& frame) {
  static const std::string kNothing;
  const auto cell = static_cast<std::size_t>(frame.strategy);
  return frame.strategy < 0 || cell >= recording.names.cells.size() ? kNothing : recording.names.cells[cell].name;
}

}  // namespace kb::sim::report
