#include "tools/kbc/wire/guide.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace kb::wire {
namespace {

constexpr float kNoPaint = 0.2f, kOnPaint = 0.8f;   // darknesses that line_sight.h certainly takes for no paint, and for paint

}  // namespace

void set_line(const Guide& guide, const mts::Body& body, mts::Senses& senses) {
  senses.line_known = true;
  std::fill(std::begin(senses.line), std::end(senses.line), guide.across ? 1.0f : 0.0f);
  if (guide.across || !guide.left_m) return;
  const float first_m = body.line_sensor_left_m(0), pitch_m = first_m - body.line_sensor_left_m(1);
  const float at = std::clamp((first_m - *guide.left_m) / pitch_m, 0.0f, static_cast<float>(mts::kLineSensors - 1));   // in sensors from the left
  const auto next = static_cast<std::size_t>(std::lround(at));
  const float beyond = at - static_cast<float>(next), share = std::abs(beyond);
  senses.line[next] = kOnPaint;
  if (share > 0.0f) senses.line[beyond > 0.0f ? next + 1 : next - 1] = kNoPaint + (kOnPaint - kNoPaint) * share / (1.0f - share);
}

}  // namespace kb::wire
