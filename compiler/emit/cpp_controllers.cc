// Controllers, which drive the robot while a strategy runs. The user's program binds them by type, so a forgotten one does not compile.
// And how fast they may drive.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "compiler/emit/cpp.h"

namespace kb::emit {
namespace {

using Out = std::back_insert_iterator<std::string>;
using program::Control;

/// One controller, with the arguments of all `control` lines that name it as fields of a struct.
struct Controller {
  struct Field {
    std::string argument, name, unit;
    bool is_number = true;
    std::vector<std::string> words;   ///< the enumerators of a field that takes a word, in order of appearance
    std::vector<std::string> enumerators;
    std::string type;
  };
  std::string source_name, method, type;
  std::vector<Field> fields;
  std::vector<std::string> drives;    ///< strategies
  const FuzzyNames* fuzzy = nullptr;  ///< a fuzzy controller: it has its own type and takes no arguments
};

void add_field(Controller& controller, const Control::Argument& argument) {
  auto field = std::find_if(controller.fields.begin(), controller.fields.end(), [&](const auto& f) {
    return f.argument == argument.name && f.is_number == argument.is_number && f.unit == argument.unit;
  });
  if (field == controller.fields.end()) {
    Controller::Field fresh;
    fresh.argument = argument.name;
    fresh.unit = argument.unit;
    fresh.is_number = argument.is_number;
    controller.fields.push_back(std::move(fresh));
    field = controller.fields.end() - 1;
  }
  if (argument.is_number) return;
  if (std::find(field->words.begin(), field->words.end(), argument.word) == field->words.end()) {
    field->words.push_back(argument.word);
  }
}

std::vector<Controller> collect(const CppInput& in) {
  std::vector<Controller> controllers;
  std::map<std::string, std::size_t> known;
  for (const Control& control : in.program.controls) {
    const auto [at, fresh] = known.try_emplace(control.controller, controllers.size());
    if (fresh) controllers.push_back({control.controller, {}, {}, {}, {}, nullptr});
    Controller& controller = controllers[at->second];
    controller.drives.emplace_back(in.program[control.strategy].name);
    if (control.fuzzy != fuzzy::kNone) {
      controller.fuzzy = &in.types.fuzzy[control.fuzzy];
      continue;
    }
    for (const Control::Argument& argument : control.arguments) add_field(controller, argument);
  }
  Scope methods{"run", "idle", "sense"};
  Scope types = in.types.taken;
  for (Controller& controller : controllers) {
    controller.method = methods.make(controller.source_name);
    if (controller.fuzzy != nullptr) continue;
    controller.type = types.make(type_name(controller.method));
    Scope fields, enumerations{controller.type};
    for (auto& field : controller.fields) {
      field.name = fields.make(field.argument + (field.unit.empty() ? "" : "_" + unit_suffix(field.unit)));
      static_cast<void>(enumerations.make(field.name));   // a field called `Way` hides a type of that name
    }
    for (auto& field : controller.fields) {
      if (field.is_number) continue;
      const std::string type = type_name(field.name);
      field.type = enumerations.make(type == controller.type ? "Word" : type);
      Scope words{"unset", "Decision", "Mind", "Perception"};
      for (const std::string& word : field.words) field.enumerators.push_back(words.make(word));
    }
  }
  return controllers;
}

/// A word as the knowledge base has it: libraries of controllers number their words otherwise. Not in the struct, whose fields may have any name.
void emit_word_name(const Controller& c, const Controller::Field& field, std::string& out) {
  fmt::format_to(Out(out), "[[nodiscard]] constexpr const char* name({0}::{1} word) noexcept {{\n  constexpr const char* kWords[] = {{\"\"", c.type, field.type);
  for (const std::string& word : field.words) fmt::format_to(Out(out), ", \"{}\"", word);
  out += "};\n  return kWords[static_cast<unsigned>(word)];\n}\n";
}

void emit_structs(const std::vector<Controller>& controllers, std::string& out) {
  for (const Controller& c : controllers) {
    if (c.fuzzy != nullptr) continue;
    fmt::format_to(Out(out), "/// What `{}` is asked for. It drives {}.\nstruct {} {{\n", c.source_name,
                   fmt::join(c.drives, ", "), c.type);
    for (const auto& field : c.fields) {
      if (!field.is_number) {
        fmt::format_to(Out(out), "  enum class {} : std::uint8_t {{ unset, {} }};\n  {} {} = {}::unset;\n", field.type,
                       fmt::join(field.enumerators, ", "), field.type, field.name, field.type);
      } else {
        fmt::format_to(Out(out), "  float {} = 0.0f;{}\n", field.name, field.unit.empty() ? "" : "  ///< " + field.unit);
      }
    }
    out += "};\n";
    for (const auto& field : c.fields) {
      if (!field.is_number) emit_word_name(c, field, out);
    }
    out += '\n';
  }
}

/// The lines that fill in `arguments`.
std::string assignments(const Controller& c, const Control& control) {
  std::string lines;
  for (const auto& field : c.fields) {
    for (const Control::Argument& a : control.arguments) {
      if (a.name != field.argument || a.is_number != field.is_number || a.unit != field.unit) continue;
      const auto word = std::find(field.words.begin(), field.words.end(), a.word) - field.words.begin();
      const std::string value = a.is_number ? float_literal(static_cast<float>(a.number))
                                            : fmt::format("{}::{}::{}", c.type, field.type,
                                                          field.enumerators[static_cast<std::size_t>(word)]);
      fmt::format_to(Out(lines), "      arguments.{} = {};\n", field.name, value);
    }
  }
  return lines;
}

void demand_fuzzy(const Controller& c, std::string& out) {
  fmt::format_to(Out(out),
                 "  static_assert(requires(typename {0}::Inputs& in) {{ controllers.sense(in); }}, \"no `sense({0}::Inputs&)`: what `{0}` is to look at\");\n"
                 "  static_assert(!requires {{ controllers.sense(typename {0}::Inputs{{}}); }}, \"`sense({0}::Inputs)` fills in a copy; it must take `{0}::Inputs&`\");\n"
                 "  static_assert(requires(const typename {0}::Outputs& out) {{ controllers.{1}(out); }}, \"no controller `{1}(const {0}::Outputs&)`: it drives {2}\");\n",
                 c.fuzzy->type, c.method, fmt::join(c.drives, ", "));
}

/// The code that gets inputs from the host, sets those that the `control` line fixes, and gives the answer to the host.
void drive_fuzzy(const CppInput& in, const Controller& c, const Control& control, const std::string& strategy, std::string& out) {
  fmt::format_to(Out(out), "    case Strategy::{}: {{\n      {}::Inputs in;\n      controllers.sense(in);\n", strategy, c.fuzzy->type);
  const fuzzy::Controller& controller = in.program.fuzzy[control.fuzzy];
  for (const Control::Argument& argument : control.arguments) {
    for (std::size_t i = 0; i < controller.inputs.size(); ++i) {
      if (controller.inputs[i].name != argument.name) continue;
      fmt::format_to(Out(out), "      in.{} = {};\n", c.fuzzy->inputs[i], float_literal(static_cast<float>(argument.number)));
    }
  }
  fmt::format_to(Out(out), "      controllers.{}({}::evaluate(in));\n      break;\n    }}\n", c.method, c.fuzzy->type);
}

using Lines = std::vector<const Control*>;   // by strategy; null where no line gives a controller

Lines lines_of(const program::Program& program) {
  Lines of(program.strategies, nullptr);
  for (const Control& control : program.controls) of[index(control.strategy) - program.first_strategy()] = &control;
  return of;
}

/// Assertions that name what the host's `Controllers` lacks.
void demand_functions(const CppInput& in, const std::vector<Controller>& controllers, const Lines& of, std::string& out) {
  for (const Controller& c : controllers) {
    if (c.fuzzy != nullptr) {
      demand_fuzzy(c, out);
      continue;
    }
    fmt::format_to(Out(out), "  static_assert(requires {{ controllers.{}({}{{}}); }}, \"no controller `{}(const {}&)`: it drives {}\");\n",
                   c.method, c.type, c.method, c.type, fmt::join(c.drives, ", "));
  }
  for (std::size_t s = 0; s < of.size(); ++s) {
    if (of[s] != nullptr) continue;
    fmt::format_to(Out(out), "  static_assert(requires {{ controllers.run(Run<Strategy::{}>{{}}); }}, \"no `run(Run<Strategy::{}>)`: no `control` line names a controller for {}\");\n",
                   in.names.strategies[s], in.names.strategies[s],
                   in.program.cells[in.program.first_strategy() + s].name);
  }
}

void emit_cases(const CppInput& in, const std::vector<Controller>& controllers, const Lines& of, std::string& out) {
  for (std::size_t s = 0; s < of.size(); ++s) {
    const std::string& name = in.names.strategies[s];
    if (of[s] == nullptr) {
      fmt::format_to(Out(out), "    case Strategy::{0}: controllers.run(Run<Strategy::{0}>{{}}); break;\n", name);
      continue;
    }
    const auto c = std::find_if(controllers.begin(), controllers.end(),
                                [&](const Controller& x) { return x.source_name == of[s]->controller; });
    if (c->fuzzy != nullptr) {
      drive_fuzzy(in, *c, *of[s], name, out);
      continue;
    }
    const std::string lines = assignments(*c, *of[s]);
    fmt::format_to(Out(out), "    case Strategy::{}: {{\n      {}{} arguments;\n{}      controllers.{}(arguments);\n      break;\n    }}\n",
                   name, lines.empty() ? "const " : "", c->type, lines, c->method);
  }
}

}  // namespace

void emit_controllers(const CppInput& in, std::string& out) {
  const std::vector<Controller> controllers = collect(in);
  emit_structs(controllers, out);
  const Lines of = lines_of(in.program);
  out +=
      "/// Stands for a strategy that no `control` line gives a controller: the host's own.\n"
      "template <Strategy kStrategy>\nstruct Run {\n  static constexpr Strategy strategy = kStrategy;\n};\n\n"
      "/// Hands the decision to its controller: calls exactly one function of `controllers`. A missing one does not compile.\n"
      "template <class Controllers>\nvoid drive(const Decision& decision, Controllers& controllers) {\n"
      "  static_assert(requires { controllers.idle(); }, \"no `idle()`: what the robot does when no strategy runs (stand)\");\n";
  demand_functions(in, controllers, of, out);
  out += "  if (!decision.drives()) {\n    controllers.idle();\n    return;\n  }\n  switch (decision.strategy()) {\n";
  emit_cases(in, controllers, of, out);
  out += "    default: break;\n  }\n}\n\n";   // never taken; -Wswitch-default demands it
}

void emit_control_lines(const CppInput& in, std::string& out) {
  if (in.program.controls.empty()) return;
  const Lines of = lines_of(in.program);
  std::string arguments, lines;
  std::size_t count = 0;
  for (std::size_t s = 0; s < of.size(); ++s) {
    const std::string_view strategy = in.program.cells[in.program.first_strategy() + s].name;
    const std::size_t mine = of[s] == nullptr ? 0 : of[s]->arguments.size();
    const std::string controller = of[s] == nullptr ? "nullptr" : fmt::format("\"{}\"", of[s]->controller);
    fmt::format_to(Out(lines), "      {{{}, {}, {}}},  // {}\n", controller, mine == 0 ? "nullptr" : fmt::format("kArguments + {}", count), mine, strategy);
    count += mine;
    for (std::size_t i = 0; i < mine; ++i) {
      const Control::Argument& a = of[s]->arguments[i];
      const std::string value = a.is_number ? fmt::format("\"\", {}, \"{}\"", float_literal(static_cast<float>(a.number)), a.unit) : fmt::format("\"{}\", 0.0f, \"\"", a.word);
      fmt::format_to(Out(arguments), "      {{\"{}\", {}}},  // {}\n", a.name, value, strategy);
    }
  }
  if (count > 0) arguments = fmt::format("  static constexpr mts::ControlArgument kArguments[] = {{\n{}  }};\n", arguments);
  fmt::format_to(Out(out),
                 "/// The `control` line of a strategy as data; null if none names its controller.\n"
                 "[[nodiscard]] inline const mts::ControlLine* control_line(Strategy strategy) noexcept {{\n{}"
                 "  static constexpr mts::ControlLine kLines[] = {{\n{}  }};\n"
                 "  const auto s = static_cast<std::uint32_t>(strategy);\n"
                 "  return s < {} && kLines[s].controller != nullptr ? &kLines[s] : nullptr;\n}}\n"
                 "/// That of the strategy that drives; null if none does.\n"
                 "[[nodiscard]] inline const mts::ControlLine* control_line(const Decision& decision) noexcept {{\n"
                 "  return decision.drives() ? control_line(decision.strategy()) : nullptr;\n}}\n\n",
                 arguments, lines, of.size());
}

void emit_limits(const CppInput& in, std::string& out) {
  if (in.program.limits.empty()) {
    if (in.program.controls.empty()) return;
    out += "/// How fast the robot may drive: no road has a limit (`at most`).\n"
           "[[nodiscard]] inline float speed_limit_m_per_s(const Mind&) { return std::numeric_limits<float>::infinity(); }\n\n";
    return;
  }
  out +=
      "/// How fast the robot may drive on its present leg, m/s, by the map (`at most`); infinity if the road has no limit.\n"
      "[[nodiscard]] inline float speed_limit_m_per_s(const Mind& mind) {\n"
      "  static constexpr Satellite kLegs[] = {\n";
  for (const program::LegLimit& limit : in.program.limits) {
    const std::string& leg = in.names.satellites[program::index(limit.leg) - in.program.facts];
    fmt::format_to(Out(out), "      Satellite::{},  // {}: {} m/s\n", leg, in.program[limit.leg].name, limit.limit_m_per_s);
  }
  out += "  };\n  static constexpr float kLimits[] = {";
  for (const program::LegLimit& limit : in.program.limits) fmt::format_to(Out(out), "{}{}", &limit == in.program.limits.data() ? "" : ", ", float_literal(limit.limit_m_per_s));
  fmt::format_to(Out(out),
                 "}};\n"
                 "  float lowest = std::numeric_limits<float>::infinity();\n"
                 "  for (unsigned i = 0; i != {}; ++i) {{\n"
                 "    if (kLimits[i] < lowest && mind.high(kLegs[i])) lowest = kLimits[i];\n"
                 "  }}\n"
                 "  return lowest;\n"
                 "}}\n\n",
                 in.program.limits.size());
}

}  // namespace kb::emit
