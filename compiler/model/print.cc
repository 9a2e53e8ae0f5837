// The model as text, one item a line: for `kbc dump model`.
#include <fmt/format.h>

#include <iterator>

#include "compiler/model/model.h"
#include "compiler/syntax/tree_text.h"

namespace kb::model {
namespace {

class Printer {
 public:
  Printer(const Model& model, const source::Sources& sources) : model_(model), sources_(sources) {}

  std::string run() {
    print_settings();
    for (const FiniteSet& set : model_.sets) line("set {} {{ {} }}", set.name, fmt::join(set.members, ", "));
    for (const Cell& cell : model_.cells) print_cell(cell);
    for (const Group& group : model_.groups) print_group(group);
    for (const auto& group : model_.exclusive) line("exclusive {}", cells(group));
    for (const Relation& relation : model_.relations) print_relation(relation);
    for (const Map& map : model_.maps) print_map(map);
    for (const Rule& rule : model_.rules) print_rule(rule);
    line("priority {}", cells(model_.priority, " > "));
    for (const Prototype& p : model_.prototypes) {
      line("prototype {} = {}{}", p.name, syntax::shape_text((*p.tree)[p.shape]), at(p.declared));
    }
    for (const Sensor& sensor : model_.sensors) print_sensor(sensor);
    for (const Perceived& perceived : model_.perceived) print_perceived(perceived);
    for (const fuzzy::Controller& controller : model_.fuzzy) out_ += fuzzy::print(controller, &sources_);
    for (const Control& control : model_.controls) print_control(control);
    return std::move(out_);
  }

 private:
  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Arguments>(arguments)...);
    out_ += '\n';
  }

  [[nodiscard]] std::string name(CellId cell) const { return std::string(model_[cell].name); }
  [[nodiscard]] std::string cells(std::span<const CellId> ids, std::string_view between = ", ") const {
    std::string text;
    for (const CellId id : ids) text += (text.empty() ? "" : std::string(between)) + name(id);
    return text;
  }
  [[nodiscard]] std::string at(source::Span span) const { return "  # " + sources_.describe(span); }

  void print_settings() {
    const Settings& s = model_.settings;
    const std::string idle = s.idle == Idle::kStop ? "stop" : s.idle == Idle::kHold ? "hold" : name(s.idle_strategy);
    line("set event = {}, attention = {}, firing = {}, idle = {}, hold_limit = {} us", s.event, s.attention, s.firing, idle, s.hold_limit_us);
    line("levels {}", fmt::join(model_.levels, " > "));
  }

  void print_cell(const Cell& cell) {
    std::string text = fmt::format("{} {} = {}", cell.command ? "command" : word(cell.kind), cell.name, cell.initial);
    if (cell.kind == CellKind::kFact) text += fmt::format(" event {} attention {}", cell.event, cell.attention);
    if (cell.keep) text += " keep";
    if (cell.output) text += " output";
    if (cell.of != CellId::kNone) text += " of " + name(cell.of);
    if (!cell.satellites.empty()) text += " satellites " + cells(cell.satellites);
    line("{}{}", text, at(cell.declared));
  }

  void print_group(const Group& group) {
    std::string sets;
    for (const SetId set : group.dimensions) sets += (sets.empty() ? "" : ", ") + model_.sets[index(set)].name;
    line("group {}[{}] {}{}", group.name, sets, cells(group.cells), at(group.declared));
  }

  [[nodiscard]] std::string text(const Value& value) const {
    struct Reader {
      const Printer& printer;
      std::string operator()(std::monostate) const { return "-"; }
      std::string operator()(RowId row) const { return std::string(printer.model_[row].name); }
      std::string operator()(CellId cell) const { return printer.name(cell); }
      std::string operator()(Member member) const { return printer.model_.sets[index(member.set)].members[member.index]; }
      std::string operator()(PointId id) const {
        const Point point = printer.model_[id];
        return fmt::format("({}, {})", point.x, point.y);
      }
      std::string operator()(KeptId id) const {
        const KeptCondition& kept = printer.model_[id];
        return kept.is_resolved ? "(" + printer.text(kept.resolved) + ")" : "(?)";
      }
    };
    return std::visit(Reader{*this}, value);
  }

  void print_relation(const Relation& relation) {
    line("relation {}({}){}{}", relation.name, fmt::join(relation.fields, ", "), relation.satellites ? " satellites" : "",
         relation.exclusive ? " exclusive" : "");
    for (const RowId id : relation.rows) {
      const Row& row = model_[id];
      std::string fields;
      const std::span<const Value> values = model_.fields(row);
      for (std::size_t i = 0; i < values.size(); ++i) {
        fields += fmt::format("{}{}: {}", i == 0 ? "" : ", ", relation.fields[i], text(values[i]));
      }
      line("row {} in {}({}){}", row.name, relation.name, fields, at(row.declared));
    }
  }

