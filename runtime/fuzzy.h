// Fuzzy control: from a few numbers to a few numbers by rules such as `bearing is left and free[2] is yes -> turn = 45`.
//
//   inputs ──▶ degrees: how well each number fits each word ──▶ strengths of the rules ──▶ outputs: a mean of what they say
//
// From each `fuzzy` block of a knowledge base kbc makes constants of the kinds below, and a class with a typed interface. A program
// calls `route1::GoToGoal::evaluate(in)` and sees nothing of this file. There are two ways to evaluate, whose results have the same
// bits: `evaluate` here walks the constants (small code, any number of rules), and kbc writes the rules out as straight C++ with the
// helpers here (faster). No heap, no exceptions, no recursion, no libm; the constants bound all loops.
//
// compiler/fuzzy/interpret.h and docs/fuzzy_control.md say step by step what is computed. Everything is `float`,
// in one fixed order of operations; see note [a bound in ulp] for what that promises. Rules: Takagi and Sugeno, 1985.
//
// note [errors of a fuzzy controller]
//   Degrees are within the bounds of `mu` in shape.h, 2e-7 for most. `and` and `or` add one rounding for each pair (min and
//   max none). With n rules that fire and values of size at most V, the mean is within (n + 4 c) * 1.2e-7 * V of exact
//   arithmetic, c the parts of the longest condition, as long as the strengths of the rules that fire add up to about 1; it
//   grows as 1 / that sum, because the mean divides by it. Where two rules are equally strong to the last bits, `winner` and
//   `within` may choose the one or the other. The tests of emitted controllers hold this bound.
#pragma once

#include <cstdint>

#include "shape.h"

