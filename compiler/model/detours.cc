// Detours that are written out: `detour A -> V -> B [on R] [when C]`. (The planned ones: plans.cc.)
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "compiler/model/conditions.h"
#include "compiler/model/plans.h"
#include "compiler/model/routes.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

/// Why a leg cannot have a detour; a later reason is a nearer miss.
enum class Miss : std::uint8_t { kNoLeg, kNeverBack, kSameWay, kTaken };

class DetourReader {
 public:
  DetourReader(Draft& draft, const syntax::Tree& tree, const syntax::Statement& statement, const syntax::Detour& detour, std::size_t planned_end)
      : draft_(draft), tree_(tree), statement_(statement), detour_(detour), planned_end_(planned_end) {}

  void run() {
    if (detour_.stops.empty() || !read_route() || !read_stops()) return;
    relation_ = need_relation(draft_, "Detour", "detour", statement_.span);
    // A copy, so that the legs which this detour adds are not asked as well.
    const std::vector<std::uint32_t> candidates = draft_.legs_from[stops_.front()];
    for (const std::uint32_t leg : candidates) {
      if (draft_.exhausted) return;
      if (const auto target = target_of(leg)) make(leg, *target);
    }
    if (replaced_.empty()) report_off_route();
  }

 private:
  bool read_route() {
    if (!detour_.on) return true;
    const auto route = draft_.route_of.find(detour_.on->text);
    if (route == draft_.route_of.end()) {
      report_unknown_route(draft_, *detour_.on);
      return false;
    }
    route_ = route->second;
    return true;
  }

  bool read_stops() {
    const Entity* entity = draft_.names.find(detour_.stops.front().landmark.text);
    const bool landmark = entity != nullptr && entity->kind == Entity::Kind::kLandmark;
    const std::uint32_t map = landmark ? draft_.landmarks[draft_.landmark_of_row.at(entity->id)].map : 0;
    auto stops = landmarks_of(draft_, detour_.stops, map);
    if (!stops) return false;
    stops_ = std::move(*stops);
    if (stops_.size() == 1) {
      draft_.diagnostics.report(Kind::kDetourOneStop, detour_.stops.front().landmark.span, {detour_.stops.front().landmark.text});
      return false;
    }
    auto roads = roads_along(draft_, detour_.stops, stops_);
    if (roads) roads_ = std::move(*roads);
    return roads.has_value();
  }

  void miss(Miss kind, std::uint32_t leg) {
    if (miss_ != Miss::kNoLeg && kind <= miss_) return;
    miss_ = kind;
    missed_leg_ = leg;
  }

  /// The first leg, from `leg` on, that ends at the detour's last landmark; nothing if `leg` may not have the detour.
  std::optional<std::uint32_t> target_of(std::uint32_t leg) {
    const LegInfo& info = draft_.legs[leg];
    if (route_ && info.route != *route_) return std::nullopt;
    std::uint32_t at = leg;
    bool same_way = true;
    for (std::size_t i = 0;; ++i) {
      same_way = same_way && i < roads_.size() && draft_.legs[at].road == roads_[i];
      if (draft_.legs[at].to == stops_.back()) {
        same_way = same_way && i + 1 == roads_.size();
        break;
      }
      at = draft_.legs[at].next;
      if (at == kNone32) return miss(Miss::kNeverBack, leg), std::nullopt;
    }
    const bool replaced = at == leg || std::find(replaced_.begin(), replaced_.end(), info.road) != replaced_.end();
    if (is_planned(leg) && !replaced) return std::nullopt;   // a way round of another kind, and no reason to leave it
    if (same_way || (!is_of_route(leg) && info.road == roads_.front())) return miss(Miss::kSameWay, leg), std::nullopt;
    if (info.detour) return miss(Miss::kTaken, leg), std::nullopt;
    return at;
  }

  /// Whether the route itself has the leg, and not one of its detours. A detour's leg is not replaced by ways over the same road: they are meant
  /// for the route's own leg.
  [[nodiscard]] bool is_of_route(std::uint32_t leg) const {
    const std::vector<std::uint32_t>& own = draft_.routes[draft_.legs[leg].route].legs;
    return std::binary_search(own.begin(), own.end(), leg);
  }

  /// Whether the leg belongs to a planned detour. These are made first, after the legs of all routes.
  [[nodiscard]] bool is_planned(std::uint32_t leg) const { return leg < planned_end_ && !is_of_route(leg); }

