// The steps of a fleet's kernel as C++. A value that is used once is an expression; a value that is used more often, or by which a rule
// fires, is a constant with a name. A value that has been stored is read from its plane again: there are many more values than registers,
// so a value that was kept would go to the stack and back.
//
// note [which values have names]
// A value has a name if it is needed where no plane has it and where it is not just a part of one expression. Which steps need it depends on
// where their own text stands: at the step if it has a name, otherwise where it is stored, or within another step's text. So the names are
// decided before anything is printed, in one pass from the last step to the first. Printing again until no more names turn up would take a
// pass for each piece of a long condition.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "compiler/emit/cpp_fleet.h"

namespace kb::emit {
namespace {

using Out = std::back_insert_iterator<std::string>;
using tables::FleetStep;
using tables::Ref;
using StepKind = FleetStep::Kind;

/// Expressions are not nested deeper than this, so that they can be read.
constexpr int kMostNested = 6;
/// A value with at most so many uses may be computed again for each of them.
constexpr std::uint32_t kMostRecomputed = 2;

class KernelPrinter {
 public:
  KernelPrinter(const FleetInput& in, std::string& out)
      : in_(in), out_(out), steps_(in.form.steps), uses_(steps_.size(), 0), named_(steps_.size(), false), recomputed_(steps_.size(), false),
        made_again_(steps_.size(), false), depth_(steps_.size(), 0), stays_(steps_.size()) {
    for (const FleetStep& step : steps_) {
      for (const Ref ref : {step.a, step.b, step.c}) ++uses_[ref >> 1];
    }
    // A step that nobody uses does not count as a use.
    for (std::size_t i = steps_.size(); i-- > 0;) {
      if (!idle(i)) continue;
      for (const Ref ref : {steps_[i].a, steps_[i].b, steps_[i].c}) --uses_[ref >> 1];
    }
    find_recomputed();
    find_stays();
    nest();
    decide_names();
  }

  void print() {
    for (now_ = 1; now_ < steps_.size(); ++now_) step(now_);
    if (in_traced_) out_ += "  }\n";
  }

 private:
  /// A plane that has a step's value, or its complement, from the step `after` to the step `last`.
  struct Stay { std::uint32_t plane; Ref ref; std::size_t after, last; };
  static constexpr std::size_t kToTheEnd = std::numeric_limits<std::size_t>::max();

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
    return combines(steps_[i].kind) && (uses_[i] == 1 || made_again_[i]) && depth_[i] < kMostNested;
  }
  /// Finds values that are computed where they are used instead of being stored: a later level stores another value there, and they are only
  /// one operation away from what is in memory.
  void find_recomputed() {
    std::vector<bool> later(in_.form.planes.size(), false);   // by plane: a later step stores another value there
    for (std::size_t i = steps_.size(); i-- > 0;) {
      if (steps_[i].kind != StepKind::kPut) continue;
      const std::size_t value = steps_[i].a >> 1;
      recomputed_[i] = later[steps_[i].what] && combines(steps_[value].kind) && steps_[steps_[value].a >> 1].kind == StepKind::kLoad &&
                       uses_[value] <= 1 + kMostRecomputed;
      if (recomputed_[i]) made_again_[value] = true;
      later[steps_[i].what] = true;
    }
  }

  /// Finds which plane has which value, and for how long: until something else is stored there.
  void find_stays() {
    std::vector<std::size_t> holds(in_.form.planes.size(), 0);   // by plane: the step whose value it has
    for (std::size_t i = 1; i < steps_.size(); ++i) {
      const FleetStep& s = steps_[i];
      if (s.kind != StepKind::kPut || recomputed_[i]) continue;
      const std::size_t value = s.a >> 1;
      std::vector<Stay>& before = stays_[std::exchange(holds[s.what], value)];
      if (!before.empty() && before.back().plane == s.what && before.back().last == kToTheEnd) before.back().last = i;
      const bool has_one = !stays_[value].empty() && stays_[value].back().last == kToTheEnd;
      if (value != 0 && !has_one) stays_[value].push_back({s.what, s.a, i, kToTheEnd});
    }
  }
  [[nodiscard]] const Stay* home(std::size_t i, std::size_t at) const {
    const auto after = std::partition_point(stays_[i].begin(), stays_[i].end(), [at](const Stay& stay) { return stay.after < at; });
    return after != stays_[i].begin() && at <= std::prev(after)->last ? &*std::prev(after) : nullptr;
  }

  void nest() {
    for (std::size_t i = 1; i < steps_.size(); ++i) {
      if (!combines(steps_[i].kind)) continue;
      for (const Ref ref : {steps_[i].a, steps_[i].b}) {
        if (is_inline(ref >> 1)) depth_[i] = std::max(depth_[i], depth_[ref >> 1] + 1);
      }
    }
  }