namespace mts {

/// In order of severity: an evaluation has the highest status that applies. Whatever it is, the outputs lie in their ranges.
enum class FuzzyStatus : std::uint8_t {
  kOk,
  kInputClamped,   ///< an input lay outside its range: the nearest number of the range was taken
  kOutputClamped,  ///< the answer of the rules lay outside an output's range: the nearest number of the range was taken
  kNoRule,         ///< no rule that fires writes an output: it has its default
  kBadInput,       ///< an input was NaN or infinite: all outputs have their defaults
};

// As in runtime/status.h.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wswitch-default"
/// A word for logs: "ok", "input_clamped", ... Static text.
[[nodiscard]] constexpr const char* text(FuzzyStatus status) noexcept {
  switch (status) {
    case FuzzyStatus::kOk: return "ok";
    case FuzzyStatus::kInputClamped: return "input_clamped";
    case FuzzyStatus::kOutputClamped: return "output_clamped";
    case FuzzyStatus::kNoRule: return "no_rule";
    case FuzzyStatus::kBadInput: return "bad_input";
  }
  return "unknown";
}
#pragma GCC diagnostic pop

constexpr void raise(FuzzyStatus& status, FuzzyStatus to) noexcept {
  if (status < to) status = to;
}

// ---- constants of a controller. Indexes are into the arrays of FuzzyTables.

/// The range of an input; on a circle `high` is `low` again and period is high - low, elsewhere 0. SI units, degrees kept.
struct FuzzyInput { float low, high, period; };

enum class FuzzyCombine : std::uint8_t { kAverage, kAverageAbout, kSum, kWinner };

struct FuzzyOutput {
  float low, high, period;   ///< as those of an input
  float within;              ///< kAverageAbout: how far from the strongest rule's value others may lie; infinity: any distance
  float fallback;            ///< where no rule fires
  FuzzyCombine combine;
  std::uint16_t first_fired; ///< kAverageAbout: its part of the list of fired rules
};

/// `constant` + the sum of coefficient * input over its parts.
struct FuzzyConsequent { float constant; std::uint16_t output, first_part, end_part; };
struct FuzzyPart { float coefficient; std::uint16_t slot; };

/// A `given`, or a rule.
struct FuzzyStep {
  std::uint16_t first_code, end_code;              ///< its condition
  std::uint16_t first_consequent, end_consequent;  ///< a rule's; a `given` has none
  std::uint16_t skip;                              ///< a given's: the step after everything inside it; 0 for a rule
  std::uint8_t depth;                              ///< the number of `given`s around it
  bool conjunctive;                                ///< begins with a degree that `and` joins with all the rest: if it is 0, so is the whole
  float weight;                                    ///< a rule's, in (0, 1]
};

/// An item of a condition in reverse Polish order: a degree, a degree that `and` joins with the top of the stack, or an operation.
namespace fuzzy_code {
inline constexpr std::uint16_t kAndDegree = 0x8000;   ///< plus the degree
inline constexpr std::uint16_t kOperation = 0x7FF0;   ///< below it: the number of a degree
inline constexpr std::uint16_t kAnd = 0x7FF0, kOr = 0x7FF1, kNot = 0x7FF2, kVery = 0x7FF3, kSomewhat = 0x7FF4;
}  // namespace fuzzy_code

/// The most numbers that a condition needs at once, and the deepest nesting of `given`s. kbc checks both.
inline constexpr std::uint32_t kMaxFuzzyStack = 144, kMaxFuzzyDepth = 16;

struct FuzzyTables {
  const FuzzyInput* inputs;               ///< by slot
  const Membership* terms;
  const std::uint16_t* slot_of_degree;
  const std::uint16_t* term_of_degree;
  const std::uint16_t* code;
  const FuzzyStep* steps;
  const FuzzyConsequent* consequents;
  const FuzzyPart* parts;
  const FuzzyOutput* outputs;
  std::uint16_t slot_count, degrees, step_count, output_count;
  bool product;                           ///< `and` multiplies; else it takes the least
  bool sum;                               ///< `or` is a + b - ab; else it takes the greatest
};

/// A rule that fired: how strongly, and what it says.
struct FuzzyFired { float strength, value; };

// ---- the steps, shared by both ways to evaluate

/// The `or` of a block that says `or = sum`, and the hedge `very`.
[[nodiscard]] constexpr float fuzzy_sum(float a, float b) noexcept { return a + b - a * b; }
[[nodiscard]] constexpr float very(float a) noexcept { return a * a; }

/// Brings an input that is not circular into its range. False if it is no number; then x has no meaning afterwards.
[[nodiscard]] constexpr bool take_on_line(float& x, float low, float high, bool& outside) noexcept {
  const bool number = is_finite(x);
  const float inside = clamped(x, low, high);
  outside = outside | (inside != x);   // no jump
  x = inside;
  return number;
}

/// Brings an input into its range. False if it is no number; then x has no meaning afterwards.
[[nodiscard]] constexpr bool take(float& x, const FuzzyInput& input, bool& outside) noexcept {
  if (!(input.period > 0.0f)) return take_on_line(x, input.low, input.high, outside);
  if (!is_finite(x)) return false;
  x = wrapped(x, input.low, input.period);
  return true;
}

/// Sums for kAverage and kSum. A strength of 0 changes nothing.
struct FuzzySums {
  float sum = 0.0f, weight = 0.0f;
  constexpr void add(float strength, float value) noexcept {
    sum = sum + strength * value;
    weight = weight + strength;
  }
};

/// The strongest so far; of equals the first.
struct FuzzyStrongest {
  float strength = 0.0f, value = 0.0f;
  constexpr void add(float s, float v) noexcept {
    const bool stronger = s > strength;
    strength = stronger ? s : strength;
    value = stronger ? v : value;
  }
};

/// The list for kAverageAbout, and in straight code for kWinner. `fired` has room for every rule that writes the output, and for one
/// more: a rule that does not fire is written as well and then overwritten, so that the processor need not guess which rules fire.
struct FuzzyList {
  FuzzyFired* fired;
  std::uint32_t count = 0;
  constexpr void add(float strength, float value) noexcept {
    fired[count] = {strength, value};
    count += strength > 0.0f ? 1u : 0u;
  }
};

/// The mean about the strongest rule's value w: w + sum(s d) / sum(s) over |d| <= within, d the shortest way from w. For
/// count > 0.
[[nodiscard]] constexpr float average_about(const FuzzyFired* fired, std::uint32_t count, const FuzzyOutput& output) noexcept {
  FuzzyStrongest strongest;
  for (std::uint32_t i = 0; i < count; ++i) strongest.add(fired[i].strength, fired[i].value);
  FuzzySums sums;
  for (std::uint32_t i = 0; i < count; ++i) {
    const float d = output.period > 0.0f ? shortest_difference(fired[i].value, strongest.value, output.period)
                                         : fired[i].value - strongest.value;
    if (d <= output.within && d >= -output.within) sums.add(fired[i].strength, d);
  }
  return strongest.value + sums.sum / sums.weight;
}

/// Brings the answer of the rules into the range of the output.
[[nodiscard]] constexpr float into_range(float raw, const FuzzyOutput& output, FuzzyStatus& status) noexcept {
  if (output.period > 0.0f) return wrapped(raw, output.low, output.period);
  const float inside = clamped(raw, output.low, output.high);
  if (inside != raw) raise(status, FuzzyStatus::kOutputClamped);
  return inside;
}

[[nodiscard]] constexpr float conclude(const FuzzySums& sums, const FuzzyOutput& output, FuzzyStatus& status) noexcept {
  if (!(sums.weight > 0.0f)) {
    raise(status, FuzzyStatus::kNoRule);
    return output.fallback;
  }
  return into_range(output.combine == FuzzyCombine::kSum ? sums.sum : sums.sum / sums.weight, output, status);
}
[[nodiscard]] constexpr float conclude(const FuzzyStrongest& strongest, const FuzzyOutput& output, FuzzyStatus& status) noexcept {
  if (!(strongest.strength > 0.0f)) {
    raise(status, FuzzyStatus::kNoRule);
    return output.fallback;
  }
  return into_range(strongest.value, output, status);
}
[[nodiscard]] constexpr float conclude(const FuzzyList& list, const FuzzyOutput& output, FuzzyStatus& status) noexcept {
  if (list.count == 0) {
    raise(status, FuzzyStatus::kNoRule);
    return output.fallback;
  }
  if (output.combine != FuzzyCombine::kWinner) return into_range(average_about(list.fired, list.count, output), output, status);
  FuzzyStrongest strongest;
  for (std::uint32_t i = 0; i < list.count; ++i) strongest.add(list.fired[i].strength, list.fired[i].value);
  return into_range(strongest.value, output, status);
}

// ---- the evaluator that walks the tables

namespace detail {

class FuzzyRun {
 public:
  constexpr FuzzyRun(const FuzzyTables& tables, const float* x, float* degrees) noexcept : t_(tables), x_(x), degrees_(degrees) {
    for (std::uint32_t d = 0; d < t_.degrees; ++d) degrees_[d] = -1.0f;   // not computed yet
  }

