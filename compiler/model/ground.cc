#include "compiler/model/ground.h"

#include <fmt/format.h>

#include <algorithm>

namespace kb::model {

std::optional<std::vector<GroundRoad>> ground_roads(const Model& model, const Map& map) {
  std::vector<GroundRoad> roads;
  roads.reserve(map.roads.size());
  for (const MapRoad& road : map.roads) {
    const Row& row = model[road.row];
    const Row *from = model.row_in(row, "from"), *to = model.row_in(row, "to");
    if (from == nullptr || to == nullptr) return std::nullopt;
    const Point *begin = model.point_in(*from, "at"), *end = model.point_in(*to, "at");
    GroundRoad made{.row = road.row, .from = from->name, .to = to->name, .exit = model.member_in(row, "exit"), .approach = model.member_in(row, "approach"),
                    .by = model.member_in(row, "by"), .course = {}, .limit_m_per_s = road.limit_m_per_s};
    if (begin == nullptr || end == nullptr || made.exit.empty()) return std::nullopt;
    const std::span<const Point> through = map.through(road);
    made.course.reserve(through.size() + 2);
    made.course.push_back(*begin);
    made.course.insert(made.course.end(), through.begin(), through.end());
    made.course.push_back(*end);
    roads.push_back(std::move(made));
  }
  return roads;
}

std::string ground_lacking(const Model& model, const Map& map) {
  const auto has_place = [&](RowId landmark) { return model.point_in(model[landmark], "at") != nullptr; };
  const auto without = std::find_if_not(map.landmarks.begin(), map.landmarks.end(), has_place);
  if (without != map.landmarks.end() && std::any_of(map.landmarks.begin(), map.landmarks.end(), has_place)) {
    return fmt::format("place `at` for landmark `{}` of map `{}`", model[*without].name, map.name);
  }
  return "map whose landmarks have a place `at` and whose roads have `from`, `to` and `exit`";
}

}  // namespace kb::model
