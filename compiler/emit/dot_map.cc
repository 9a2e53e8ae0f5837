// The picture of the map, with routes and detours.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "compiler/emit/dot.h"

namespace kb::emit {
namespace {

using model::Model;
using model::Point;
using model::RowId;

// How long the shortest road is drawn, in inches: there is room for the names of two exits.
constexpr double kShortestRoadIn = 1.7;
// Line styles of the methods, in the order of declaration. They can be told apart without colours.
constexpr std::array<std::string_view, 5> kLines{"solid", "dashed", "dotted", "bold", "tapered"};
// The palette of Okabe and Ito, which colour-blind people can distinguish. Legs are also labelled.
constexpr std::array<std::string_view, 5> kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9"};

// The value of a row's field, if there is one and it is a `T`.
template <class T>
std::optional<T> field(const Model& model, RowId row, std::string_view name) {
  const T* value = std::get_if<T>(model.field(model[row], name));
  return value == nullptr ? std::nullopt : std::optional<T>(*value);
}

std::string node(RowId landmark) { return fmt::format("l{}", index(landmark)); }

/// Where landmarks and bends are drawn, in inches.
class Canvas {
 public:
  explicit Canvas(const Model& model) : scale_(scale(model)) {}
  [[nodiscard]] std::string at(Point point) const {
    return fmt::format("{:.3f},{:.3f}!", point.x * scale_, point.y * scale_);
  }

