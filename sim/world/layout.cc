#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <waymark/controllers/road_map.h>

#include "sim/world/geometry.h"
#include "sim/world/parts.h"

namespace kb::sim {
namespace {

using diagnostics::Diagnostics;
using diagnostics::Kind;

constexpr double kLeastGap = 10.0 * kPi / 180.0;       // between two arms
constexpr double kMostAstray = kPi / 4.0 + 1e-6;       // of an arm from the direction that it is called by
constexpr double kLeastEndPiece = 0.5;                 // of straight road outside of a stop line; times the size
constexpr double kScaleStep = 0.05;
constexpr double kFarthestFloor = 1e8;                 // m; at this distance neighbouring doubles are 15 nm apart
constexpr double kLargestFloor = 1e6;                  // m2; 16 million squares of floor.cc

std::string degrees(double rad) { return fmt::format("{}", std::lround(rad * 180.0 / kPi)); }
/// As people read a compass: clockwise from north, 0 to 359.
std::string compass_degrees(double heading_rad) {
  return fmt::format("{}", (std::lround((kPi / 2.0 - heading_rad) * 180.0 / kPi) + 720) % 360);
}

Picture::Kind kind_of(std::string_view method) {
  if (method == "mark" || method.empty()) return Picture::Kind::kMark;
  if (method == "dist") return Picture::Kind::kDist;
  if (method == "azimuth") return Picture::Kind::kAzimuth;
  return Picture::Kind::kOpen;
}

/// Whether its rows say where roads begin and end: a relation of the user's own may lack that.
bool has_ends(const model::Relation& road, Diagnostics& diagnostics) {
  bool all = true;
  for (const std::string_view field : {"from", "to", "exit", "approach"}) {
    if (std::find(road.fields.begin(), road.fields.end(), field) != road.fields.end()) continue;
    diagnostics.report(Kind::kSimRoadField, road.declared, {field});
    all = false;
  }
  return all;
}

void read_roads(const model::Model& model, const model::Map& map, Labyrinth& out) {
  const auto crossing_of = [&](const model::Row& row, std::string_view name) {
    const auto* id = std::get_if<model::RowId>(model.field(row, name));
    return out.crossing(model[*id].name);
  };
  for (std::size_t i = 0; i < map.roads.size(); ++i) {
    if (i > 0 && map.roads[i].road == map.roads[i - 1].road) continue;   // the way back
    const bool both_ways = i + 1 < map.roads.size() && map.roads[i + 1].road == map.roads[i].road;
    const model::Row& row = model[map.roads[i].row];
    Road road;
    road.from = crossing_of(row, "from");
    road.to = crossing_of(row, "to");
    road.exit = model.member_in(row, "exit");
    road.approach = model.member_in(row, "approach");
    road.method = model.member_in(row, "by");
    if (road.method.empty()) road.method = "mark";
    road.kind = kind_of(road.method);
    road.width_m = out.size * (road.kind == Picture::Kind::kOpen ? kHallWidth : kRoadWidth);
    road.span = row.declared;
    road.name = fmt::format("{}.{}{}{}.{}", out[road.from].name, road.exit, both_ways ? "--" : "->", out[road.to].name, road.approach);
    road.along.push_back(out[road.from].at);
    const Spot end = out[road.to].at;
    for (const model::Point& point : map.through(map.roads[i])) {   // without bends where the road already is or where it ends
      const Spot bend{point.x, point.y};
      if (distance(road.along.back(), bend) > 0.0 && distance(bend, end) > 0.0) road.along.push_back(bend);
    }
    road.along.push_back(end);
    const auto id = static_cast<RoadId>(out.roads.size());
    out.crossings[at(road.from)].arms.push_back({road.exit, id, true, true, 0.0, 0.0});
    out.crossings[at(road.to)].arms.push_back({road.approach, id, false, both_ways, 0.0, 0.0});
    out.roads.push_back(std::move(road));
  }
}

/// Reports a box that is none, or that is not between the walls of its hall.
bool check_box(const std::string& hall, const HallBuild::Box& box, double long_m, double width_m, double size, Diagnostics& diagnostics) {
  constexpr double kWritten = 0.005;   // m: places are told to a centimetre
  const auto wrong = [&](std::string_view what, std::string wanted) {
    diagnostics.report(Kind::kSimHallBox, box.span, {hall, what, std::move(wanted)});
    return false;
  };
  const auto within = [&](double from, double to, double low, double high) { return from >= low - kWritten && to <= high + kWritten; };
  const double door_m = size * kHallDoor, half_m = 0.5 * width_m;
  if (!(box.to_along_m > box.from_along_m) && !(box.to_aside_m > box.from_aside_m)) return wrong("is a point", "another corner");
  if (!within(box.from_along_m, box.to_along_m, door_m, long_m - door_m)) {
    return wrong("is not between its doors", fmt::format("from {:.2f} to {:.2f} m along it", door_m, long_m - door_m));
  }
  if (within(box.from_aside_m, box.to_aside_m, -half_m, half_m)) return true;
  return wrong("is not between its walls", fmt::format("from {:.2f} to {:.2f} m across it", -half_m, half_m));
}

bool furnish(Labyrinth& labyrinth, const std::vector<HallBuild>& halls, Diagnostics& diagnostics) {
  bool good = true;
  std::map<RoadId, source::Span> described;
  for (const HallBuild& hall : halls) {
    const auto end = labyrinth.end(hall.road);
    if (!end || labyrinth[end->arm->road].kind != Picture::Kind::kOpen) {
      diagnostics.report(Kind::kSimUnknownName, hall.span, {"hall", hall.road});
      good = false;
      continue;
    }
    const auto [first, fresh] = described.try_emplace(end->arm->road, hall.span);
    if (!fresh) {   // named by the same end or by the other
      diagnostics.report(Kind::kSimTwice, hall.span, {"hall", hall.road}).note(Kind::kSimFirstDescribed, first->second);
      good = false;
      continue;
    }
    Road& road = labyrinth.roads[at(end->arm->road)];
    road.width_m = hall.width_m.value_or(road.width_m);
    road.pillars = hall.pillars;
    road.boxes = hall.boxes;
    const double long_m = road.ends_m - road.begins_m;
    for (const HallBuild::Box& box : road.boxes) good = check_box(hall.road, box, long_m, road.width_m, labyrinth.size, diagnostics) && good;
    if (end->arm->forward) continue;
    for (HallBuild::Box& box : road.boxes) {
      box = {long_m - box.to_along_m, -box.to_aside_m, long_m - box.from_along_m, -box.from_aside_m, box.span};
    }
  }
  return good;
}

/// How far out the stop line of an arm lies: clear of the corners with the arms beside it.
double stop_of(const Crossing& crossing, const Arm& arm, double size) {
  return size * static_cast<double>(mts::stop_line_m(static_cast<float>(crossing.apart_rad(arm)), kRobot));
}

/// The scale at which a road has room for its stop lines and what lies between them.
double least_scale(const Labyrinth& labyrinth, const Road& road) {
  const double begin_m = labyrinth[road.from].arm(road.exit)->stop_m, end_m = labyrinth[road.to].arm(road.approach)->stop_m;
  const double end_piece_m = labyrinth.size * kLeastEndPiece;
  double least = (begin_m + end_m + labyrinth.size * kLeastRoad) / length_of(road.along);
  if (road.along.size() > 2) {
    least = std::max(least, (begin_m + end_piece_m) / distance(road.along[0], road.along[1]));
    least = std::max(least, (end_m + end_piece_m) / distance(road.along[road.along.size() - 2], road.along.back()));
  }
  return least;
}

std::vector<std::vector<Spot>> chains_of(const Labyrinth& labyrinth) {
  std::vector<std::vector<Spot>> chains;
  for (const Road& road : labyrinth.roads) chains.push_back(road.between_stop_lines());
  return chains;
}

}  // namespace

std::optional<Labyrinth> read_map(const model::Model& model, double size, Diagnostics& diagnostics) {
  Labyrinth out;
  out.size = size;
  bool whole = true;
  for (const model::Map& map : model.maps) {
    out.maps.emplace_back(map.name);
    for (const model::RowId id : map.landmarks) {
      const model::Row& row = model[id];
      const model::Point* point = model.point_in(row, "at");
      if (point == nullptr) {
        diagnostics.report(Kind::kSimNoPlace, row.declared, {row.name});
        whole = false;
      }
      Crossing crossing;
      crossing.name = row.name;
      crossing.at = point != nullptr ? Spot{point->x, point->y} : Spot{};
      crossing.methods = {"mark"};
      crossing.span = row.declared;
      crossing.map = static_cast<std::uint32_t>(out.maps.size() - 1);
      out.by_name.emplace(crossing.name, static_cast<CrossingId>(out.crossings.size()));
      out.crossings.push_back(std::move(crossing));
    }
  }
  if (out.crossings.empty()) {
    diagnostics.report(Kind::kSimNoMap, {});
    return std::nullopt;
  }
  for (const model::Relation& relation : model.relations) whole = (relation.name != "Road" || has_ends(relation, diagnostics)) && whole;
  if (!whole) return std::nullopt;
  for (const model::Map& map : model.maps) read_roads(model, map, out);
  return out;
}

bool arrange_arms(Labyrinth& labyrinth, Diagnostics& diagnostics) {
  bool good = true;
  for (Crossing& crossing : labyrinth.crossings) {
    for (Arm& arm : crossing.arms) {
      const Road& road = labyrinth[arm.road];
      arm.heading_rad = heading(labyrinth.point(arm, 1) - crossing.at);
      const auto says = compass_heading(arm.name);
      if (says && std::abs(wrap(arm.heading_rad - *says)) > kMostAstray) {
        diagnostics.report(Kind::kSimDirection, road.span,
                           {arm.name, crossing.name, compass_degrees(arm.heading_rad), compass_word(arm.heading_rad)});
        good = false;
      }
      crossing.walled = crossing.walled || road.kind == Picture::Kind::kDist;
    }
    std::stable_sort(crossing.arms.begin(), crossing.arms.end(), [](const Arm& a, const Arm& b) { return a.heading_rad < b.heading_rad; });
    const std::size_t gaps = crossing.arms.size() > 2 ? crossing.arms.size() : crossing.arms.size() / 2;
    for (std::size_t i = 0; i < gaps; ++i) {
      const Arm& arm = crossing.arms[i];
      const Arm& next = crossing.arms[(i + 1) % crossing.arms.size()];
      const double gap = std::abs(wrap(next.heading_rad - arm.heading_rad));
      if (gap >= kLeastGap) continue;
      diagnostics.report(Kind::kSimExitsCoincide, labyrinth[next.road].span,
                         {arm.name, next.name, crossing.name, fmt::format("{}", std::floor(gap * 180.0 / kPi)), degrees(kLeastGap)});
      good = false;
    }
    for (Arm& arm : crossing.arms) {
      if (good) arm.stop_m = stop_of(crossing, arm, labyrinth.size);
    }
  }
  return good;
}

namespace {

/// A scale rounded up to the next step: those are used, and written in messages.
double stepped(double scale) { return std::ceil(scale / kScaleStep - 1e-9) * kScaleStep; }

/// Warns if the whole floor is made larger for one road that is far shorter than all others: mostly a place is mistyped.
void warn_of_short_road(const Labyrinth& labyrinth, Diagnostics& diagnostics) {
  constexpr double kFar = 4.0;
  if (labyrinth.roads.size() < 2) return;
  const auto shortest = std::min_element(labyrinth.roads.begin(), labyrinth.roads.end(), [](const Road& a, const Road& b) { return length_of(a.along) < length_of(b.along); });
  double next_m = std::numeric_limits<double>::infinity(), others = 1.0;
  for (const Road& road : labyrinth.roads) {
    if (&road == &*shortest) continue;
    next_m = std::min(next_m, length_of(road.along));
    others = std::max(others, least_scale(labyrinth, road));
  }
  if (kFar * length_of(shortest->along) > next_m || least_scale(labyrinth, *shortest) < kFar * others) return;
  diagnostics.report(Kind::kSimScaleByOneRoad, shortest->span,
                     {shortest->name, fmt::format("{:.3g}", length_of(shortest->along)), fmt::format("{:g}", labyrinth.scale),
                      fmt::format("{:g}", stepped(others))});
}

/// A size of a floor; one that no floor has without its hundreds of digits.
std::string size_text(double size) { return size < 1e12 ? fmt::format("{:.0f}", size) : fmt::format("{:.3g}", size); }

}  // namespace

bool stretch(Labyrinth& labyrinth, const LayoutOptions& options, Diagnostics& diagnostics) {
  double needed = 0.0;
  for (std::size_t r = 0; r < labyrinth.roads.size(); ++r) {
    const double least = least_scale(labyrinth, labyrinth.roads[r]);
    if (!options.scale && least > std::max(1.0, needed)) labyrinth.scaled_for = static_cast<RoadId>(r);
    needed = std::max(needed, least);
  }
  labyrinth.scale = options.scale ? *options.scale : std::max(1.0, stepped(needed));
  if (!options.scale) warn_of_short_road(labyrinth, diagnostics);
  bool good = true;
  for (const Road& road : labyrinth.roads) {
    if (least_scale(labyrinth, road) <= labyrinth.scale + 1e-9) continue;
    diagnostics.report(Kind::kSimRoadShort, road.span,
                       {road.name, fmt::format("{:.2f}", labyrinth.scale * length_of(road.along)),
                        fmt::format("{:.2f}", stepped(needed))});
    good = false;
  }
  for (Crossing& crossing : labyrinth.crossings) crossing.at = labyrinth.scale * crossing.at;
  for (Road& road : labyrinth.roads) {
    for (Spot& spot : road.along) spot = labyrinth.scale * spot;
    road.begins_m = labyrinth[road.from].arm(road.exit)->stop_m;
    road.ends_m = length_of(road.along) - labyrinth[road.to].arm(road.approach)->stop_m;
  }
  return good;
}

bool check_size(const Labyrinth& labyrinth, Diagnostics& diagnostics) {
  const Spot low = labyrinth.low, high = labyrinth.high;
  const double wide_m = high.x_m - low.x_m, deep_m = high.y_m - low.y_m;
  const source::Span at = labyrinth.crossings.front().span;
  if (wide_m * deep_m > kLargestFloor) {
    diagnostics.report(Kind::kSimFloorLarge, at, {size_text(wide_m), size_text(deep_m), size_text(kLargestFloor)});
    return false;
  }
  const double far_m = std::max({-low.x_m, -low.y_m, high.x_m, high.y_m});
  if (far_m <= kFarthestFloor) return true;
  diagnostics.report(Kind::kSimFloorFar, at, {size_text(far_m / 1000.0), size_text(kFarthestFloor / 1000.0)});
  return false;
}

Ways::Ways(const Labyrinth& labyrinth) : chains_(chains_of(labyrinth)), near_(chains_, [](const std::vector<Spot>& chain) { return bounds_of(chain); }) {}

std::optional<Labyrinth> lay_out(const model::Model& model, const LayoutOptions& options, Diagnostics& diagnostics) {
  auto labyrinth = read_map(model, options.build.size, diagnostics);
  if (!labyrinth) return std::nullopt;
  labyrinth->widths = options.build.widths;
  straighten_curves(*labyrinth, diagnostics);
  if (!arrange_arms(*labyrinth, diagnostics) || !stretch(*labyrinth, options, diagnostics) ||
      !furnish(*labyrinth, options.build.halls, diagnostics)) {
    return std::nullopt;
  }
  find_corners(*labyrinth);
  if (!check_size(*labyrinth, diagnostics)) return std::nullopt;   // before the walls too: a hall far too long would be filled with pillars first
  build_walls(*labyrinth, options.background);
  find_corners(*labyrinth);
  if (!check_size(*labyrinth, diagnostics)) return std::nullopt;
  if (!check_maps(*labyrinth, diagnostics)) return std::nullopt;   // before what follows from it: roads that cross those of the other map
  const Ways ways(*labyrinth);
  if (!cross_roads(*labyrinth, ways, diagnostics) || !check_room(*labyrinth, ways, options.background, diagnostics)) return std::nullopt;
  paint_floor(*labyrinth);
  return labyrinth;
}

}  // namespace kb::sim
