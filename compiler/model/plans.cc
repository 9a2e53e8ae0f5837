// note [planned detours]
// Every leg of the route gets a way round for each other exit of the landmark at which it begins: out by that exit and on by the
// shortest way to a landmark of the route from the leg's end on, the earliest that can be reached without the leg's road (and, if
// possible, without turning back on the first road of the way round). The leg and its ways round form a ring, the best first
// (earliest rejoining, then shortest, then by name). The robot may change from any way of the ring to any other if that other is
// open, and all ways before it as well as its present one are closed. So a road that opens again is used again, and if two are
// closed the third is taken. A detour that is written out comes before all of these.
// The legs of a way round get ways round of their own; those get none. A leg's road is used neither by its ways round nor by theirs.
//
// A way round is named by the route, the number of the leg and the exit, `Errand.p2S`; one round its leg 1 `Errand.p2S.1E`. So the names
// stay what they are when the map grows elsewhere, and a robot that is on its way round when it gets another image still is.
#include "compiler/model/plans.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "compiler/model/planner.h"
#include "compiler/model/routes.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

/// Ways round, and ways round these.
constexpr int kDepth = 2;

class Planner {
 public:
  Planner(Draft& draft, std::uint32_t route, std::uint32_t statement, source::Span at)
      : draft_(draft), route_(route), statement_(statement), at_(at), search_(road_graph(draft)) {}

  void run() {
    relation_ = need_relation(draft_, "Detour", "detours", at_);
    legs_ = draft_.routes[route_].legs;
    for (std::size_t j = 0; j < legs_.size(); ++j) {
      if (draft_.legs[legs_[j]].road != kNone32) plan_leg(legs_[j], j, fmt::format("{}.p{}", draft_.routes[route_].name, j), {}, kDepth);
    }
    const bool drives = legs_.size() > 1;
    if (drives && !planned_) warn(Kind::kNoDetour);
    if (const auto retreat = find_relation(draft_, "Retreat")) {
      const std::size_t before = rows_;
      for (std::size_t j = 0; j < legs_.size(); ++j) {
        if (draft_.legs[legs_[j]].road != kNone32) plan_retreat(*retreat, j);
      }
      if (drives && planned_ && rows_ == before) warn(Kind::kNoRetreat);
    }
    if (const auto recheck = find_relation(draft_, "Recheck"); recheck && !legs_.empty()) plan_recheck(*recheck);
    if (const auto rejoin = find_relation(draft_, "Rejoin"); rejoin && !legs_.empty()) plan_rejoins(*rejoin);
  }

 private:
  /// One way round.
  struct Alternative {
    std::size_t rejoins = 0;  ///< the leg of the route at whose end it rejoins
    Way roads;
  };

  void warn(Kind kind) {
    if (!draft_.exhausted) draft_.diagnostics.report(kind, at_, {draft_.routes[route_].name});
  }

  /// False if there would be too many rows; the first time with a message.
  bool count(std::size_t more) {
    rows_ += more;
    draft_.planned_rows += more;
    const bool alone = rows_ > kMaxPlannedRows;
    if (!alone && draft_.planned_rows <= kMaxPlannedInAll) return true;
    if (!std::exchange(draft_.exhausted, true)) {
      draft_.diagnostics.report(Kind::kTooManyDetours, at_,
                                {draft_.routes[route_].name, fmt::format("{}", alone ? kMaxPlannedRows : kMaxPlannedInAll), alone ? "" : ", with those of other routes"});
    }
    return false;
  }

