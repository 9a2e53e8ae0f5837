// Maps: landmarks are facts and rows of `Landmark`, roads are rows of `Road`, one for each direction.
//
// note [exits of roads]
// The compiler knows no directions. The exits of all roads are members of one finite set: the set of the knowledge base that
// has most of the names which roads use as exits (of several such sets the one declared first). A name that is not in this set
// is an error at its place, with the line `names S more { ... }` that would add it. The set of the methods after `by` is found
// in the same way, but sets over which strategies are declared are preferred, because a strategy drives each road. If no set has
// any of the names, they are measured by the sets that std.basics calls `Direction` and `Method`, if there are such sets.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <unordered_set>
#include <utility>

#include "compiler/model/draft.h"
#include "compiler/model/shapes.h"
#include "compiler/model/speed.h"
#include "compiler/model/units.h"
#include "compiler/syntax/tree_text.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

class Words {
 public:
  void add(syntax::Name word) {
    if (seen_.insert(word.text).second) words_.push_back(word);
  }
  /// The different words, each at its first place.
  [[nodiscard]] const std::vector<syntax::Name>& words() const { return words_; }

 private:
  std::unordered_set<std::string_view> seen_;
  std::vector<syntax::Name> words_;
};

/// The set that has most of `words`. Sets that are `preferred` (by set; may be empty) win if they have any of them.
SetId best_set(const Draft& draft, const std::vector<syntax::Name>& words, const std::vector<bool>& preferred = {}) {
  SetId best = SetId::kNone;
  std::pair<bool, std::size_t> most{};
  for (std::size_t i = 0; i < draft.sets.size(); ++i) {
    std::size_t held = 0;
    for (const syntax::Name& word : words) held += draft.sets[i].members.count(word.text);
    const std::pair rank{!preferred.empty() && preferred[i], held};
    if (held == 0 || rank <= most) continue;
    most = rank;
    best = SetId{static_cast<std::uint32_t>(i)};
  }
  return best;
}

SetId usual_set(const Draft& draft, std::string_view name) {
  const auto found = draft.set_of.find(name);
  return found == draft.set_of.end() ? SetId::kNone : found->second;
}

/// For each set whether there is a strategy for each of its members.
std::vector<bool> sets_of_strategies(const Draft& draft) {
  std::vector<bool> found(draft.sets.size(), false);
  const auto mark = [&](std::string_view name) {
    const auto set = draft.set_of.find(name);
    if (set != draft.set_of.end()) found[index(set->second)] = true;
  };
  draft.each<syntax::Declaration>([&](const auto&, const auto&, const syntax::Declaration& declaration) {
    if (declaration.kind != syntax::Declaration::Kind::kStrategy) return;
    for (const auto& item : declaration.items) {
      if (item.shape == syntax::Declaration::Item::Shape::kMembers) mark(item.name.text);
      if (item.shape != syntax::Declaration::Item::Shape::kOver) continue;
      for (const syntax::Name& set : item.names) mark(set.text);
    }
  });
  return found;
}

/// Refuses a method that is only in some other set, such as `line` of std.care: the rules that drive would not understand it.
void check_methods(Draft& draft, const std::vector<syntax::Name>& methods, const std::vector<bool>& driven) {
  if (draft.methods == SetId::kNone || driven[index(draft.methods)] || std::find(driven.begin(), driven.end(), true) == driven.end()) return;
  const auto held = std::find_if(methods.begin(), methods.end(), [&](const syntax::Name& word) { return draft.member(draft.methods, word.text).has_value(); });
  draft.diagnostics.report(Kind::kRoadMethod, held->span, {held->text, draft.model.sets[index(draft.methods)].name});
}

class MapReader {
 public:
  MapReader(Draft& draft, const syntax::Map& map) : draft_(draft), map_(map) {}

  void run() {
    const auto id = static_cast<std::uint32_t>(draft_.model.maps.size());
    if (!draft_.names.declare(map_.name, {Entity::Kind::kMap, id, {}}, draft_.diagnostics)) return;
    map_id_ = id;
    Map map;
    map.name = std::string(map_.name.text);
    map.declared = map_.name.span;
    draft_.model.maps.push_back(std::move(map));
    draft_.broken_maps.push_back(false);
    landmark_relation_ = implicit_relation(draft_, "Landmark", map_.name.span);
    road_relation_ = need_relation(draft_, "Road", "map", map_.name.span);
    if (too_many_cells(draft_, 2 * map_.landmarks.size(), map_.name.text, map_.name.span)) return;
    reserve();
    const auto field = [&](std::string_view name) { return find_field(draft_.model[road_relation_], name); };
    fields_ = {field("from"), field("to"), field("exit"), field("approach"), field("by")};
    for (const syntax::Landmark& landmark : map_.landmarks) read_landmark(landmark);
    report_shared_places();
    arms_.resize(draft_.landmarks.size() - first_);
    for (const syntax::Road& road : map_.roads) read_road(road);
  }

