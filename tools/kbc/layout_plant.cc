#include "tools/kbc/layout_plant.h"

#include <fmt/format.h>

#include <utility>

namespace kb::cli {

LayoutPlant::LayoutPlant(layout::Map map, const sim::Labyrinth& labyrinth, std::string map_id, bool turns, std::string prefix)
    : map_(std::move(map)), edges_(map_), roads_(labyrinth, std::move(map_id), turns, std::move(prefix)) {
  for (std::uint32_t i = 0; i < map_.names.size(); ++i) places_.emplace(map_.names[i], i);
}

vda5050::Visit LayoutPlant::worded(const layout::Visit& visit) const { return {map_.names[visit.place], std::string(layout::kSides[visit.exit])}; }

bool LayoutPlant::is_on_floor(diagnostics::Diagnostics& diagnostics) const {
  const auto refuse = [&](source::Span at, const std::string& why) {
    diagnostics.report(diagnostics::Kind::kLayoutOther, at, {why});
    return false;
  };
  for (std::size_t i = 0; i < map_.names.size(); ++i) {
    const layout::Place& place = map_.layout.places[i];
    if (roads_.node_at(map_.names[i])) continue;
    return refuse(place.span, fmt::format("node `{}` is its landmark `{}`, which it has not", place.id, map_.names[i]));
  }
  for (const layout::Way& way : map_.layout.ways) {
    const auto begin = edges_.begin_of(way);
    const auto end = edges_.place(way.to);
    if (!begin || !end) continue;   // left out
    const vda5050::Visit from = worded(*begin);
    const std::string& to = map_.names[*end];
    if (roads_.leads(from, to)) continue;
    return refuse(way.from_span, fmt::format("edge `{}` leaves its landmark `{}` by `{}` for `{}`, where it has no road", way.id, from.landmark,
                                             from.exit, to));
  }
  return true;
}

std::optional<std::string> LayoutPlant::landmark_of(std::string_view node) const {
  if (const auto place = edges_.place(node)) return map_.names[*place];
  auto landmark = roads_.landmark_of(node);
  if (landmark && places_.contains(*landmark)) landmark.reset();
  return landmark;
}

std::optional<std::string> LayoutPlant::node_at(std::string_view landmark) const {
  const auto place = places_.find(landmark);
  return place == places_.end() ? roads_.node_at(landmark) : std::optional(map_.layout.places[place->second].id);
}

std::optional<vda5050::Pose> LayoutPlant::place_of(std::string_view node) const {
  const auto place = edges_.place(node);
  if (!place) return roads_.place_of(node);
  const layout::Point at = map_.layout.places[*place].at;
  return vda5050::Pose{at.x_m, at.y_m, 0.0};
}

std::optional<std::vector<vda5050::Visit>> LayoutPlant::way(std::string_view edge, std::string_view from, std::string_view to) const {
  const auto begin = edges_.place(from), end = edges_.place(to);
  if (!begin || !end) {
    const auto first = landmark_of(from), last = landmark_of(to);
    return first && last ? roads_.way(edge, *first, *last) : std::nullopt;
  }
  const auto drive = edges_.find(edge, *begin, *end);
  if (!drive || drive->round) return std::nullopt;
  std::vector<vda5050::Visit> way;
  for (const layout::Visit& visit : drive->visits) way.push_back(worded(visit));
  return way;
}

std::string map_of(const layout::Layout& layout) {
  std::string map;
  for (const layout::Place& place : layout.places) {
    if (place.map.empty()) continue;
    if (!map.empty() && place.map != map) return {};
    map = place.map;
  }
  return map;
}

}  // namespace kb::cli
