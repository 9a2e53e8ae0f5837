// The steps of a fleet's kernel as C++: an expression where a value is used once, a constant with a name where it is used
// more often or is what a rule fires by. What has been stored is read from its plane: there are many more values than
// registers, and a value that is kept would go to the stack and back.
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
/// Uses of a value for which it is made again.
constexpr std::uint32_t kMostRecomputed = 2;

class KernelPrinter {
 public:
  KernelPrinter(const FleetInput& in, std::string& out) : in_(in), out_(out), steps_(in.form.steps), uses_(steps_.size(), 0), named_(steps_.size(), false), recomputed_(steps_.size(), false), made_again_(steps_.size(), false) {
    for (const FleetStep& step : steps_) {
      for (const Ref ref : {step.a, step.b, step.c}) ++uses_[ref >> 1];
    }
    // What nobody uses does not count as a use either.
    for (std::size_t i = steps_.size(); i-- > 0;) {
      if (!idle(i)) continue;
      for (const Ref ref : {steps_[i].a, steps_[i].b, steps_[i].c}) --uses_[ref >> 1];
    }
    find_recomputed();
  }

  /// Printed until it is known which values are asked for when no plane has them: those need names.
  void print() {
    const std::size_t begin = out_.size();
    do {
      out_.resize(begin);
      again_ = in_traced_ = contests_ = false;
      depth_.assign(steps_.size(), 0);
      home_.assign(steps_.size(), {});
      holds_.assign(in_.form.planes.size(), 0);
      for (std::size_t i = 1; i < steps_.size(); ++i) step(i);
    } while (again_);
    if (in_traced_) out_ += "  }\n";
  }

 private:
  /// The plane that has a step's value, or its complement.
  struct Home { std::uint32_t plane = kNowhere; Ref ref = tables::kZeros; };
  static constexpr std::uint32_t kNowhere = 0xFFFF'FFFFu;

  template <class... T>
  void line(fmt::format_string<T...> format, T&&... values) {
    out_ += in_traced_ ? "    " : "  ";
    fmt::format_to(Out(out_), format, std::forward<T>(values)...);
    out_ += '\n';
  }

  static bool waits(StepKind kind) { return kind == StepKind::kTimer || kind == StepKind::kHold; }
  static bool combines(StepKind kind) { return kind == StepKind::kAnd || kind == StepKind::kOr || kind == StepKind::kAndNot; }
  [[nodiscard]] bool idle(std::size_t i) const {
    const StepKind kind = steps_[i].kind;
    return uses_[i] == 0 && (combines(kind) || kind == StepKind::kLoad || kind == StepKind::kLater);
  }
  [[nodiscard]] bool is_inline(std::size_t i) const {
    return combines(steps_[i].kind) && (uses_[i] == 1 || made_again_[i]) && !named_[i] && depth_[i] < kMostNested;
  }
  /// A value that another level changes before it counts, and that is one operation away from what is in memory, is made where it is
  /// used rather than stored.
  void find_recomputed() {
    std::vector<bool> later(in_.form.planes.size(), false);   // by plane: another value is stored there
    for (std::size_t i = steps_.size(); i-- > 0;) {
      if (steps_[i].kind != StepKind::kPut) continue;
      const std::size_t value = steps_[i].a >> 1;
      recomputed_[i] = later[steps_[i].what] && combines(steps_[value].kind) && steps_[steps_[value].a >> 1].kind == StepKind::kLoad &&
                       uses_[value] <= 1 + kMostRecomputed;
      if (recomputed_[i]) made_again_[value] = true;
      later[steps_[i].what] = true;
    }
  }

  [[nodiscard]] const std::string& plane(std::uint32_t plane) const { return in_.names.planes[plane]; }

  std::string value(Ref ref, bool nested = true) {
    if (ref == tables::kZeros) return "all_of(false)";
    if (ref == tables::kOnes) return "all_of(true)";
    const std::size_t i = ref >> 1;
    const bool negated = (ref & 1u) != 0;
    const FleetStep& s = steps_[i];
    if (s.kind == StepKind::kLoad) return fmt::format("{}word.{}(Plane::{})", negated ? "~" : "", s.what < in_.form.given ? "given" : "before", plane(s.what));
    if (home_[i].plane != kNowhere) return fmt::format("{}word.now(Plane::{})", home_[i].ref != ref ? "~" : "", plane(home_[i].plane));
    if (is_inline(i)) {
      const std::string text = expression(i);
      return negated ? "~(" + text + ")" : nested ? "(" + text + ")" : text;
    }
    if (!named_[i] && s.kind != StepKind::kLater) named_[i] = again_ = true;
    return (negated ? "~" : "") + in_.names.steps[i];
  }
  /// What is stored needs no name if nobody asked for it before.
  std::string stored_value(Ref ref) {
    const std::size_t i = ref >> 1;
    if (named_[i] || home_[i].plane != kNowhere) return value(ref, false);
    if (waits(steps_[i].kind)) return (ref & 1u) != 0 ? "~" + timer(i) : timer(i);
    if (!combines(steps_[i].kind)) return value(ref, false);
    return (ref & 1u) != 0 ? "~(" + expression(i) + ")" : expression(i);
  }
  std::string expression(std::size_t i) {
    const FleetStep& s = steps_[i];
    const char* sign = s.kind == StepKind::kOr ? " | " : " & ";
    const Ref second = s.kind == StepKind::kAndNot ? s.b ^ 1u : s.b;
    std::string text = operand(s.a, s.kind);
    return text + sign + operand(second, s.kind);
  }
  /// `a & b & c` needs no parentheses.
  std::string operand(Ref ref, StepKind within) {
    const std::size_t i = ref >> 1;
    const bool ors = within == StepKind::kOr;
    const bool same = combines(steps_[i].kind) && (steps_[i].kind == StepKind::kOr) == ors;
    return value(ref, !same);
  }