  void print_map(const Map& map) {
    line("map {}: {} landmarks, {} roads by direction{}", map.name, map.landmarks.size(), map.roads.size(), at(map.declared));
    for (const MapRoad& road : map.roads) {
      std::string through;
      for (const Point& point : map.through(road)) through += fmt::format(" ({}, {})", point.x, point.y);
      const std::string limit = road.limit_m_per_s > 0.0f ? fmt::format(" at most {} m/s", road.limit_m_per_s) : "";
      line("road {} {}{}{}{}", road.road, model_[road.row].name, limit, through.empty() ? "" : " through", through);
    }
  }

  /// Recursion as deep as conditions nest.
  [[nodiscard]] std::string text(CondId id) const {
    const Cond& cond = model_[id];
    switch (cond.op) {
      case Cond::Op::kEvent: return "event " + name(cond.cell);
      case Cond::Op::kLost: return "lost " + name(cond.cell);
      case Cond::Op::kSeen: return "seen " + name(cond.cell);
      case Cond::Op::kIs: return cond.term == syntax::Term::kHigh ? name(cond.cell) : fmt::format("{} is {}", name(cond.cell), word(cond.term));
      case Cond::Op::kNot: return fmt::format("not {}", text(cond.children.front()));
      case Cond::Op::kFor: return fmt::format("({} for {} us)", text(cond.children.front()), cond.duration_us);
      case Cond::Op::kAnd:
      case Cond::Op::kOr: break;
    }
    if (cond.children.empty()) return cond.op == Cond::Op::kAnd ? "true" : "false";
    std::string parts;
    for (const CondId child : cond.children) {
      if (!parts.empty()) parts += cond.op == Cond::Op::kAnd ? " and " : " or ";
      parts += text(child);
    }
    return "(" + parts + ")";
  }

  void print_rule(const Rule& rule) {
    std::string effects;
    for (const Write& write : rule.effects) {
      effects += effects.empty() ? "" : ", ";
      effects += write.reset ? std::string("reset") : fmt::format("{} = {}", name(write.cell), write.value);
    }
    const Template& tmpl = model_[rule.tmpl];
    line("rule {} at {} {} {} then {}{}", rule.name, model_.levels[tmpl.level],
         tmpl.mode == syntax::Rule::Mode::kWhen ? "when" : "while", text(rule.condition), effects, at(tmpl.span));
  }

  void print_sensor(const Sensor& s) {
    std::string text = s.text ? std::string("text") : fmt::format("{}..{}", s.low, s.high);
    if (!s.unit.empty()) text += " " + s.unit;
    if (s.noise > 0.0) text += fmt::format(" noise {}", s.noise);
    if (s.stale_s) text += fmt::format(" stale {} s", *s.stale_s);
    if (s.circular) text += " circular";
    if (s.strict) text += " strict";
    line("sensor {}{} {}{}", s.name, s.array ? fmt::format("[{}]", s.count) : "", text, at(s.declared));
  }

  [[nodiscard]] std::string reading(std::uint32_t number) const {
    for (const Sensor& s : model_.sensors) {
      if (number < s.first + s.count) return s.array ? fmt::format("{}[{}]", s.name, number - s.first) : s.name;
    }
    return "?";
  }

  [[nodiscard]] std::string text(PerceptId id) const {
    const Percept& percept = model_[id];
    std::string parts;
    switch (percept.op) {
      case Percept::Op::kFits: return fmt::format("{} ~ {}", reading(percept.reading), fuzzy::text(model_.placed_shapes[percept.shape].shape));
      case Percept::Op::kReads: return fmt::format("{} ~ \"{}\"", reading(percept.reading), percept.text);
      case Percept::Op::kFact: return name(percept.cell);
      case Percept::Op::kNot: return "not " + text(percept.children.front());
      case Percept::Op::kAnd:
      case Percept::Op::kOr: break;
    }
    for (const PerceptId child : percept.children) {
      if (!parts.empty()) parts += percept.op == Percept::Op::kAnd ? " and " : " or ";
      parts += text(child);
    }
    return "(" + parts + ")";
  }

  void print_perceived(const Perceived& perceived) {
    line("perceive {} = {}{}{}", name(perceived.fact), text(perceived.percept), perceived.lazy ? " lazy" : "", at(perceived.span));
  }

  void print_control(const Control& control) {
    std::string arguments;
    for (const Control::Argument& argument : control.arguments) {
      arguments += (arguments.empty() ? "" : ", ") + model::text(argument);
    }
    line("control {} = {}({}){}", name(control.strategy), control.controller, arguments, at(control.span));
  }

  const Model& model_;
  const source::Sources& sources_;
  std::string out_;
};

}  // namespace

std::string text(const Control::Argument& a) {
  return a.is_number ? fmt::format("{}: {}{}{}", a.name, a.number, a.unit.empty() ? "" : " ", a.unit) : fmt::format("{}: {}", a.name, a.word);
}

std::string print(const Model& model, const source::Sources& sources) { return Printer(model, sources).run(); }

}  // namespace kb::model
