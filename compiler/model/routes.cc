// Routes: the legs of a mission.
#include "compiler/model/routes.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "compiler/model/planner.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

void report_no_road(Draft& draft, source::Span at, std::uint32_t from, std::uint32_t to) {
  const std::string_view a = landmark_name(draft, from);
  const std::string_view b = landmark_name(draft, to);
  if (from == to) {   // the way from a landmark to itself has no roads
    draft.diagnostics.report(Kind::kNoRoad, at, {a, b});
    return;
  }
  for (const std::uint32_t back : draft.landmarks[to].out) {
    if (draft.roads[back].to != from) continue;
    draft.diagnostics.report(Kind::kNoRoad, at, {a, b})
        .note(Kind::kOtherDirectionOnly, draft.model[draft.roads[back].row].declared, {b, a});
    return;
  }
  const auto way = RoadSearch(road_graph(draft)).shortest(from, to, {});
  if (!way) {
    draft.diagnostics.report(Kind::kUnreachable, at, {a, b}).note(Kind::kNameDeclaredHere, draft.model[draft.landmarks[to].row].declared, {b});
    return;
  }
  constexpr std::size_t kShown = 8;
  std::string over(a);
  for (std::size_t i = 0; i < way->size(); ++i) {
    if (i == kShown && way->size() > kShown + 1) {
      over += fmt::format(" -> ... -> {}", b);
      break;
    }
    over.append(" -> ").append(landmark_name(draft, draft.roads[(*way)[i]].to));
  }
  draft.diagnostics.report(Kind::kNoRoad, at, {a, b})
      .note(Kind::kWayOver, draft.model[draft.roads[way->front()].row].declared, {fmt::format("`{}`", over)});
}

/// Reports a stop that names an exit from which no road leads to `to`.
void report_wrong_exit(Draft& draft, const syntax::Stop& stop, std::uint32_t from, std::uint32_t to) {
  std::vector<std::string_view> exits;
  for (const std::uint32_t id : draft.landmarks[from].out) {
    const DirectedRoad& road = draft.roads[id];
    exits.push_back(road.exit_name);
    if (road.exit_name != stop.exit->text) continue;
    draft.diagnostics
        .report(Kind::kExitLeadsElsewhere, stop.exit->span,
                {stop.exit->text, stop.landmark.text, landmark_name(draft, road.to), landmark_name(draft, to)})
        .note(Kind::kRoadLeadsHere, draft.model[road.row].declared, {stop.landmark.text, landmark_name(draft, road.to)});
    return;
  }
  draft.diagnostics.report(Kind::kNoSuchExit, stop.exit->span, {stop.landmark.text, stop.exit->text})
      .suggest(diagnostics::closest(stop.exit->text, exits));
}

/// The landmark of a stop on map `map`; reported if there is none.
std::optional<std::uint32_t> landmark_of(Draft& draft, syntax::Name name, std::uint32_t map) {
  if (draft.lost_landmarks.contains(name.text) && draft.names.find(name.text)->kind != Entity::Kind::kLandmark) return std::nullopt;
  const Entity* entity = need_entity(draft, name, Entity::Kind::kLandmark, Kind::kUnknownLandmark, Kind::kNotALandmark);
  if (entity == nullptr) return std::nullopt;
  const std::uint32_t landmark = draft.landmark_of_row.at(entity->id);
  const std::uint32_t own = draft.landmarks[landmark].map;
  if (own == map) return landmark;
  draft.diagnostics.report(Kind::kOtherMap, name.span, {name.text, draft.model.maps[own].name, draft.model.maps[map].name})
      .note(Kind::kNameDeclaredHere, entity->declared, {name.text});
  return std::nullopt;
}

/// The road from `stop` to `next` (from landmark `from` to landmark `to`). Reports if there is none, or if the exit must be named.
std::optional<std::uint32_t> road_between(Draft& draft, const syntax::Stop& stop, const syntax::Stop& next,
                                          std::uint32_t from, std::uint32_t to) {
  std::vector<std::uint32_t> all;
  for (const std::uint32_t road : draft.landmarks[from].out) {
    if (draft.roads[road].to == to) all.push_back(road);
  }
  if (stop.exit) {
    for (const std::uint32_t road : all) {
      if (draft.roads[road].exit_name == stop.exit->text) return road;
    }
    report_wrong_exit(draft, stop, from, to);
    return std::nullopt;
  }
  if (all.size() == 1) return all.front();
  if (all.empty()) {
    report_no_road(draft, source::join(stop.landmark.span, next.landmark.span), from, to);
    return std::nullopt;
  }
  auto builder = draft.diagnostics.report(Kind::kParallelRoads, stop.landmark.span,
                                          {std::to_string(all.size()), stop.landmark.text, next.landmark.text});
  for (const std::uint32_t road : all) builder.note(Kind::kOneRoadHere, draft.model[draft.roads[road].row].declared, {draft.roads[road].exit_name});
  builder.suggest(fmt::format("{}.{}", stop.landmark.text, draft.roads[all.front()].exit_name));
  return std::nullopt;
}

