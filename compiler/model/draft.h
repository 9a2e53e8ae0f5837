// The model under construction, with what is needed only to make it: names, tables, roads and plans. Each step of `resolve` is a
// function that works on a Draft; resolve.cc lists them in order.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compiler/model/model.h"
#include "compiler/model/names.h"
#include "compiler/model/shapes.h"
#include "compiler/model/standard_names.h"

namespace kb::model {

inline constexpr std::uint32_t kNone32 = 0xFFFFFFFFu;

/// Limits, each named in its message.
inline constexpr std::size_t kMaxCells = std::size_t{1} << 24;
inline constexpr std::size_t kMaxFieldValues = std::size_t{1} << 26;   ///< fields of all rows
inline constexpr std::size_t kMaxInstances = 10'000'000;            ///< combinations tried for one rule
inline constexpr std::size_t kMaxRules = std::size_t{1} << 22;      ///< instances in all
inline constexpr std::size_t kMaxEffects = std::size_t{1} << 25;    ///< effects of all instances
inline constexpr std::size_t kMaxPlannedRows = std::size_t{1} << 18;  ///< legs and detours planned for one route
inline constexpr std::size_t kMaxPlannedInAll = std::size_t{3} << 19;  ///< the same for all routes; some three rules come of each, and so kMaxRules

/// An index of a set's members, and which of them were added.
struct SetIndex {
  std::unordered_map<std::string_view, std::uint32_t> members;
  std::optional<std::uint32_t> more;     ///< the first that a `names S more` added
};

/// A road of a map in one direction.
struct DirectedRoad {
  std::uint32_t road = 0;                ///< the same for both directions
  RowId row = RowId::kNone;              ///< declared where the road is
  std::uint32_t from = 0, to = 0;        ///< landmarks
  std::string_view exit_name;
  std::uint32_t exit = kNone32, approach = kNone32;   ///< members of `Draft::exits`
  std::uint32_t by = kNone32;            ///< a member of `Draft::methods`
  float limit_m_per_s = 0.0f;            ///< see MapRoad
};

/// A fact with a threshold of its own, and where it stands.
struct OwnThreshold {
  CellId fact = CellId::kNone;
  std::optional<source::Span> event, attention;
};

struct LandmarkInfo {
  RowId row = RowId::kNone;
  std::uint32_t map = 0;                 ///< index into `Model::maps`
  source::Few<std::uint32_t, 4> out;     ///< roads that leave it, in order of declaration
  std::uint32_t in = 0;                  ///< how many roads lead to it
};

/// The detour that is written out for a leg.
struct WrittenDetour { source::Span span; KeptId when; };

/// A leg of a route or a detour, independent of the fields that the relation `Leg` has.
struct LegInfo {
  RowId row = RowId::kNone;
  std::uint32_t route = 0;
  std::uint32_t from = kNone32, to = 0;  ///< landmarks
  std::uint32_t road = kNone32;          ///< directed road; none for the first leg of a route and for a retreat
  std::uint32_t next = kNone32;          ///< leg
  bool ends = false;                     ///< the route ends with it
  std::optional<WrittenDetour> detour;
};

struct RouteInfo {
  std::string_view name;
  RowId row = RowId::kNone;
  std::uint32_t map = 0;
  std::vector<std::uint32_t> legs;       ///< its own, in order; empty if it could not be read
  std::uint32_t written_detours = 0;
  std::optional<source::Span> planned;   ///< its `detours on`
  source::Span span;
};

/// A field that holds a condition which is not yet resolved.
struct KeptPlace {
  RowId row = RowId::kNone;
  std::string_view field;
  std::uint32_t leg = kNone32;           ///< the leg that `exit` and `leg` speak of, if there is one
};

/// The condition of a planned detour: all of `closed` are closed and `open` is not. Both are legs; filled in once all rows exist.
struct PlannedCondition {
  RowId row = RowId::kNone;
  std::uint32_t statement = 0;           ///< index into `Draft::plans`
  std::uint32_t instead = 0;             ///< leg
  std::vector<std::uint32_t> closed;     ///< legs, among them `instead`
  std::uint32_t open = 0;                ///< leg
};

/// What a draft adds to a sensor of the model: the quantity that prototypes are laid on.
struct SensorInfo { Domain domain; bool used = false; };

/// One `detours on R when C`. Without `when` it is `Closed[exit]`.
struct PlanStatement {
  std::string_view route;
  const syntax::Tree* tree = nullptr;
  std::optional<syntax::CondId> when;
  source::Span span;
};

/// Conditions that many instances ask for, each made once: `event`, `lost`, `seen` and `is` with each term by cell, `not` by what it negates,
/// a long `or` by its parts. An entry may be stale, when the instance that made it was withdrawn: before use, check that the condition there
/// is the one looked for.
struct SharedConds {
  std::array<std::vector<CondId>, 3 + kTermWords.size()> asked;
  std::vector<CondId> negated;
  std::map<std::vector<CondId>, CondId> any;
};

struct Draft {
  Draft(const Forest& f, diagnostics::Diagnostics& d) : forest(f), diagnostics(d) {}