 private:
  struct Arm { std::uint32_t exit; source::Span span; };
  using Field = std::optional<std::size_t>;
  struct RoadFields { Field from, to, exit, approach, by; };   // the fields that the relation has

  void reserve() {
    const std::size_t landmarks = map_.landmarks.size(), roads = 2 * map_.roads.size();
    make_room(draft_.model.cells, 2 * landmarks);
    make_room(draft_.model.rows, landmarks + roads);
    const std::size_t values = landmarks * draft_.model[landmark_relation_].fields.size() + roads * draft_.model[road_relation_].fields.size();
    make_room(draft_.model.values, std::min(values, kMaxFieldValues));
    make_room(draft_.model.relations[index(road_relation_)].rows, roads);
    make_room(draft_.model.relations[index(landmark_relation_)].rows, landmarks);
    make_room(draft_.model.points, landmarks);
    make_room(draft_.roads, roads);
    make_room(draft_.model.maps[map_id_].roads, roads);
    make_room(draft_.model.maps[map_id_].landmarks, landmarks);
    make_room(draft_.landmarks, landmarks);
    draft_.names.reserve(draft_.names.all().size() + landmarks);
  }

  void read_landmark(const syntax::Landmark& landmark) {
    const RowId id{static_cast<std::uint32_t>(draft_.model.rows.size())};
    const Entity entity{Entity::Kind::kLandmark, static_cast<std::uint32_t>(id), {}};
    if (!draft_.names.declare(landmark.name, entity, draft_.diagnostics, twice(landmark.name.text))) {
      draft_.lost_landmarks.emplace(landmark.name.text, true);
      return;
    }
    Cell cell;
    cell.name = draft_.model.texts->keep(landmark.name.text);
    cell.kind = CellKind::kFact;
    cell.event = cell.attention = std::numeric_limits<double>::quiet_NaN();
    cell.declared = landmark.name.span;
    const std::string_view name = cell.name;
    add_row_of(draft_, landmark_relation_, name, landmark.name.span, add_cell(draft_, std::move(cell)));
    if (landmark.at) set_field(draft_, id, "at", add_point(draft_.model, {landmark.at->x, landmark.at->y}));
    draft_.model.maps[map_id_].landmarks.push_back(id);
    draft_.landmark_of_row.resize(index(id), kNone32);
    draft_.landmark_of_row.push_back(static_cast<std::uint32_t>(draft_.landmarks.size()));
    draft_.landmarks.push_back({id, map_id_, {}, 0});
  }

  void report_shared_places() {
    std::vector<const syntax::Landmark*> placed;
    for (const syntax::Landmark& landmark : map_.landmarks) {
      if (landmark.at) placed.push_back(&landmark);
    }
    const auto place = [](const syntax::Landmark* landmark) { return std::pair(landmark->at->x, landmark->at->y); };
    std::stable_sort(placed.begin(), placed.end(), [&](const auto* a, const auto* b) { return place(a) < place(b); });
    for (std::size_t first = 0, i = 1; i < placed.size(); ++i) {
      if (place(placed[i]) != place(placed[first])) first = i;
      else draft_.diagnostics.report(Kind::kSharedPlace, placed[i]->name.span, {placed[i]->name.text, placed[first]->name.text})
          .note(Kind::kNameDeclaredHere, placed[first]->name.span, {placed[first]->name.text});
    }
  }

  [[nodiscard]] Kind twice(std::string_view name) const {
    const Entity* known = draft_.names.find(name);
    return known != nullptr && known->kind == Entity::Kind::kLandmark ? Kind::kLandmarkTwice : Kind::kRedeclared;
  }

