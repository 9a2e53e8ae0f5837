// The text of a map, and of a mission on it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <cmath>
#include <iterator>
#include <unordered_map>
#include <unordered_set>

#include "compiler/diagnostics/consumers.h"
#include "compiler/diagnostics/display.h"
#include "compiler/syntax/syntax.h"
#include "tools/kbc/layout/layout.h"

namespace kb::layout {

using diagnostics::Kind;

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_foreign(char c) { return static_cast<unsigned char>(c) >= 0x80; }

// Tenths of a millimetre, and no minus before a zero.
std::string point_text(Point p) {
  const auto rounded = [](double m) { return std::round(m * 1e4) / 1e4 + 0.0; };
  return fmt::format("({}, {})", rounded(p.x_m), rounded(p.y_m));
}

// Of letters that are not ASCII only the lexer can tell which may stand in a name, and which begin one.
bool is_one_name(const std::string& text) {
  source::Sources sources;
  diagnostics::CountingConsumer counted;
  diagnostics::Diagnostics diagnostics(sources, counted);
  const auto tokens = syntax::lex(sources, sources.add({}, text), diagnostics);
  return !diagnostics.failed() && tokens.size() == 2 && tokens[0].kind == syntax::TokenKind::kIdentifier;
}

bool begins_name(const std::string& text) {
  return !text.empty() && (is_letter(text[0]) || (is_foreign(text[0]) && is_one_name(text)));
}

/// `id` with `_` for what cannot stand in a name; it may still begin with a digit, or be empty.
std::string worded(std::string_view id) {
  constexpr std::size_t kLongest = 200;   // of 255, so that a prefix and a number have room
  std::string name(id.substr(0, kLongest));
  std::replace_if(name.begin(), name.end(), [](char c) { return !is_letter(c) && !is_digit(c) && !is_foreign(c); }, '_');
  if (std::any_of(name.begin(), name.end(), is_foreign) && !is_one_name("a" + name)) std::replace_if(name.begin(), name.end(), is_foreign, '_');
  return name;
}

bool diagonal(const Road& road) { return road.exit % 2 != 0 || road.approach % 2 != 0; }

double length_of(const Layout& layout, const Road& road) {
  Point at = layout.places[road.from].at;
  double length = 0.0;
  const auto go = [&](Point to) { length += std::hypot(to.x_m - at.x_m, to.y_m - at.y_m), at = to; };
  for (const Point& point : road.through) go(point);
  go(layout.places[road.to].at);
  return length;
}

using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property, boost::property<boost::edge_weight_t, double>>;

Graph graph_of(const Layout& layout, std::span<const Road> roads) {
  Graph graph(layout.places.size());
  for (const Road& road : roads) {
    const double length = length_of(layout, road);
    boost::add_edge(road.from, road.to, length, graph);
    if (road.both) boost::add_edge(road.to, road.from, length, graph);
  }
  return graph;
}

/// The places behind `from` on the shortest way to `to`; empty if there is none.
std::vector<std::uint32_t> way_between(const Graph& graph, std::uint32_t from, std::uint32_t to) {
  std::vector<std::size_t> before(boost::num_vertices(graph));
  boost::dijkstra_shortest_paths(graph, from, boost::predecessor_map(before.data()));
  std::vector<std::uint32_t> way;
  for (std::size_t at = to; at != from; at = before[at]) {
    if (before[at] == at) return {};
    way.push_back(static_cast<std::uint32_t>(at));
  }
  std::reverse(way.begin(), way.end());
  return way;
}

/// `A.E` where more than one road leads on from A to `to`: the shortest. Else `A`.
std::string stop_text(const Layout& layout, std::span<const Road> roads, std::span<const std::string> names, std::uint32_t from, std::uint32_t to) {
  double least = 0.0;
  std::size_t count = 0;
  std::uint32_t exit = 0;
  for (const Road& road : roads) {
    const bool there = road.from == from && road.to == to, back = road.both && road.to == from && road.from == to;
    if (!there && !back) continue;
    const double length = length_of(layout, road);
    if (count++ != 0 && length >= least) continue;
    least = length;
    exit = there ? road.exit : road.approach;
  }
  return count > 1 ? fmt::format("{}.{}", names[from], kSides[exit]) : names[from];
}

}  // namespace

std::vector<std::string> landmark_names(const Layout& layout, const Wording& wording) {
  std::vector<std::string> names;
  std::unordered_set<std::string> used;
  const auto free = [&](const std::string& name) { return !used.contains(name) && !(wording.taken && wording.taken(name)); };
  for (const Place& place : layout.places) {
    std::string name = worded(place.id);
    if (!begins_name(name) || !free(name)) name = wording.prefix + name;
    const std::string plain = name;
    for (std::size_t i = 2; !free(name); ++i) name = fmt::format("{}_{}", plain, i);
    used.insert(name);
    names.push_back(std::move(name));
  }
  return names;
}

std::string write_map(const Layout& layout, std::span<const Road> roads, std::span<const std::string> names, const Wording& wording) {
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
    if (!names[i].ends_with(place.id) || !place.called.empty()) {
      fmt::format_to(to, "   # {}{}{}", diagnostics::visible(place.id), place.called.empty() ? "" : ": ", diagnostics::visible(place.called));
    }
    out += '\n';
  }
  out += '\n';
  for (const Road& road : roads) {
    fmt::format_to(to, "road {}.{} {} {}.{} by {}", names[road.from], kSides[road.exit], road.both ? "--" : "->", names[road.to],
                   kSides[road.approach], road.marked ? "mark" : wording.method);
    for (std::size_t i = 0; i < road.through.size(); ++i) fmt::format_to(to, "{}{}", i == 0 ? " through " : ", ", point_text(road.through[i]));
    out += '\n';
  }
  out += "}\n";
  return out;
}

std::optional<std::string> write_mission(const Layout& layout, std::span<const Road> roads, std::span<const std::string> names,
                                         const Wording& wording, std::span<const std::string> stops, diagnostics::Diagnostics& diagnostics) {
  std::unordered_map<std::string_view, std::uint32_t> index;
  for (std::uint32_t i = 0; i < names.size(); ++i) index.try_emplace(names[i], i);
  for (std::uint32_t i = 0; i < names.size(); ++i) index.insert_or_assign(layout.places[i].id, i);
  const Graph graph = graph_of(layout, roads);
  std::vector<std::uint32_t> way;
  for (const std::string& stop : stops) {
    const auto found = index.find(stop);
    if (found == index.end()) {
      std::vector<std::string_view> known;
      for (const Place& place : layout.places) known.push_back(place.id);
      diagnostics.report(Kind::kLayoutNoStop, {}, {stop}).suggest(diagnostics::closest(stop, known));
      return std::nullopt;
    }
    if (way.empty()) {
      way.push_back(found->second);
      continue;
    }
    const auto more = way_between(graph, way.back(), found->second);
    if (more.empty()) {
      diagnostics.report(Kind::kLayoutNoWay, {}, {layout.places[way.back()].id, stop});
      return std::nullopt;
    }
    way.insert(way.end(), more.begin(), more.end());
  }
  std::vector<std::string> legs;
  for (std::size_t i = 0; i < way.size(); ++i) {
    legs.push_back(i + 1 < way.size() ? stop_text(layout, roads, names, way[i], way[i + 1]) : names[way[i]]);
  }
  return fmt::format("\ncommand Start\nroute Mission on {} by Start:\n    {}\ndetours on Mission\n\n{}", wording.map, fmt::join(legs, " -> "), wording.controllers);
}

}  // namespace kb::layout