  void make(std::uint32_t leg, std::uint32_t target) {
    replaced_.push_back(draft_.legs[leg].road);
    RouteInfo& route = draft_.routes[draft_.legs[leg].route];
    if (too_many_cells(draft_, roads_.size(), route.name, statement_.span)) return;
    const std::string name = fmt::format("{}.d{}", route.name, route.written_detours++);
    const std::uint32_t first = add_chain(draft_, draft_.legs[leg].route, roads_, target, name, statement_.span);
    const RowId row = add_row(draft_, relation_, name, statement_.span);
    set_field(draft_, row, "instead", draft_.legs[leg].row);
    set_field(draft_, row, "first", draft_.legs[first].row);
    KeptCondition kept;
    if (detour_.when) {
      kept.tree = &tree_;
      kept.condition = *detour_.when;
      if (find_field(draft_.model[relation_], "when")) draft_.kept.push_back({row, "when", leg});
    } else {
      kept.resolved = add_cond(draft_.model, {});   // an empty `and` always holds
      kept.is_resolved = true;
    }
    const KeptId when = add_kept(draft_.model, kept);
    set_field(draft_, row, "when", when);
    draft_.legs[leg].detour = {statement_.span, when};
  }

  /// Whether a route that could not be read, and has been reported, may be the one that is meant.
  [[nodiscard]] bool may_belong_to_a_broken_route() const {
    const auto broken = [](const RouteInfo& route) { return route.legs.empty(); };
    return route_ ? broken(draft_.routes[*route_]) : std::any_of(draft_.routes.begin(), draft_.routes.end(), broken);
  }

  void report_off_route() {
    if (may_belong_to_a_broken_route()) return;
    const std::string_view from = landmark_name(draft_, stops_.front());
    const std::string_view to = landmark_name(draft_, stops_.back());
    const std::string whose = detour_.on ? fmt::format("`{}`", detour_.on->text) : std::string("a route");
    const std::string why = miss_ == Miss::kNoLeg       ? fmt::format("no leg of {} leaves `{}`", whose, from)
                            : miss_ == Miss::kNeverBack ? fmt::format("{} leaves `{}`, but does not come to `{}` after it", whose, from, to)
                            : miss_ == Miss::kSameWay   ? fmt::format("{} goes that way already", whose)
                                                        : fmt::format("the leg that leaves `{}` has a detour already", from);
    auto builder = draft_.diagnostics.report(Kind::kDetourOffRoute, stops_span(), {why});
    if (miss_ == Miss::kTaken) {
      const LegInfo& leg = draft_.legs[missed_leg_];
      builder.note(Kind::kLegHasDetour, leg.detour->span, {landmark_name(draft_, leg.from), landmark_name(draft_, leg.to)});
    } else if (miss_ != Miss::kNoLeg) {
      builder.note(Kind::kRouteStandsHere, draft_.routes[draft_.legs[missed_leg_].route].span);
    }
  }

  [[nodiscard]] source::Span stops_span() const {
    return source::join(detour_.stops.front().landmark.span, detour_.stops.back().landmark.span);
  }

  Draft& draft_;
  const syntax::Tree& tree_;
  const syntax::Statement& statement_;
  const syntax::Detour& detour_;
  std::size_t planned_end_;                // legs of routes and of planned detours come before this one
  std::vector<std::uint32_t> replaced_;    // the roads of the legs that have this detour
  std::optional<std::uint32_t> route_;
  std::vector<std::uint32_t> stops_;
  std::vector<std::uint32_t> roads_;
  RelationId relation_ = RelationId::kNone;
  Miss miss_ = Miss::kNoLeg;
  std::uint32_t missed_leg_ = 0;
};

}  // namespace

void report_unknown_route(Draft& draft, const syntax::Name& name) {
  const Entity* entity = draft.names.find(name.text);
  if (entity != nullptr && (entity->kind == Entity::Kind::kBroken || entity->kind == Entity::Kind::kRoute || entity->twice)) return;
  draft.diagnostics.report(Kind::kUnknownRoute, name.span, {name.text})
      .suggest(draft.names.nearest(name.text, Entity::Kind::kRoute, draft.diagnostics));
}

void plan_detours(Draft& draft) {
  draft.each<syntax::Detours>([&](const syntax::Tree& tree, const syntax::Statement& statement, const syntax::Detours& detours) {
    if (!draft.exhausted) plan_route(draft, tree, statement, detours);
  });
  const std::size_t planned_end = draft.legs.size();
  draft.each<syntax::Detour>([&](const syntax::Tree& tree, const syntax::Statement& statement, const syntax::Detour& detour) {
    if (!draft.exhausted) DetourReader(draft, tree, statement, detour, planned_end).run();
  });
}

}  // namespace kb::model
