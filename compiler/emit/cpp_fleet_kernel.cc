// The steps of a fleet's kernel as C++: an expression where a value is used once, a constant with a name where it is used
// more often or is what a rule fires by. Planes are read where they are asked, as long as none has been stored: there are
// many more than registers, and a value that is kept would go to the stack and back.
#include <fmt/format.h>

#include "compiler/emit/cpp_fleet.h"

namespace kb::emit {
namespace {

using Out = std::back_insert_iterator<std::string>;
using tables::FleetStep;
using tables::Ref;
using StepKind = FleetStep::Kind;

/// An expression is not nested deeper, for the reader's sake.
constexpr int kMostNested = 6;

class KernelPrinter {
 public:
  KernelPrinter(const FleetInput& in, std::string& out) : in_(in), out_(out), steps_(in.form.steps), uses_(steps_.size(), 0), depth_(steps_.size(), 0) {
    for (const FleetStep& step : steps_) {
      for (const Ref ref : {step.a, step.b, step.c}) ++uses_[ref >> 1];
    }
    // What nobody uses does not count as a use either.
    for (std::size_t i = steps_.size(); i-- > 0;) {
      if (!idle(i)) continue;
      for (const Ref ref : {steps_[i].a, steps_[i].b, steps_[i].c}) --uses_[ref >> 1];
    }
  }

  void print() {
    for (std::size_t i = 1; i < steps_.size(); ++i) {
      if (!storing_ && stores(steps_[i].kind)) keep_loads(i);
      step(i);
    }
    if (in_traced_) out_ += "  }\n";
  }

 private:
  template <class... T>
  void line(fmt::format_string<T...> format, T&&... values) {
    out_ += in_traced_ ? "    " : "  ";
    fmt::format_to(Out(out_), format, std::forward<T>(values)...);
    out_ += '\n';
  }

  static bool combines(StepKind kind) { return kind == StepKind::kAnd || kind == StepKind::kOr || kind == StepKind::kAndNot; }
  static bool stores(StepKind kind) { return kind == StepKind::kStore || kind == StepKind::kPut || kind == StepKind::kTraced; }
  /// From here on planes change: what is asked of them later is read now.
  void keep_loads(std::size_t first) {
    std::vector<bool> asked(steps_.size(), false);
    const auto ask = [&](Ref ref, const auto& self) -> void {
      const std::size_t i = ref >> 1;
      if (asked[i] || (i < first && !is_inline(i) && steps_[i].kind != StepKind::kLoad)) return;
      asked[i] = true;
      for (const Ref part : {steps_[i].a, steps_[i].b}) {
        if (combines(steps_[i].kind)) self(part, self);
      }
    };
    for (std::size_t i = first; i < steps_.size(); ++i) {
      for (const Ref ref : {steps_[i].a, steps_[i].b, steps_[i].c}) ask(ref, ask);
    }
    storing_ = true;
    for (std::size_t i = 1; i < first; ++i) {
      if (asked[i] && steps_[i].kind == StepKind::kLoad) line("const V {} = {};", in_.names.steps[i], load(i));
    }
  }
  [[nodiscard]] std::string load(std::size_t i) const { return "word.load(Plane::" + in_.names.planes[steps_[i].what] + ")"; }

  [[nodiscard]] bool idle(std::size_t i) const {
    const StepKind kind = steps_[i].kind;
    return uses_[i] == 0 && (combines(kind) || kind == StepKind::kLoad || kind == StepKind::kLater);
  }
  [[nodiscard]] bool is_inline(std::size_t i) const {
    return combines(steps_[i].kind) && uses_[i] == 1 && depth_[i] < kMostNested;
  }

