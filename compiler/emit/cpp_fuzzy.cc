// Fuzzy controllers: the typed interface, and the constants for runtime/fuzzy.h. The rules as code are in cpp_fuzzy_code.cc.
#include <fmt/format.h>

#include "compiler/emit/cpp.h"
#include "compiler/emit/cpp_fuzzy.h"

namespace kb::emit {
namespace {

using Out = std::back_insert_iterator<std::string>;

void emit_class(const fuzzy::Controller& c, const FuzzyNames& names, const tables::FuzzyForm& form, std::string& out) {
  fmt::format_to(Out(out), "/// The fuzzy controller `{}`: {} rules.\nstruct {} {{\n  struct Inputs {{\n", c.name, c.rules.size(), names.type);
  for (std::size_t i = 0; i < c.inputs.size(); ++i) {
    const fuzzy::Input& input = c.inputs[i];
    fmt::format_to(Out(out), "    float {}{} = {};  ///< {}\n", names.inputs[i], input.group ? fmt::format("[{}]", input.count) : "",
                   input.group ? "{}" : "0.0f", fuzzy::range_text(input.low, input.high, input.unit, input.circular));
  }
  out += "  };\n  struct Outputs {\n";
  for (std::size_t o = 0; o < c.outputs.size(); ++o) {
    const fuzzy::Output& output = c.outputs[o];
    fmt::format_to(Out(out), "    float {} = {};  ///< {}\n", names.outputs[o], float_constant(static_cast<float>(output.default_value())),
                   fuzzy::range_text(output.low, output.high, output.unit, output.circular));
  }
  out +=
      "    mts::FuzzyStatus status = mts::FuzzyStatus::kOk;\n  };\n"
      "  /// What the rules say of `in`. Never fails: see `status`.\n"
      "  [[nodiscard]] static Outputs evaluate(const Inputs& in) noexcept;\n"
      "  /// The same bits by walking the tables: less code, more time.\n"
      "  [[nodiscard]] static Outputs evaluate_tables(const Inputs& in) noexcept;\n";
  fmt::format_to(Out(out), "  static constexpr std::uint32_t kRules = {}, kTableBytes = {};\n}};\n\n", c.rules.size(), tables::bytes(form));
}

std::string combine(mts::FuzzyCombine how) {
  constexpr std::string_view kNames[] = {"kAverage", "kAverageAbout", "kSum", "kWinner"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(mts::FuzzyCombine::kWinner) + 1);
  return fmt::format("mts::FuzzyCombine::{}", kNames[static_cast<std::size_t>(how)]);
}

std::string origin(const fuzzy::Controller& c, const tables::FuzzyForm& form, std::size_t step) {
  if (form.steps[step].skip != 0) return "given " + fuzzy::text(c, c.nests[form.origins[step]].condition);
  return fuzzy::text(c, c.rules[form.origins[step]]);
}

void emit_constants(const fuzzy::Controller& c, const tables::FuzzyForm& form, std::string& out) {
  const auto f = float_constant;
  std::vector<std::string> term_names;
  for (const fuzzy::Input& input : c.inputs) {
    for (const fuzzy::Term& term : input.terms) term_names.push_back(input.name + " is " + term.name);
  }
  std::string fields;
  const auto field = [&](std::string_view name, std::size_t count) { fmt::format_to(Out(fields), "{}, ", count == 0 ? "nullptr" : name); };
  const auto array = [&](std::string_view type, std::string_view name, std::size_t count, auto&& row) {
    emit_array(out, type, name, count, [&](std::size_t i) { return row(i) + ","; });
    field(name, count);
  };
  const auto numbers = [&](std::string_view name, const std::vector<std::uint16_t>& values) {
    emit_numbers(out, "std::uint16_t", name, values);
    field(name, values.size());
  };
  array("mts::FuzzyInput", "kInputs", form.inputs.size(), [&](std::size_t i) {
    return fmt::format("{{{}, {}, {}}}", f(form.inputs[i].low), f(form.inputs[i].high), f(form.inputs[i].period));
  });
  array("mts::Membership", "kTerms", form.terms.size(), [&](std::size_t i) { return fmt::format("/* {} */ {}", term_names[i], membership_row(form.terms[i])); });
  numbers("kSlotOfDegree", form.slot_of_degree);
  numbers("kTermOfDegree", form.term_of_degree);
  numbers("kCode", form.code);
  array("mts::FuzzyStep", "kSteps", form.steps.size(), [&](std::size_t i) {
    const mts::FuzzyStep& s = form.steps[i];
    return fmt::format("/* {} */\n    {{{}, {}, {}, {}, {}, {}, {}, {}}}", origin(c, form, i), s.first_code, s.end_code, s.first_consequent,
                       s.end_consequent, s.skip, s.depth, s.conjunctive, f(s.weight));
  });
  array("mts::FuzzyConsequent", "kConsequents", form.consequents.size(), [&](std::size_t i) {
    const mts::FuzzyConsequent& k = form.consequents[i];
    return fmt::format("{{{}, {}, {}, {}}}", f(k.constant), k.output, k.first_part, k.end_part);
  });
  array("mts::FuzzyPart", "kParts", form.parts.size(), [&](std::size_t i) { return fmt::format("{{{}, {}}}", f(form.parts[i].coefficient), form.parts[i].slot); });
  array("mts::FuzzyOutput", "kOutputs", form.outputs.size(), [&](std::size_t i) {
    const mts::FuzzyOutput& o = form.outputs[i];
    return fmt::format("{{{}, {}, {}, {}, {}, {}, {}}}", f(o.low), f(o.high), f(o.period), f(o.within), f(o.fallback), combine(o.combine), o.first_fired);
  });
  fmt::format_to(Out(out), "constexpr mts::FuzzyTables kTables = {{\n    {}\n    {}, {}, {}, {}, {}, {}}};\n", fields, form.inputs.size(), form.slot_of_degree.size(),
                 form.steps.size(), form.outputs.size(), form.product, form.sum);
}

}  // namespace

std::string slot_expression(const fuzzy::Controller& c, const FuzzyNames& names, std::uint32_t slot) {
  const std::uint32_t input = fuzzy::input_of_slot(c, slot);
  return c.inputs[input].group ? fmt::format("in.{}[{}]", names.inputs[input], slot - c.inputs[input].first_slot) : "in." + names.inputs[input];
}

void emit_fuzzy(const CppInput& in, std::string& out) {
  for (std::size_t i = 0; i < in.program.fuzzy.size(); ++i) emit_class(in.program.fuzzy[i], in.types.fuzzy[i], in.tables.fuzzy[i], out);
}

void emit_fuzzy_code(const CppInput& in, std::string& out) {
  for (std::size_t i = 0; i < in.program.fuzzy.size(); ++i) {
    const fuzzy::Controller& c = in.program.fuzzy[i];
    const tables::FuzzyForm& form = in.tables.fuzzy[i];
    const FuzzyNames& names = in.types.fuzzy[i];
    fmt::format_to(Out(out), "// ---- fuzzy controller {}\nnamespace {{\nnamespace fuzzy_{} {{\n\n", c.name, names.type);
    emit_constants(c, form, out);
    fmt::format_to(Out(out), "\n}}  // namespace fuzzy_{}\n}}  // namespace\n\n", names.type);
    emit_table_walk(c, form, names, out);
    emit_straight_code(c, form, names, out);
  }
}

}  // namespace kb::emit
