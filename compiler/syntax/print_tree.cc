#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "compiler/syntax/syntax.h"
#include "compiler/syntax/tree_text.h"

namespace kb::syntax {
namespace {

std::string joined(const std::vector<Name>& names, std::string_view separator = ", ") {
  std::string out;
  for (const Name& name : names) {
    if (!out.empty()) out += separator;
    out += name.text;
  }
  return out;
}

std::string stop_text(const Stop& stop) {
  return stop.exit ? fmt::format("{}.{}", stop.landmark.text, stop.exit->text) : std::string(stop.landmark.text);
}

class Printer {
 public:
  Printer(const source::Sources& sources, const Tree& tree) : sources_(sources), tree_(tree) {}

  std::string run() {
    for (const Statement& statement : tree_.statements) {
      std::visit([this](const auto& node) { print(node); }, statement.node);
    }
    return std::move(out_);
  }

 private:
  template <class... Arguments>
  void line(int indent, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    out_.append(static_cast<std::size_t>(indent) * 2, ' ');
    fmt::format_to(std::back_inserter(out_), format, std::forward<Arguments>(arguments)...);
    out_ += '\n';
  }

  void print(const Import& node) { line(0, "import {}{}{}", node.quoted ? "\"" : "", node.path, node.quoted ? "\"" : ""); }
  void print(const Levels& node) { line(0, "levels {}", joined(node.names, " > ")); }
  void print(const Set& node);
  void print(const NameSet& node) { line(0, "names {}{} {{ {} }}", node.name.text, node.more ? " more" : "", joined(node.members)); }
  void print(const Declaration& node);
  void print(const Priority& node);
  void print(const Relation& node);
  void print(const Row& node);
  void print(const Map& node);
  void print(const Route& node);
  void print(const Detour& node);
  void print(const Detours& node);
  void print(const Table& node);
  void print(const Rule& node);
  void print(const Control& node);
  void print(const Prototype& node) { line(0, "prototype {} = {}", node.name.text, shape_text(tree_[node.shape])); }
  void print(const Sensor& node);
  void print(const Perceive& node);
  void print(const Fuzzy& node);
  void print(const Road& road, const Map& map);
  void print(const Effect& effect);
  void print_stops(const std::vector<Stop>& stops);
  [[nodiscard]] std::string members(const Declaration::Item& item) const;
  void print_when(const std::optional<CondId>& when);
  void print(int indent, const Cond& condition);

