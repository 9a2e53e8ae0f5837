#include "compiler/emit/names.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/emit/reserved_words.h"
#include "compiler/source/encoding.h"
#include "compiler/source/fingerprint.h"
#include "compiler/tables/names.h"

namespace kb::emit {
namespace {

bool part_of_identifier(char c) { return source::is_letter_or_digit(c) || (static_cast<unsigned char>(c) & 0x80u) != 0; }

}  // namespace

std::string identifier(std::string_view name) {
  std::string out;
  for (const char c : name) {
    if (part_of_identifier(c)) out += c;
    else if (!out.empty() && out.back() != '_') out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  if (out.empty() || source::is_digit(out.front())) out.insert(0, "n");
  if (is_reserved(out)) out += '_';
  return out;
}

Scope::Scope(std::initializer_list<std::string_view> taken) {
  for (const std::string_view name : taken) taken_.emplace(name);
}

std::string Scope::make(std::string_view name) {
  const std::string plain = identifier(name);
  std::string unique = plain;
  for (int n = 2; !taken_.insert(unique).second; ++n) unique = plain + (plain.back() == '_' ? "" : "_") + std::to_string(n);
  return unique;
}

namespace {

/// The text from which the atom's enumerator is made. For a timer or a node the condition would be too long.
std::string atom_text(const program::Program& program, const tables::Tables& tables, std::uint32_t atom) {
  using Kind = tables::AtomOrigin::Kind;
  switch (tables.origins[atom].kind) {
    case Kind::kTrue: return "always";
    case Kind::kFalse: return "never";
    case Kind::kTimer: return "timer " + std::to_string(atom);
    case Kind::kNode: return "node " + std::to_string(atom);
    default: return tables::atom_name(tables, program, atom);
  }
}

/// A name that clashes neither with the tables in an emitted source (`kRules` and the like) nor with the namespaces of its fuzzy controllers
/// (`fuzzy_GoToGoal`).
std::string beside_tables(std::string name) {
  const bool table = name.size() > 1 && name[0] == 'k' && name[1] >= 'A' && name[1] <= 'Z';
  if (table || name.starts_with("fuzzy_")) name.insert(0, "n");
  return name;
}

}  // namespace

Names make_names(const program::Program& program, const tables::Tables& tables) {
  Names names;
  Scope atoms{"Atom", "Decision", "Fact", "Facts", "Index", "Knowledge", "Mind", "Perception", "Readings", "Rule", "Run", "Satellite",
              "Senses", "Strategy", "control_line", "drive", "name", "no", "yes"};   // names in the same scope
  const auto identifiers = [](Scope scope, const auto& items) {
    std::vector<std::string> made;
    for (const auto& item : items) made.push_back(scope.make(item.name));
    return made;
  };
  using program::CellKind;
  names.facts = identifiers(Scope{"store", "set", "get", "clear"}, program.cells_of(CellKind::kFact));
  names.satellites = identifiers(Scope{}, program.cells_of(CellKind::kSatellite));
  names.strategies = identifiers(Scope{}, program.cells_of(CellKind::kStrategy));
  names.rules = identifiers(Scope{}, program.rules);
  for (std::uint32_t a = 0; a < tables.origins.size(); ++a) {
    names.atoms.push_back(atoms.make(beside_tables(atom_text(program, tables, a))));
  }
  return names;
}

std::string plane_text(const program::Program& program, const tables::FleetForm& form, const tables::FleetPlane& plane) {
  using Kind = tables::FleetPlane::Kind;
  const auto fact = [&] { return std::string(program.cells[plane.of].name); };
  const auto satellite = [&] {
    const std::string bit = form.satellites[plane.of].bits > 1 ? " bit " + std::to_string(plane.bit) : "";
    return std::string(program.cells[program.facts + plane.of].name) + bit;
  };
  const auto strategy = [&] { return std::string(program.cells[program.first_strategy() + plane.of].name); };
  switch (plane.kind) {
    case Kind::kHigh: return fact();
    case Kind::kLow: return fact() + " is low";
    case Kind::kZero: return fact() + " is zero";
    case Kind::kPlain: return fact() + " above event";
    case Kind::kAttended: return fact() + " above attention";
    case Kind::kSeen: return "seen " + fact();
    case Kind::kBad: return "bad " + fact();
    case Kind::kCode: return satellite();
    case Kind::kActive: return "active " + strategy();
    case Kind::kRuns: return "runs " + strategy();
    case Kind::kHeld: return "held " + strategy();
    case Kind::kSeveral: return "several active";
    case Kind::kDone: return fmt::format("disarmed {}", program.rules[plane.of].name);
    case Kind::kTimerOn: return "timer " + std::to_string(plane.of) + " on";
    case Kind::kTimerOver: return "timer " + std::to_string(plane.of) + " over";
    case Kind::kHoldOn: return "idle";
    case Kind::kHoldOver: return "idle for too long";
    case Kind::kFired: return fmt::format("fired {}", program.rules[plane.of].name);
    case Kind::kEvent: return "event " + fact();
    case Kind::kLost: return "lost " + fact();
    case Kind::kBefore: return "before " + satellite();
  }
  return {};
}

FleetNames make_fleet_names(const program::Program& program, const tables::FleetForm& form) {
  FleetNames names;
  // Names that the kernel uses itself.
  Scope scope{"Plane", "V", "Word", "tick", "block", "word", "kTraced", "kWidthWords", "any", "all_of", "zeros", "several", "oldest", "kGivenPlanes"};
  for (const tables::FleetPlane& plane : form.planes) {
    names.texts.push_back(plane_text(program, form, plane));
    names.planes.push_back(scope.make(names.texts.back()));
  }
  for (const program::Rule& rule : program.rules) names.fire.push_back(scope.make(fmt::format("fire {}", rule.name)));
  names.steps.resize(form.steps.size());
  for (std::size_t i = 0; i < form.steps.size(); ++i) {
    const tables::FleetStep& step = form.steps[i];
    using Step = tables::FleetStep::Kind;
    if (step.kind == Step::kLoad) names.steps[i] = names.planes[step.what];
    if (step.kind == Step::kTimer) names.steps[i] = scope.make("long enough " + std::to_string(step.what));
    if (step.kind == Step::kHold) names.steps[i] = scope.make("idle long enough");
    if (step.kind == Step::kLater) names.steps[i] = scope.make("later");
    if (step.kind == Step::kFire && (step.a & 1u) == 0 && names.steps[step.a >> 1].empty()) {
      names.steps[step.a >> 1] = names.fire[step.what];
    }
  }
  for (std::size_t i = 0; i < form.steps.size(); ++i) {
    if (names.steps[i].empty()) names.steps[i] = scope.make("x" + std::to_string(i));
  }
  return names;
}

std::string type_name(std::string_view name) {
  std::string out;
  bool up = true;
  for (const char c : name) {
    if (c == '_') {
      up = true;
      continue;
    }
    out += up && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    up = false;
  }
  return out;
}

std::string unit_suffix(std::string_view unit) {
  std::string out;
  for (const char c : unit) out += c == '/' ? "_per_" : c == '%' ? "percent" : std::string(1, c);
  return out;
}

TypeNames make_type_names(const program::Program& program) {
  TypeNames all;
  Scope& types = all.taken = Scope{"Atom", "Controllers", "Decision", "Fact", "Facts", "Fleet", "Index", "Inputs", "Knowledge", "Mind", "Outputs",
                                   "Perception", "Readings", "Rule", "Run", "Satellite", "Senses", "Strategy", "control_line", "drive", "evaluate",
                                   "evaluate_tables", "find_road", "kMapPieces", "kMapRoads", "landmarks", "name", "road_of_leg", "speed_limit_m_per_s"};
  const auto field = [](Scope& scope, const std::string& name, const std::string& unit) {
    return scope.make(name + (unit.empty() ? "" : "_" + unit_suffix(unit)));
  };
  for (const fuzzy::Controller& controller : program.fuzzy) {
    FuzzyNames names;
    names.type = types.make(beside_tables(std::string(controller.name)));
    Scope inputs, outputs{"status"};
    for (const fuzzy::Input& input : controller.inputs) names.inputs.push_back(field(inputs, input.name, input.unit));
    for (const fuzzy::Output& output : controller.outputs) names.outputs.push_back(field(outputs, output.name, output.unit));
    all.fuzzy.push_back(std::move(names));
  }
  for (const program::Sensor& sensor : program.perception.sensors) {
    all.texts.push_back(sensor.text ? types.make(beside_tables(sensor.name + "Texts")) : "");
  }
  return all;
}

namespace {

/// Adds code without its comments. (Comments begin outside of strings.)
void mix_code(source::Fingerprint& print, std::string_view text) {
  bool quoted = false;
  std::size_t from = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quoted && text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      quoted = !quoted;
    } else if (!quoted && text.substr(i, 2) == "//") {
      print.mix(text.substr(from, i - from));
      from = i = std::min(text.find('\n', i), text.size());
    }
  }
  print.mix(text.substr(from));
}

}  // namespace

// note [two minds of one name]
// Two knowledge bases with the same namespace can meet in one process: an old and a new plug-in, or libraries that use theirs internally.
// Templates over `mission::Knowledge`, and the tables that they read, would have the same symbols in both, and a linker or loader keeps
// only one of each: one of the robots would be driven by the wrong rules. So all emitted code is in an inline namespace whose name depends
// on that code. Users do not see it, and if both headers are included in one file, the compiler says that their names are ambiguous.
// Comments do not count: they say on which lines rules are, and one more line of text in a knowledge base does not change the mind.
std::uint64_t print_of_code(std::string_view declared, std::string_view defined) {
  source::Fingerprint print;
  mix_code(print, declared);
  mix_code(print, defined);
  return print.value();
}

std::string version_name(std::uint64_t print) { return fmt::format("kb_{:016x}", print); }

std::string name_space_for(std::string_view path) {
  const std::size_t slash = path.find_last_of("/\\");
  if (slash != std::string_view::npos) path.remove_prefix(slash + 1);
  if (path.ends_with(".kb")) path.remove_suffix(3);
  return identifier(path);
}

}  // namespace kb::emit
