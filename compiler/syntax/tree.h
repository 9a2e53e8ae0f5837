// The tree: the source as written, before any name is looked up. Vectors and typed 32-bit ids; no pointers, so a
// tree is a value. All `text` fields are views into `source::Sources`, which must outlive the tree.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "compiler/source/kinds.h"
#include "compiler/source/source.h"

namespace kb::syntax {

enum class RefId : std::uint32_t {};
enum class CondId : std::uint32_t {};
enum class ShapeId : std::uint32_t {};
enum class PerceptId : std::uint32_t {};

/// An identifier where it stands.
struct Name {
  source::Span span;
  std::string_view text;
};

/// A number with its unit: `0.3 m`, `500 ms`, `-0.5`. `value` is as written (sign included), `unit` empty if there is none.
struct Number {
  source::Span span;
  double value = 0.0;
  Name unit;
};

/// One index of `G[...]` or argument of `f(...)`: a reference, `*` for every member, or a number, as in `line[0]`.
struct Index {
  source::Span span;
  bool star = false;
  RefId ref{};                  ///< meaningless if `star` or `number`
  std::optional<double> number;
};

/// What follows the name of a reference: `[i, j]`, `.field`, `(a, b)`.
struct Postfix {
  enum class Kind : std::uint8_t { kIndex, kField, kCall };
  Kind kind = Kind::kIndex;
  source::Span span;
  Name field;                  ///< kField
  std::vector<Index> arguments;  ///< kIndex, kCall
};

/// A reference: `Line`, `In[i]`, `In.N`, `l.exit`, `d.instead.to`, `turn_of(i, o)`.
struct Ref {
  source::Span span;
  Name base;
  std::vector<Postfix> postfixes;
};

/// A membership function: `triangle(135, 180, 225)`, `gaussian(0.9, left 0.15, right inf)`, `gaussian(1 m..2 m, 20 cm)`.
struct Shape {
  struct Argument {
    source::Span span;
    std::optional<Name> label;    ///< `left`, `right`
    std::optional<Number> number; ///< else it is `word`
    std::optional<Number> to;     ///< the end of a range that begins with `number`
    Name word;                    ///< `inf`
  };
  source::Span span;
  Name name;
  std::vector<Argument> arguments;
};

using kb::Term;

/// A condition. `and` and `or` are flat (two or more children, none of the same kind unless parenthesised).
struct Cond {
  enum class Kind : std::uint8_t {
    kOr, kAnd,
    kFor,    ///< children[0] has held for `duration`
    kNot,    ///< not children[0]
    kEvent, kLost, kSeen,  ///< of `ref`
    kIs,     ///< `[sat] ref [is [not] term]`
    kAny,    ///< `any|no [sat|event|lost|seen] ref`
    kError,  ///< could not be read; already reported, so later phases report nothing more about it
  };
  Kind kind = Kind::kError;
  source::Span span;
  std::vector<CondId> children;
  Number duration;             ///< kFor
  source::Span time;           ///< kFor: `for 300 ms`
  RefId ref{};                 ///< kEvent, kLost, kSeen, kIs, kAny
  bool sat = false;            ///< kIs, kAny: `sat` stood before the reference
  Kind asked = Kind::kIs;      ///< kAny: kEvent, kLost, kSeen or kIs of each
  bool none = false;           ///< kAny: `no` instead of `any`
  bool negated = false;        ///< kIs: `is not`
  bool parenthesised = false;  ///< parentheses of its own stand round it
  Name term;                   ///< kIs: the word after `is`, empty text if there was no `is` (then the term is high)
};

/// What defines a fact: `line[0] ~ dark and not (tag ~ "LM7")`. `and` and `or` are flat, as in conditions.
struct Percept {
  enum class Kind : std::uint8_t {
    kOr, kAnd,
    kNot,       ///< not children[0]
    kFact,      ///< the fact `ref`
    kFits,      ///< the sensor `ref` is like `shape`, written out
    kFitsNamed, ///< the sensor `ref` is like `word`: a prototype, or the name that a variable stands for
    kReads,     ///< the sensor `ref` reads `word`, written in quotes
    kError,     ///< could not be read; already reported
  };
  Kind kind = Kind::kError;
  source::Span span;
  std::vector<PerceptId> children;
  RefId ref{};
  ShapeId shape{};
  Name word;   ///< kReads: without the quotes; the span has them
};

struct Effect {
  enum class Kind : std::uint8_t { kRaise, kLower, kAssign, kReset };  ///< +X  -X  X = v  reset
  Kind kind = Kind::kRaise;
  source::Span span;
  bool sat = false;
  RefId ref{};    ///< meaningless for kReset
  Number value;   ///< kAssign
};

// ---- statements, in the order of language/README

struct Import { std::string_view path; source::Span path_span; bool quoted = false; };  ///< `"file.kb"` or `std.road`
struct Levels { std::vector<Name> names; };
struct Setting { Name key; std::optional<Number> number; Name word; RefId ref{}; };  ///< a number, or a word as written and as a reference
struct Set { std::vector<Setting> settings; };
struct NameSet { Name name; std::vector<Name> members; bool more = false; };  ///< `more`: added to a set declared elsewhere

/// `fact(s)`, `command`, `satellite(s)`, `strategy|strategies`.
struct Declaration {
  enum class Kind : std::uint8_t { kFact, kCommand, kSatellite, kStrategy };
  struct Item {
    Name name;
    enum class Shape : std::uint8_t { kPlain, kMembers, kOver } shape = Shape::kPlain;  ///< X   X { a, b }   X[A, B]
    std::vector<Name> names;     ///< the members, or the sets
    std::vector<std::optional<PerceptId>> definitions;  ///< by member: what it is perceived by (kMembers)
    std::vector<std::optional<Number>> values;          ///< by member: an initial value of its own, `left = 1` (kMembers, satellites)
    std::optional<RefId> of;     ///< `of X` (satellites only); one `of` serves all items since the last one
  };
  Kind kind = Kind::kFact;
  bool plural = false;
  std::vector<Item> items;
  std::optional<source::Span> exclusive;
  std::optional<source::Span> keep;
  std::optional<source::Span> output;
  std::optional<Number> initial;     ///< `= v` (satellites)
  std::optional<Number> sat_initial; ///< `sat = v` (facts, commands)
  std::optional<Number> event;       ///< own threshold (facts, commands)
  std::optional<Number> attention;
  std::optional<PerceptId> definition; ///< `= percept` (facts)
  source::Span definition_span;
  std::optional<source::Span> lazy;    ///< facts
};

struct Priority { std::vector<RefId> order; };  ///< highest first

struct Relation {
  Name name;
  std::vector<Name> fields;
  bool satellites = false;      ///< each row is a state cell
  std::vector<Name> of;         ///< fields whose cell a row draws attention to
  bool exclusive = false;       ///< the rows are one variable
};

/// `row [name] in R(field: value, ...)`: a row of a relation, written out. A value is a reference or a condition
/// (a condition that is a bare reference is taken as the reference).
struct Row {
  struct Field { Name name; CondId value{}; };
  std::optional<Name> name;
  Name relation;
  std::vector<Field> fields;
};

struct Point { double x = 0.0, y = 0.0; };  ///< metres; x east, y north
struct Landmark { source::Span span; Name name; std::optional<Point> at; };
/// Kept small, because a map can have a million of them: it holds the places of its names instead of the names.
struct Road {
  source::Span span;
  source::Span from, exit, to, approach;
  source::Span by;                   ///< unknown if it has none
  bool both_ways = true;             ///< `--`, else `->`
  std::uint32_t limit = 0;           ///< `at most`: the number of its speed in `Map::limits`, from 1; 0: none
  std::vector<Point> through;
};
struct Map { Name name; std::vector<Landmark> landmarks; std::vector<Road> roads; std::vector<Number> limits; };

struct Stop { Name landmark; std::optional<Name> exit; };  ///< `LM5` or `LM5.W`
struct Route { Name name, map, command; std::vector<Stop> stops; };
struct Detour { std::vector<Stop> stops; std::optional<Name> on; std::optional<CondId> when; };
struct Detours { Name route; std::optional<CondId> when; };

struct Table {
  struct Line { Name label; std::vector<Name> values; };
  Name name;
  std::vector<Name> parameters;      ///< sets, one or two
  Name result;
  std::vector<Name> columns;         ///< members of the second set; empty for one parameter
  std::vector<Line> lines;           ///< label: member of the first set
  bool more = false;                 ///< `table f more { ... }`: entries of a table declared elsewhere; no parameters, no result
};

struct Rule {
  struct Binder { Name variable, set; };
  enum class Mode : std::uint8_t { kWhen, kWhile };
  Name name;
  std::vector<Binder> binders;
  Name level;
  Mode mode = Mode::kWhen;
  CondId condition{};
  std::vector<Effect> effects;
};

struct Control {
  struct Argument { Name name; std::optional<Number> number; Name word; };  ///< a number with unit, or a word
  RefId strategy{};
  Name controller;
  std::vector<Argument> arguments;
};

struct Prototype { Name name; ShapeId shape{}; };  ///< `prototype near = gaussian(0.25 m, left inf, right 0.08 m)`

/// `sensor range[8] 0..4 m noise 0.02 m stale 0.2 s`
struct Sensor {
  Name name;
  std::optional<Number> count;          ///< how many there are, if it is an array
  std::optional<std::pair<Number, Number>> range;  ///< if there is none, readings are texts
  std::optional<Number> noise, stale;
  std::optional<source::Span> circular, strict;
};

/// `perceive [l in Landmark] l = tag ~ l`
struct Perceive {
  std::vector<Rule::Binder> binders;
  RefId target{};
  PerceptId percept{};
};

/// An input of a fuzzy block, or one of a group: `bearing`, `free[3]`.
struct FuzzyRef { source::Span span; Name name; std::optional<Number> element; };

/// A condition of a fuzzy block; ids are indices into `Fuzzy::conds`. `and` and `or` have two children.
struct FuzzyCond {
  enum class Kind : std::uint8_t { kAnd, kOr, kNot, kIs };
  Kind kind = Kind::kIs;
  source::Span span;
  std::uint32_t left = 0, right = 0;   ///< kNot: `left` only
  FuzzyRef ref;                        ///< kIs
  std::vector<Name> words;             ///< kIs: what stands after `is`: `not`, hedges, the term last
};

struct Fuzzy {
  struct Method { source::Span span; Name word; };
  struct Input {
    struct Term { Name name; ShapeId shape{}; };
    Name name;
    std::optional<Number> count;       ///< `free[8]`
    Number low, high;
    bool circular = false;
    std::vector<Term> terms;
  };
  struct Output {
    struct Term { Name name; Number value; };
    Name name;
    Number low, high;
    bool circular = false;
    std::vector<Term> terms;
    std::optional<Name> by;            ///< `average`, `sum`, `winner`
    std::optional<Number> within;
    std::optional<Number> default_number;
    std::optional<Name> default_term;
  };
  /// A part of a sum: a number, an input or a term, or a number times an input.
  struct Part { source::Span span; bool negative = false; std::optional<Number> number; std::optional<FuzzyRef> ref; };
  struct Consequent { source::Span span; Name output; std::vector<Part> sum; };
  static constexpr std::uint32_t kNoGiven = 0xFFFFFFFFu;
  struct Rule {
    source::Span span;
    std::uint32_t given = kNoGiven;    ///< the innermost one around it
    std::uint32_t condition = 0;
    std::vector<Consequent> consequents;
    std::optional<Number> weight;
  };
  struct Given { source::Span span; std::uint32_t parent = kNoGiven, condition = 0, first_rule = 0, end_rule = 0; };
  Name name;
  std::optional<Name> conjunction, disjunction;   ///< `and = product`, `or = sum`
  std::vector<Input> inputs;
  std::vector<Output> outputs;
  std::vector<FuzzyCond> conds;
  std::vector<Rule> rules;
  std::vector<Given> givens;
};

struct Statement {
  source::Span span;
  std::variant<Import, Levels, Set, NameSet, Declaration, Priority, Relation, Row, Map, Route, Detour, Detours, Table,
               Rule, Control, Prototype, Sensor, Perceive, Fuzzy>
      node;
};

/// One file. `refs`, `conds`, `shapes` and `percepts` are the arenas that ids point into.
struct Tree {
  source::FileId file = source::FileId::kNone;
  std::vector<Statement> statements;
  std::vector<Ref> refs;
  std::vector<Cond> conds;
  std::vector<Shape> shapes;
  std::vector<Percept> percepts;

  [[nodiscard]] const Ref& operator[](RefId id) const { return refs[static_cast<std::size_t>(id)]; }
  [[nodiscard]] const Cond& operator[](CondId id) const { return conds[static_cast<std::size_t>(id)]; }
  [[nodiscard]] const Shape& operator[](ShapeId id) const { return shapes[static_cast<std::size_t>(id)]; }
  [[nodiscard]] const Percept& operator[](PerceptId id) const { return percepts[static_cast<std::size_t>(id)]; }
};

}  // namespace kb::syntax
