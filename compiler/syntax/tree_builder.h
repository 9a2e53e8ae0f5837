// Makes the tree while the parser reduces. Lists grow in members named after what they hold and are moved into their
// statement when it is complete; ids go through the parser's stack as plain numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"
#include "compiler/syntax/tree.h"

namespace kb::syntax {

class TreeBuilder {
 public:
  using Id = std::uint32_t;  ///< a RefId, a CondId, a ShapeId, or an index into a list of the builder
  using Span = source::Span;
  static constexpr Id kNothing = 0xFFFFFFFFu;

  TreeBuilder(const source::Sources& sources, source::FileId file, diagnostics::Diagnostics& diagnostics);

  [[nodiscard]] Tree take() { return std::move(tree_); }
  [[nodiscard]] diagnostics::Diagnostics& diagnostics() { return diagnostics_; }

  // ---- statements
  void end_statement(Span span);
  /// Whether the last statement of the tree is the one that begins with the word at `word`.
  [[nodiscard]] bool ends_with_statement_at(Span word) const {
    return !tree_.statements.empty() && tree_.statements.back().span.begin == word.begin;
  }
  /// Called after an error: forgets what was read of the statement.
  void abandon_statement() { clear(); }
  void import(Span path, bool quoted);
  void levels();
  void add_setting(Span key, Id number);
  void add_setting(Span key, Span word, Id ref);
  void set();
  void begin_names(Span name, bool more);
  void names();
  void add_name(Span name) { names_.push_back(name_at(name)); }

  void begin_declaration(Declaration::Kind kind, bool plural);
  void add_item(Span name);
  void add_member(Span name, Id percept = kNothing);
  void add_member_value(Span name, Id number);
  void item_names(Declaration::Item::Shape shape);
  void items_of(Id ref);
  void exclusive(Span span);
  void keep(Span span);
  void output(Span span);
  void initial(Span span, Id number);
  void sat_initial(Span span, Id number);
  void event_threshold(Span span, Id number);
  void attention_threshold(Span span, Id number);
  void definition(Span span, Id percept);
  void lazy(Span span);
  void declaration();
  void add_priority(Id ref) { refs_.push_back(RefId{ref}); }
  void priority();

  void begin_relation(Span name);
  void relation_satellites();
  void relation_exclusive() { relation_.exclusive = true; }
  void relation();
  void add_row_field(Span name, Id condition) { row_fields_.push_back({name_at(name), CondId{condition}}); }
  void row(Span relation);
  void row(Span name, Span relation);

  /// Reserves room for so many items.
  void begin_map(Span name, std::size_t landmarks, std::size_t roads);
  void add_landmark(Span span, Span name, Id at = kNothing);
  void begin_road(Span from, Span exit, Id both_ways, Span to, Span approach);
  void road_by(Span by, Span method);
  void road_limit(Span at, Span end, Id number);
  void road_through(Id at) { road_.through.push_back(points_[at]); }
  void end_road(Span span);
  void abandon_map_item() { road_ = Road{}; }
  void map();
  [[nodiscard]] Id point(Id x, Id y);

  void add_stop(Span landmark) { stops_.push_back({name_at(landmark), {}}); }
  void add_stop(Span landmark, Span exit) { stops_.push_back({name_at(landmark), name_at(exit)}); }
  void route(Span name, Span map, Span command);
  void detour(Id when);
  void detour(Id when, Span on);
  void detours(Span route, Id when);

  void begin_table(Span name, Span result);
  void begin_table_extension(Span name);
  void add_column(Span name) { table_.columns.push_back(name_at(name)); }
  void begin_line(Span label) { table_.lines.push_back({name_at(label), {}}); }
  void add_cell(Span name) { table_.lines.back().values.push_back(name_at(name)); }
  void table();

  void add_binder(Span variable, Span set) { binders_.push_back({name_at(variable), name_at(set)}); }
  void add_effect(Span span, Effect::Kind kind, Id sat, Id ref);
  void add_assignment(Span span, Id sat, Id ref, Id number);
  void add_reset(Span span);
  void rule(Span name, Span level, Id mode, Id condition);
  void add_argument(Span name, Id number);
  void add_argument(Span name, Span word);
  void control(Id strategy, Span controller);

  // ---- fuzzy numbers
  void begin_shape(Span name);
  void shape_number(Id number) { shape_argument_.number = numbers_[number]; }
  void shape_word(Span word) { shape_argument_.word = name_at(word); }
  void add_shape_argument(Span span);
  void add_shape_argument(Span span, Span label);
  /// `last` is the end of the range, read right after its beginning.
  void add_shape_range(Span span, Id last);
  [[nodiscard]] Id shape(Span span);
  void prototype(Span name, Id shape);

  // ---- sensors, and facts that are perceived
  void begin_sensor(Span name);
  void begin_sensor(Span name, Span count);
  void sensor_range(Id last);
  void sensor_text(Span word);
  void sensor_noise(Span span, Id number);
  void sensor_stale(Span span, Id number);
  void sensor_circular(Span span);
  void sensor_strict(Span span);
  void sensor();
  void perceive(Id target, Id percept);
  [[nodiscard]] Id combine_percepts(Percept::Kind kind, Span span, Id left, Id right);
  [[nodiscard]] Id extend_percept(Span span, Id whole, Id part);
  [[nodiscard]] Id negate_percept(Span span, Id percept);
  [[nodiscard]] Id parenthesised_percept(Span span, Id percept);
  [[nodiscard]] Id percept(Span span, Id ref);
  [[nodiscard]] Id fits(Span span, Id sensor, Id shape);
  [[nodiscard]] Id fits_named(Span span, Id sensor, Span name);
  [[nodiscard]] Id reads(Span span, Id sensor, Span text);