  // See note [which values have names].
  void decide_names() {
    std::vector<std::vector<std::size_t>> asked(steps_.size()), stored(steps_.size());   // by step: at which steps, where no plane has it
    const auto ask = [&](std::vector<std::vector<std::size_t>>& list, Ref ref, std::size_t at) {
      if (home(ref >> 1, at) == nullptr) list[ref >> 1].push_back(at);
    };
    for (std::size_t i = steps_.size(); i-- > 1;) {
      const FleetStep& s = steps_[i];
      if (s.kind == StepKind::kPut && !recomputed_[i]) ask(stored, s.a, i);
      if (s.kind == StepKind::kFallBack || s.kind == StepKind::kWake) ask(asked, s.a, i);
      if (s.kind == StepKind::kLater) named_[i] = !asked[i].empty() || !stored[i].empty();
      if (!combines(s.kind) && !waits(s.kind)) continue;
      named_[i] = !asked[i].empty() && !is_inline(i);
      std::vector<std::size_t> made = std::move(asked[i]);   // the steps where its text stands
      if (named_[i]) made = {i};
      else made.insert(made.end(), stored[i].begin(), stored[i].end());
      for (const std::size_t at : made) {
        for (const Ref ref : {s.a, s.b, s.c}) ask(asked, ref, at);
      }
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
    if (const Stay* in = home(i, now_)) return fmt::format("{}word.now(Plane::{})", in->ref != ref ? "~" : "", plane(in->plane));
    if (is_inline(i)) {
      const std::string text = expression(i);
      return negated ? "~(" + text + ")" : nested ? "(" + text + ")" : text;
    }
    return (negated ? "~" : "") + in_.names.steps[i];
  }
  /// The value to be stored. It needs no name if nobody has needed it before.
  std::string stored_value(Ref ref) {
    const std::size_t i = ref >> 1;
    if (named_[i] || home(i, now_) != nullptr) return value(ref, false);
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

  void step(std::size_t i) {
    const FleetStep& s = steps_[i];
    switch (s.kind) {
      case StepKind::kZero:
      case StepKind::kLoad: return;
      case StepKind::kLevel: return line("\n  // ---- level {}\n  word.settle();", in_.program.levels[s.what]);
      case StepKind::kFire: return remark(s);
      case StepKind::kLater:
        if (named_[i]) line("const V {} = word.later();", in_.names.steps[i]);
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
        if (!recomputed_[i]) line("word.put(Plane::{}, {});{}", plane(s.what), stored_value(s.a), duration(s.a >> 1));
        return;
      case StepKind::kFallBack:
        contests_ = true;
        return line("word.contest({});", value(s.a, false));
      case StepKind::kWake: return line("\n  if (word.wakes({}, oldest)) return false;\n", value(s.a, false));
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
    const bool said = s.a == tables::kZeros || steps_[i].kind == StepKind::kLoad || home(i, now_) != nullptr || named_[i];
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
  std::vector<bool> made_again_;      // by step: its value is computed where it is used
  std::vector<int> depth_;            // by step: how deep its expression nests
  std::vector<std::vector<Stay>> stays_;   // by step, in order
  std::size_t now_ = 0;               // the step that is being printed
  bool in_traced_ = false, contests_ = false;
};

/// The kernel for words whose planes at rest rest: see note [planes at rest] in compiler/tables/fleet_rest.h.
void emit_resting(const FleetInput& in, std::string& out) {
  FleetInput resting = in;
  resting.form.steps = in.form.resting;
  resting.names = make_fleet_names(in.program, resting.form);
  out +=
      "/// The same where all planes from busy_planes on are at rest. False if one of them wakes: then the word is as it was.\n"
      "[[gnu::always_inline]] inline bool tick_resting(const mts::FleetTick& tick, const mts::FleetBlock& block, std::uint32_t number) {\n"
      "  Word word(tick, block, number);\n";
  const bool wakes = std::ranges::any_of(resting.form.steps, [](const FleetStep& step) { return step.kind == StepKind::kWake; });
  if (wakes) out += "  const Word::Oldest oldest = word.oldest();\n";
  KernelPrinter(resting, out).print();
  out +=
      "  word.fall_back();\n"
      "  return true;\n"
      "}\n\n"
      "void tick_resting_block(const mts::FleetTick& tick, const mts::FleetBlock& block) {\n"
      "  for (std::uint32_t word = 0; word < mts::kPlaneWords / kWidthWords; ++word) {\n"
      "    if (tick_resting(tick, block, word)) continue;\n"
      "    tick_word<false>(tick, block, word);\n"
      "    *block.woke = true;\n"
      "  }\n"
      "}\n\n";
}

}  // namespace

void emit_fleet_kernel(const FleetInput& in, std::string& out) {
  out +=
      "/// One tick of a word of robots.\n"
      "template <bool kTraced>\n"
      "void tick_word([[maybe_unused]] const mts::FleetTick& tick, const mts::FleetBlock& block, std::uint32_t number) {\n"
      "  Word word(tick, block, number);\n";
  KernelPrinter(in, out).print();
  out +=
      "}\n\n";
  if (!in.form.resting.empty()) emit_resting(in, out);
  out +=
      "template <bool kTraced>\n"
      "void tick_block(const mts::FleetTick& tick, const mts::FleetBlock& block) {\n"
      "  for (std::uint32_t word = 0; word < mts::kPlaneWords / kWidthWords; ++word) tick_word<kTraced>(tick, block, word);\n"
      "}\n\n";
}

}  // namespace kb::emit