  [[nodiscard]] constexpr float both(float a, float b) const noexcept { return t_.product ? a * b : least(a, b); }

  /// How well a condition holds. A conjunction is known as soon as one of its leading parts does not hold at all.
  [[nodiscard]] constexpr float holds(const FuzzyStep& step) noexcept {
    std::uint32_t i = step.first_code;
    float a = degree(t_.code[i++]);   // every condition begins with a degree
    if (step.conjunctive) {
      for (; a > 0.0f && i < step.end_code && t_.code[i] >= fuzzy_code::kAndDegree; ++i) a = both(a, degree(t_.code[i] & 0x7FFFu));
      if (!(a > 0.0f)) return a;
    }
    return i < step.end_code ? evaluate(a, i, step.end_code) : a;
  }

  /// Notes what a rule that fires says of each output.
  template <class Scratch>
  constexpr void say(const FuzzyStep& step, float strength, Scratch& room) const noexcept {
    for (std::uint32_t c = step.first_consequent; c < step.end_consequent; ++c) {
      const std::uint32_t o = t_.consequents[c].output;
      const FuzzyOutput& output = t_.outputs[o];
      float said = value(t_.consequents[c]);
      if (output.period > 0.0f) said = wrapped(said, output.low, output.period);
      if (output.combine == FuzzyCombine::kWinner) room.strongest[o].add(strength, said);
      else if (output.combine == FuzzyCombine::kAverageAbout) room.fired[output.first_fired + room.counts[o]++] = {strength, said};
      else room.sums[o].add(strength, said);
    }
  }

 private:
  [[nodiscard]] constexpr float value(const FuzzyConsequent& consequent) const noexcept {
    float sum = consequent.constant;
    for (std::uint32_t p = consequent.first_part; p < consequent.end_part; ++p) {
      sum = sum + t_.parts[p].coefficient * x_[t_.parts[p].slot];
    }
    return sum;
  }