  const Forest& forest;
  diagnostics::Diagnostics& diagnostics;
  StandardNames* library = nullptr;                 // may be null
  std::size_t first_leg = 0;                        // the number of each route's first leg
  Model model;
  Names names;
  std::vector<SetIndex> sets;                       // beside model.sets
  std::unordered_map<std::string_view, SetId> set_with;  // by member: the first set that holds it
  std::unordered_map<std::string_view, SetId> set_of;  // finite sets and the members of groups, by name
  std::vector<OwnThreshold> own_thresholds;
  std::vector<SensorInfo> sensors;                  // beside model.sensors
  std::unordered_map<std::string, std::uint32_t> placed_shape_of;
  std::unordered_map<std::uint32_t, std::uint32_t> perceived_of;  // by fact: index into Model::perceived
  SetId exits = SetId::kNone, methods = SetId::kNone;  // see note [exits of roads]
  std::vector<DirectedRoad> roads;
  float lowest_limit_m_per_s = std::numeric_limits<float>::infinity();   // of all roads
  std::vector<LandmarkInfo> landmarks;
  std::unordered_map<std::string_view, bool> lost_landmarks;  // their names were taken already; reported
  std::vector<bool> broken_maps;                    // by map: a road could not be read
  std::vector<std::uint32_t> landmark_of_row;       // by row, as far as there are landmarks; kNone32 for other rows
  std::shared_ptr<const class RoadGraph> graph;     // planner.h
  std::vector<LegInfo> legs;
  std::vector<std::vector<std::uint32_t>> legs_from;  // by landmark: legs that leave it by a road
  std::vector<RouteInfo> routes;
  std::unordered_map<std::string_view, std::uint32_t> route_of;
  std::unordered_map<std::string_view, source::Span> commands_used;  // by routes
  std::vector<PlanStatement> plans;
  std::vector<PlannedCondition> planned_conditions;
  std::vector<KeptPlace> kept;
  SharedConds shared_conds;
  std::unordered_map<std::uint64_t, source::Span> field_spans;  // of rows written out: see field_key
  std::unordered_map<std::string_view, bool> unknown_names;  // reported already
  std::size_t effects = 0;                          // of all rules
  std::map<std::pair<SetId, SetId>, SetId> other_owner_told;   // by two sets of the same names: which is to be indexed with the other
  bool library_missing = false;                     // reported once; what follows from it is not reported
  bool said_no_levels = false;
  bool said_no_exits = false, said_no_methods = false;
  std::size_t planned_rows = 0;                     // legs and detours that were planned, on all routes
  bool rows_written = false;                        // all fields have what was written, but for conditions
  bool exhausted = false;                           // a limit was reached; nothing more is made