class RouteReader {
 public:
  RouteReader(Draft& draft, const syntax::Route& route) : draft_(draft), route_(route) {}

  void run() {
    need_relation(draft_, "Leg", "route", route_.name.span);
    const RelationId relation = route_relation();
    const Entity entity{Entity::Kind::kRoute, static_cast<std::uint32_t>(draft_.model.rows.size()), {}};
    if (!draft_.names.declare(route_.name, entity, draft_.diagnostics)) return;
    id_ = static_cast<std::uint32_t>(draft_.routes.size());
    RouteInfo info;
    info.name = route_.name.text;
    info.span = route_.name.span;
    info.row = add_row(draft_, relation, route_.name.text, route_.name.span);
    draft_.routes.push_back(std::move(info));
    draft_.route_of.emplace(route_.name.text, id_);
    read_command();
    if (read_map() && read_stops()) make_legs();
  }

 private:
  /// The relation of routes. Only a library of the user's own may do without it; in the standard one, std.mission has the rules that start
  /// a route.
  RelationId route_relation() {
    const auto leg = find_relation(draft_, "Leg");
    const bool standard = leg && draft_.standard(draft_.model.relations[index(*leg)].declared);
    return standard ? need_relation(draft_, "Route", "route", route_.name.span) : implicit_relation(draft_, "Route", route_.name.span);
  }

  void read_command() {
    const Entity* declared = draft_.names.find(route_.command.text);
    if (declared != nullptr && declared->twice && declared->kind != Entity::Kind::kCommand) return;
    const Entity* entity = need_entity(draft_, route_.command, Entity::Kind::kCommand, Kind::kUnknownCommand, Kind::kNotACommand);
    if (entity == nullptr) return;
    const auto [first, fresh] = draft_.commands_used.emplace(route_.command.text, route_.command.span);
    if (!fresh) {
      draft_.diagnostics.report(Kind::kCommandTwice, route_.command.span, {route_.command.text})
          .note(Kind::kFirstUsedHere, first->second);
      return;
    }
    set_field(draft_, draft_.routes[id_].row, "command", RowId{entity->id});
  }

  bool read_map() {
    const Entity* entity = draft_.names.find(route_.map.text);
    if (entity == nullptr || entity->kind != Entity::Kind::kMap) {
      if (entity == nullptr || entity->kind != Entity::Kind::kBroken) {
        report_unknown(draft_, Kind::kUnknownMap, route_.map, draft_.names.nearest(route_.map.text, Entity::Kind::kMap, draft_.diagnostics));
      }
      return false;
    }
    draft_.routes[id_].map = entity->id;
    return true;
  }

  bool read_stops() {
    auto stops = landmarks_of(draft_, route_.stops, draft_.routes[id_].map);
    if (!stops || stops->empty()) return false;
    stops_ = std::move(*stops);
    auto roads = roads_along(draft_, route_.stops, stops_);
    if (roads) roads_ = std::move(*roads);
    return roads.has_value();
  }

  void make_legs() {
    RouteInfo& route = draft_.routes[id_];
    if (too_many_cells(draft_, stops_.size(), route.name, route.span)) return;
    route.legs.push_back(make_first_leg());
    for (std::size_t i = 0; i < roads_.size(); ++i) {
      const std::string name = fmt::format("{}.{}:{}>{}", route.name, draft_.first_leg + i + 1, landmark_name(draft_, stops_[i]),
                                           landmark_name(draft_, stops_[i + 1]));
      const std::uint32_t leg = add_leg(draft_, id_, name, roads_[i], route_.stops[i].landmark.span);
      link_legs(draft_, route.legs.back(), leg);
      route.legs.push_back(leg);
    }
    LegInfo& last = draft_.legs[route.legs.back()];
    last.ends = true;
    set_field(draft_, last.row, "ends", route.row);
    set_field(draft_, route.row, "first", draft_.legs[route.legs.front()].row);
  }

  /// The leg to the first landmark, from wherever the robot stands.
  std::uint32_t make_first_leg() {
    const RouteInfo& route = draft_.routes[id_];
    LegInfo leg;
    leg.route = id_;
    leg.to = stops_.front();
    leg.row = add_row(draft_, *find_relation(draft_, "Leg"), fmt::format("{}.{}:{}", route.name, draft_.first_leg, landmark_name(draft_, leg.to)),
                      route_.stops.front().landmark.span);
    set_field(draft_, leg.row, "to", draft_.landmarks[leg.to].row);
    lay_leg(draft_, leg.row, RowId::kNone, draft_.lowest_limit_m_per_s);   // nobody knows on which road it is
    draft_.legs.push_back(leg);
    return static_cast<std::uint32_t>(draft_.legs.size() - 1);
  }

