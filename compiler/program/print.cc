// The program in the language's own words: `kbc expand` and `kbc dump program`.
#include <fmt/format.h>

#include <algorithm>

#include "compiler/program/net_effects.h"
#include "compiler/program/program.h"
#include "compiler/program/text.h"

namespace kb::program {
namespace {

/// How tightly a form binds, from loose to tight.
enum class Binding : std::uint8_t { kOr, kAnd, kFor, kNot, kPrimary };

Binding binding_of(const Cond& cond) {
  switch (cond.op) {
    case Cond::Op::kOr: return cond.children.empty() ? Binding::kPrimary : Binding::kOr;
    case Cond::Op::kAnd: return cond.children.empty() ? Binding::kPrimary : Binding::kAnd;
    case Cond::Op::kFor: return Binding::kFor;
    case Cond::Op::kNot: return Binding::kNot;
    default: return Binding::kPrimary;
  }
}

void append_duration(std::string& out, std::uint32_t duration_us) {
  if (duration_us % 1'000'000 == 0 || duration_us > 1'000'000) {
    append_seconds(out, duration_us);
    out += " s";
  } else {
    append_seconds(out, std::int64_t{duration_us} * 1000);
    out += " ms";
  }
}

class ConditionPrinter {
 public:
  ConditionPrinter(const Program& program, std::string& out) : program_(program), out_(out) {}

  /// Prints a condition, in parentheses if it binds more loosely than `least`.
  void print(CondId id, Binding least) {
    const Cond& cond = program_[id];
    const bool loose = binding_of(cond) < least;
    if (loose) out_ += '(';
    print(cond);
    if (loose) out_ += ')';
  }

 private:
  void print(const Cond& cond) {
    switch (cond.op) {
      case Cond::Op::kAnd: return several(cond, " and ", "always", Binding::kFor);
      case Cond::Op::kOr: return several(cond, " or ", "never", Binding::kAnd);
      case Cond::Op::kNot: out_ += "not "; return print(cond.children.front(), Binding::kNot);
      case Cond::Op::kFor:
        print(cond.children.front(), Binding::kNot);
        out_ += " for ";
        return append_duration(out_, cond.duration_us);
      case Cond::Op::kEvent: return sighting("event ", cond);
      case Cond::Op::kLost: return sighting("lost ", cond);
      case Cond::Op::kSeen: return sighting("seen ", cond);
      case Cond::Op::kIs:
        out_ += program_[cond.cell].name;
        if (cond.term != Term::kHigh) out_.append(" is ").append(word(cond.term));
        return;
    }
  }

  void several(const Cond& cond, std::string_view between, std::string_view none, Binding least) {
    if (cond.children.empty()) out_ += none;
    Commas separators(between);
    for (const CondId part : cond.children) {
      separators.next(out_);
      print(part, least);
    }
  }

  void sighting(std::string_view word, const Cond& cond) {
    out_ += word;
    out_ += program_[cond.cell].name;
  }