  // ---- fuzzy controllers
  void begin_fuzzy(Span name);
  void abandon_fuzzy_item();
  void fuzzy_and(Span clause, Span word);
  void fuzzy_or(Span clause, Span word);
  void input_size(Id number) { input_size_ = number; }
  void add_input(Span name, Id range_end, Id circular);
  void add_input_term(Span name, Id shape);
  void add_output(Span name, Id range_end, Id circular);
  void add_output_term(Span name, Id number);
  void output_by(Span word, Span method);
  void output_within(Span word, Id number);
  void output_default(Span word, Id number);
  void output_default(Span word, Span term);
  void begin_given(Id condition);
  void end_given();
  void begin_consequent(Span output);
  void end_consequent(Span span);
  void linear_number(Span span, Span digits, Span unit);
  void linear_ref(Id ref) { part_.ref = fuzzy_refs_[ref]; }
  void add_linear_part(Span span, Id negative);
  void fuzzy_rule(Span span, Id condition, Id weight);
  void fuzzy();
  [[nodiscard]] Id fuzzy_join(Span span, FuzzyCond::Kind kind, Id left, Id right);
  [[nodiscard]] Id fuzzy_not(Span span, Id inner);
  [[nodiscard]] Id fuzzy_is(Span span, Id ref);
  void begin_is_words(Span word) { is_words_.assign(1, name_at(word)); }
  void add_is_word(Span word) { is_words_.push_back(name_at(word)); }
  [[nodiscard]] Id fuzzy_ref(Span span, Span name, Id element);

  // ---- conditions
  [[nodiscard]] Id combine(Cond::Kind kind, Span span, Id left, Id right);
  [[nodiscard]] Id extend(Span span, Id whole, Id part);
  [[nodiscard]] Id held_for(Span span, Span word, Id condition, Id duration);
  [[nodiscard]] Id negate(Span span, Id condition);
  [[nodiscard]] Id parenthesised(Span span, Id condition);
  [[nodiscard]] Id question(Cond::Kind kind, Span span, Id ref);
  [[nodiscard]] Id any(Span span, bool none, Id asked, Id ref);
  [[nodiscard]] Id is_high(Span span, Id sat, Id ref);
  [[nodiscard]] Id is(Span span, Id sat, Id ref, bool negated, Span term);

  // ---- references and numbers
  [[nodiscard]] Id begin_ref(Span base);
  [[nodiscard]] Id add_field(Id ref, Span field);
  [[nodiscard]] Id add_postfix(Postfix::Kind kind, Span span, Id ref, Span open, Id first_index);
  [[nodiscard]] Id add_index(Span span, Id ref);
  [[nodiscard]] Id add_star(Span span);
  [[nodiscard]] Id add_number_index(Span number);
  [[nodiscard]] Id number(Span span, Id negative, Span digits, Span unit);

 private:
  [[nodiscard]] std::string_view text(Span span) const;
  [[nodiscard]] Name name_at(Span span) const { return {span, text(span)}; }
  [[nodiscard]] double value_of(Span digits) const;
  /// The text between the quotes; the closing one may be missing.
  [[nodiscard]] std::string_view unquoted(Span span) const;
  [[nodiscard]] Id add_condition(Cond condition, std::uint16_t depth);
  [[nodiscard]] Id add_fuzzy(FuzzyCond condition, std::uint32_t depth);
  [[nodiscard]] Id too_deep(Span span);
  /// Reports at most once for each statement.
  void report_too_deep(Span span);
  [[nodiscard]] Id add_percept(Percept percept, std::uint16_t depth);
  void once(bool already, Span span);
  /// Sets what a clause says. A second such clause is reported and replaces the first.
  template <class T>
  void set_once(std::optional<T>& what, const std::type_identity_t<T>& value, Span span) {
    once(what.has_value(), span);
    what = value;
  }
  template <class Node>
  void add(Node node) {
    tree_.statements.push_back({Span{}, std::move(node)});
    clear();
  }
  void clear();

  std::string_view bytes_;
  diagnostics::Diagnostics& diagnostics_;
  Tree tree_;
  std::vector<std::uint16_t> cond_depths_;  // by CondId: how deep the tree below it is
  std::vector<std::uint16_t> ref_depths_;   // by RefId
  std::vector<std::uint16_t> percept_depths_;

  bool depth_reported_ = false;
  std::vector<Name> names_;
  std::vector<Number> numbers_;
  std::vector<Point> points_;
  std::vector<Index> indices_;
  std::vector<RefId> refs_;
  std::vector<Stop> stops_;
  std::vector<Setting> settings_;
  std::vector<Row::Field> row_fields_;
  std::vector<Rule::Binder> binders_;
  std::vector<Effect> effects_;
  std::vector<Control::Argument> arguments_;
  NameSet name_set_;
  Declaration declaration_;
  std::size_t items_with_of_ = 0;
  Relation relation_;
  Map map_;
  Road road_;
  Table table_;
  Shape shape_;
  Shape::Argument shape_argument_;
  std::vector<std::optional<PerceptId>> definitions_;
  std::vector<std::optional<Number>> values_;
  Sensor sensor_;
  Fuzzy fuzzy_;
  std::vector<FuzzyRef> fuzzy_refs_;
  std::vector<Name> is_words_;
  std::vector<std::uint32_t> givens_;       // open ones, the innermost last
  std::vector<std::uint16_t> fuzzy_depths_; // by condition
  std::vector<Fuzzy::Consequent> consequents_;
  Fuzzy::Part part_;
  Id input_size_ = kNothing;
};

}  // namespace kb::syntax
