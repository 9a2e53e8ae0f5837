// The emitted C++: its parts in order, and the typed interface.
#include "compiler/emit/cpp.h"

#include <fmt/format.h>

#include <cmath>

#include "compiler/tables/compact.h"

namespace kb::emit {

std::string float_literal(float value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + "f";
}

std::string float_constant(float value) {
  if (std::isinf(value)) return value > 0.0f ? "mts::kInfinity" : "-mts::kInfinity";
  return float_literal(value);
}

std::string membership_row(const mts::Membership& m) {
  constexpr std::string_view kProfiles[] = {"kLinear", "kGaussian", "kBell", "kSigmoid"};
  static_assert(std::size(kProfiles) == static_cast<std::size_t>(mts::Profile::kSigmoid) + 1);
  const auto f = float_constant;
  return fmt::format("{{mts::Profile::{}, {}, {}, {}, {}, {}, {}, {}}}", kProfiles[static_cast<std::size_t>(m.profile)], f(m.centre),
                     f(m.period), f(m.low), f(m.high), f(m.rise), f(m.fall), f(m.slope));
}

namespace {

const char* index_type(const CppInput& in) { return in.tables.narrow ? "std::uint16_t" : "std::uint32_t"; }

using Out = std::back_insert_iterator<std::string>;

void enumeration(std::string& out, const CppInput& in, std::string_view name, std::string_view about,
                 const std::vector<std::string>& members, const std::vector<std::string>& comments) {
  fmt::format_to(Out(out), "/// {}\nenum class {} : {} {{\n", about, name, index_type(in));
  for (std::size_t i = 0; i < members.size() && !is_full(out); ++i) {
    fmt::format_to(Out(out), "  {},{}{}\n", members[i], comments[i].empty() ? "" : "  // ", comments[i]);
  }
  out += "};\n\n";
}

std::vector<std::string> comments(const CppInput& in, program::CellKind kind, const std::vector<std::string>& names) {
  std::vector<std::string> out;
  for (const program::Cell& cell : in.program.cells_of(kind)) {
    std::string comment(cell.name == names[out.size()] ? "" : cell.name);
    if (cell.output) comment += comment.empty() ? "output" : ", output";
    out.push_back(std::move(comment));
  }
  return out;
}

const char* mind_class(const CppInput& in) { return in.options.compact ? "CompactMind" : "Mind"; }

void emit_enumerations(const CppInput& in, std::string& out) {
  using program::CellKind;
  enumeration(out, in, "Fact", "What the sensors say.", in.names.facts, comments(in, CellKind::kFact, in.names.facts));
  enumeration(out, in, "Satellite", "What the mind holds: goals and context.", in.names.satellites,
              comments(in, CellKind::kSatellite, in.names.satellites));
  enumeration(out, in, "Strategy", "What it can do.", in.names.strategies,
              comments(in, CellKind::kStrategy, in.names.strategies));
  std::vector<std::string> origins;
  for (const program::Rule& rule : in.program.rules) origins.push_back(fmt::format("{}  {}", rule.name, in.program.at(rule)));
  enumeration(out, in, "Rule", "Rules, from the highest level to the lowest.", in.names.rules, origins);
  out +=
      "/// Names as they stand in the knowledge base; `?` for what has none, as the strategy of a decision that drives none. Static text.\n"
      "[[nodiscard]] const char* name(Fact fact);\n"
      "[[nodiscard]] const char* name(Satellite satellite);\n"
      "[[nodiscard]] const char* name(Strategy strategy);\n"
      "[[nodiscard]] const char* name(Rule rule);\n\n";
}

void emit_knowledge(const CppInput& in, std::string& out) {
  const mts::Shape& n = in.tables.shape;
  fmt::format_to(Out(out),
                 "/// The knowledge base as the runtime takes it.\n"
                 "struct Knowledge {{\n"
                 "  using Index = {};\n"
                 "  using Fact = ::{ns}::Fact;\n"
                 "  using Satellite = ::{ns}::Satellite;\n"
                 "  using Strategy = ::{ns}::Strategy;\n"
                 "  using Rule = ::{ns}::Rule;\n"
                 "  using Facts = ::{ns}::Facts;\n"
                 "  static constexpr std::uint32_t kAbi = {};\n"
                 "  static constexpr mts::Shape kShape = {{\n",
                 index_type(in), mts::kAbi, fmt::arg("ns", in.options.name_space));
  const auto field = [&out](std::string_view name, std::uint32_t value) {
    fmt::format_to(Out(out), "      .{} = {},\n", name, value);
  };
  field("facts", n.facts);
  field("satellites", n.satellites);
  field("strategies", n.strategies);
  field("atoms", n.atoms);
  field("rules", n.rules);
  field("words", n.words);
  field("nodes", n.nodes);
  field("timers", n.timers);
  field("queues", n.queues);
  field("levels", n.levels);
  field("groups", n.groups);
  field("group_members", n.group_members);
  field("contested", n.contested);
  out += "  };\n";
  if (const std::uint32_t planes = in.planes.planes(); planes != 0) fmt::format_to(Out(out), "  static constexpr std::uint32_t kPlanes = {};\n", planes);
  if (in.options.compact) {
    const mts::CompactShape bounds = tables::compact_shape(in.tables);
    fmt::format_to(Out(out), "  static constexpr mts::CompactShape kCompact = {{.written = {}, .blends = {}}};\n",
                   bounds.written, bounds.blends);
  }
  fmt::format_to(Out(out),
                 "  static const mts::Tables<Index> kTables;\n"
                 "}};\n\n"
                 "using Mind = mts::{}<Knowledge>;\n"
                 "using Decision = mts::Decision<Knowledge>;\n\n",
                 mind_class(in));
}

std::string header_body(const CppInput& in) {
  std::string h;
  emit_enumerations(in, h);
  emit_facts(in, h);
  emit_knowledge(in, h);
  if (has_perception(in)) emit_readings(in, h);
  emit_fuzzy(in, h);
  emit_controllers(in, h);
  emit_control_lines(in, h);
  emit_limits(in, h);
  return h;
}

std::string source_body(const CppInput& in) {
  std::string s = "namespace {\n\n";
  emit_tables(in, s);
  if (has_perception(in)) emit_perception(in, s);
  emit_texts(in, s);
  emit_fuzzy_code(in, s);
  return s;
}

/// Instantiations of the runtime's templates, to stand in the file with the tables; each preceded by `before`.
std::string instances(const CppInput& in, std::string_view before) {
  const std::string& ns = in.options.name_space;
  std::string out = fmt::format("{}template class mts::{}<::{}::Knowledge>;\n", before, mind_class(in), ns);
  if (has_perception(in)) out += fmt::format("{}template class mts::Perception<::{}::Senses>;\n", before, ns);
  return out;
}

/// The planes of the knowledge base as the runtime finds them: before the instances, which need them.
std::string planes_of(const CppInput& in) {
  if (in.planes.planes() == 0) return {};
  const std::string& ns = in.options.name_space;
  return fmt::format("template <>\ninline constexpr mts::Planes mts::kPlanesOf<::{0}::Knowledge>{{::{0}::kPlaneFirst, ::{0}::kPlaneBegin, {1}, ::{0}::kPlanesAtStart}};\n\n",
                     ns, in.planes.rows.empty() ? "nullptr" : "::" + ns + "::kPlaneRows");
}

// note [files of one make]
// The fleet and the map of a knowledge base stand in files of their own, which say planes, satellites and facts by number. One that
// is left over from before a change would compile with the new header and decide by the old numbers. So the header says what it was
// made of, and they assert that they were made of the same. A map has what no mind has, the course of its roads; its fingerprint
// stands in the header if both were made at once, and a header that was made without a map fits none.
std::string emit_prints(std::uint64_t mind, std::uint64_t map) {
  return fmt::format(
      "/// What this header was made of: the headers of its fleet and of its map, made by the same run of kbc, check it.\n"
      "inline constexpr std::uint64_t kMadeOf = 0x{:016x}u, kMapMadeOf = 0x{:x}u;\n\n",
      mind, map);
}

/// About the bytes of the enumerations, which are the most of a large header: each cell once, each rule with its name and its place behind it.
std::size_t least_of_header(const program::Program& program) {
  constexpr std::size_t kAroundCell = 4, kAroundRule = 15;
  std::size_t bytes = 0;
  for (const program::Cell& cell : program.cells) bytes += cell.name.size() + kAroundCell;
  for (const program::Rule& rule : program.rules) bytes += 2 * rule.name.size() + kAroundRule;
  return bytes;
}

}  // namespace

Cpp cpp(const program::Program& program, const tables::Tables& tables, const CppOptions& options) {
  if (least_of_header(program) > kMaxCppBytes) return {};
  const CppInput in{program, tables, options, make_names(program, tables), make_type_names(program), options.compact ? tables::PlaneForm{} : tables::build_planes(tables)};
  const std::string declared = header_body(in), defined = is_full(declared) ? "" : source_body(in);
  if (is_full(declared) || is_full(defined)) return {};
  const std::uint64_t print = print_of_code(declared, defined);
  const std::string version = version_name(print);
  const auto within = [&](std::string_view body) {
    return fmt::format("namespace {0} {{\ninline namespace {1} {{\n\n{2}}}  // namespace {1}\n}}  // namespace {0}\n\n", options.name_space, version, body);
  };
  Cpp cpp;
  cpp.print = print;
  std::string& h = cpp.header;
  h += kGenerated;
  h += "#pragma once\n\n#include <cstdint>\n";
  h += program.limits.empty() && program.controls.empty() ? "\n" : "#include <limits>\n\n";
  if (!program.fuzzy.empty()) h += "#include <waymark/runtime/fuzzy_straight.h>\n";
  if (!program.controls.empty()) h += "#include <waymark/runtime/control_line.h>\n";
  h += options.compact ? "#include <waymark/runtime/compact_mind.h>\n" : "#include <waymark/runtime/mind.h>\n";
  h += has_perception(in) ? "#include <waymark/runtime/perception.h>\n\n" : "\n";
  h += within(declared + emit_prints(print, options.map_print)) + instances(in, "extern ");
  cpp.source = fmt::format("{}#include \"{}\"\n\n{}{}{}", kGenerated, options.header_name, within(defined), planes_of(in), instances(in, ""));
  return cpp;
}

}  // namespace kb::emit