  /// Recurses kDepth deep. `name`: of its ways round, without their exits.
  void plan_leg(std::uint32_t leg, std::size_t j, const std::string& name, Way avoid, int depth) {
    if (depth == 0 || draft_.exhausted) return;
    avoid.push_back(draft_.roads[draft_.legs[leg].road].road);
    std::vector<Alternative> alternatives = find_alternatives(leg, j, avoid);
    std::vector<std::uint32_t> ring{leg};
    for (const Alternative& way : alternatives) {
      if (!count(way.roads.size())) return;
      planned_ = true;
      const std::string chain = fmt::format("{}{}", name, draft_.roads[way.roads.front()].exit_name);
      const std::uint32_t first = add_chain(draft_, route_, way.roads, legs_[way.rejoins], chain, at_);
      ring.push_back(first);
      for (std::uint32_t m = 1; m < way.roads.size(); ++m) plan_leg(first + m, way.rejoins, fmt::format("{}.{}", chain, m), avoid, depth - 1);
    }
    join_ring(ring);
  }

  std::vector<Alternative> find_alternatives(std::uint32_t leg, std::size_t j, const Way& avoid) {
    std::vector<Alternative> found;
    for (const std::uint32_t road : draft_.landmarks[draft_.legs[leg].from].out) {
      const std::uint32_t id = draft_.roads[road].road;
      if (std::find(avoid.begin(), avoid.end(), id) != avoid.end()) continue;
      if (auto way = way_round(road, j, avoid)) found.push_back(std::move(*way));
    }
    const auto rank = [this](const Alternative& way) {
      Length length = 0;
      for (const std::uint32_t road : way.roads) length += road_graph(draft_).length(road);
      return std::tuple(way.rejoins, length, std::string_view(draft_.model[draft_.roads[way.roads.front()].row].name));
    };
    std::sort(found.begin(), found.end(), [&](const Alternative& a, const Alternative& b) { return rank(a) < rank(b); });
    return found;
  }

  /// The way out by `road` and back to the end of leg `j`, or of the earliest later leg that can be reached.
  std::optional<Alternative> way_round(std::uint32_t road, std::size_t j, const Way& avoid) {
    const std::uint32_t start = draft_.roads[road].to;
    Way strict = avoid;
    strict.push_back(draft_.roads[road].road);
    const auto finish = [&](std::size_t t, const Way& tail) {
      Alternative made{t, {road}};
      made.roads.insert(made.roads.end(), tail.begin(), tail.end());
      return std::optional(std::move(made));
    };
    const auto goal = [&](std::size_t t) { return draft_.legs[legs_[t]].to; };
    if (const auto way = search_.shortest(start, goal(j), strict)) return finish(j, *way);
    // The failed search has found everything that can be reached. Kept apart, because the next search overwrites it.
    std::vector<std::optional<Way>> later(legs_.size());
    for (std::size_t t = j + 1; t < legs_.size() && !later[t - 1]; ++t) later[t] = search_.known(goal(t));
    if (const auto way = search_.shortest(start, goal(j), avoid)) return finish(j, *way);
    for (std::size_t t = j + 1; t < legs_.size(); ++t) {
      if (later[t]) return finish(t, *later[t]);
      if (const auto way = search_.known(goal(t))) return finish(t, *way);
    }
    return std::nullopt;
  }

  void join_ring(const std::vector<std::uint32_t>& ring) {
    for (std::size_t a = 0; a < ring.size(); ++a) {
      for (std::size_t b = 0; b < ring.size(); ++b) {
        if (a == b) continue;
        PlannedCondition condition;
        for (std::size_t c = 0; c < b; ++c) {
          if (c != a) condition.closed.push_back(ring[c]);
        }
        condition.closed.push_back(ring[a]);
        condition.instead = ring[a];
        condition.open = ring[b];
        condition.statement = statement_;
        if (!count(1 + condition.closed.size() / 8)) return;
        add_detour(std::move(condition));
      }
    }
  }

  void add_detour(PlannedCondition condition) {
    const RowId instead = draft_.legs[condition.instead].row;
    const RowId first = draft_.legs[condition.open].row;
    condition.row = add_row(draft_, relation_, fmt::format("{}=>{}", draft_.model[instead].name, draft_.model[first].name), at_);
    set_field(draft_, condition.row, "instead", instead);
    set_field(draft_, condition.row, "first", first);
    draft_.planned_conditions.push_back(std::move(condition));
  }

