// The model: what a knowledge base says, all names resolved, every template expanded to its instances.
//
// Cells are facts, satellites and strategies. Rows are the rows of relations. Rules are instances: one for each
// combination of rows for which every field that the rule needs is there.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/fuzzy/controller.h"
#include "compiler/fuzzy/shape.h"
#include "compiler/source/kinds.h"
#include "compiler/source/source.h"
#include "compiler/source/texts.h"
#include "compiler/syntax/tree.h"

namespace kb::model {

enum class CellId : std::uint32_t { kNone = 0xFFFFFFFFu };
enum class SetId : std::uint32_t { kNone = 0xFFFFFFFFu };
enum class RelationId : std::uint32_t { kNone = 0xFFFFFFFFu };
enum class RowId : std::uint32_t { kNone = 0xFFFFFFFFu };
enum class CondId : std::uint32_t {};
enum class TemplateId : std::uint32_t { kNone = 0xFFFFFFFFu };
enum class PerceptId : std::uint32_t {};
enum class PointId : std::uint32_t {};
enum class KeptId : std::uint32_t {};

template <class Id>
[[nodiscard]] constexpr std::size_t index(Id id) { return static_cast<std::size_t>(id); }

using kb::CellKind;
using kb::Idle;

/// A cell. Names: `Line`, `sat Line`, `In.N` (one index), `Cross[right,mark]` (two or more), `Route1.1:LM5>LM2` (a row).
struct Cell {
  std::string_view name;              ///< in `Model::texts`
  CellKind kind = CellKind::kFact;
  float initial = 0.0f;               ///< facts 0, satellites as declared (-1), strategies -1
  double event = 0.75;                ///< facts: epsilon as written (own or general); thresholds are rounded once, in lower
  double attention = 0.25;            ///< facts: delta
  bool command = false;               ///< facts
  bool keep = false;                  ///< satellites: survives `reset`
  bool output = false;                ///< satellites: the host program reads it
  bool own_satellite = false;         ///< satellites: the `sat X` that every fact and strategy has
  source::Few<CellId, 2> satellites;  ///< facts, strategies: the satellites that draw attention to it, `sat X` first
  CellId of = CellId::kNone;          ///< satellites: what it draws attention to, if anything (the first)
  source::Span declared;
};

/// A finite set: `names Direction { N, E, S, W }`, or the members of a group (`Turn`).
struct FiniteSet {
  std::string name;
  std::vector<std::string> members;
  std::vector<source::Span> places;   ///< of the members
  source::Span declared;
};

/// A group of cells over the product of sets, last index fastest.
struct Group {
  std::string name;
  CellKind kind = CellKind::kFact;
  std::vector<SetId> dimensions;
  std::vector<CellId> cells;
  source::Span declared;
};

struct Member { SetId set = SetId::kNone; std::uint32_t index = 0; };
struct Point { double x = 0.0, y = 0.0; };
/// A condition kept in a row (`when`). Written ones are resolved once all rows exist, before any rule is expanded.
struct KeptCondition {
  const syntax::Tree* tree = nullptr;  ///< null: the condition is always true, or its row was rejected
  syntax::CondId condition{};
  CondId resolved{};
  bool is_resolved = false;
  std::uint8_t depth = 0;              ///< how deep a written one nests, with what it asks of other rows: see note [written out]
};
/// What a field of a row holds; `std::monostate` is a missing field.
/// Kept small, because a map has millions of fields: places and conditions are in lists of the model.
using Value = std::variant<std::monostate, RowId, CellId, Member, KeptId, PointId>;

struct Row {
  static constexpr std::uint32_t kNoFields = 0xFFFFFFFFu;
  std::string_view name;               ///< in `Model::texts`
  RelationId relation = RelationId::kNone;
  CellId cell = CellId::kNone;         ///< its fact (Landmark, Command) or its satellite (Leg, Route), if it has one
  std::uint32_t first = kNoFields;     ///< where its fields begin in `Model::values`: see `Model::fields`
  source::Span declared;
};

struct Relation {
  std::string name;
  std::vector<std::string> fields;
  std::vector<RowId> rows;
  bool satellites = false;
  bool exclusive = false;
  source::Span declared;
};

/// note [loose timers]
/// In `A and B for 1 s` only `B` is timed, where a reader may think of both. Such a timer is loose: a part of an `and` with parentheses neither
/// round the timer nor round what it times. It is told here, since conditions are shared once they are lowered.

/// A resolved condition. `and` of none is true, `or` of none is false.
struct Cond {
  enum class Op : std::uint8_t { kAnd, kOr, kNot, kFor, kEvent, kLost, kSeen, kIs };
  Op op = Op::kAnd;
  syntax::Term term = syntax::Term::kHigh;  ///< kIs
  bool loose = false;                       ///< kFor: see note [loose timers]; kAnd, kOr: it has such a part
  CellId cell = CellId::kNone;              ///< kEvent, kLost, kSeen, kIs
  std::uint32_t duration_us = 0;            ///< kFor
  source::Few<CondId, 4> children;          ///< kAnd, kOr; kNot, kFor: one
};

/// One effect as written, in order. Exclusive groups and `reset` are not yet written out.
struct Write { CellId cell = CellId::kNone; float value = 0.0f; source::Span span; bool reset = false; };

/// The rule as written; its instances share it.
struct Template {
  std::string name;
  source::Span span;          ///< of the name: where messages about its instances point
  bool standard = false;      ///< from the standard library
  std::uint32_t level = 0;    ///< index into `levels`, 0 the highest
  syntax::Rule::Mode mode = syntax::Rule::Mode::kWhen;
};

struct Rule {
  std::string_view name;      ///< `enter[right,mark]`, `arrive[Route1.1:LM5>LM2]`, `finish[...]`; in `Model::texts`
  TemplateId tmpl = TemplateId::kNone;
  CondId condition{};
  source::Few<Write, 1> effects;
};

/// The controller that a strategy names.
struct Control {
  struct Argument { std::string name; double number = 0.0; std::string unit; std::string word; bool is_number = false; source::Span span; };
  CellId strategy = CellId::kNone;
  std::string controller;
  std::uint32_t fuzzy = fuzzy::kNone; ///< index into `Model::fuzzy` if it is a fuzzy controller; arguments fix its inputs
  std::vector<Argument> arguments;   ///< numbers in SI (degrees kept), `unit` the SI unit
  source::Span span;              ///< where the strategy stands
  source::Span controller_span;
};
/// `speed: 0.4 m/s`, `side: left`.
[[nodiscard]] std::string text(const Control::Argument& argument);

/// The name of a cell as it was declared, without an index: `Move` of `Move.mark`, `Cross` of `Cross[left,mark]`.
[[nodiscard]] constexpr std::string_view declared_name(std::string_view name) { return name.substr(0, name.find_first_of(".[")); }

/// A road of a map in one direction; both directions of `--` share `road`.
struct MapRoad {
  std::uint32_t road = 0;
  RowId row = RowId::kNone;
  std::uint32_t first_bend = 0, bends = 0;   ///< in `Map::bends`: see `Map::through`
  float limit_m_per_s = 0.0f;   ///< the fastest that it may be driven; 0: as fast as its controller drives
};
struct Map {
  std::string name;
  std::vector<RowId> landmarks;
  std::vector<MapRoad> roads;
  std::vector<Point> bends;            ///< of all roads, one road after another
  source::Span declared;