  /// From here on the value stands in the plane, and what stood there does not.
  void move_in(Ref ref, std::uint32_t plane) {
    if (const std::size_t before = holds_[plane]; home_[before].plane == plane) home_[before] = {};
    const std::size_t i = ref >> 1;
    holds_[plane] = i;
    if (i != 0 && home_[i].plane == kNowhere) home_[i] = {plane, ref};
  }

  void step(std::size_t i) {
    const FleetStep& s = steps_[i];
    for (const Ref ref : {s.a, s.b, s.c}) {
      if (combines(s.kind) && is_inline(ref >> 1)) depth_[i] = std::max(depth_[i], depth_[ref >> 1] + 1);
    }
    switch (s.kind) {
      case StepKind::kZero:
      case StepKind::kLoad: return;
      case StepKind::kLevel: return line("\n  // ---- level {}\n  word.settle();", in_.program.levels[s.what]);
      case StepKind::kFire: return remark(s);
      case StepKind::kLater:
        if (uses_[i] > 0) line("const V {} = word.later();", in_.names.steps[i]);
        return;
      case StepKind::kAnd:
      case StepKind::kOr:
      case StepKind::kAndNot:
        if (uses_[i] > 0 && named_[i]) line("const V {} = {};", in_.names.steps[i], expression(i));
        return;
      case StepKind::kTimer:
      case StepKind::kHold:
        if (named_[i]) line("const V {} = {};", in_.names.steps[i], timer(i));
        return;
      case StepKind::kPut:
        if (recomputed_[i]) return;
        line("word.put(Plane::{}, {});{}", plane(s.what), stored_value(s.a), duration(s.a >> 1));
        return move_in(s.a, s.what);
      case StepKind::kFallBack:
        contests_ = true;
        return line("word.contest({});", value(s.a, false));
      case StepKind::kTraced:
        fall_back();
        line("if constexpr (kTraced) {{");
        in_traced_ = true;
        return;
    }
  }

  void fall_back() {
    if (contests_) line("\n  word.fall_back();\n");
  }

  void remark(const FleetStep& s) {
    const program::Rule& rule = in_.program.rules[s.what];
    const std::size_t i = s.a >> 1;
    const bool said = s.a == tables::kZeros || steps_[i].kind == StepKind::kLoad || home_[i].plane != kNowhere || named_[i];
    line("// {}: {}  {}", s.a == tables::kZeros ? "never" : said ? value(s.a, false) : "below", rule.name, in_.program.at(rule));
  }

  std::string timer(std::size_t i) {
    const FleetStep& s = steps_[i];
    const bool hold = s.kind == StepKind::kHold;
    const std::uint32_t queue = hold ? in_.tables.shape.queues : in_.tables.timers[s.what].queue;
    return fmt::format("word.{}({}, {}, {}, {}, {})", hold ? "hold" : "timer", s.what, queue, value(s.a, false), value(s.b, false), value(s.c, false));
  }
  [[nodiscard]] std::string duration(std::size_t i) const {
    if (steps_[i].kind != StepKind::kTimer) return {};
    return fmt::format("  // for {} ms", in_.tables.queue_us[in_.tables.timers[steps_[i].what].queue] / 1000.0);
  }

  const FleetInput& in_;
  std::string& out_;
  const std::vector<FleetStep>& steps_;
  std::vector<std::uint32_t> uses_;
  std::vector<bool> named_;           // by step
  std::vector<bool> recomputed_;      // by step: is not stored
  std::vector<bool> made_again_;      // by step: its value is not stored, but made where it is used
  std::vector<int> depth_;            // by step: of nested expressions
  std::vector<Home> home_;            // by step
  std::vector<std::size_t> holds_;    // by plane: the step whose value it has
  bool in_traced_ = false, contests_ = false, again_ = false;
};

}  // namespace

void emit_fleet_kernel(const FleetInput& in, std::string& out) {
  out +=
      "/// One tick of a word of robots.\n"
      "template <bool kTraced>\n"
      "void tick_word([[maybe_unused]] const mts::FleetTick& tick, const mts::FleetBlock& block, std::uint32_t number) {\n"
      "  Word word(tick, block, number);\n";
  KernelPrinter(in, out).print();
  out +=
      "}\n\n"
      "template <bool kTraced>\n"
      "void tick_block(const mts::FleetTick& tick, const mts::FleetBlock& block) {\n"
      "  for (std::uint32_t word = 0; word < mts::kPlaneWords / kWidthWords; ++word) tick_word<kTraced>(tick, block, word);\n"
      "}\n\n";
}

}  // namespace kb::emit
