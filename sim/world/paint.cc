// The extent of the floor, the paint on it, and tags.
#include <algorithm>
#include <cmath>
#include <span>

#include "sim/world/geometry.h"
#include "sim/world/parts.h"

namespace kb::sim {
namespace {

constexpr double kMargin = 0.5;          // m, times the size: around everything on the floor

/// Appends a line, without the parts that lie so near to level crossings that they would mislead.
void add_line(const Paint& line, std::span<const Level> levels, std::vector<Paint>& out) {
  const Spot d = line.to - line.from;
  const double long_m = length(d);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const Spot to_level = levels[i].at - line.from;
    const double along_m = dot(to_level, d) / long_m, aside_m = cross(d, to_level) / long_m, reach_m = levels[i].unpainted_m;
    if (std::abs(aside_m) >= reach_m) continue;
    const double half_m = std::sqrt(reach_m * reach_m - aside_m * aside_m);
    if (along_m + half_m <= 0.0 || along_m - half_m >= long_m) continue;
    Paint before = line, behind = line;
    before.to = line.from + ((along_m - half_m) / long_m) * d;
    behind.from = line.from + ((along_m + half_m) / long_m) * d;
    if (along_m > half_m) add_line(before, levels.subspan(i + 1), out);
    if (along_m + half_m < long_m) add_line(behind, levels.subspan(i + 1), out);
    return;
  }
  out.push_back(line);
}

}  // namespace

void find_corners(Labyrinth& labyrinth) {
  Bounds all = bounds_of(labyrinth.crossings.front().at);
  for (const Crossing& crossing : labyrinth.crossings) all = grown(all, crossing.at);
  for (const Road& road : labyrinth.roads) {
    for (const Spot& spot : road.along) all = grown(all, spot);
  }
  for (const Picture::Wall& wall : labyrinth.walls) all = grown(grown(all, wall.from), wall.to);
  const double margin_m = labyrinth.size * kMargin;
  labyrinth.low = all.low - Spot{margin_m, margin_m};
  labyrinth.high = all.high + Spot{margin_m, margin_m};
}

void paint_floor(Labyrinth& labyrinth) {
  double reach_m = 0.0;
  for (const Level& level : labyrinth.levels) reach_m = std::max(reach_m, level.unpainted_m);
  const Nearby levels(labyrinth.levels, [](const Level& level) { return bounds_of(level.at); });
  for (std::size_t r = 0; r < labyrinth.roads.size(); ++r) {
    const Road& road = labyrinth.roads[r];
    if (road.kind != Picture::Kind::kMark) continue;
    const auto chain = rounded(road.between_stop_lines(), labyrinth.size * kBendRadius);
    for (std::size_t i = 1; i < chain.size(); ++i) {
      std::vector<Level> near;
      for (const std::uint32_t level : levels.near(bounds_of(chain[i - 1], chain[i]), reach_m)) near.push_back(labyrinth.levels[level]);
      add_line({chain[i - 1], chain[i], 0.5 * labyrinth.widths.line_m, static_cast<RoadId>(r)}, near, labyrinth.paint);
    }
  }
  for (std::size_t c = 0; c < labyrinth.crossings.size(); ++c) {
    const Crossing& crossing = labyrinth.crossings[c];
    for (std::uint32_t a = 0; a < crossing.arms.size(); ++a) {
      const Arm& arm = crossing.arms[a];
      const Spot ahead = direction(arm.heading_rad), stop = crossing.at + arm.stop_m * ahead;
      const Spot half = (0.5 * labyrinth.size * kRoadWidth) * left_of(ahead);
      if (crossing.painted) labyrinth.paint.push_back({crossing.at, stop, 0.5 * labyrinth.widths.line_m, RoadId::kNone, static_cast<CrossingId>(c)});
      labyrinth.stop_lines.push_back({stop - half, stop + half, 0.5 * labyrinth.widths.stop_line_m, RoadId::kNone});
      labyrinth.tags.push_back({stop + labyrinth.size * kTagBefore * ahead, static_cast<CrossingId>(c), a});
    }
  }
}

}  // namespace kb::sim
