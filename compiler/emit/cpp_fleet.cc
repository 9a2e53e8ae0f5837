// The files of a fleet: the header that declares mts::Fleet<Knowledge>, the planes, and the kernel.
#include "compiler/emit/cpp_fleet.h"

#include <fmt/format.h>

#include <map>

#include <waymark/fleet/kernel.h>
#include "compiler/emit/cpp.h"

namespace kb::emit {
namespace {

using Out = std::back_insert_iterator<std::string>;
using tables::FleetPlane;
using PlaneKind = FleetPlane::Kind;

class LayoutPrinter {
 public:
  LayoutPrinter(const FleetInput& in, std::string& out) : in_(in), out_(out) {
    for (std::uint32_t i = 0; i < in.form.planes.size(); ++i) {
      const FleetPlane& plane = in.form.planes[i];
      if (plane.bit == 0) at_[{plane.kind, plane.of}] = i;
    }
    for (const tables::FleetDerived& derived : in.form.derived) {
      at_[{derived.plane.kind, derived.plane.of}] = derived.part;
    }
  }

  void print() {
    planes();
    rows("FleetFact", "kFacts", in_.program.facts, 0, [&](std::uint32_t f) {
      return list({PlaneKind::kHigh, PlaneKind::kLow, PlaneKind::kZero, PlaneKind::kPlain, PlaneKind::kAttended, PlaneKind::kSeen, PlaneKind::kBad, PlaneKind::kEvent, PlaneKind::kLost}, f) +
             ", " + (in_.form.weighed[f] ? std::to_string(weights_++) : "none");
    });
    satellites();
    rows("FleetStrategy", "kStrategies", in_.program.strategies, in_.program.first_strategy(), [&](std::uint32_t u) {
      const PlaneKind runs = at_.contains({PlaneKind::kRuns, u}) ? PlaneKind::kRuns : PlaneKind::kActive;
      return list({PlaneKind::kActive, runs, PlaneKind::kHeld}, u);
    });
    rows("FleetRule", "kRules", static_cast<std::uint32_t>(in_.program.rules.size()), kNoCell,
         [&](std::uint32_t r) { return list({PlaneKind::kDone, PlaneKind::kFired}, r); });
    timers();
    groups();
    parts();
    tables();
  }

 private:
  static constexpr std::uint32_t kNoCell = 0xFFFFFFFFu;

  template <class... T>
  void line(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(Out(out_), format, std::forward<T>(values)...);
    out_ += '\n';
  }

  void planes() {
    line("/// A bit for each robot: see note [blocks of planes] in fleet/kernel.h.");
    line("enum class Plane : std::uint32_t {{");
    for (std::size_t i = 0; i < in_.form.planes.size(); ++i) {
      if (i == 0 && in_.form.given != 0) line("  // What the host gives.");
      if (i == in_.form.busy_given && i != in_.form.read_given) line("  // The same, at rest in the profile.");
      if (i == in_.form.read_given && i != in_.form.busy_given) line("  // The same, not read by the kernel.");
      if (i == in_.form.given) line("  // What the kernel makes.");
      if (i == in_.form.busy_planes && i != in_.form.plain_planes) line("  // The same, at rest in the profile.");
      if ((i == in_.form.plain_given && i != in_.form.given) || i == in_.form.plain_planes) line("  // The same, of traced fleets only.");
      const std::string& text = in_.names.texts[i];
      line("  {},{}", in_.names.planes[i], text == in_.names.planes[i] ? "" : "  // " + text);
    }
    line("}};\n");
    line("constexpr std::uint32_t none = mts::kNoPlane;");
    line("constexpr std::uint32_t kGivenPlanes = {};", in_.form.given);
    line("[[maybe_unused]] constexpr std::uint32_t at(Plane plane) {{ return static_cast<std::uint32_t>(plane); }}");
    line("/// What is not kept, as it is said by planes: see FleetPart in fleet/kernel.h.");
    line("[[maybe_unused]] constexpr std::uint32_t part(std::uint32_t number) {{ return {} + number; }}", in_.form.planes.size());
    line("[[maybe_unused]] constexpr std::uint32_t yes(std::uint32_t plane) {{ return plane << 1; }}");
    line("[[maybe_unused]] constexpr std::uint32_t no(std::uint32_t plane) {{ return plane << 1 | 1u; }}\n");
  }

  std::string plane(PlaneKind kind, std::uint32_t of) const {
    const auto found = at_.find({kind, of});
    return found == at_.end() ? "none" : numbered(found->second);
  }
  /// A plane, or a part.
  std::string numbered(std::size_t number) const {
    const std::size_t planes = in_.form.planes.size();
    return number < planes ? "at(Plane::" + in_.names.planes[number] + ")" : fmt::format("part({})", number - planes);
  }
  std::string list(std::initializer_list<PlaneKind> kinds, std::uint32_t of) const {
    std::string out;
    for (const PlaneKind kind : kinds) out += (out.empty() ? "" : ", ") + plane(kind, of);
    return out;
  }

