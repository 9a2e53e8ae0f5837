// The JSON form that docs/program_json.md describes. Written directly as text, because a large map has millions of values.
#include "compiler/program/conditions.h"
#include "compiler/program/json_numbers.h"
#include "compiler/program/net_effects.h"
#include "compiler/program/program.h"
#include "compiler/program/text.h"

namespace kb::program {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 20;

class Printer {
 public:
  Printer(const Program& program, const Sink& sink) : program_(program), sink_(sink) {}

  void run() {
    out_ = "{\"settings\":";
    print_settings();
    print_list("cells", program_.cells, [this](const Cell& cell) { print_cell(cell); });
    print_list("exclusive", program_.exclusive, [this](const std::vector<CellId>& group) { print_names(group); });
    print_list("levels", program_.levels, [this](const std::string& level) { append_json(out_, level); });
    out_ += ",\n\"priority\":";
    print_names(program_.priority);
    print_list("rules", program_.rules, [this](const Rule& rule) { print_rule(rule); });
    print_list("controls", program_.controls, [this](const Control& control) { print_control(control); });
    if (!program_.limits.empty()) print_list("limits", program_.limits, [this](const LegLimit& limit) { print_limit(limit); });
    append_perception_json(out_, program_);
    append_fuzzy_json(out_, program_);
    out_ += "}\n";
    sink_(out_);
  }

 private:
  /// Writes one item on each line.
  template <class T, class F>
  void print_list(std::string_view key, const std::vector<T>& items, F&& print_item) {
    out_ += ",\n\"";
    out_ += key;
    out_ += "\":";
    append_items(out_, items, [&](const T& item) {
      out_ += '\n';
      print_item(item);
      flush();
    });
  }

  void flush() {
    if (out_.size() < kChunk) return;
    sink_(out_);
    out_.clear();
  }

  void name(CellId cell) { append_json(out_, program_[cell].name); }

  void print_names(std::span<const CellId> cells) {
    append_items(out_, cells, [this](CellId cell) { name(cell); });
  }

  void print_settings() {
    const Settings& settings = program_.settings;
    out_ += "{\"event\":";
    append_number(out_, settings.event);
    out_ += ",\"attention\":";
    append_number(out_, settings.attention);
    out_ += ",\"firing\":";
    append_number(out_, settings.firing);
    out_ += ",\"idle\":";
    switch (settings.idle) {
      case Idle::kStop: out_ += "\"stop\""; break;
      case Idle::kHold: out_ += "\"hold\""; break;
      case Idle::kStrategy: name(settings.idle_strategy); break;
    }
    out_ += ",\"hold_limit\":";
    append_seconds(out_, settings.hold_limit_us);
    out_ += '}';
  }

  void print_cell(const Cell& cell) {
    out_ += "{\"name\":";
    append_json(out_, cell.name);
    out_.append(",\"kind\":\"").append(word(cell.kind)).append("\",\"initial\":");
    append_number(out_, cell.initial);
    if (cell.kind == CellKind::kFact) {
      out_ += ",\"event\":";
      append_number(out_, cell.event);
      out_ += ",\"attention\":";
      append_number(out_, cell.attention);
    }
    if (cell.command) out_ += ",\"command\":true";
    if (cell.keep) out_ += ",\"keep\":true";
    if (cell.output) out_ += ",\"output\":true";
    if (cell.kind != CellKind::kSatellite) {
      out_ += ",\"satellites\":";
      print_names(cell.satellites);
    }
    out_ += '}';
  }

  void print_parts(std::string_view key, const Cond& cond) {
    out_ += "{\"";
    out_ += key;
    out_ += "\":";
    append_items(out_, cond.children, [this](CondId part) { print_condition(part); });
    out_ += '}';
  }

  void print_sighting(std::string_view key, CellId fact) {
    out_ += "{\"";
    out_ += key;
    out_ += "\":";
    name(fact);
    out_ += '}';
  }

  /// Recursion as deep as conditions nest, which is limited.
  void print_condition(CondId id) {
    const Cond& cond = program_[id];
    switch (cond.op) {
      case Cond::Op::kAnd: return print_parts("and", cond);
      case Cond::Op::kOr: return print_parts("or", cond);
      case Cond::Op::kEvent: return print_sighting("event", cond.cell);
      case Cond::Op::kLost: return print_sighting("lost", cond.cell);
      case Cond::Op::kSeen: return print_sighting("seen", cond.cell);
      case Cond::Op::kNot:
        out_ += "{\"not\":";
        print_condition(cond.children.front());
        break;
      case Cond::Op::kFor:
        out_ += "{\"for\":[";
        print_condition(cond.children.front());
        out_ += ',';
        append_seconds(out_, cond.duration_us);
        out_ += ']';
        break;
      case Cond::Op::kIs:
        out_ += "{\"is\":[";
        name(cond.cell);
        out_ += ",\"";
        out_ += word(cond.term);
        out_ += "\"]";
        break;
    }
    out_ += '}';
  }

  void print_rule(const Rule& rule) {
    out_ += "{\"name\":";
    append_json(out_, rule.name);
    out_ += ",\"level\":";
    append_json(out_, program_.levels[rule.level]);
    out_ += rule.mode == Mode::kWhen ? ",\"mode\":\"when\",\"if\":" : ",\"mode\":\"while\",\"if\":";
    print_condition(rule.condition);
    out_ += ",\"then\":[";
    Commas commas;
    for_each_net_write(program_, rule, [&](CellId cell, float value) {
      commas.next(out_);
      out_ += '[';
      name(cell);
      out_ += ',';
      append_number(out_, value);
      out_ += ']';
    });
    out_ += ']';
    if (rule.reset) out_ += ",\"reset\":true";
    out_ += ",\"at\":";
    append_json(out_, program_.at(rule));
    out_ += '}';
  }

  void print_limit(const LegLimit& limit) {
    out_ += '[';
    name(limit.leg);
    out_ += ',';
    append_number(out_, limit.limit_m_per_s);
    out_ += ']';
  }

  void print_control(const Control& control) {
    out_ += "{\"strategy\":";
    name(control.strategy);
    out_ += ",\"controller\":";
    append_json(out_, control.controller);
    append_key(out_, "arguments");
    append_items(out_, control.arguments, [this](const Control::Argument& argument) {
      out_ += '[';
      append_json(out_, argument.name);
      out_ += ',';
      if (argument.is_number) {
        append_number(out_, argument.number);
        out_ += ',';
        append_json(out_, argument.unit);
      } else {
        append_json(out_, argument.word);
      }
      out_ += ']';
    });
    out_ += '}';
  }

  const Program& program_;
  const Sink& sink_;
  std::string out_;
};

}  // namespace

void print_json(const Program& program, const Sink& sink) { Printer(program, sink).run(); }

std::string print_json(const Program& program) {
  std::string all;
  print_json(program, [&](std::string_view chunk) { all += chunk; });
  return all;
}

}  // namespace kb::program
