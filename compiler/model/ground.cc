#include "compiler/model/ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <utility>

namespace kb::model {
namespace {

double direction(const Point& from, const Point& to) { return std::atan2(to.y - from.y, to.x - from.x); }
double direction_out(const GroundRoad& road) { return direction(road.course[0], road.course[1]); }
double direction_back(const GroundRoad& road) { return direction(road.course.back(), road.course[road.course.size() - 2]); }

/// The directions in which roads leave a landmark, in ascending order.
class Star {
 public:
  void add(double direction_rad) { directions_rad_.push_back(direction_rad); }
  void sort() {
    source::sort_unique(directions_rad_);   // both directions of a road
  }
  /// From one of them to its nearest neighbour.
  [[nodiscard]] double apart_rad(double direction_rad) const {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const auto at = std::lower_bound(directions_rad_.begin(), directions_rad_.end(), direction_rad);
    const double before = at == directions_rad_.begin() ? directions_rad_.back() - kTurn : *std::prev(at);
    const double after = std::next(at) == directions_rad_.end() ? directions_rad_.front() + kTurn : *std::next(at);
    return std::min({std::numbers::pi, *at - before, after - *at});
  }

 private:
  std::vector<double> directions_rad_;
};

void tell_apart(std::vector<GroundRoad>& roads) {
  std::unordered_map<std::string_view, Star> stars;
  for (const GroundRoad& road : roads) {
    stars[road.from].add(direction_out(road));
    stars[road.to].add(direction_back(road));
  }
  for (auto& [landmark, star] : stars) star.sort();
  for (GroundRoad& road : roads) {
    road.begins_apart_rad = stars.at(road.from).apart_rad(direction_out(road));
    road.ends_apart_rad = stars.at(road.to).apart_rad(direction_back(road));
  }
}

}  // namespace

GroundRoad reversed(const GroundRoad& road) {
  GroundRoad back = road;
  std::swap(back.from, back.to);
  std::swap(back.exit, back.approach);
  std::swap(back.begins_apart_rad, back.ends_apart_rad);
  std::reverse(back.course.begin(), back.course.end());
  return back;
}

std::vector<GroundPiece> pieces_of(std::span<const Point> course) {
  constexpr double kShortest_m = 0.01;
  std::vector<GroundPiece> pieces;
  Point here = course.front();
  for (std::size_t i = 1; i < course.size(); ++i) {
    const double length_m = std::hypot(course[i].x - here.x, course[i].y - here.y);
    const bool only = i + 1 == course.size() && pieces.empty();
    if (length_m < kShortest_m && !only) continue;
    pieces.push_back({direction(here, course[i]), length_m});
    here = course[i];
  }
  return pieces;
}

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
  tell_apart(roads);
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
