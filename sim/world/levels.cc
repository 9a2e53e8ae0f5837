// Roads that cross where no landmark is.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "compiler/diagnostics/display.h"
#include "sim/world/geometry.h"
#include "sim/world/parts.h"

namespace kb::sim {
namespace {

// note [level crossings]
// A robot that drives straight on is not misled by a line that crosses its own at 60 degrees or more: the row of its sensors is over that
// line only for a moment, and it is too thin for a stop line. At 45 degrees the robot follows now one line, now the other. So where lines
// cross at such an angle, both are left unpainted as far as the row would see both; the controller that drives over a gap in a line
// (hold_heading) drives over this one. Roads with walls cannot cross: the walls would be in the way.

constexpr double kLeastAngle = 15.0 * kPi / 180.0;
constexpr double kNoticed = 55.0 * kPi / 180.0;   // at sharper angles a line misleads
constexpr double kRowSees = 0.12;                 // from the middle of a line; times the size
constexpr double kRowOfLines = 4.0;               // times the width of a line: the same where lines are broad
constexpr double kFromTag = kTagRange + 0.1;      // times the size: a tag of one road is not read from the other

double angle_between(Spot a, Spot b) {
  const double angle = std::abs(wrap(heading(a) - heading(b)));
  return std::min(angle, kPi - angle);
}

bool is_walled(const Road& road) { return road.kind == Picture::Kind::kDist || road.kind == Picture::Kind::kOpen; }

/// Whether a robot that drives along `way` comes near a stop line or a tag of road `a`.
bool has_end_near(double size, const Road& a, const std::vector<Spot>& way) {
  const double tag_m = size * kTagBefore, ends_m[] = {a.begins_m, a.begins_m + tag_m, a.ends_m - tag_m, a.ends_m};
  return std::any_of(std::begin(ends_m), std::end(ends_m), [&](double m) { return nearest_along(way, point_on(a.along, m).at).distance_m < size * kFromTag; });
}

/// Why two roads cannot cross there; empty if they can.
std::string obstacle(const Labyrinth& labyrinth, const Ways& ways, RoadId over, RoadId by, double angle_rad) {
  const Road &a = labyrinth[over], &b = labyrinth[by];
  if (over == by) return "a road does not cross itself";
  if (is_walled(a) || is_walled(b)) return fmt::format("`{}` has walls", is_walled(a) ? a.name : b.name);
  if (angle_rad < kLeastAngle) return fmt::format("{:.0f} degrees is the least angle", kLeastAngle * 180.0 / kPi);
  if (has_end_near(labyrinth.size, a, ways[at(by)])) return fmt::format("`{}` has a stop line there", a.name);
  if (has_end_near(labyrinth.size, b, ways[at(over)])) return fmt::format("`{}` has a stop line there", b.name);
  return {};
}

/// Whether the crossing at `spot` is the one found last: where roads cross in a bend, both pieces of the bent road meet the other road.
bool is_last_of(const Labyrinth& labyrinth, RoadId over, RoadId by, Spot spot) {
  if (labyrinth.levels.empty()) return false;
  const Level& last = labyrinth.levels.back();
  return last.over == over && last.by == by && distance(last.at, spot) < labyrinth.widths.line_m;
}

/// Finds the places where two roads cross; false if they must not cross there (reported).
bool cross_pair(Labyrinth& labyrinth, const Ways& ways, RoadId over, RoadId by, diagnostics::Diagnostics& diagnostics) {
  using diagnostics::Kind;
  const std::vector<Spot>&chain_a = ways[at(over)], &chain_b = ways[at(by)];
  const Road &a = labyrinth[over], &b = labyrinth[by];
  for (std::size_t i = 1; i < chain_a.size(); ++i) {
    for (std::size_t j = over == by ? i + 2 : 1; j < chain_b.size(); ++j) {
      const auto meeting = meet(chain_a[i - 1], chain_a[i], chain_b[j - 1], chain_b[j]);
      if (!meeting || is_last_of(labyrinth, over, by, meeting->at)) continue;
      const double angle = angle_between(chain_a[i] - chain_a[i - 1], chain_b[j] - chain_b[j - 1]);
      const std::string why = obstacle(labyrinth, ways, over, by, angle);
      if (!why.empty()) {
        auto message = diagnostics.report(Kind::kSimRoadsCross, b.span, {a.name, b.name, place_text(labyrinth, meeting->at), why});
        message.note(Kind::kSimOtherHere, a.span);
        note_floor(labyrinth, labyrinth[b.from].map, labyrinth[a.from].map, message);
        return false;
      }
      const bool lines = a.kind == Picture::Kind::kMark && b.kind == Picture::Kind::kMark;
      const double sees_m = std::max(labyrinth.size * kRowSees, kRowOfLines * labyrinth.widths.line_m);
      const double unpainted_m = lines && angle < kNoticed ? 0.5 * sees_m / std::sin(0.5 * angle) : 0.0;
      labyrinth.levels.push_back({over, by, meeting->at, unpainted_m});
    }
  }
  return true;
}

}  // namespace

bool cross_roads(Labyrinth& labyrinth, const Ways& ways, diagnostics::Diagnostics& diagnostics) {
  bool good = true;
  ways.each_pair(0.0, [&](std::size_t i, std::size_t j) {
    if (!cross_pair(labyrinth, ways, static_cast<RoadId>(j), static_cast<RoadId>(i), diagnostics)) good = false;
  });
  if (!good || labyrinth.levels.empty()) return good;
  const Level& first = labyrinth.levels.front();
  const Road &a = labyrinth[first.over], &b = labyrinth[first.by];
  const std::string places = diagnostics::counted(labyrinth.levels.size(), "place");
  auto message = diagnostics.report(diagnostics::Kind::kSimLevel, b.span, {a.name, b.name, place_text(labyrinth, first.at), places});
  message.note(diagnostics::Kind::kSimOtherHere, a.span);
  note_floor(labyrinth, labyrinth[b.from].map, labyrinth[a.from].map, message);
  return true;
}

}  // namespace kb::sim