  /// Plans what to do if a leg is blocked while the robot is on it: back, and on by another way. Only on two-way roads.
  void plan_retreat(RelationId relation, std::size_t j) {
    const DirectedRoad* opposite = way_opposite(j);
    if (opposite == nullptr || draft_.exhausted) return;
    const auto way = way_back(draft_.legs[legs_[j]].from, j, draft_.roads[draft_.legs[legs_[j]].road].road);
    if (!way || !count(way->roads.size() + 2)) return;
    const std::string_view name = draft_.routes[route_].name;
    const std::uint32_t back = add_back(j, *opposite);
    link_legs(draft_, back, add_chain(draft_, route_, way->roads, legs_[way->rejoins], fmt::format("{}.back{}", name, j), at_));
    add_way_back(relation, fmt::format("{}.retreat{}", name, j), j, back);
    if (j + 1 == legs_.size()) last_retreats_ = true;
  }

  /// If no way leads round the last road: back to where it begins, and over it again.
  void plan_recheck(RelationId relation) {
    const std::size_t j = legs_.size() - 1;
    if (last_retreats_ || draft_.legs[legs_[j]].road == kNone32) return;
    const DirectedRoad* opposite = way_opposite(j);
    if (opposite == nullptr || draft_.exhausted || !count(2)) return;
    const std::uint32_t back = add_back(j, *opposite);
    link_legs(draft_, back, legs_[j]);
    add_way_back(relation, fmt::format("{}.recheck", draft_.routes[route_].name), j, back);
  }

  /// The road of leg `j` in the other direction; null if it is one-way.
  [[nodiscard]] const DirectedRoad* way_opposite(std::size_t j) const {
    const LegInfo& leg = draft_.legs[legs_[j]];
    for (const std::uint32_t id : draft_.landmarks[leg.to].out) {
      if (id != leg.road && draft_.roads[id].road == draft_.roads[leg.road].road) return &draft_.roads[id];
    }
    return nullptr;
  }

  void add_way_back(RelationId relation, const std::string& name, std::size_t j, std::uint32_t back) {
    const RowId row = add_row(draft_, relation, name, at_);
    set_field(draft_, row, "leg", draft_.legs[legs_[j]].row);
    set_field(draft_, row, "back", draft_.legs[back].row);
  }

  /// Adds the leg that leads back over leg `j` along the road `opposite`. The caller links the leg that follows it.
  std::uint32_t add_back(std::size_t j, const DirectedRoad& opposite) {
    const LegInfo leg = draft_.legs[legs_[j]];
    const std::string_view name = draft_.routes[route_].name;
    LegInfo back;
    back.route = route_;
    back.from = leg.to;
    back.to = leg.from;
    back.row = add_row(draft_, *find_relation(draft_, "Leg"),
                       fmt::format("{}.back{}:{}>{}", name, j, landmark_name(draft_, leg.to), landmark_name(draft_, leg.from)), at_);
    set_field(draft_, back.row, "from", draft_.landmarks[leg.to].row);
    set_field(draft_, back.row, "to", draft_.landmarks[leg.from].row);
    lay_leg(draft_, back.row, opposite.row, opposite.limit_m_per_s);
    draft_.legs.push_back(back);
    return static_cast<std::uint32_t>(draft_.legs.size() - 1);
  }

  /// The way from where leg `j` began, without its road, to the end of leg `j` or of the earliest later leg that can be reached.
  std::optional<Alternative> way_back(std::uint32_t start, std::size_t j, std::uint32_t road) {
    const Way avoid{road};
    bool exhausted = false;
    for (std::size_t t = j; t < legs_.size(); ++t) {
      const std::uint32_t goal = draft_.legs[legs_[t]].to;
      if (goal == start) continue;
      const auto way = exhausted ? search_.known(goal) : search_.shortest(start, goal, avoid);
      if (way) return Alternative{t, *way};
      exhausted = true;
    }
    return std::nullopt;
  }

