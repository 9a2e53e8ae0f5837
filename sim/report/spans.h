// Spans of frames during which something lasted.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/recording.h"

namespace kb::sim::report {

/// The frames [first, last).
struct Span {
  std::uint32_t first = 0, last = 0;
};

/// Frames of equal value, joined: covers all frames, in order.
template <class Of>
[[nodiscard]] std::vector<Span> equal_spans(const std::vector<Frame>& frames, const Of& of) {
  std::vector<Span> spans;
  for (std::uint32_t i = 0; i < frames.size(); ++i) {
    if (spans.empty() || !(of(frames[i]) == of(frames[i - 1]))) spans.push_back({i, i});
    spans.back().last = i + 1;
  }
  return spans;
}

/// A rule that fired at each of these frames.
struct Firing {
  std::uint32_t rule = 0;
  Span span;
};
/// By first frame, then in the order of the rules. Rules that `recording` does not name are skipped.
[[nodiscard]] std::vector<Firing> firings(const Recording& recording, Span of);

/// When a frame ends, which is when the next begins. The last frame takes as long as the one before it.
[[nodiscard]] double end_s(const Recording& recording, std::uint32_t frame);

/// The name of the strategy of a frame, "" if none runs.
[[nodiscard]] const std::string& strategy_name(const Recording& recording, const Frame& frame);

}  // namespace kb::sim::report
