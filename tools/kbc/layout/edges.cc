#include "tools/kbc/layout/edges.h"

#include <algorithm>

#include "tools/kbc/layout/chain.h"

namespace kb::layout {

Edges::Edges(const Map& map) : map_(map), places_(map.layout.places) {
  for (const Road& road : map.roads) roads_[std::minmax(road.from, road.to)].push_back(&road);
  const std::vector<Way>& ways = map.layout.ways;
  for (auto way = ways.begin(); way != ways.end(); ++way) {
    const Way* first = &*way;
    while (way->goes_on) ++way;
    const auto from = place(first->from), to = place(way->to);
    if (from && to) ways_[{*from, *to}].push_back(first);
  }
}

std::optional<std::uint32_t> Edges::place(std::string_view node) const {
  const Place* place = places_.find(node);
  return place == nullptr ? std::nullopt : std::optional(static_cast<std::uint32_t>(place - map_.layout.places.data()));
}

const std::vector<const Way*>& Edges::ways(std::uint32_t from, std::uint32_t to) const {
  static const std::vector<const Way*> kNone;
  const auto found = ways_.find({from, to});
  return found == ways_.end() ? kNone : found->second;
}

std::optional<Edges::Drive> Edges::find(std::string_view edge, std::uint32_t from, std::uint32_t to) const {
  Drive drive;
  const Way* taken = nullptr;
  std::optional<Visit> begin;
  for (const Way* way : ways(from, to)) {
    if (way->id.empty() || way->id != edge) continue;
    if (from == to) {
      drive.round = plain(course_of(map_.layout, from, way->through, to)).size() > 2;
      return drive;
    }
    const auto other = begin_of(*way);
    if (!begin) taken = way, begin = other;
    else drive.twice = drive.twice || (other && other->exit != begin->exit);
  }
  if (!begin) return std::nullopt;
  for (const Way* piece = taken;; ++piece) {
    drive.visits.push_back(begin_of(*piece).value_or(Visit{}));   // if its first piece has a road, all have
    if (!piece->goes_on) break;
  }
  return drive;
}

std::optional<std::string> Edges::instead_of(std::string_view edge, std::uint32_t from, std::uint32_t to) const {
  for (const Way* way : ways(from, to)) {
    if (!way->id.empty() && way->id != edge) return way->id;
  }
  return std::nullopt;
}

std::optional<Visit> Edges::begin_of(const Way& way) const {
  const auto from = place(way.from), to = place(way.to);
  if (!from || !to) return std::nullopt;
  const auto roads = roads_.find(std::minmax(*from, *to));
  if (roads == roads_.end()) return std::nullopt;
  const std::vector<Point> there = course_of(map_.layout, *from, way.through, *to);
  for (const Road* road : roads->second) {
    if (!lies_on(map_.layout, *road, *from, there)) continue;
    if (const auto exit = road->leads(*from, *to)) return Visit{*from, *exit};
  }
  return std::nullopt;
}

}  // namespace kb::layout