  const source::Sources& sources_;
  const Tree& tree_;
  std::string out_;
};

void Printer::print(const Set& node) {
  line(0, "set");
  for (const Setting& setting : node.settings) {
    line(1, "{} = {}", setting.key.text, setting.number ? number_text(*setting.number) : std::string(setting.word.text));
  }
}

void Printer::print(const Declaration& node) {
  constexpr std::string_view kWords[][2] = {
      {"fact", "facts"}, {"command", "command"}, {"satellite", "satellites"}, {"strategy", "strategies"}};
  line(0, "{}", kWords[static_cast<std::size_t>(node.kind)][node.plural ? 1 : 0]);
  for (const Declaration::Item& item : node.items) {
    std::string text(item.name.text);
    if (item.shape == Declaration::Item::Shape::kMembers) text += fmt::format(" {{ {} }}", members(item));
    if (item.shape == Declaration::Item::Shape::kOver) text += fmt::format("[{}]", joined(item.names));
    if (item.of) text += fmt::format(" of {}", ref_text(tree_, *item.of));
    line(1, "{}", text);
  }
  if (node.exclusive) line(1, "exclusive");
  if (node.keep) line(1, "keep");
  if (node.output) line(1, "output");
  if (node.initial) line(1, "= {}", number_text(*node.initial));
  if (node.sat_initial) line(1, "sat = {}", number_text(*node.sat_initial));
  if (node.event) line(1, "event {}", number_text(*node.event));
  if (node.attention) line(1, "attention {}", number_text(*node.attention));
  if (node.definition) line(1, "= {}", percept_text(tree_, *node.definition));
  if (node.lazy) line(1, "lazy");
}

std::string Printer::members(const Declaration::Item& item) const {
  std::string out;
  for (std::size_t i = 0; i < item.names.size(); ++i) {
    out += fmt::format("{}{}", i == 0 ? "" : ", ", item.names[i].text);
    if (item.definitions[i]) out += " = " + percept_text(tree_, *item.definitions[i]);
    if (item.values[i]) out += " = " + number_text(*item.values[i]);
  }
  return out;
}

void Printer::print(const Sensor& node) {
  std::string text(node.name.text);
  if (node.count) text += fmt::format("[{}]", node.count->value);
  text += node.range ? fmt::format(" {}..{}", number_text(node.range->first), number_text(node.range->second)) : " text";
  line(0, "sensor {}", text);
  if (node.noise) line(1, "noise {}", number_text(*node.noise));
  if (node.stale) line(1, "stale {}", number_text(*node.stale));
  if (node.circular) line(1, "circular");
  if (node.strict) line(1, "strict");
}

void Printer::print(const Perceive& node) {
  line(0, "perceive {}", ref_text(tree_, node.target));
  for (const Rule::Binder& binder : node.binders) line(1, "{} in {}", binder.variable.text, binder.set.text);
  line(1, "= {}", percept_text(tree_, node.percept));
}

void Printer::print(const Priority& node) {
  line(0, "priority");
  for (const RefId id : node.order) line(1, "{}", ref_text(tree_, id));
}

void Printer::print(const Relation& node) {
  line(0, "relation {}({})", node.name.text, joined(node.fields));
  if (!node.satellites) return;
  line(1, "satellites{}{}{}", node.of.empty() ? "" : " of ", joined(node.of), node.exclusive ? " exclusive" : "");
}

void Printer::print(const Row& node) {
  line(0, "row {}{}in {}", node.name ? node.name->text : "", node.name ? " " : "", node.relation.text);
  for (const Row::Field& field : node.fields) {
    line(1, "{}:", field.name.text);
    print(2, tree_[field.value]);
  }
}

void Printer::print(const Map& node) {
  line(0, "map {}", node.name.text);
  for (const Landmark& landmark : node.landmarks) {
    if (landmark.at) {
      line(1, "landmark {} at ({}, {})", landmark.name.text, landmark.at->x, landmark.at->y);
    } else {
      line(1, "landmark {}", landmark.name.text);
    }
  }
  for (const Road& road : node.roads) print(road, node);
}

void Printer::print(const Road& road, const Map& map) {
  std::string text = fmt::format("road {}.{} {} {}.{}", sources_.text(road.from), sources_.text(road.exit), road.both_ways ? "--" : "->",
                                 sources_.text(road.to), sources_.text(road.approach));
  if (road.by.known()) text += fmt::format(" by {}", sources_.text(road.by));
  if (road.limit != 0) text += fmt::format(" at most {}", number_text(map.limits[road.limit - 1]));
  for (std::size_t i = 0; i < road.through.size(); ++i) {
    text += fmt::format("{}({}, {})", i == 0 ? " through " : ", ", road.through[i].x, road.through[i].y);
  }
  line(1, "{}", text);
}

void Printer::print_stops(const std::vector<Stop>& stops) {
  for (const Stop& stop : stops) line(1, "{}", stop_text(stop));
}

void Printer::print_when(const std::optional<CondId>& when) {
  if (!when) return;
  line(1, "when");
  print(2, tree_[*when]);
}

void Printer::print(const Route& node) {
  line(0, "route {} on {} by {}", node.name.text, node.map.text, node.command.text);
  print_stops(node.stops);
}

void Printer::print(const Detour& node) {
  line(0, "detour{}{}", node.on ? " on " : "", node.on ? node.on->text : "");
  print_stops(node.stops);
  print_when(node.when);
}

void Printer::print(const Detours& node) {
  line(0, "detours on {}", node.route.text);
  print_when(node.when);
}

void Printer::print(const Table& node) {
  if (node.more) {
    line(0, "table {} more", node.name.text);
  } else {
    line(0, "table {}({}) -> {}", node.name.text, joined(node.parameters), node.result.text);
  }
  if (!node.columns.empty()) line(1, "columns {}", joined(node.columns, " "));
  for (const Table::Line& row : node.lines) line(1, "{}: {}", row.label.text, joined(row.values, " "));
}

void Printer::print(const Rule& node) {
  line(0, "rule {}", node.name.text);
  for (const Rule::Binder& binder : node.binders) line(1, "{} in {}", binder.variable.text, binder.set.text);
  line(1, "at {}", node.level.text);
  line(1, "{}", node.mode == Rule::Mode::kWhen ? "when" : "while");
  print(2, tree_[node.condition]);
  line(1, "then");
  for (const Effect& effect : node.effects) print(effect);
}

void Printer::print(const Effect& effect) {
  const std::string_view sat = effect.sat ? "sat " : "";
  switch (effect.kind) {
    case Effect::Kind::kRaise: line(2, "+{}{}", sat, ref_text(tree_, effect.ref)); break;
    case Effect::Kind::kLower: line(2, "-{}{}", sat, ref_text(tree_, effect.ref)); break;
    case Effect::Kind::kAssign: line(2, "{}{} = {}", sat, ref_text(tree_, effect.ref), number_text(effect.value)); break;
    case Effect::Kind::kReset: line(2, "reset"); break;
  }
}

void Printer::print(const Fuzzy& node) {
  line(0, "fuzzy {}", node.name.text);
  if (node.conjunction) line(1, "and = {}", node.conjunction->text);
  if (node.disjunction) line(1, "or = {}", node.disjunction->text);
  for (const Fuzzy::Input& input : node.inputs) {
    line(1, "input {}{} {}..{}{}", input.name.text, input.count ? fmt::format("[{}]", number_text(*input.count)) : "",
         number_text(input.low), number_text(input.high), input.circular ? " circular" : "");
    for (const auto& term : input.terms) line(2, "{} = {}", term.name.text, shape_text(tree_[term.shape]));
  }
  for (const Fuzzy::Output& output : node.outputs) {
    line(1, "output {} {}..{}{}", output.name.text, number_text(output.low), number_text(output.high), output.circular ? " circular" : "");
    for (const auto& term : output.terms) line(2, "{} = {}", term.name.text, number_text(term.value));
    if (output.by) line(2, "by {}", output.by->text);
    if (output.within) line(2, "within {}", number_text(*output.within));
    if (output.default_number) line(2, "default {}", number_text(*output.default_number));
    if (output.default_term) line(2, "default {}", output.default_term->text);
  }
  std::size_t given = 0;
  for (std::size_t r = 0; r <= node.rules.size(); ++r) {
    for (; given < node.givens.size() && node.givens[given].first_rule == r; ++given) {
      line(1, "given {}: rules {} to {}", fuzzy_text(node, node.givens[given].condition), r, node.givens[given].end_rule);
    }
    if (r < node.rules.size()) line(1, "rule {}", fuzzy_text(node, node.rules[r]));
  }
}

void Printer::print(const Control& node) {
  line(0, "control {} = {}", ref_text(tree_, node.strategy), node.controller.text);
  for (const Control::Argument& argument : node.arguments) {
    line(1, "{}: {}", argument.name.text,
         argument.number ? number_text(*argument.number) : std::string(argument.word.text));
  }
}

// Recursion is bounded by kMaxNesting.
void Printer::print(int indent, const Cond& condition) {
  const std::string_view sat = condition.sat ? "sat " : "";
  switch (condition.kind) {
    case Cond::Kind::kOr: line(indent, "or"); break;
    case Cond::Kind::kAnd: line(indent, "and"); break;
    case Cond::Kind::kFor: line(indent, "for {}", number_text(condition.duration)); break;
    case Cond::Kind::kNot: line(indent, "not"); break;
    case Cond::Kind::kEvent: line(indent, "event {}", ref_text(tree_, condition.ref)); break;
    case Cond::Kind::kLost: line(indent, "lost {}", ref_text(tree_, condition.ref)); break;
    case Cond::Kind::kSeen: line(indent, "seen {}", ref_text(tree_, condition.ref)); break;
    case Cond::Kind::kIs:
      line(indent, "{}{}{}{}{}", sat, ref_text(tree_, condition.ref), condition.term.text.empty() ? "" : " is ",
           condition.negated ? "not " : "", condition.term.text);
      break;
    case Cond::Kind::kAny:
      line(indent, "{} {}{}", condition.none ? "no" : "any", condition.asked == Cond::Kind::kEvent  ? "event "
                                                             : condition.asked == Cond::Kind::kLost ? "lost "
                                                             : condition.asked == Cond::Kind::kSeen ? "seen "
                                                                                                    : sat, ref_text(tree_, condition.ref));
      break;
    case Cond::Kind::kError: line(indent, "error"); break;
  }
  for (const CondId child : condition.children) print(indent + 1, tree_[child]);
}

}  // namespace

std::string print_tree(const source::Sources& sources, const Tree& tree) { return Printer(sources, tree).run(); }

}  // namespace kb::syntax