  /// An array. It is never empty, so that it has an address.
  template <class F>
  void rows(std::string_view type, std::string_view name, std::uint32_t count, std::uint32_t first_cell, F&& row) {
    line("constexpr mts::{} {}[] = {{", type, name);
    for (std::uint32_t i = 0; i < count; ++i) {
      line("    {{{}}},  // {}", row(i), first_cell == kNoCell ? in_.program.rules[i].name : in_.program.cells[first_cell + i].name);
    }
    if (count == 0) line("    {{}},");
    line("}};\n");
  }

  void satellites() {
    std::string values;
    std::uint32_t begin = 0;
    rows("FleetSatellite", "kSatellites", in_.program.satellites, in_.program.facts, [&](std::uint32_t s) {
      const tables::FleetCode& code = in_.form.satellites[s];
      const auto count = static_cast<std::uint32_t>(code.values.size());
      for (const float value : code.values) fmt::format_to(Out(values), " {},", float_literal(value));
      const std::string text = fmt::format("{}, {}, {}, {}, {}", plane(PlaneKind::kCode, s), plane(PlaneKind::kBefore, s), code.bits, begin, count);
      begin += count;
      return text;
    });
    line("constexpr float kValues[] = {{{} 0.0f}};\n", values);
  }
  void timers() {
    line("constexpr mts::FleetTimer kTimers[] = {{");
    for (std::uint32_t i = 0; i < in_.tables.shape.timers; ++i) line("    {{{}}},", list({PlaneKind::kTimerOn, PlaneKind::kTimerOver}, i));
    line("    {{{}}},  // idle = hold\n}};\n", list({PlaneKind::kHoldOn, PlaneKind::kHoldOver}, 0));
  }

  void groups() {
    std::string begin, members;
    std::size_t count = 0;
    for (const auto& group : in_.form.exclusive) {
      fmt::format_to(Out(begin), "{}, ", count);
      for (const std::uint32_t member : group) fmt::format_to(Out(members), "{}, ", member);
      count += group.size();
    }
    line("constexpr std::uint32_t kGroupBegin[] = {{{}{}}};", begin, count);
    line("constexpr std::uint32_t kGroups[] = {{{}0}};\n", members);
  }

  std::string operand(tables::Ref ref) const {
    return fmt::format("{}({})", (ref & 1u) != 0 ? "no" : "yes", numbered(ref >> 1));
  }
  void parts() {
    std::map<std::uint32_t, std::string> said;
    for (const tables::FleetDerived& derived : in_.form.derived) {
      std::string& text = said[derived.part];
      text += (text.empty() ? "  // " : ", ") + plane_text(in_.program, in_.form, derived.plane);
    }
    line("constexpr mts::FleetPart kParts[] = {{");
    for (std::size_t i = 0; i < in_.form.parts.size(); ++i) {
      const tables::FleetPart& p = in_.form.parts[i];
      line("    {{{}, {}}},{}", operand(p.a), operand(p.b), said[static_cast<std::uint32_t>(in_.form.planes.size() + i)]);
    }
    line("    {{}},\n}};\n");
  }

  void tables() {
    std::string bits;
    for (const bool bit : in_.form.rest) bits += bit ? "1, " : "0, ";
    line("constexpr std::uint8_t kRest[] = {{{}0}};\n", bits);
    line("constexpr mts::FleetTables kFleetTables = {{");
    line("    .read_given = {},\n    .plain_given = {},\n    .given = {},", in_.form.read_given, in_.form.plain_given, in_.form.given);
    line("    .planes = {},\n    .traced_planes = {},", in_.form.plain_planes, in_.form.planes.size());
    line("    .several = {},\n    .weights = {},", plane(PlaneKind::kSeveral, 0), weights_);
    line("    .busy_given = {},\n    .busy_planes = {},\n    .rest = kRest,", in_.form.busy_given, in_.form.busy_planes);
    line("    .parts = kParts,");
    line("    .facts = kFacts,\n    .satellites = kSatellites,\n    .strategies = kStrategies,\n    .rules = kRules,");
    line("    .timers = kTimers,\n    .values = kValues,");
    line("    .group_begin = kGroupBegin,\n    .groups = kGroups,\n    .group_count = {},\n}};\n", in_.form.exclusive.size());
  }