  [[nodiscard]] constexpr float degree(std::uint32_t d) noexcept {
    float& known = degrees_[d];
    if (known < 0.0f) known = mu(t_.terms[t_.term_of_degree[d]], x_[t_.slot_of_degree[d]]);
    return known;
  }

  /// The codes from i on, with `first` on the stack.
  [[nodiscard]] constexpr float evaluate(float first, std::uint32_t i, std::uint32_t end) noexcept {
    float stack[kMaxFuzzyStack];
    stack[0] = first;
    std::uint32_t top = 1;
    for (; i < end; ++i) {
      const std::uint16_t code = t_.code[i];
      float& a = stack[top - 1];
      if (code >= fuzzy_code::kAndDegree) {
        a = both(a, degree(code & 0x7FFFu));
      } else if (code < fuzzy_code::kOperation) {
        stack[top++] = degree(code);
      } else if (code == fuzzy_code::kNot) {
        a = 1.0f - a;
      } else if (code == fuzzy_code::kVery) {
        a = very(a);
      } else if (code == fuzzy_code::kSomewhat) {
        a = square_root(a);
      } else {
        --top;
        float& left = stack[top - 1];
        left = code == fuzzy_code::kAnd ? both(left, a) : t_.sum ? fuzzy_sum(left, a) : greatest(left, a);
      }
    }
    return stack[0];
  }

  const FuzzyTables& t_;
  const float* x_;
  float* degrees_;
};

}  // namespace detail

/// Working memory for `evaluate`; kbc says how much a controller needs. Nothing in it outlives a call.
template <std::uint32_t kDegrees, std::uint32_t kOutputs, std::uint32_t kFired>
struct FuzzyScratch {
  float degrees[kDegrees > 0 ? kDegrees : 1];
  FuzzySums sums[kOutputs];
  FuzzyStrongest strongest[kOutputs];
  std::uint32_t counts[kOutputs];
  FuzzyFired fired[kFired > 0 ? kFired : 1];
};

/// Computes the outputs for the inputs x (by slot; they are brought into their ranges in place). Cost: a membership function for each
/// degree that is asked for, and about 2 ns for each part of a condition. Rules in a `given` that does not hold cost nothing.
template <class Scratch>
constexpr FuzzyStatus evaluate(const FuzzyTables& t, float* x, float* out, Scratch& room) noexcept {
  FuzzyStatus status = FuzzyStatus::kOk;
  bool good = true, outside = false;
  for (std::uint32_t s = 0; s < t.slot_count; ++s) good = take(x[s], t.inputs[s], outside) && good;
  if (outside) raise(status, FuzzyStatus::kInputClamped);
  if (!good) {
    for (std::uint32_t o = 0; o < t.output_count; ++o) out[o] = t.outputs[o].fallback;
    return FuzzyStatus::kBadInput;
  }
  for (std::uint32_t o = 0; o < t.output_count; ++o) {
    room.sums[o] = {};
    room.strongest[o] = {};
    room.counts[o] = 0;
  }
  detail::FuzzyRun run(t, x, room.degrees);
  float given[kMaxFuzzyDepth + 1];
  for (std::uint32_t i = 0; i < t.step_count;) {
    const FuzzyStep& step = t.steps[i++];
    const float own = run.holds(step);
    const float joined = step.depth == 0 ? own : run.both(given[step.depth - 1], own);
    if (step.skip != 0) {
      given[step.depth] = joined;
      if (!(joined > 0.0f)) i = step.skip;
      continue;
    }
    if (const float strength = joined * step.weight; strength > 0.0f) run.say(step, strength, room);
  }
  for (std::uint32_t o = 0; o < t.output_count; ++o) {
    const FuzzyOutput& output = t.outputs[o];
    if (output.combine == FuzzyCombine::kWinner) out[o] = conclude(room.strongest[o], output, status);
    else if (output.combine == FuzzyCombine::kAverageAbout) out[o] = conclude(FuzzyList{room.fired + output.first_fired, room.counts[o]}, output, status);
    else out[o] = conclude(room.sums[o], output, status);
  }
  return status;
}

}  // namespace mts
