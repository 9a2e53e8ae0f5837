#include "tools/kbc/trace/map_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace kb::trace {
namespace {

using model::Model;

/// The things on a map, by a name that contains the kind and does not depend on how the thing is written.
struct Item { std::string text; std::vector<std::string> landmarks; };
using Items = std::map<std::string, Item>;

std::string point(const model::Point& at) { return fmt::format("({}, {})", at.x, at.y); }

void add_landmark(const Model& model, const model::Row& row, Items& items) {
  const model::Point* at = model.point_in(row, "at");
  std::string text = fmt::format("landmark {}{}", row.name, at != nullptr ? " at " + point(*at) : "");
  items.emplace(fmt::format("landmark {}", row.name), Item{std::move(text), {std::string(row.name)}});
}

/// A two-way road is named in the direction that begins at the end whose name comes first.
void add_road(const Model& model, const model::Map& map, const model::MapRoad& road, bool two_way, Items& items) {
  const model::Row& row = model[road.row];
  const std::size_t cut = row.name.find('>');
  const std::string_view from = row.name.substr(0, cut), to = row.name.substr(std::min(cut + 1, row.name.size()));
  if (two_way && to < from) return;
  std::string text = fmt::format("road {} {} {}", from, two_way ? "--" : "->", to);
  if (const std::string_view method = model.member_in(row, "by"); !method.empty()) text += fmt::format(" by {}", method);
  if (road.limit_m_per_s > 0.0f) text += fmt::format(" at most {} m/s", road.limit_m_per_s);
  const char* before = " through ";
  for (const model::Point& bend : map.through(road)) text += std::exchange(before, ", ") + point(bend);
  std::vector<std::string> ends;
  for (const char* end : {"from", "to"}) {
    if (const model::Row* landmark = model.row_in(row, end)) ends.emplace_back(landmark->name);
  }
  items.emplace(fmt::format("road {} {}", std::min(from, to), std::max(from, to)), Item{std::move(text), std::move(ends)});
}

Items items_of(const Model& model, const model::Map& map) {
  Items items;
  for (const model::RowId landmark : map.landmarks) add_landmark(model, model[landmark], items);
  std::map<std::uint32_t, int> directions;
  for (const model::MapRoad& road : map.roads) ++directions[road.road];
  for (const model::MapRoad& road : map.roads) add_road(model, map, road, directions[road.road] == 2, items);
  return items;
}

}  // namespace

std::vector<MapChange> map_changes(const Model& before, const Model& after) {
  std::vector<MapChange> changes;
  for (const model::Map& map : before.maps) {
    const auto same = std::find_if(after.maps.begin(), after.maps.end(), [&](const model::Map& other) { return other.name == map.name; });
    if (same == after.maps.end()) continue;
    Items old = items_of(before, map), now = items_of(after, *same);
    for (auto& [name, item] : now) old.try_emplace(name);   // now `old` has all names
    for (auto& [name, item] : old) {
      Item& other = now[name];
      if (item.text == other.text) continue;
      changes.push_back({map.name, std::move(item.text), other.text, std::move(item.landmarks)});
      if (changes.back().landmarks.empty()) changes.back().landmarks = std::move(other.landmarks);
    }
  }
  return changes;
}

MapWatch::MapWatch(std::vector<MapChange>& changes, DecisionDiffer::Side before, DecisionDiffer::Side after) {
  std::multimap<std::string_view, MapChange*> places;
  for (MapChange& change : changes) {
    for (const std::string& landmark : change.landmarks) places.emplace(landmark, &change);
  }
  for (const DecisionDiffer::Side& side : {before, after}) {
    for (std::uint32_t i = 0; i < side.program.facts; ++i) {
      const program::Cell& fact = side.program.cells[i];
      const auto [first, last] = places.equal_range(fact.name);
      for (auto at = first; at != last; ++at) sights_.push_back({&side.engine, program::CellId{i}, program::thresholds(fact).attended, at->second});
    }
  }
}

void MapWatch::look() {
  std::erase_if(sights_, [](const Sight& sight) {
    sight.change->reached = sight.change->reached || sight.engine->value(sight.fact) > sight.threshold;
    return sight.change->reached;
  });
}

std::string print(const MapChange& change) {
  std::string what = change.before.empty()  ? "only in NEW: " + change.after
                     : change.after.empty() ? "only in OLD: " + change.before
                                            : change.after + " instead of " + change.before;
  return fmt::format("map {}: {}{}", change.map, what, change.reached ? "" : "; the drive does not come there");
}

}  // namespace kb::trace