  /// The places that the road goes through, in its direction.
  [[nodiscard]] std::span<const Point> through(const MapRoad& road) const { return std::span(bends).subspan(road.first_bend, road.bends); }
};

/// What a leg leads along, by its satellite.
struct LegRoad {
  CellId leg = CellId::kNone;
  RowId road = RowId::kNone;    ///< kNone: the leg to the first landmark of a route, on whatever road the robot stands
  float limit_m_per_s = 0.0f;   ///< how fast it may be driven; 0: no limit
};

/// A total function over finite sets.
struct Table {
  std::string name;
  std::vector<SetId> parameters;
  SetId result = SetId::kNone;
  std::vector<std::uint32_t> values;     ///< last parameter fastest; kNone32 where an entry is missing
  std::vector<source::Span> places;      ///< of the entries
  source::Span declared;
};

/// `prototype near = gaussian(...)`. Its numbers get a meaning only where it is laid on a sensor: see shapes.h.
struct Prototype {
  std::string name;
  const syntax::Tree* tree = nullptr;
  syntax::ShapeId shape{};
  source::Span declared;
};

/// A sensor; its elements are readings `first` to `first + count - 1`.
struct Sensor {
  std::string name;
  bool text = false;
  bool array = false;
  double low = 0.0, high = 0.0;      ///< SI, degrees kept
  std::string unit;
  bool circular = false;
  double noise = 0.0;                ///< spread of a fresh reading
  std::optional<double> stale_s;     ///< the age at which a reading is as wide as half of the range; none: readings do not age
  std::uint32_t first = 0, count = 1;
  source::Span declared;
  bool strict = false;               ///< a reading outside of the range is none, instead of the nearest one in it
};

/// A prototype laid on the quantity of a sensor.
struct PlacedShape { fuzzy::Shape shape; std::string text; };

/// A part of what defines a fact. Parts stand before the whole.
struct Percept {
  using Op = PerceptOp;
  Op op = Op::kAnd;
  std::uint32_t reading = 0;         ///< kFits, kReads
  std::uint32_t shape = 0;           ///< kFits: index into `Model::placed_shapes`
  std::string text;                  ///< kReads
  CellId cell = CellId::kNone;       ///< kFact
  std::vector<PerceptId> children;   ///< kNot one, kAnd, kOr two or more
};

/// A fact that is made of readings and of other facts.
struct Perceived {
  CellId fact = CellId::kNone;
  PerceptId percept{};
  bool lazy = false;
  source::Span span;                 ///< of its definition
};

/// Neighbours in a line of `priority`: each of `before` goes before each of `after`.
struct Precedence {
  std::vector<CellId> before, after;
};

/// What `set` sets.
inline constexpr std::array<std::string_view, 5> kSettingNames{"event", "attention", "firing", "idle", "hold_limit"};
struct Settings {
  double event = 0.75, attention = 0.25, firing = 0.5;
  Idle idle = Idle::kStop;
  CellId idle_strategy = CellId::kNone;
  std::uint32_t hold_limit_us = 5'000'000;   ///< `set hold_limit = 5 s`: how long `hold` may hold
};

struct Model {
  std::shared_ptr<source::Texts> texts = std::make_shared<source::Texts>();   ///< names of cells, rows and rules
  Settings settings;
  std::vector<std::string> levels;            ///< the highest first; the last is the control level
  std::vector<source::Span> level_spans;
  std::vector<Cell> cells;                    ///< in order of declaration
  std::vector<FiniteSet> sets;
  std::vector<Group> groups;
  std::vector<Relation> relations;
  std::vector<Row> rows;
  std::vector<Value> values;                  ///< fields of all rows, one row after another
  std::vector<Point> points;                  ///< those that fields hold
  std::vector<KeptCondition> kept;            ///< those that fields hold
  std::map<CondId, source::Span> loose_timers;   ///< `for 300 ms`: see note [loose timers]
  std::vector<std::vector<CellId>> exclusive; ///< satellites and facts; a group is satellites only or facts only
  std::vector<CellId> priority;               ///< every strategy once, the highest first (a total order that extends the partial one)
  std::vector<Precedence> precedences;        ///< the partial order, as the lines state it
  std::vector<Cond> conds;
  std::vector<Template> templates;
  std::vector<Rule> rules;                    ///< in order of declaration, instances in order of rows
  std::vector<Control> controls;
  std::vector<Table> tables;
  std::vector<Map> maps;
  std::vector<LegRoad> leg_roads;             ///< of all legs, in order of their rows
  std::vector<Prototype> prototypes;
  std::vector<Sensor> sensors;
  std::vector<PlacedShape> placed_shapes;
  std::vector<Percept> percepts;
  std::vector<Perceived> perceived;           ///< a fact stands after those that define it
  std::vector<fuzzy::Controller> fuzzy;