  /// Every statement of type `Node`, in order.
  template <class Node, class Visit>
  void each(Visit visit) const {
    for (const syntax::Tree& tree : forest.trees) {
      for (const syntax::Statement& statement : tree.statements) {
        if (const auto* node = std::get_if<Node>(&statement.node)) visit(tree, statement, *node);
      }
    }
  }
  /// Declares what is to be the `id`-th of its kind; if it is not `sound`, which is reported, its name as something broken. Whether to add it.
  bool declare(const syntax::Name& name, Entity::Kind kind, std::size_t id, bool sound) {
    return names.declare(name, {sound ? kind : Entity::Kind::kBroken, static_cast<std::uint32_t>(id), {}}, diagnostics) && sound;
  }
  [[nodiscard]] bool standard(source::Span span) const {
    return span.known() && diagnostics.sources().standard(span.file);
  }
  [[nodiscard]] const std::string& name_of(Member member) const {
    return model.sets[index(member.set)].members[member.index];
  }
  /// A member of the set; none if it is kNone32.
  [[nodiscard]] static Value value(SetId set, std::uint32_t member) { return member == kNone32 ? Value{} : Value{Member{set, member}}; }
  /// The member of that name, of the first set that has one.
  [[nodiscard]] std::optional<Member> member_anywhere(std::string_view text) const {
    const auto set = set_with.find(text);
    return set == set_with.end() ? std::nullopt : member(set->second, text);
  }
  [[nodiscard]] std::optional<Member> member(SetId set, std::string_view text) const {
    const auto& members = sets[index(set)].members;
    const auto found = members.find(text);
    if (found == members.end()) return std::nullopt;
    return Member{set, found->second};
  }
};

// ---- certain.cc

/// For files with errors: from now on `diagnostics` hands on no warnings, and of the errors only those about names that hold whatever
/// stands in the text that could not be read: the names at their place do not occur there. None at all if an import could not be followed.
void report_only_certain(const Forest& forest, diagnostics::Diagnostics& diagnostics);

// ---- cells and rows (cells.cc)

/// A new cell. Facts and strategies get their own satellite, `sat X`, right after them.
CellId add_cell(Draft& draft, Cell cell, float own_initial = -1.0f);
/// True if `more` cells would be too many, which is reported.
bool too_many_cells(Draft& draft, std::size_t more, std::string_view name, source::Span at);
/// True if `more` fields in rows of the relation would be too many, which is reported.
bool too_many_values(Draft& draft, std::size_t more, const Relation& relation, source::Span at);
/// The own satellite of a fact or strategy.
[[nodiscard]] CellId own_satellite(const Model& model, CellId cell);
/// `satellite` draws attention to `cell`.
void attach(Model& model, CellId satellite, CellId cell);
/// What a cell is, for messages.
[[nodiscard]] std::string_view words_for(const Model& model, CellId cell);

/// The relation of this name, or nothing.
[[nodiscard]] std::optional<RelationId> find_relation(const Draft& draft, std::string_view name);
/// The same; if it is not declared, one without fields is made.
RelationId implicit_relation(Draft& draft, std::string_view name, source::Span at);
/// The same, and reports that it is not declared (`what` writes its rows), once for all relations of the library.
RelationId need_relation(Draft& draft, std::string_view name, std::string_view what, source::Span at);
/// A new row of this cell, with all its fields missing; if they are too many, it gets none. `name` is one of the model's texts.
RowId add_row_of(Draft& draft, RelationId relation, std::string_view name, source::Span at, CellId cell);
/// A new row, named by its parts joined (they are copied). It gets a satellite of its own if the relation has satellites.
RowId add_row(Draft& draft, RelationId relation, std::initializer_list<std::string_view> name, source::Span at);
inline RowId add_row(Draft& draft, RelationId relation, std::string_view name, source::Span at) { return add_row(draft, relation, {name}, at); }
/// Adds a place or a condition that a field can hold.
PointId add_point(Model& model, Point point);
KeptId add_kept(Model& model, KeptCondition kept);
/// Sets a field if the relation has it.
void set_field(Draft& draft, RowId row, std::string_view field, Value value);
/// Sets the field at this place of the relation.
void set_field(Draft& draft, RowId row, std::size_t place, Value value);
/// A field of a row as one number.
[[nodiscard]] constexpr std::uint64_t field_key(RowId row, std::size_t field) { return (std::uint64_t{index(row)} << 32) | field; }
[[nodiscard]] std::optional<std::size_t> find_field(const Relation& relation, std::string_view field);
void report_unknown_field(Draft& draft, const Relation& relation, const syntax::Name& field);

/// The entity of this name and kind. Null if there is none: `unknown` is reported, or `other` if the name is something else, or nothing if
/// its declaration was broken.
[[nodiscard]] const Entity* need_entity(Draft& draft, const syntax::Name& name, Entity::Kind wanted, diagnostics::Kind unknown, diagnostics::Kind other);

/// The finite set of this name; reported if there is none. `or_relation`: a relation may be meant as well.
[[nodiscard]] std::optional<SetId> need_set(Draft& draft, syntax::Name name, bool or_relation = false);

/// Reserves room for `more` items, and some spare: repeated small calls then do not reallocate each time, and the next few items do
/// not double the memory. Unused room costs address space, not memory.
template <class T>
void make_room(std::vector<T>& items, std::size_t more) {
  if (items.capacity() - items.size() < more) items.reserve(items.size() + std::max(more + more / 8, items.size() / 2));
}

/// The next combination of values, the last one fastest: `size(i)` is the number of values of the i-th. After the last combination comes
/// the first, and it returns false.
template <class Size>
bool next_combination(std::vector<std::size_t>& places, Size size) {
  for (std::size_t i = places.size(); i-- > 0;) {
    if (++places[i] < size(i)) return true;
    places[i] = 0;
  }
  return false;
}

// ---- the steps of resolve, in order

void declare_sets(Draft& draft);          // sets.cc
void declare_levels(Draft& draft);        // settings.cc
void report_no_levels(Draft& draft, source::Span at);   // settings.cc
void declare_all(Draft& draft);           // declare.cc: cells, groups, relations, maps, in order of the statements
void declare_map(Draft& draft, const syntax::Map& map);   // maps.cc
void choose_exits(Draft& draft);          // maps.cc: which sets name the exits and the methods of roads
void declare_prototypes(Draft& draft);    // prototypes.cc
void declare_sensors(Draft& draft);       // sensors.cc
void declare_fuzzy(Draft& draft);         // fuzzy.cc
void declare_tables(Draft& draft);        // tables.cc
void apply_settings(Draft& draft);        // settings.cc
void plan_routes(Draft& draft);           // routes.cc
void report_islands(Draft& draft);        // islands.cc
void write_rows(Draft& draft);            // rows.cc
void plan_detours(Draft& draft);          // detours.cc: planned ones, then written ones
void attach_satellites(Draft& draft);     // attention.cc: `of X`, and rows `satellites of f`
void read_perception(Draft& draft);       // perception.cc: the definitions of facts
void order_perception(Draft& draft);      // perception_order.cc: a fact after those that define it
void resolve_kept_conditions(Draft& draft);  // kept.cc
void forget_roads(Draft& draft);          // maps.cc: not needed from here on, and there may be millions
void expand_rules(Draft& draft);          // expand.cc
void order_strategies(Draft& draft);      // priority.cc
void bind_controllers(Draft& draft);      // controls.cc
void report_unused(Draft& draft);         // unused.cc: declarations that nothing names

}  // namespace kb::model