  std::optional<std::uint32_t> landmark(syntax::Name name) {
    if (const auto near = near_landmark(name.text)) return near;
    const Entity* entity = draft_.names.find(name.text);
    if (entity != nullptr && entity->kind == Entity::Kind::kBroken) return std::nullopt;
    if (entity != nullptr && entity->kind == Entity::Kind::kLandmark) {
      const std::uint32_t found = draft_.landmark_of_row.at(entity->id);
      if (draft_.landmarks[found].map == map_id_) return remember(found);
    }
    if (draft_.lost_landmarks.contains(name.text)) return std::nullopt;
    draft_.diagnostics.report(Kind::kRoadUnknownLandmark, name.span, {map_.name.text, name.text})
        .suggest(draft_.diagnostics.nearest(name.text, map_.landmarks, [](const syntax::Landmark& known) { return known.name.text; }));
    return std::nullopt;
  }

  std::uint32_t remember(std::uint32_t landmark) {
    last_[1] = std::exchange(last_[0], landmark);
    return landmark;
  }

  /// Looks for the landmark among the last two and those declared right after them. In large maps nearly all roads begin and end there,
  /// and this costs much less than a look-up among all names.
  std::optional<std::uint32_t> near_landmark(std::string_view name) {
    for (const std::uint32_t last : last_) {
      for (const std::uint32_t near : {last, last + 1}) {
        if (near < draft_.landmarks.size() && draft_.model[draft_.landmarks[near].row].name == name) return remember(near);
      }
    }
    return std::nullopt;
  }

  void read_road(const syntax::Road& road) {
    const syntax::Name from_name = name(road.from), exit_name = name(road.exit);
    const syntax::Name to_name = name(road.to), approach_name = name(road.approach);
    const auto from = landmark(from_name);
    const auto to = landmark(to_name);
    const std::uint32_t exit = exit_of(exit_name);
    const std::uint32_t approach = exit_of(approach_name);
    const std::uint32_t by = road.by.known() ? method_of(name(road.by)) : kNone32;
    if (!from || !to) {
      draft_.broken_maps[map_id_] = true;
      return;
    }
    if (*from == *to && exit_name.text == approach_name.text) {
      draft_.diagnostics.report(Kind::kRoadToItself, approach_name.span, {from_name.text, exit_name.text});
      return;
    }
    take_arm(*from, exit, from_name, exit_name);
    take_arm(*to, approach, to_name, approach_name);
    const float limit_m_per_s = limit_of(road);
    const auto id = next_road_id();
    add({id, RowId::kNone, *from, *to, exit_name.text, exit, approach, by, limit_m_per_s}, approach_name.text, road.span);
    bend(road.through.begin(), road.through.end());
    if (!road.both_ways) return;
    add({id, RowId::kNone, *to, *from, approach_name.text, approach, exit, by, limit_m_per_s}, exit_name.text, road.span);
    bend(road.through.rbegin(), road.through.rend());
  }

  /// 0 if it has none, or what it has is none (reported).
  float limit_of(const syntax::Road& road) {
    if (road.limit == 0) return 0.0f;
    const syntax::Number& number = map_.limits[road.limit - 1];
    const auto speed = to_si(number, draft_.diagnostics);
    if (!speed || !in_reach(number, speed->value, draft_.diagnostics)) return 0.0f;
    const auto limit = static_cast<float>(speed->value);
    if (speed->unit == "m/s" && speed->value >= kSlowest_m_per_s) {
      draft_.lowest_limit_m_per_s = std::min(draft_.lowest_limit_m_per_s, limit);
      return limit;
    }
    draft_.diagnostics.report(Kind::kSpeedLimit, number.span, {fmt::format("{}", kSlowest_m_per_s), syntax::number_text(number)});
    return 0.0f;
  }

  [[nodiscard]] syntax::Name name(source::Span span) const { return {span, draft_.diagnostics.sources().text(span)}; }

  [[nodiscard]] std::uint32_t next_road_id() const { return draft_.roads.empty() ? 0 : draft_.roads.back().road + 1; }

  /// Adds these points to the road that was added last.
  void bend(auto point, auto end) {
    Map& map = draft_.model.maps[map_id_];
    map.roads.back().first_bend = static_cast<std::uint32_t>(map.bends.size());
    for (; point != end; ++point) map.bends.push_back({point->x, point->y});
    map.roads.back().bends = static_cast<std::uint32_t>(map.bends.size()) - map.roads.back().first_bend;
  }

  void take_arm(std::uint32_t landmark, std::uint32_t exit, syntax::Name name, syntax::Name at) {
    if (exit == kNone32) return;
    source::Few<Arm, 4>& arms = arms_[landmark - first_];
    for (const Arm& arm : arms) {
      if (arm.exit != exit) continue;
      draft_.diagnostics.report(Kind::kExitTwice, at.span, {at.text, name.text}).note(Kind::kFirstUsedHere, arm.span);
      return;
    }
    arms.push_back({exit, at.span});
  }