  Draft& draft_;
  const syntax::Route& route_;
  std::uint32_t id_ = 0;
  std::vector<std::uint32_t> stops_;  // landmarks
  std::vector<std::uint32_t> roads_;  // between them
};

}  // namespace

std::string_view landmark_name(const Draft& draft, std::uint32_t landmark) {
  return draft.model[draft.landmarks[landmark].row].name;
}

std::optional<std::vector<std::uint32_t>> landmarks_of(Draft& draft, const std::vector<syntax::Stop>& stops, std::uint32_t map) {
  std::vector<std::uint32_t> found;
  bool known = true;
  for (const syntax::Stop& stop : stops) {
    const auto landmark = landmark_of(draft, stop.landmark, map);
    known = known && landmark.has_value();
    found.push_back(landmark.value_or(0));
  }
  return known ? std::optional(std::move(found)) : std::nullopt;
}

std::optional<std::vector<std::uint32_t>> roads_along(Draft& draft, const std::vector<syntax::Stop>& stops, const std::vector<std::uint32_t>& landmarks) {
  if (stops.back().exit) draft.diagnostics.report(Kind::kLastStopExit, stops.back().exit->span, {stops.back().landmark.text});
  std::vector<std::uint32_t> found;
  bool known = true;
  for (std::size_t i = 1; i < stops.size(); ++i) {
    const auto road = road_between(draft, stops[i - 1], stops[i], landmarks[i - 1], landmarks[i]);
    known = known && road.has_value();
    found.push_back(road.value_or(0));
  }
  return known ? std::optional(std::move(found)) : std::nullopt;
}

std::uint32_t add_leg(Draft& draft, std::uint32_t route, std::string name, std::uint32_t road, source::Span at) {
  const DirectedRoad& along = draft.roads[road];
  LegInfo leg;
  leg.route = route;
  leg.from = along.from;
  leg.to = along.to;
  leg.road = road;
  leg.row = add_row(draft, *find_relation(draft, "Leg"), name, at);
  set_field(draft, leg.row, "from", draft.landmarks[along.from].row);
  set_field(draft, leg.row, "to", draft.landmarks[along.to].row);
  set_field(draft, leg.row, "exit", draft.value(draft.exits, along.exit));
  set_field(draft, leg.row, "approach", draft.value(draft.exits, along.approach));
  set_field(draft, leg.row, "by", draft.value(draft.methods, along.by));
  set_field(draft, leg.row, "road", along.row);
  lay_leg(draft, leg.row, along.row, along.limit_m_per_s);
  const auto id = static_cast<std::uint32_t>(draft.legs.size());
  draft.legs.push_back(leg);
  draft.legs_from[along.from].push_back(id);
  return id;
}

void lay_leg(Draft& draft, RowId leg, RowId road, float limit_m_per_s) {
  const CellId cell = draft.model[leg].cell;
  if (cell != CellId::kNone) draft.model.leg_roads.push_back({cell, road, std::isfinite(limit_m_per_s) ? limit_m_per_s : 0.0f});
}

void link_legs(Draft& draft, std::uint32_t leg, std::uint32_t next) {
  draft.legs[leg].next = next;
  set_field(draft, draft.legs[leg].row, "next", draft.legs[next].row);
}

std::uint32_t add_chain(Draft& draft, std::uint32_t route, const std::vector<std::uint32_t>& roads, std::uint32_t target,
                        const std::string& name, source::Span at) {
  const auto first = static_cast<std::uint32_t>(draft.legs.size());
  for (std::size_t i = 0; i < roads.size(); ++i) {
    const DirectedRoad& road = draft.roads[roads[i]];
    const std::uint32_t leg = add_leg(
        draft, route, fmt::format("{}.{}:{}>{}", name, i, landmark_name(draft, road.from), landmark_name(draft, road.to)),
        roads[i], at);
    if (i > 0) link_legs(draft, leg - 1, leg);
  }
  const std::uint32_t last = first + static_cast<std::uint32_t>(roads.size()) - 1;
  if (draft.legs[target].next != kNone32) link_legs(draft, last, draft.legs[target].next);
  if (draft.legs[target].ends) {
    draft.legs[last].ends = true;
    set_field(draft, draft.legs[last].row, "ends", draft.routes[draft.legs[target].route].row);
  }
  return first;
}

void plan_routes(Draft& draft) {
  draft.legs_from.resize(draft.landmarks.size());
  draft.each<syntax::Route>([&](const auto&, const auto&, const syntax::Route& route) {
    if (!draft.exhausted) RouteReader(draft, route).run();
  });
}

}  // namespace kb::model
