#include "compiler/syntax/tree_builder.h"

#include <charconv>
#include <utility>

namespace kb::syntax {
namespace {

using diagnostics::Kind;

std::optional<CondId> optional_condition(TreeBuilder::Id id) {
  if (id == TreeBuilder::kNothing) return std::nullopt;
  return CondId{id};
}

}  // namespace

TreeBuilder::TreeBuilder(const source::Sources& sources, source::FileId file, diagnostics::Diagnostics& diagnostics)
    : bytes_(sources.bytes(file)), diagnostics_(diagnostics) {
  tree_.file = file;
}

std::string_view TreeBuilder::text(Span span) const { return bytes_.substr(span.begin, span.end - span.begin); }

double TreeBuilder::value_of(Span digits) const {
  const std::string_view written = text(digits);
  double value = 0.0;
  std::from_chars(written.data(), written.data() + written.size(), value);
  return value;
}

std::string_view TreeBuilder::unquoted(Span span) const {
  std::string_view inner = text(span).substr(1);
  if (inner.ends_with('"')) inner.remove_suffix(1);
  return inner;
}

// Lists that went into a statement are empty anyway; this removes what an abandoned statement has left.
void TreeBuilder::clear() {
  depth_reported_ = false;
  names_.clear();
  numbers_.clear();
  points_.clear();
  indices_.clear();
  refs_.clear();
  stops_.clear();
  settings_.clear();
  row_fields_.clear();
  binders_.clear();
  effects_.clear();
  arguments_.clear();
  definitions_.clear();
  fuzzy_refs_.clear();
  givens_.clear();
  fuzzy_depths_.clear();
  consequents_.clear();
  part_ = Fuzzy::Part{};
}

// The block goes on, so finished conditions and open nests are kept.
void TreeBuilder::abandon_fuzzy_item() {
  numbers_.clear();
  fuzzy_refs_.clear();
  consequents_.clear();
  part_ = Fuzzy::Part{};
}

void TreeBuilder::end_statement(Span span) { tree_.statements.back().span = span; }

void TreeBuilder::once(bool already, Span span) {
  if (!already) return;
  const std::string_view word = text(span).substr(0, text(span).find_first_of(" \t\r\n=#"));
  diagnostics_.report(Kind::kClauseTwice, span, {word.empty() ? text(span).substr(0, 1) : word});
}

// ---- files, levels, settings, sets

void TreeBuilder::import(Span path, bool quoted) {
  add(Import{quoted ? unquoted(path) : text(path), path, quoted});
}

void TreeBuilder::levels() { add(Levels{std::move(names_)}); }

void TreeBuilder::add_setting(Span key, Id number) { settings_.push_back({name_at(key), numbers_[number], {}, {}}); }

void TreeBuilder::add_setting(Span key, Span word, Id ref) { settings_.push_back({name_at(key), {}, name_at(word), RefId{ref}}); }

void TreeBuilder::set() { add(Set{std::move(settings_)}); }

void TreeBuilder::begin_names(Span name, bool more) {
  name_set_ = NameSet{};
  name_set_.name = name_at(name);
  name_set_.more = more;
}

void TreeBuilder::names() {
  name_set_.members = std::move(names_);
  add(std::move(name_set_));
}

// ---- cells

void TreeBuilder::begin_declaration(Declaration::Kind kind, bool plural) {
  declaration_ = Declaration{};
  declaration_.kind = kind;
  declaration_.plural = plural;
  items_with_of_ = 0;
}

void TreeBuilder::add_item(Span name) { declaration_.items.push_back({name_at(name), {}, {}, {}, {}, {}}); }

void TreeBuilder::item_names(Declaration::Item::Shape shape) {
  declaration_.items.back().shape = shape;
  declaration_.items.back().names = std::move(names_);
  declaration_.items.back().definitions = std::move(definitions_);
  declaration_.items.back().values = std::move(values_);
  names_.clear();
  definitions_.clear();
  values_.clear();
}

void TreeBuilder::items_of(Id ref) {
  for (; items_with_of_ < declaration_.items.size(); ++items_with_of_) {
    declaration_.items[items_with_of_].of = RefId{ref};
  }
}

void TreeBuilder::exclusive(Span span) { set_once(declaration_.exclusive, span, span); }

void TreeBuilder::keep(Span span) { set_once(declaration_.keep, span, span); }

void TreeBuilder::output(Span span) { set_once(declaration_.output, span, span); }

void TreeBuilder::initial(Span span, Id number) { set_once(declaration_.initial, numbers_[number], span); }

void TreeBuilder::sat_initial(Span span, Id number) { set_once(declaration_.sat_initial, numbers_[number], span); }

void TreeBuilder::event_threshold(Span span, Id number) { set_once(declaration_.event, numbers_[number], span); }

void TreeBuilder::attention_threshold(Span span, Id number) { set_once(declaration_.attention, numbers_[number], span); }

void TreeBuilder::declaration() { add(std::move(declaration_)); }

void TreeBuilder::priority() { add(Priority{std::move(refs_)}); }

// ---- relations

void TreeBuilder::begin_relation(Span name) {
  relation_ = Relation{};
  relation_.name = name_at(name);
  relation_.fields = std::move(names_);
  names_.clear();
}

void TreeBuilder::relation_satellites() {
  relation_.satellites = true;
  relation_.of = std::move(names_);
  names_.clear();
}

void TreeBuilder::relation() { add(std::move(relation_)); }

void TreeBuilder::row(Span relation) { add(Row{{}, name_at(relation), std::move(row_fields_)}); }

void TreeBuilder::row(Span name, Span relation) {
  add(Row{name_at(name), name_at(relation), std::move(row_fields_)});
}

// ---- maps and routes

void TreeBuilder::begin_map(Span name, std::size_t landmarks, std::size_t roads) {
  map_ = Map{};
  map_.name = name_at(name);
  map_.landmarks.reserve(landmarks);
  map_.roads.reserve(roads);
}

void TreeBuilder::add_landmark(Span span, Span name, Id at) {
  map_.landmarks.push_back({span, name_at(name), {}});
  if (at != kNothing) map_.landmarks.back().at = points_[at];
  numbers_.clear();
  points_.clear();
}

void TreeBuilder::begin_road(Span from, Span exit, Id both_ways, Span to, Span approach) {
  road_ = Road{};
  road_.from = from;
  road_.exit = exit;
  road_.to = to;
  road_.approach = approach;
  road_.both_ways = both_ways != 0;
}

void TreeBuilder::road_by(Span by, Span method) {
  if (road_.by.known()) diagnostics_.report(Kind::kClauseTwice, source::join(by, method), {"by"});
  road_.by = method;
}

void TreeBuilder::road_limit(Span at, Span end, Id number) {
  if (road_.limit != 0) diagnostics_.report(Kind::kClauseTwice, source::join(at, end), {"at most"});
  map_.limits.push_back(numbers_[number]);
  road_.limit = static_cast<std::uint32_t>(map_.limits.size());
}

void TreeBuilder::end_road(Span span) {
  road_.span = span;
  map_.roads.push_back(std::move(road_));
  numbers_.clear();
  points_.clear();
}

void TreeBuilder::map() { add(std::move(map_)); }

TreeBuilder::Id TreeBuilder::point(Id x, Id y) {
  for (const Id id : {x, y}) {
    const Name& unit = numbers_[id].unit;
    if (!unit.text.empty() && unit.text != "m") diagnostics_.report(Kind::kCoordinateUnit, unit.span, {unit.text});
  }
  points_.push_back({numbers_[x].value, numbers_[y].value});
  return static_cast<Id>(points_.size() - 1);
}

void TreeBuilder::route(Span name, Span map, Span command) {
  add(Route{name_at(name), name_at(map), name_at(command), std::move(stops_)});
}

void TreeBuilder::detour(Id when) { add(Detour{std::move(stops_), {}, optional_condition(when)}); }

void TreeBuilder::detour(Id when, Span on) {
  add(Detour{std::move(stops_), name_at(on), optional_condition(when)});
}

void TreeBuilder::detours(Span route, Id when) { add(Detours{name_at(route), optional_condition(when)}); }

// ---- tables, rules, control

void TreeBuilder::begin_table(Span name, Span result) {
  table_ = Table{};
  table_.name = name_at(name);
  table_.parameters = std::move(names_);
  table_.result = name_at(result);
  names_.clear();
}

void TreeBuilder::begin_table_extension(Span name) {
  table_ = Table{};
  table_.name = name_at(name);
  table_.more = true;
}

void TreeBuilder::table() { add(std::move(table_)); }

void TreeBuilder::add_effect(Span span, Effect::Kind kind, Id sat, Id ref) {
  effects_.push_back({kind, span, sat != 0, RefId{ref}, {}});
}

void TreeBuilder::add_assignment(Span span, Id sat, Id ref, Id number) {
  effects_.push_back({Effect::Kind::kAssign, span, sat != 0, RefId{ref}, numbers_[number]});
}

void TreeBuilder::add_reset(Span span) { effects_.push_back({Effect::Kind::kReset, span, false, RefId{}, {}}); }

void TreeBuilder::rule(Span name, Span level, Id mode, Id condition) {
  add(Rule{name_at(name), std::move(binders_), name_at(level), static_cast<Rule::Mode>(mode), CondId{condition},
           std::move(effects_)});
}

void TreeBuilder::add_argument(Span name, Id number) { arguments_.push_back({name_at(name), numbers_[number], {}}); }

void TreeBuilder::add_argument(Span name, Span word) { arguments_.push_back({name_at(name), {}, name_at(word)}); }

void TreeBuilder::control(Id strategy, Span controller) {
  add(Control{RefId{strategy}, name_at(controller), std::move(arguments_)});
}

}  // namespace kb::syntax