  /// Also makes the road's row.
  void add(DirectedRoad road, std::string_view approach_name, source::Span declared) {
    const RowId from = draft_.landmarks[road.from].row;
    const RowId to = draft_.landmarks[road.to].row;
    const std::string_view from_name = draft_.model[from].name, to_name = draft_.model[to].name;
    road.row = add_row(draft_, road_relation_, {from_name, ".", road.exit_name, ">", to_name, ".", approach_name}, declared);
    set(road.row, fields_.from, from);
    set(road.row, fields_.to, to);
    set(road.row, fields_.exit, draft_.value(draft_.exits, road.exit));
    set(road.row, fields_.approach, draft_.value(draft_.exits, road.approach));
    set(road.row, fields_.by, draft_.value(draft_.methods, road.by));
    draft_.landmarks[road.from].out.push_back(static_cast<std::uint32_t>(draft_.roads.size()));
    ++draft_.landmarks[road.to].in;
    draft_.model.maps[map_id_].roads.push_back({road.road, road.row, 0, 0, road.limit_m_per_s});
    draft_.roads.push_back(road);
  }

  void set(RowId row, Field field, Value value) {
    if (field) set_field(draft_, row, *field, value);
  }

  std::uint32_t exit_of(syntax::Name name) {
    return member_of(draft_.exits, name, Kind::kUnknownExit, Kind::kExitsWithoutSet, draft_.said_no_exits);
  }
  std::uint32_t method_of(syntax::Name name) {
    return member_of(draft_.methods, name, Kind::kUnknownMethod, Kind::kMethodsWithoutSet, draft_.said_no_methods);
  }

  /// The member of that name, or kNone32 after a message: `unknown` for each name, `without_set` only once.
  std::uint32_t member_of(SetId id, syntax::Name name, Kind unknown, Kind without_set, bool& said) {
    if (id == SetId::kNone) {
      if (draft_.library_missing || std::exchange(said, true)) return kNone32;
      draft_.diagnostics.report(without_set, name.span, {name.text}).suggest(draft_.diagnostics.nearest_of(name.text, [&](auto& members) {
        for (const FiniteSet& set : draft_.model.sets) members.insert(members.end(), set.members.begin(), set.members.end());
      }));
      return kNone32;
    }
    if (const auto member = draft_.member(id, name.text)) return member->index;
    const FiniteSet& set = draft_.model.sets[index(id)];
    report_unknown_member(draft_, unknown, name, {set.name, set.declared, set});
    return kNone32;
  }

  Draft& draft_;
  const syntax::Map& map_;
  std::uint32_t map_id_ = 0;
  RelationId landmark_relation_ = RelationId::kNone;
  RelationId road_relation_ = RelationId::kNone;
  RoadFields fields_;                            // of the relation of roads, looked up once
  std::size_t first_ = draft_.landmarks.size();  // the landmarks of this map begin here
  std::uint32_t last_[2] = {static_cast<std::uint32_t>(first_), static_cast<std::uint32_t>(first_)};   // the two landmarks that roads named last
  std::vector<source::Few<Arm, 4>> arms_;        // by landmark of this map: the exits in use
};

}  // namespace

void choose_exits(Draft& draft) {
  Words exits;
  Words methods;
  const auto name = [&](source::Span span) { return syntax::Name{span, draft.diagnostics.sources().text(span)}; };
  draft.each<syntax::Map>([&](const auto&, const auto&, const syntax::Map& map) {
    for (const syntax::Road& road : map.roads) {
      exits.add(name(road.exit));
      exits.add(name(road.approach));
      if (road.by.known()) methods.add(name(road.by));
    }
  });
  const std::vector<bool> driven = sets_of_strategies(draft);
  draft.exits = best_set(draft, exits.words());
  draft.methods = best_set(draft, methods.words(), driven);
  check_methods(draft, methods.words(), driven);
  if (draft.exits == SetId::kNone && !exits.words().empty()) draft.exits = usual_set(draft, "Direction");
  if (draft.methods == SetId::kNone && !methods.words().empty()) draft.methods = usual_set(draft, "Method");
}

void declare_map(Draft& draft, const syntax::Map& map) { MapReader(draft, map).run(); }

void forget_roads(Draft& draft) {
  source::release(draft.roads);
  source::release(draft.landmarks);
  source::release(draft.legs_from);
  draft.graph.reset();
}

}  // namespace kb::model
