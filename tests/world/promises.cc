#include "tests/world/promises.h"

#include <algorithm>

namespace kb::world {

Promises::Promises(const Knowledge& knowledge)
    : firing_(static_cast<float>(knowledge.program().settings.firing)),
      line_in_(knowledge.cell("Line_in")),
      line_out_(knowledge.cell("Line_out")),
      arrived_(knowledge.cell("Arrived")),
      driving_(knowledge.cell("Driving")),
      road_methods_(knowledge.group("Asked")),
      routes_(knowledge.rows("Route")),
      legs_(knowledge.rows("Leg")) {
  for (const char* group : {"Out", "Turn", "Came"}) {
    const Cells cells = knowledge.group(group);
    plans_at_landmark_.insert(plans_at_landmark_.end(), cells.begin(), cells.end());
  }
  const Cells moves = knowledge.group("Move", true);
  road_methods_.insert(road_methods_.end(), moves.begin(), moves.end());
}

bool Promises::any(const Mind& mind, const Cells& cells) const {
  return std::any_of(cells.begin(), cells.end(), [&](program::CellId cell) { return high(mind, cell); });
}

std::string Promises::broken(const Mind& mind) const {
  if (high(mind, line_in_) && high(mind, line_out_)) return "both lines are awaited";
  if (!high(mind, arrived_) && any(mind, plans_at_landmark_)) return "an exit or a turn without a landmark";
  if (!high(mind, driving_) && any(mind, road_methods_)) return "a road method off the road";
  if (any(mind, routes_) != any(mind, legs_)) return "a mission without a leg";
  return {};
}

}  // namespace kb::world