 private:
  static double scale(const Model& model) {
    double shortest = 0.0;
    for (const model::Map& map : model.maps) {
      for (const model::MapRoad& road : map.roads) {
        const auto from = field<RowId>(model, road.row, "from"), to = field<RowId>(model, road.row, "to");
        if (!from || !to) continue;
        const Point *a = model.point_in(model[*from], "at"), *b = model.point_in(model[*to], "at");
        if (!a || !b) continue;
        const double length = std::hypot(a->x - b->x, a->y - b->y);
        if (length > 0.0 && (shortest == 0.0 || length < shortest)) shortest = length;
      }
    }
    return shortest > 0.0 ? kShortestRoadIn / shortest : 1.0;
  }
  double scale_;
};

/// For each (landmark, exit): the nodes over which its road is drawn, including its ends.
using Ways = std::map<std::pair<RowId, std::string>, std::vector<std::string>>;

void print_chain(const std::vector<std::string>& chain, std::string_view attributes, std::string_view first,
                 std::string_view last, std::string& out) {
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    out += fmt::format("  {} -> {} [{}{}{}];\n", chain[i], chain[i + 1], attributes, i == 0 ? first : "",
                       i + 2 == chain.size() ? last : "");
  }
}

void print_landmarks(const Model& model, const model::Map& map, const Canvas& canvas, const std::set<RowId>& ends,
                     std::string& out) {
  for (const RowId landmark : map.landmarks) {
    const Point* at = model.point_in(model[landmark], "at");
    out += fmt::format("  {} [label={}{}{}];\n", node(landmark), dot_string(model[landmark].name),
                       at ? fmt::format(", pos=\"{}\"", canvas.at(*at)) : "",
                       ends.contains(landmark) ? ", peripheries=2" : "");
  }
}

// Prints each road once, also if it can be driven both ways.
void print_roads(const Model& model, const model::Map& map, const Canvas& canvas, Ways& ways, std::string& out) {
  std::map<std::uint32_t, std::vector<const model::MapRoad*>> roads;
  for (const model::MapRoad& road : map.roads) roads[road.road].push_back(&road);
  for (const auto& [id, directions] : roads) {
    const model::MapRoad& road = *directions.front();
    const auto from = field<RowId>(model, road.row, "from"), to = field<RowId>(model, road.row, "to");
    if (!from || !to) continue;
    std::vector<std::string> chain{node(*from)};
    const auto through = map.through(road);
    for (std::size_t i = 0; i < through.size(); ++i) {
      const std::string bend = fmt::format("b{}_{}_{}", index(*from), id, i);
      out += fmt::format("  {} [shape=point, width=0.03, label=\"\", pos=\"{}\"];\n", bend, canvas.at(through[i]));
      chain.push_back(bend);
    }
    chain.push_back(node(*to));
    const std::string exit(model.member_in(model[road.row], "exit")), approach(model.member_in(model[road.row], "approach"));
    ways[{*from, exit}] = chain;
    if (directions.size() > 1) ways[{*to, approach}] = {chain.rbegin(), chain.rend()};
    const auto by = field<model::Member>(model, road.row, "by");
    const std::string style = fmt::format("style={}, dir={}", by ? kLines[by->index % kLines.size()] : kLines[0],
                                          directions.size() > 1 ? "none" : "forward");
    const std::string limit = road.limit_m_per_s > 0.0f ? fmt::format(", label={}", dot_string(fmt::format("{} m/s", road.limit_m_per_s))) : "";
    print_chain(chain, style, fmt::format(", taillabel={}{}", dot_string(exit), limit),
                fmt::format(", headlabel={}", dot_string(approach)), out);
  }
}

struct Plans {
  std::set<RowId> drawn;  // legs
  std::set<std::pair<RowId, std::string>> detoured;
};

// Prints the legs from `first` on, up to one that has been printed, which also ends loops.
void print_legs(const Model& model, RowId first, const Ways& ways, Plans& plans, std::string_view style,
                const std::string& name, bool detour, std::string& out) {
  std::size_t number = 0;
  for (std::optional<RowId> leg = first; leg && plans.drawn.insert(*leg).second;
       leg = field<RowId>(model, *leg, "next")) {
    const auto from = field<RowId>(model, *leg, "from");
    if (!from) continue;  // the leg to the first landmark may begin anywhere
    ++number;
    const std::pair<RowId, std::string> start{*from, std::string(model.member_in(model[*leg], "exit"))};
    const auto way = ways.find(start);
    if (way == ways.end() || (detour && !plans.detoured.insert(start).second)) continue;
    const std::string label = fmt::format(", label={}", dot_string(detour ? name : fmt::format("{} {}", name, number)));
    print_chain(way->second, style, label, "", out);
  }
}

void print_plans(const Model& model, const Ways& ways, std::string& out) {
  Plans plans;
  std::size_t number = 0;
  for (const RowId route : model.rows_of("Route")) {
    if (const auto first = field<RowId>(model, route, "first")) {
      const std::string_view colour = kColours[number++ % kColours.size()];
      print_legs(model, *first, ways, plans,
                 fmt::format("color=\"{0}\", fontcolor=\"{0}\", penwidth=2.5, constraint=false", colour),
                 std::string(model[route].name), false, out);
    }
  }
  for (const RowId detour : model.rows_of("Detour")) {
    if (const auto first = field<RowId>(model, detour, "first")) {
      print_legs(model, *first, ways, plans,
                 "color=\"#606060\", fontcolor=\"#606060\", penwidth=2, style=dashed, arrowhead=empty", "detour",
                 true, out);
    }
  }
}

// The landmarks where routes end.
std::set<RowId> ends_of_routes(const Model& model) {
  std::set<RowId> ends;
  for (const RowId leg : model.rows_of("Leg"))
    if (const auto to = field<RowId>(model, leg, "to"); to && field<RowId>(model, leg, "ends")) ends.insert(*to);
  return ends;
}

// The text under the picture: which line is which method.
std::string legend(const Model& model) {
  std::string out;
  for (const RowId road : model.rows_of("Road")) {
    if (const auto by = field<model::Member>(model, road, "by")) {
      const auto& methods = model.sets[index(by->set)].members;
      for (std::size_t i = 0; i < methods.size(); ++i)
        out += fmt::format("{}{}: {}", i == 0 ? "" : "   ", kLines[i % kLines.size()], methods[i]);
      break;
    }
  }
  return out + (out.empty() ? "" : "   ") + "thick: routes, by leg   double circle: a route ends here";
}

}  // namespace

std::string print_map_dot(const Model& model) {
  std::string out =
      "digraph {\n"
      "  graph [layout=neato, splines=true, overlap=true, fontname=\"Helvetica\", fontsize=11, labelloc=b];\n"
      "  node [shape=circle, fixedsize=true, width=0.5, fontname=\"Helvetica\", fontsize=10];\n"
      "  edge [fontname=\"Helvetica\", fontsize=9, labeldistance=1.6, arrowsize=0.7];\n";
  out += fmt::format("  label={};\n", dot_string(legend(model)));
  const Canvas canvas(model);
  const std::set<RowId> ends = ends_of_routes(model);
  Ways ways;
  for (const model::Map& map : model.maps) {
    print_landmarks(model, map, canvas, ends, out);
    print_roads(model, map, canvas, ways, out);
  }
  print_plans(model, ways, out);
  return out + "}\n";
}

}  // namespace kb::emit