  const FleetInput& in_;
  std::string& out_;
  std::map<std::pair<PlaneKind, std::uint32_t>, std::uint32_t> at_;   // the plane's or the part's number
  std::uint32_t weights_ = 0;
};

/// See note [files of one make]. Both files assert it: either may be the one that was left over.
std::string demand_mind(const std::string& ns, const FleetFiles& files) {
  return fmt::format("static_assert({0}::kMadeOf == 0x{1:016x}u, \"this fleet was made of another version of the knowledge base than the mind of {0}: \"\n"
                     "              \"compile the knowledge base with --fleet again (with CMake: FLEET in kb_add_library, then build)\");\n\n",
                     ns, files.mind_print);
}

std::string header(const std::string& ns, const FleetFiles& files) {
  std::string h = std::string(kGenerated) + "#pragma once\n\n";
  fmt::format_to(Out(h), "#include <waymark/fleet/fleet.h>\n#include \"{}\"\n\n", files.plain_header);
  h += demand_mind(ns, files);
  fmt::format_to(Out(h),
                 "template <>\nstruct mts::FleetForm<::{0}::Knowledge> {{\n"
                 "  static constexpr std::uint32_t kAbi = {1};\n"
                 "  static const mts::FleetTables& tables();\n"
                 "  /// The widest kernel that this processor can run and that is no wider than `most_bits`.\n"
                 "  static const mts::FleetKernels& kernels(std::uint32_t most_bits);\n}};\n\n"
                 "namespace {0} {{\n/// Many robots with this knowledge base.\nusing Fleet = mts::Fleet<Knowledge>;\n}}  // namespace {0}\n\n"
                 "extern template class mts::Fleet<::{0}::Knowledge>;\n",
                 ns, mts::kFleetAbi);
  return h;
}

/// The tables, and the kernel for each width of words.
void emit_kernels(const std::string& ns, bool rest, std::string& s) {
  const auto kernels = [&](int bits) {
    const std::string in = fmt::format("::{}::fleet_kernel::width_{}", ns, bits);
    return fmt::format("      {{{1}, {0}::tick_block<false>, {0}::tick_block<true>, {2}}},\n", in, bits, rest ? in + "::tick_resting_block" : "nullptr");
  };
  fmt::format_to(Out(s),
                 "const mts::FleetTables& mts::FleetForm<::{0}::Knowledge>::tables() {{ return ::{0}::fleet_kernel::kFleetTables; }}\n\n"
                 "const mts::FleetKernels& mts::FleetForm<::{0}::Knowledge>::kernels(std::uint32_t most_bits) {{\n"
                 "  static constexpr mts::FleetKernels kKernels[] = {{\n"
                 "{1}#ifdef MTS_FLEET_X86\n{2}{3}#endif\n"
                 "  }};\n"
                 "  std::uint32_t widest = mts::fleet_widths() - 1;\n"
                 "  while (widest > 0 && kKernels[widest].bits > most_bits) --widest;\n"
                 "  return kKernels[widest];\n}}\n\n"
                 "template class mts::Fleet<::{0}::Knowledge>;\n\n",
                 ns, kernels(64), kernels(256), kernels(512));
}

std::string source_text(const FleetInput& in, const FleetFiles& files) {
  const std::string& ns = in.options.name_space;
  std::string s = std::string(kGenerated) + "// Reads itself, once for each width of words: see note [one source, several widths] in fleet/widths.h.\n";
  fmt::format_to(Out(s), "#ifndef KB_FLEET_WIDTH\n#include \"{}\"\n\n{}namespace {}::fleet_kernel {{\nnamespace {{\n\n", in.options.header_name, demand_mind(ns, files), ns);
  LayoutPrinter(in, s).print();
  fmt::format_to(Out(s), "}}  // namespace\n}}  // namespace {0}::fleet_kernel\n\n#define KB_FLEET_SOURCE \"{1}\"\n#include <waymark/fleet/widths.h>\n#undef KB_FLEET_SOURCE\n\n", ns,
                 files.source_name);
  emit_kernels(ns, !in.form.resting.empty(), s);
  fmt::format_to(Out(s),
                 "#else\nnamespace {0}::fleet_kernel {{\nnamespace {{\n"
                 "#if KB_FLEET_WIDTH == 64\nnamespace width_64 {{\n#elif KB_FLEET_WIDTH == 256\nnamespace width_256 {{\n#else\nnamespace width_512 {{\n#endif\n"
                 "#include <waymark/fleet/kernel_code.h>\n\n",
                 ns);
  emit_fleet_kernel(in, s);
  fmt::format_to(Out(s), "}}  // namespace width_*\n}}  // namespace\n}}  // namespace {}::fleet_kernel\n#endif\n", ns);
  return s;
}

}  // namespace

Cpp cpp_fleet(const program::Program& program, const tables::Tables& tables, const CppOptions& options, const FleetFiles& files, const tables::FleetRest& rest) {
  FleetInput in{program, tables, options, tables::build_fleet(program, tables, rest), {}};
  in.names = make_fleet_names(program, in.form);
  return {header(options.name_space, files), source_text(in, files)};
}

}  // namespace kb::emit
