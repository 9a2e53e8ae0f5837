// The emitted `Readings` and `Perception`: see runtime/readings.h and runtime/perception.h.
#include <fmt/format.h>

#include <algorithm>

#include "compiler/emit/cpp.h"
#include "compiler/tables/perception.h"

namespace kb::emit {
namespace {

using Out = std::back_insert_iterator<std::string>;
using I = tables::PerceptionForm::I;

const char* truth(bool value) { return value ? "true" : "false"; }

/// A text of the knowledge base as a C++ literal. The lexer has refused quotes and control characters.
std::string literal(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '\\' || c == '"' || c == '?') out += '\\';
    out += c;
  }
  return out + '"';
}

class SensesPrinter {
 public:
  SensesPrinter(const CppInput& in, std::string& out)
      : in_(in), from_(in.program.perception), form_(tables::build_perception(in.program)), out_(out) {}

  void declare() {
    Scope scope{"store_", "store", "Readings", "Store"};
    for (const program::Sensor& sensor : from_.sensors) {
      names_.push_back(scope.make(sensor.name));
      if (sensor.text) declare_texts(sensor, in_.types.texts[names_.size() - 1]);
    }
    line("/// What the sensors said last, and when: `readings.name = {{value, instant}}`. A reading stays until the next one.");
    line("struct Readings {{\n  using Store = mts::ReadingStore<{}>;\n", std::max(form_.shape.readings, 1u));
    line("  union {{\n    Store store_;");
    for (std::size_t s = 0; s < from_.sensors.size(); ++s) slot(from_.sensors[s], s);
    line("  }};\n\n  Readings() : store_() {{}}\n  Readings(const Readings& other_) : store_(other_.store_) {{}}");
    line("  Readings& operator=(const Readings& other_) {{\n    store_ = other_.store_;\n    return *this;\n  }}");
    line("  [[nodiscard]] const Store& store() const {{ return store_; }}\n}};\n");
    description();
  }

  void tables() {
    line("// ---- perception\nnamespace {{\n");
    rows("mts::Sensor", "kSensors", form_.sensors.size(), [&](std::size_t i) {
      const mts::Sensor& x = form_.sensors[i];
      const auto f = float_constant;
      return fmt::format("{{{}, {}, {}, {}, {}, {}, {}{}}},  // {}", f(x.low), f(x.high), f(x.period), f(x.noise), f(x.growth), f(x.stale_s),
                         truth(x.text), x.strict ? ", true" : "", from_.sensors[i].name);
    });
    rows("mts::Membership", "kPrototypes", form_.prototypes.size(), [&](std::size_t i) {
      return fmt::format("{},  // {}", membership_row(form_.prototypes[i]), from_.prototypes[i].text);
    });
    numbers("kSensorOf", form_.sensor_of);
    numbers("kFitsBegin", form_.fits_begin);
    rows("mts::FitRow<Senses::Index>", "kFits", form_.fits.size(), [&](std::size_t i) {
      return fmt::format("{{{}, {}}},  // {}", form_.fits[i].reading, form_.fits[i].prototype, from_.reading_name(form_.fits[i].reading));
    });
    rows("Senses::Index", "kPerceived", form_.fact.size(), [&](std::size_t i) {
      return fmt::format("static_cast<Senses::Index>(Fact::{}),", in_.names.facts[form_.fact[i]]);
    });
    numbers("kStepsBegin", form_.steps_begin);
    steps();
    lazy();
    assembly();
  }

 private:
  template <class... T>
  void line(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(Out(out_), format, std::forward<T>(values)...);
    out_ += '\n';
  }
  template <class F>
  void rows(std::string_view type, std::string_view name, std::size_t count, F&& row) { emit_array(out_, type, name, count, row); }
  void numbers(std::string_view name, const std::vector<I>& values) { emit_numbers(out_, "Senses::Index", name, values); }

  void declare_texts(const program::Sensor& sensor, const std::string& name) {
    line("/// What is asked of `{}`, in ascending order.", sensor.name);
    line("struct {} {{\n  static constexpr std::uint32_t kCount = {};", name, sensor.texts.size());
    out_ += "  static constexpr const char* kTexts[] = {";
    for (const std::string& text : sensor.texts) out_ += literal(text) + ", ";
    line("nullptr}};\n}};\n");
  }

