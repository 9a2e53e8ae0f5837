#include "compiler/program/json_numbers.h"

#include <cmath>

#include "compiler/program/text.h"

namespace kb::program {
namespace {

/// JSON has no infinity; it is written as a text.
void number(std::string& out, double value) {
  if (std::isinf(value)) out += value > 0.0 ? "\"inf\"" : "\"-inf\"";
  else append_number(out, value);
}

void text_key(std::string& out, std::string_view name, std::string_view text) {
  if (text.empty()) return;
  append_key(out, name);
  append_json(out, text);
}
void number_key(std::string& out, std::string_view name, double value) {
  append_key(out, name);
  number(out, value);
}

template <class T, class F>
void list(std::string& out, std::string_view name, const std::vector<T>& items, F&& append) {
  if (items.empty()) return;
  out += ",\n\"";
  out += name;
  out += "\":";
  append_items(out, items, [&](const T& item) {
    out += '\n';
    append(item);
  });
}

void range(std::string& out, double low, double high, std::string_view unit, bool circular) {
  append_key(out, "range");
  out += '[';
  number(out, low);
  out += ',';
  number(out, high);
  out += ']';
  text_key(out, "unit", unit);
  if (circular) out += ",\"circular\":true";
}

std::size_t numbers_of(fuzzy::ShapeKind kind) {
  switch (kind) {
    case fuzzy::ShapeKind::kTriangle:
    case fuzzy::ShapeKind::kBell: return 3;
    case fuzzy::ShapeKind::kTrapezoid:
    case fuzzy::ShapeKind::kGaussian: return 4;
    case fuzzy::ShapeKind::kSigmoid:
    case fuzzy::ShapeKind::kRamp: return 2;
    case fuzzy::ShapeKind::kSingleton: return 1;
  }
  return 0;
}

/// ["gaussian", 0.25, 0.25, 0.1, "inf"]
void shape(std::string& out, const fuzzy::Shape& shape) {
  out += "[\"";
  out += word(shape.kind);
  out += '"';
  for (std::size_t i = 0; i < numbers_of(shape.kind); ++i) {
    out += ',';
    number(out, shape.p[i]);
  }
  out += ']';
}

/// Recursion as deep as definitions nest, which is limited.
void percept(std::string& out, const Program& program, PerceptId id) {
  const Perception& perception = program.perception;
  const Percept& what = perception[id];
  const auto parts = [&](std::string_view name) {
    out += "{\"";
    out += name;
    out += "\":";
    append_items(out, what.children, [&](PerceptId child) { percept(out, program, child); });
    out += '}';
  };
  switch (what.op) {
    case Percept::Op::kAnd: return parts("and");
    case Percept::Op::kOr: return parts("or");
    case Percept::Op::kNot:
      out += "{\"not\":";
      percept(out, program, what.children.front());
      break;
    case Percept::Op::kFact:
      out += "{\"fact\":";
      append_json(out, program[what.cell].name);
      break;
    case Percept::Op::kFits:
      out += "{\"fits\":[";
      append_json(out, perception.reading_name(what.reading));
      out += ',';
      shape(out, perception.prototypes[what.prototype].shape);
      out += ']';
      break;
    case Percept::Op::kReads:
      out += "{\"reads\":[";
      append_json(out, perception.reading_name(what.reading));
      out += ',';
      append_json(out, what.text);
      out += ']';
      break;
  }
  out += '}';
}

class ControllerPrinter {
 public:
  ControllerPrinter(const fuzzy::Controller& controller, std::string& out) : c_(controller), out_(out) {}

  void run() {
    out_ += "{\"name\":";
    append_json(out_, c_.name);
    text_key(out_, "and", c_.conjunction == fuzzy::And::kMin ? "min" : "product");
    text_key(out_, "or", c_.disjunction == fuzzy::Or::kMax ? "max" : "sum");
    several("inputs", c_.inputs, [this](const fuzzy::Input& input) { print(input); });
    several("outputs", c_.outputs, [this](const fuzzy::Output& output) { print(output); });
    several("rules", c_.rules, [this](const fuzzy::Rule& rule) { print(rule); });
    out_ += '}';
  }

 private:
  template <class T, class F>
  void several(std::string_view name, const std::vector<T>& items, F&& append) {
    append_key(out_, name);
    append_items(out_, items, append);
  }