  std::string value(Ref ref, bool nested = true) const {
    if (ref == tables::kZeros) return "all_of(false)";
    if (ref == tables::kOnes) return "all_of(true)";
    const std::size_t i = ref >> 1;
    const bool negated = (ref & 1u) != 0;
    if (steps_[i].kind == StepKind::kLoad && !storing_) return (negated ? "~" : "") + load(i);
    if (!is_inline(i)) return (negated ? "~" : "") + in_.names.steps[i];
    const std::string text = expression(i);
    return negated ? "~(" + text + ")" : nested ? "(" + text + ")" : text;
  }
  std::string expression(std::size_t i) const {
    const FleetStep& s = steps_[i];
    const char* sign = s.kind == StepKind::kOr ? " | " : " & ";
    const Ref second = s.kind == StepKind::kAndNot ? s.b ^ 1u : s.b;
    return operand(s.a, s.kind) + sign + operand(second, s.kind);
  }
  /// `a & b & c` needs no parentheses.
  std::string operand(Ref ref, StepKind within) const {
    const std::size_t i = ref >> 1;
    const bool ors = within == StepKind::kOr;
    const bool same = combines(steps_[i].kind) && (steps_[i].kind == StepKind::kOr) == ors;
    return value(ref, !same);
  }

  void step(std::size_t i) {
    const FleetStep& s = steps_[i];
    for (const Ref ref : {s.a, s.b, s.c}) {
      if (combines(s.kind) && is_inline(ref >> 1)) depth_[i] = std::max(depth_[i], depth_[ref >> 1] + 1);
    }
    const std::string& name = in_.names.steps[i];
    switch (s.kind) {
      case StepKind::kZero: return;
      case StepKind::kLevel: return line("\n  // ---- level {}", in_.program.levels[s.what]);
      case StepKind::kFire: return remark(s);
      case StepKind::kLoad:
        if (uses_[i] > 0 && storing_) line("const V {} = {};", name, load(i));
        return;
      case StepKind::kLater:
        if (uses_[i] > 0) line("const V {} = word.later();", name);
        return;
      case StepKind::kAnd:
      case StepKind::kOr:
      case StepKind::kAndNot:
        if (uses_[i] > 0 && !is_inline(i)) line("const V {} = {};", name, expression(i));
        return;
      case StepKind::kTimer: return timer(i);
      case StepKind::kHold:
        return line("const V {} = word.hold({}, {}, {}, {}, {});", name, s.what, in_.tables.shape.queues, value(s.a, false), value(s.b), value(s.c));
      case StepKind::kStore: return line("word.store(Plane::{}, {});", in_.names.planes[s.what], value(s.a, false));
      case StepKind::kPut: return line("word.put(Plane::{}, {});", in_.names.planes[s.what], value(s.a, false));
      case StepKind::kFallBack: return line("\n  word.fall_back({});\n", value(s.a, false));
      case StepKind::kTraced:
        line("if constexpr (kTraced) {{");
        in_traced_ = true;
        return;
    }
  }

  void remark(const FleetStep& s) {
    const program::Rule& rule = in_.program.rules[s.what];
    line("// {}: {}  {}", s.a == tables::kZeros ? "never" : value(s.a, false), rule.name, in_.program.at(rule));
  }

  void timer(std::size_t i) {
    const FleetStep& s = steps_[i];
    const std::uint32_t queue = in_.tables.timers[s.what].queue;
    line("const V {} = word.timer({}, {}, {}, {}, {});  // for {} ms", in_.names.steps[i], s.what, queue, value(s.a, false),
         value(s.b), value(s.c), in_.tables.queue_us[queue] / 1000.0);
  }

  const FleetInput& in_;
  std::string& out_;
  const std::vector<FleetStep>& steps_;
  std::vector<std::uint32_t> uses_;
  std::vector<int> depth_;   // of nested expressions
  bool in_traced_ = false, storing_ = false;
};

}  // namespace

void emit_fleet_kernel(const FleetInput& in, std::string& out) {
  out +=
      "/// One tick of a word of robots.\n"
      "template <bool kTraced>\n"
      "bool tick_word([[maybe_unused]] const mts::FleetTick& tick, const mts::FleetBlock& block, std::uint32_t number) {\n"
      "  Word word(tick, block, number);\n";
  KernelPrinter(in, out).print();
  out +=
      "  return word.changed();\n"
      "}\n\n"
      "template <bool kTraced>\n"
      "void tick_block(const mts::FleetTick& tick, mts::FleetBlock& block) {\n"
      "  bool changed = false;\n"
      "  for (std::uint32_t word = 0; word < mts::kPlaneWords / kWidthWords; ++word) {\n"
      "    changed = tick_word<kTraced>(tick, block, word) || changed;\n"
      "  }\n"
      "  block.changed = changed;\n"
      "}\n\n";
}

}  // namespace kb::emit
