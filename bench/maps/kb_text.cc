// Tours, and maps as `.kb` text.
#include <fmt/format.h>

#include <iterator>

#include "bench/maps/dice.h"
#include "bench/maps/road_map.h"

namespace kb::bench {
namespace {

constexpr std::string_view kSides = "NESW";
constexpr std::string_view kMethods[] = {"mark", "dist", "azimuth"};

/// What the map adds to std.navigation. All else follows from the tour.
constexpr std::string_view kRules = R"(
# From landmark to landmark, for each road of the map in each direction: who stands at the one awaits the other, planned or
# not. So a robot that has taken a wrong road, or was carried, finds itself again sooner.
rule expect[r in Road] at map
    when seen r.from and Arrived and not Closed[r.exit]
    then +sat r.to

control Move.mark      = follow_line(speed: 0.4 m/s)
control Move.dist      = keep_wall(distance: 0.3 m, speed: 0.3 m/s)
control Move.azimuth   = hold_heading(speed: 0.3 m/s)
control Cross[t, mark] = turn_on_line(turn: t)
control Avoid          = keep_wall(side: right, distance: 0.2 m, speed: 0.2 m/s)
)";

using Text = std::back_insert_iterator<std::string>;

void write_end(Text out, const RoadMap& map, End end) {
  fmt::format_to(out, "{}{}.{}", map.landmarks[end.landmark].letter, end.landmark, kSides[static_cast<std::size_t>(end.side)]);
}

void write_map(Text out, const RoadMap& map) {
  fmt::format_to(out, "map {} {{\n", map.name);
  for (std::size_t i = 0; i < map.landmarks.size(); ++i) {
    const Landmark& l = map.landmarks[i];
    fmt::format_to(out, "    landmark {}{} at ({}, {})\n", l.letter, i, l.at.x_m, l.at.y_m);
  }
  for (const Road& road : map.roads) {
    fmt::format_to(out, "    road ");
    write_end(out, map, road.a);
    fmt::format_to(out, " -- ");
    write_end(out, map, road.b);
    fmt::format_to(out, " by {}", kMethods[static_cast<std::size_t>(road.by)]);
    if (road.bend) fmt::format_to(out, " through ({}, {})", road.bend->x_m, road.bend->y_m);
    fmt::format_to(out, "\n");
  }
  fmt::format_to(out, "}}\n");
}

void write_tour(Text out, const RoadMap& map, const Tour& tour) {
  fmt::format_to(out, "\ncommand Go\nroute Tour on {} by Go:\n    {}", map.name, map.landmark_name(tour.start));
  std::uint32_t at = tour.start;
  for (std::size_t i = 0; i < tour.exits.size(); ++i) {
    at = map.across({at, tour.exits[i]}).landmark;
    fmt::format_to(out, "{}-> {}", i % 10 == 9 ? "\n    " : " ", map.landmark_name(at));
  }
  fmt::format_to(out, "\n");
}

}  // namespace

Tour make_tour(const RoadMap& map, std::uint32_t legs, std::uint64_t seed) {
  Dice dice(seed + 1);   // not the numbers that the map was drawn with
  Tour tour;
  tour.start = dice.below(static_cast<std::uint32_t>(map.landmarks.size()));
  std::uint32_t at = tour.start, came = 4;   // the side that it came by: none yet
  for (std::uint32_t leg = 0; leg < legs; ++leg) {
    std::vector<Side> onward, all;
    for (unsigned side = 0; side < 4; ++side) {
      if (map.landmarks[at].road[side] == kNoRoad) continue;
      all.push_back(static_cast<Side>(side));
      if (side != came) onward.push_back(static_cast<Side>(side));
    }
    const std::vector<Side>& choice = onward.empty() ? all : onward;
    const Side exit = choice[dice.below(static_cast<std::uint32_t>(choice.size()))];
    const End to = map.across({at, exit});
    tour.exits.push_back(exit);
    at = to.landmark;
    came = static_cast<std::uint32_t>(to.side);
  }
  return tour;
}

std::string kb_text(const RoadMap& map, const Tour& tour) {
  std::string text;
  text.reserve(map.roads.size() * 48 + map.landmarks.size() * 40 + 4096);
  const Text out = std::back_inserter(text);
  fmt::format_to(out, "# {} of {} landmarks and {} roads, with a tour of {} legs.\nimport std.navigation\n\n", map.name,
                 map.landmarks.size(), map.roads.size(), tour.exits.size());
  write_map(out, map);
  text += kRules;
  write_tour(out, map, tour);
  return text;
}

}  // namespace kb::bench