  void slot(const program::Sensor& sensor, std::size_t s) {
    if (sensor.text) {
      line("    mts::TextSlot<Store, {}, {}, ::{}::{}> {};", sensor.first, sensor.array ? sensor.count : 1, in_.options.name_space, in_.types.texts[s],
           names_[s]);   // a sensor may have the name that is the type of another one
    } else if (sensor.array) {
      line("    mts::NumberArray<Store, {}, {}> {};  // {}", sensor.first, sensor.count, names_[s], fuzzy::range_text(sensor.low, sensor.high, sensor.unit, sensor.circular));
    } else {
      line("    mts::NumberSlot<Store, {}> {};  // {}", sensor.first, names_[s], fuzzy::range_text(sensor.low, sensor.high, sensor.unit, sensor.circular));
    }
  }

  void description() {
    line("/// The perception as the runtime takes it.");
    line("struct Senses {{\n  using Index = {};", form_.steps.size() < 60000 && in_.tables.narrow ? "std::uint16_t" : "std::uint32_t");
    line("  using Knowledge = ::{0}::Knowledge;\n  using Readings = ::{0}::Readings;", in_.options.name_space);
    line("  static constexpr std::uint32_t kAbi = {};", mts::kAbi);
    line("  static constexpr mts::PerceptionShape kShape = {{.readings = {}, .fits = {}, .facts = {}, .lazy = {}}};", form_.shape.readings,
         form_.shape.fits, form_.shape.facts, form_.shape.lazy);
    line("  static const mts::PerceptionTables<Index> kTables;\n}};\n\nusing Perception = mts::Perception<Senses>;\n");
  }

  void steps() {
    constexpr std::string_view kWords[] = {"kFits", "kReads", "kFact", "kNot", "kAnd", "kOr"};
    static_assert(std::size(kWords) == static_cast<std::size_t>(mts::PerceptOp::kOr) + 1);
    line("constexpr mts::PerceptStep<Senses::Index> kSteps[] = {{");
    for (std::size_t f = 0; f < form_.fact.size(); ++f) {
      line("    // {} = {}", in_.program.cells[form_.fact[f]].name, program::percept_text(in_.program, from_.perceived[f].percept));
      for (I s = form_.steps_begin[f]; s < form_.steps_begin[f + 1]; ++s) {
        line("    {{mts::PerceptOp::{}, {}}},", kWords[static_cast<std::size_t>(form_.steps[s].op)], form_.steps[s].argument);
      }
    }
    out_ += "};\n\n";
  }

  void lazy() {
    if (form_.lazy.empty()) return;
    rows("std::uint8_t", "kLazy", form_.lazy.size(), [&](std::size_t i) { return fmt::format("{},", form_.lazy[i]); });
    numbers("kUsesBegin", form_.uses_begin);
    numbers("kUses", form_.uses);
    numbers("kAlternativesBegin", form_.alternatives_begin);
    numbers("kDemandsBegin", form_.demands_begin);
    rows("mts::Demand<Senses::Index>", "kDemands", form_.demands.size(), [&](std::size_t i) {
      const mts::Demand<I>& x = form_.demands[i];
      return fmt::format("{{{}, {}, {}}},  // {}", x.cell, x.term, truth(x.negated), in_.program.cells[x.cell].name);
    });
  }

  void assembly() {
    const auto field = [&](std::string_view name, bool there, std::string_view array) {
      line("    .{} = {},", name, there ? array : "nullptr");
    };
    line("}}  // namespace\n\nconstexpr mts::PerceptionTables<Senses::Index> Senses::kTables = {{\n    .abi = Senses::kAbi,\n    .shape = Senses::kShape,");
    field("sensors", !form_.sensors.empty(), "kSensors");
    field("sensor_of", !form_.sensor_of.empty(), "kSensorOf");
    field("prototypes", !form_.prototypes.empty(), "kPrototypes");
    field("fits_begin", true, "kFitsBegin");
    field("fits", !form_.fits.empty(), "kFits");
    field("fact", true, "kPerceived");
    field("steps_begin", true, "kStepsBegin");
    field("steps", true, "kSteps");
    const bool lazy = !form_.lazy.empty();
    field("lazy", lazy, "kLazy");
    field("uses_begin", lazy, "kUsesBegin");
    field("uses", lazy && !form_.uses.empty(), "kUses");
    field("alternatives_begin", lazy, "kAlternativesBegin");
    field("demands_begin", lazy, "kDemandsBegin");
    field("demands", lazy && !form_.demands.empty(), "kDemands");
    line("}};\n");
  }

  const CppInput& in_;
  const program::Perception& from_;
  tables::PerceptionForm form_;
  std::string& out_;
  std::vector<std::string> names_;  // by sensor
};

}  // namespace

bool has_perception(const CppInput& in) {
  return !in.program.perception.perceived.empty();
}

void emit_readings(const CppInput& in, std::string& out) { SensesPrinter(in, out).declare(); }
void emit_perception(const CppInput& in, std::string& out) { SensesPrinter(in, out).tables(); }

}  // namespace kb::emit