  const Program& program_;
  std::string& out_;
};

void append_write(std::string& out, const Program& program, const Write& write) {
  const std::string_view name = program[write.cell].name;
  if (write.value == 1.0f || write.value == -1.0f) {
    out += write.value > 0.0f ? '+' : '-';
    out += name;
    return;
  }
  out += name;
  out += " = ";
  append_number(out, write.value);
}

/// Prints `reset`, then what is raised (which clears its group, as in the language), then the rest.
void append_effects(std::string& out, const Program& program, const std::vector<std::uint32_t>& group_of,
                    const Rule& rule) {
  Commas commas(", ");
  const auto append = [&](const Write& write) {
    commas.next(out);
    append_write(out, program, write);
  };
  if (rule.reset) {
    commas.next(out);
    out += "reset";
  }
  std::vector<std::uint32_t> raised;
  for (const Write& write : rule.writes) {
    if (write.value <= 0.0f) continue;
    append(write);
    raised.push_back(group_of[index(write.cell)]);
  }
  for (const std::uint32_t group : rule.clears) {
    if (std::find(raised.begin(), raised.end(), group) != raised.end()) continue;
    for (const CellId member : program.exclusive[group]) append({member, -1.0f});
  }
  for (const Write& write : rule.writes) {
    if (write.value <= 0.0f) append(write);
  }
  if (rule.writes.empty() && rule.clears.empty() && !rule.reset) out += "nothing";
}

void append_rule(std::string& out, const Program& program, const std::vector<std::uint32_t>& group_of,
                 const Rule& rule) {
  out.append("rule ").append(rule.name).append(" at ").append(program.levels[rule.level]).append("    # ").append(program.at(rule)) += '\n';
  out += rule.mode == Mode::kWhen ? "    when " : "    while ";
  ConditionPrinter(program, out).print(rule.condition, Binding::kOr);
  out += "\n    then ";
  append_effects(out, program, group_of, rule);
  out += '\n';
}

void append_settings(std::string& out, const Program& program) {
  const Settings& settings = program.settings;
  out += "set event = ";
  append_number(out, settings.event);
  out += ", attention = ";
  append_number(out, settings.attention);
  out += ", firing = ";
  append_number(out, settings.firing);
  out += ", idle = ";
  switch (settings.idle) {
    case Idle::kStop: out += "stop"; break;
    case Idle::kHold:
      out += "hold, hold_limit = ";
      append_duration(out, settings.hold_limit_us);
      break;
    case Idle::kStrategy: out += program[settings.idle_strategy].name; break;
  }
  out += "\nlevels ";
  Commas greater(" > ");
  for (const std::string& level : program.levels) {
    greater.next(out);
    out += level;
  }
  out += '\n';
}

/// By satellite: the cells to which it draws attention.
std::vector<std::vector<CellId>> attended_by(const Program& program) {
  std::vector<std::vector<CellId>> targets(program.cells.size());
  for (std::uint32_t i = 0; i < program.cells.size(); ++i) {
    for (const CellId satellite : program.cells[i].satellites) targets[index(satellite)].push_back(CellId{i});
  }
  return targets;
}

void append_cells(std::string& out, const Program& program) {
  const std::vector<std::vector<CellId>> targets = attended_by(program);
  for (std::uint32_t i = 0; i < program.cells.size(); ++i) {
    const Cell& cell = program.cells[i];
    switch (cell.kind) {
      case CellKind::kFact:
        out.append(cell.command ? "command " : "fact ").append(cell.name).append(" event ");
        append_number(out, cell.event);
        out += " attention ";
        append_number(out, cell.attention);
        break;
      case CellKind::kSatellite: {
        out.append("satellite ").append(cell.name);
        Commas commas(", ");
        if (!targets[i].empty()) out += " of ";
        for (const CellId target : targets[i]) {
          commas.next(out);
          out += program[target].name;
        }
        if (cell.keep) out += " keep";
        if (cell.output) out += " output";
        out += " = ";
        append_number(out, cell.initial);
        break;
      }
      case CellKind::kStrategy: out.append("strategy ").append(cell.name); break;
    }
    out += '\n';
  }
}

void append_names(std::string& out, const Program& program, std::string_view word, std::string_view between,
                  const std::vector<CellId>& cells) {
  if (cells.empty()) return;
  out += word;
  Commas separators(between);
  for (const CellId cell : cells) {
    separators.next(out);
    out += program[cell].name;
  }
  out += '\n';
}

/// `sensor range[8] 0..4 m noise 0.02 m stale 0.2 s`, `perceive Line = ...`.
void append_perception(std::string& out, const Program& program) {
  for (const Sensor& sensor : program.perception.sensors) {
    const std::string unit = sensor.unit.empty() ? "" : " " + sensor.unit;
    out += "sensor " + sensor.name;
    if (sensor.array) out += fmt::format("[{}]", sensor.count);
    out += sensor.text ? " text" : fmt::format(" {}..{}{}", sensor.low, sensor.high, unit);
    if (sensor.noise > 0.0) out += fmt::format(" noise {}{}", sensor.noise, unit);
    if (sensor.stale_s) out += fmt::format(" stale {} s", *sensor.stale_s);
    if (sensor.circular) out += " circular";
    out += sensor.strict ? " strict\n" : "\n";
  }
  for (const Prototype& prototype : program.perception.prototypes) {
    const std::string text = fuzzy::text(prototype.shape);
    if (prototype.text.find('(') == std::string::npos) out += fmt::format("prototype {} = {}\n", prototype.text, text);
  }
  for (const Perceived& perceived : program.perception.perceived) out += print(program, perceived);
}

}  // namespace

std::string print(const Program& program, const Perceived& perceived) {
  return fmt::format("perceive {} = {}{}\n", program[perceived.fact].name, percept_text(program, perceived.percept), perceived.lazy ? "  # lazy" : "");
}

std::string print_condition(const Program& program, CondId condition) {
  std::string out;
  ConditionPrinter(program, out).print(condition, Binding::kOr);
  return out;
}

void print(const Program& program, const std::vector<RuleId>& rules, const Sink& sink) {
  const std::vector<std::uint32_t> group_of = group_of_cells(program);
  for (const RuleId rule : rules) {
    std::string out;
    append_rule(out, program, group_of, program[rule]);
    sink(out);
  }
}

void print(const Program& program, const Sink& sink) {
  std::string out;
  append_settings(out, program);
  append_cells(out, program);
  for (const std::vector<CellId>& group : program.exclusive) append_names(out, program, "exclusive ", ", ", group);
  append_names(out, program, "priority ", " > ", program.priority);
  append_perception(out, program);
  sink(out);
  print(program, select(program, {}), sink);
  for (const fuzzy::Controller& controller : program.fuzzy) sink(fuzzy::print(controller, nullptr));
}

std::string print(const Program& program) {
  std::string all;
  print(program, [&](std::string_view piece) { all += piece; });
  return all;
}

std::vector<RuleId> select(const Program& program, const Filter& filter) {
  std::vector<RuleId> passed;
  for (std::uint32_t i = 0; i < program.rules.size(); ++i) {
    const Rule& rule = program.rules[i];
    if (!filter.rule.empty() && rule.name != filter.rule && rule.tmpl() != filter.rule) continue;
    if (!filter.level.empty() && program.levels[rule.level] != filter.level) continue;
    passed.push_back(RuleId{i});
  }
  return passed;
}

}  // namespace kb::program
