// The text of a map, and of a mission on it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <unordered_set>

#include "compiler/diagnostics/display.h"
#include "compiler/syntax/syntax.h"
#include "tools/kbc/layout/chain.h"
#include "tools/kbc/layout/layout.h"

namespace kb::layout {

namespace {

std::string point_text(Point p) { return fmt::format("({}, {})", as_written(p.x_m), as_written(p.y_m)); }

/// Whether a text from `worded` can begin the name of a landmark. With `_` behind it, it is no word of the language.
bool begins_name(const std::string& text) { return !text.empty() && text[0] != '_' && syntax::is_name(text + '_'); }

bool diagonal(const Road& road) { return road.exit % 2 != 0 || road.approach % 2 != 0; }

/// How many roads lead from one place to another.
std::size_t roads_between(std::span<const Road> roads, std::uint32_t from, std::uint32_t to) {
  return static_cast<std::size_t>(std::count_if(roads.begin(), roads.end(), [&](const Road& r) { return r.leads(from, to).has_value(); }));
}

}  // namespace

std::vector<std::string> landmark_names(const Layout& layout, const Wording& wording) {
  std::vector<std::string> names(layout.places.size());
  std::unordered_set<std::string> used;
  std::unordered_map<std::string, std::size_t> last_of;   // by name: the last number put behind it, less 1
  const auto free = [&](const std::string& name) { return !used.contains(name) && !(wording.taken && wording.taken(name)); };
  for (std::size_t i = 0; i < names.size(); ++i) {   // an id that is a name comes before others that would become it: orders may use it
    const std::string& id = layout.places[i].id;
    if (syntax::worded(id) == id && begins_name(id) && free(id)) used.insert(names[i] = id);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty()) continue;
    std::string name = syntax::worded(layout.places[i].id);
    if (!begins_name(name) || !free(name)) name = wording.prefix + name;
    const std::string plain = name;
    for (std::size_t& k = last_of[plain]; !free(name);) name = fmt::format("{}_{}", plain, ++k + 1);
    used.insert(names[i] = std::move(name));
  }
  return names;
}

std::string write_map(const Map& map, const Wording& wording) {
  const auto& [layout, roads, names] = map;
  std::string out;
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "# The roads of {}, by `kbc import {}`. Metres; x to the east, y to the north.\n", diagnostics::visible(wording.file), wording.format);
  if (!layout.name.empty()) fmt::format_to(to, "# {}\n", diagnostics::visible(layout.name));
  out += "import std.navigation\n";
  if (std::any_of(roads.begin(), roads.end(), diagonal)) out += "import std.compass8\n";
  fmt::format_to(to, "\nmap {} {{\n", wording.map);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Place& place = layout.places[i];
    fmt::format_to(to, "landmark {} at {}", names[i], point_text(place.at));
    if ((names[i] != place.id && names[i] != wording.prefix + place.id) || !place.called.empty() || !place.also.empty()) {
      fmt::format_to(to, "   # {}", diagnostics::visible(place.id));
      for (const std::string& id : place.also) fmt::format_to(to, ", {}", diagnostics::visible(id));
      fmt::format_to(to, "{}{}", place.called.empty() ? "" : ": ", diagnostics::visible(place.called));
    }
    out += '\n';
  }
  out += '\n';
  for (const Road& road : roads) {
    fmt::format_to(to, "road {}.{} {} {}.{} by {}", names[road.from], kSides[road.exit], road.both ? "--" : "->", names[road.to],
                   kSides[road.approach], road.marked ? "mark" : wording.method);
    if (road.limit_m_s > 0.0) fmt::format_to(to, " at most {} m/s", as_written(road.limit_m_s));
    for (std::size_t i = 0; i < road.through.size(); ++i) fmt::format_to(to, "{}{}", i == 0 ? " through " : ", ", point_text(road.through[i]));
    out += '\n';
  }
  out += "}\n";
  return out;
}

std::string write_mission(const Mission& mission, const Map& map, const Wording& wording) {
  std::vector<std::string> stops;
  for (std::size_t i = 0; i < mission.visits.size(); ++i) {
    const Visit& visit = mission.visits[i];
    const bool choice = i + 1 < mission.visits.size() && roads_between(map.roads, visit.place, mission.visits[i + 1].place) > 1;
    stops.push_back(choice ? fmt::format("{}.{}", map.names[visit.place], kSides[visit.exit]) : map.names[visit.place]);
  }
  const std::string head = mission.order.empty() ? "" : fmt::format("# {}\n", diagnostics::visible(mission.order));
  return fmt::format("\ncommand Start\n{}route Mission on {} by Start:\n    {}\n{}\n{}", head, wording.map, fmt::join(stops, " -> "),
                     mission.order.empty() && !mission.alone && has_way_round(map, mission) ? "detours on Mission\n" : "", wording.controllers);
}

}  // namespace kb::layout