  /// Plans for each landmark at which the robot may find itself the leg that leads on to the goal: on the route the route's own leg (the
  /// last of several), elsewhere the first leg of a shortest way to the goal. Legs that are planned already are used.
  void plan_rejoins(RelationId relation) {
    const std::uint32_t goal = draft_.legs[legs_.back()].to;
    std::vector<std::uint32_t> onward(draft_.landmarks.size(), kNone32);
    for (const std::uint32_t leg : legs_) {
      if (draft_.legs[leg].road != kNone32) onward[draft_.legs[leg].from] = leg;
    }
    const std::vector<std::uint32_t> next = roads_towards(draft_, goal);
    for (std::uint32_t start = 0; start < onward.size() && !draft_.exhausted; ++start) plan_onward(start, next, goal, onward);
    for (std::uint32_t at = 0; at < onward.size(); ++at) {
      if (at != goal && onward[at] == kNone32) continue;
      if (!count(1)) return;
      const RowId row = add_row(draft_, relation, fmt::format("{}.from:{}", draft_.routes[route_].name, landmark_name(draft_, at)), at_);
      set_field(draft_, row, "route", draft_.routes[route_].row);
      set_field(draft_, row, "at", draft_.landmarks[at].row);
      if (at == goal) set_field(draft_, row, "last", draft_.legs[legs_.back()].row);
      else set_field(draft_, row, "leg", draft_.legs[onward[at]].row);
    }
  }

  /// Adds a leg for each of the roads `next` from `start` on, up to a landmark from which the way on is known.
  void plan_onward(std::uint32_t start, const std::vector<std::uint32_t>& next, std::uint32_t goal, std::vector<std::uint32_t>& onward) {
    std::uint32_t last = kNone32;
    for (std::uint32_t from = start; next[from] != kNone32 && onward[from] == kNone32 && count(1); from = draft_.roads[next[from]].to) {
      const std::uint32_t id = next[from], to = draft_.roads[id].to;
      const std::uint32_t leg = add_leg(
          draft_, route_, fmt::format("{}.r:{}>{}", draft_.routes[route_].name, landmark_name(draft_, from), landmark_name(draft_, to)), id, at_);
      if (last != kNone32) link_legs(draft_, last, leg);
      onward[from] = last = leg;
    }
    if (last == kNone32) return;
    const std::uint32_t end = draft_.legs[last].to;
    if (end != goal) {
      if (onward[end] != kNone32) link_legs(draft_, last, onward[end]);
      return;
    }
    draft_.legs[last].ends = true;
    set_field(draft_, draft_.legs[last].row, "ends", draft_.routes[route_].row);
  }

  Draft& draft_;
  std::uint32_t route_;
  std::uint32_t statement_;
  source::Span at_;
  RoadSearch search_;
  RelationId relation_ = RelationId::kNone;
  std::vector<std::uint32_t> legs_;  // of the route
  bool planned_ = false;             // some leg has a way round
  std::size_t rows_ = 0;
  bool last_retreats_ = false;       // the last leg has a way back that leads round it
};

}  // namespace

void plan_route(Draft& draft, const syntax::Tree& tree, const syntax::Statement& statement, const syntax::Detours& detours) {
  const auto found = draft.route_of.find(detours.route.text);
  if (found == draft.route_of.end()) return report_unknown_route(draft, detours.route);
  RouteInfo& route = draft.routes[found->second];
  if (route.planned) {
    draft.diagnostics.report(Kind::kDetoursTwice, detours.route.span, {detours.route.text})
        .note(Kind::kFirstUsedHere, *route.planned);
    return;
  }
  route.planned = statement.span;
  if (route.legs.empty()) return;  // it could not be read, which has been reported
  draft.plans.push_back({route.name, &tree, detours.when, statement.span});
  Planner(draft, found->second, static_cast<std::uint32_t>(draft.plans.size() - 1), statement.span).run();
}

}  // namespace kb::model
