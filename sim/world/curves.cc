// Curves that leave a landmark along another road.
#include <algorithm>
#include <cmath>
#include <set>

#include "compiler/diagnostics/display.h"
#include "sim/world/geometry.h"
#include "sim/world/parts.h"

namespace kb::sim {
namespace {

// note [curves that leave along a road]
// In a plant a curve leaves along the road that it turns off from: at the landmark the two are parallel, some metres farther on they are
// well apart. Exits that are nearly parallel have their stop lines far out, or cannot be told apart at all. So where two exits are near
// to each other, a road is built without its first bend, again and again, as long as that sets its exit farther apart from the others.

constexpr double kNear = 25.0 * kPi / 180.0;   // exits at least this far apart have stop lines not much farther out than those of other crossings

/// The angle between an exit, if it led to `next`, and the nearest other exit of its crossing.
double apart(const Labyrinth& labyrinth, const Crossing& crossing, const Arm& arm, Spot next) {
  double least = kPi;
  for (const Arm& other : crossing.arms) {
    if (&other == &arm) continue;
    least = std::min(least, std::abs(wrap(heading(next - crossing.at) - heading(labyrinth.point(other, 1) - crossing.at))));
  }
  return least;
}

/// Whether an exit is better without the first bend of its road.
bool is_curve(const Labyrinth& labyrinth, const Crossing& crossing, const Arm& arm) {
  if (labyrinth[arm.road].along.size() < 3) return false;
  const double now = apart(labyrinth, crossing, arm, labyrinth.point(arm, 1));
  return now < kNear && apart(labyrinth, crossing, arm, labyrinth.point(arm, 2)) > now;
}

/// Removes the first bend of one curve at the crossing; false if there is none.
bool straighten(Labyrinth& labyrinth, const Crossing& crossing, std::set<RoadId>& straightened) {
  const auto arm = std::find_if(crossing.arms.begin(), crossing.arms.end(), [&](const Arm& a) { return is_curve(labyrinth, crossing, a); });
  if (arm == crossing.arms.end()) return false;
  auto& along = labyrinth.roads[at(arm->road)].along;
  along.erase(arm->forward ? along.begin() + 1 : along.end() - 2);
  straightened.insert(arm->road);
  return true;
}

}  // namespace

void straighten_curves(Labyrinth& labyrinth, diagnostics::Diagnostics& diagnostics) {
  std::set<RoadId> straightened;
  for (bool again = true; again;) {   // a road without bends is one straight piece: it leaves its other landmark in another direction too
    again = false;
    for (const Crossing& crossing : labyrinth.crossings) {
      while (straighten(labyrinth, crossing, straightened)) again = true;
    }
  }
  if (straightened.empty()) return;
  const Road& first = labyrinth[*straightened.begin()];
  diagnostics.report(diagnostics::Kind::kSimStraight, first.span, {first.name, diagnostics::counted(straightened.size(), "road")});
}

}  // namespace kb::sim