  [[nodiscard]] const Cell& operator[](CellId id) const { return cells[index(id)]; }
  [[nodiscard]] const Cond& operator[](CondId id) const { return conds[index(id)]; }
  [[nodiscard]] const Percept& operator[](PerceptId id) const { return percepts[index(id)]; }
  [[nodiscard]] const Point& operator[](PointId id) const { return points[index(id)]; }
  [[nodiscard]] const KeptCondition& operator[](KeptId id) const { return kept[index(id)]; }
  [[nodiscard]] const Row& operator[](RowId id) const { return rows[index(id)]; }
  [[nodiscard]] const Relation& operator[](RelationId id) const { return relations[index(id)]; }
  [[nodiscard]] const Template& operator[](TemplateId id) const { return templates[index(id)]; }

  /// What the row's fields hold, in the order of its relation's fields; empty after `forget_details`.
  [[nodiscard]] std::span<const Value> fields(const Row& row) const {
    if (row.first == Row::kNoFields) return {};
    return std::span(values).subspan(row.first, (*this)[row.relation].fields.size());
  }
  /// What the field of that name holds; null if the row's relation has none.
  [[nodiscard]] const Value* field(const Row& row, std::string_view name) const;
  /// The row that the field refers to; null if it refers to none.
  [[nodiscard]] const Row* row_in(const Row& row, std::string_view field) const;
  /// The name of the member of a set that the field holds; empty if it holds none.
  [[nodiscard]] std::string_view member_in(const Row& row, std::string_view field) const;
  /// The point that the field holds; null if it holds none.
  [[nodiscard]] const Point* point_in(const Row& row, std::string_view field) const;
  /// The rows of the relation of that name; none if there is none. O(relations).
  [[nodiscard]] std::span<const RowId> rows_of(std::string_view relation) const;
};

/// All files of a knowledge base, each once, imports before importers. A model's prototypes refer to these trees for
/// printing; nothing else in a finished model does.
struct Forest {
  std::vector<syntax::Tree> trees;
  bool all_imports = true;   ///< false: some import could not be followed, which has been reported
};

class StandardNames;

/// Reads the file at `path` and everything it imports (cycles, missing files: reported). `library` is the folder that
/// holds `std/`.
[[nodiscard]] Forest load(std::string_view path, std::string_view library, const source::FileSystem& files,
                          source::Sources& sources, diagnostics::Diagnostics& diagnostics);

/// The model of the files. Messages about unknown names ask `standard` (standard_names.h) which import would bring them. After
/// errors the model holds what could be understood, and must not be lowered. If `diagnostics` is broken already, some text may be missing, and
/// only what is certain all the same is reported (certain.cc). `first_leg`: the number in the name of each route's first leg.
[[nodiscard]] Model resolve(const Forest& forest, diagnostics::Diagnostics& diagnostics, StandardNames* standard = nullptr, std::size_t first_leg = 0);

/// Frees what only readers of the model itself need: roads, tables, and everything about rows except their cells. The model can
/// still be lowered and analysed.
void forget_details(Model& model);
/// For use after lowering: frees conditions and rules with one effect, which are not needed then. The model can still be analysed.
void forget_rules(Model& model);

/// One item a line, stable: for `kbc dump model`.
[[nodiscard]] std::string print(const Model& model, const source::Sources& sources);

}  // namespace kb::model