  void print(const fuzzy::Input& input) {
    out_ += "{\"name\":";
    append_json(out_, input.name);
    if (input.group) number_key(out_, "elements", input.count);
    range(out_, input.low, input.high, input.unit, input.circular);
    several("terms", input.terms, [this](const fuzzy::Term& term) {
      out_ += '[';
      append_json(out_, term.name);
      out_ += ',';
      shape(out_, term.shape);
      out_ += ']';
    });
    out_ += '}';
  }
  void print(const fuzzy::Output& output) {
    out_ += "{\"name\":";
    append_json(out_, output.name);
    range(out_, output.low, output.high, output.unit, output.circular);
    text_key(out_, "by", fuzzy::kCombineWords[static_cast<std::size_t>(output.combine)]);
    if (output.within < fuzzy::kInfinity) number_key(out_, "within", output.within);
    number_key(out_, "default", output.default_value());
    several("terms", output.terms, [this](const fuzzy::Value& term) {
      out_ += '[';
      append_json(out_, term.name);
      out_ += ',';
      number(out_, term.number);
      out_ += ']';
    });
    out_ += '}';
  }

  /// The conditions of the nests, the outermost first, then the rule's own.
  void print(const fuzzy::Rule& rule) {
    std::vector<std::uint32_t> given;
    for (std::uint32_t n = rule.nest; n != fuzzy::kNone; n = c_.nests[n].parent) given.insert(given.begin(), c_.nests[n].condition);
    out_ += "{\"if\":";
    condition(rule.condition);
    if (!given.empty()) several("given", given, [this](std::uint32_t node) { condition(node); });
    if (rule.weight != 1.0) number_key(out_, "weight", rule.weight);
    several("then", rule.consequents, [this](const fuzzy::Consequent& consequent) {
      out_ += '[';
      append_json(out_, c_.outputs[consequent.output].name);
      out_ += ',';
      number(out_, consequent.constant);
      for (const auto& [slot, coefficient] : consequent.linear) {
        out_ += ",[";
        append_json(out_, fuzzy::slot_name(c_, slot));
        out_ += ',';
        number(out_, coefficient);
        out_ += ']';
      }
      out_ += ']';
    });
    out_ += '}';
  }

  /// Recursion as deep as conditions nest.
  void condition(std::uint32_t id) {
    const fuzzy::Node& node = c_.nodes[id];
    if (node.op == fuzzy::Node::Op::kDegree) {
      const fuzzy::Degree& degree = c_.degrees[node.degree];
      out_ += "{\"is\":[";
      append_json(out_, fuzzy::slot_name(c_, degree.slot));
      out_ += ',';
      append_json(out_, c_.input_of(degree).terms[degree.term].name);
      out_ += "]}";
      return;
    }
    const bool two = node.right != fuzzy::kNone;
    out_ += "{\"";
    out_ += fuzzy::kOpWords[static_cast<std::size_t>(node.op)];
    out_ += two ? "\":[" : "\":";
    condition(node.left);
    if (two) {
      out_ += ',';
      condition(node.right);
      out_ += ']';
    }
    out_ += '}';
  }

  const fuzzy::Controller& c_;
  std::string& out_;
};

}  // namespace

void append_perception_json(std::string& out, const Program& program) {
  list(out, "sensors", program.perception.sensors, [&](const Sensor& sensor) {
    out += "{\"name\":";
    append_json(out, sensor.name);
    if (sensor.array) number_key(out, "elements", sensor.count);
    if (sensor.text) out += ",\"text\":true";
    else range(out, sensor.low, sensor.high, sensor.unit, sensor.circular);
    if (!sensor.text) number_key(out, "noise", sensor.noise);
    if (sensor.stale_s) number_key(out, "stale", *sensor.stale_s);
    if (sensor.strict) out += ",\"strict\":true";
    out += '}';
  });
  list(out, "percepts", program.perception.perceived, [&](const Perceived& perceived) {
    out += "{\"fact\":";
    append_json(out, program[perceived.fact].name);
    append_key(out, "is");
    percept(out, program, perceived.percept);
    if (perceived.lazy) out += ",\"lazy\":true";
    out += '}';
  });
}

void append_fuzzy_json(std::string& out, const Program& program) {
  list(out, "fuzzy", program.fuzzy, [&](const fuzzy::Controller& controller) { ControllerPrinter(controller, out).run(); });
}

}  // namespace kb::program
