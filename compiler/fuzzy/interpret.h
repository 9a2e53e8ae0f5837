// What a fuzzy controller means: the oracle for the robot's evaluator and for emitted C++. It walks the trees as they stand, in
// `double` (the exact meaning) or in `float` (what the robot computes, in the same order).
//
// 1. An input on a circle is moved into its range by whole turns; any other is clamped to its range. If one is NaN or infinite, all
//    outputs take their defaults.
// 2. A rule is as strong as its condition holds, joined by `and` with the conditions of the nests around it, the outermost
//    first, times its weight. `and` and `or` are as the block chooses; `not` is 1 - a, `very` a^2, `somewhat` the square root of a.
//    The value of a rule is its constant plus coefficient times input, in the order of the inputs.
// 3. Of the rules that fire (strength s above 0) and write an output, with values v:
//      kAverage  sum(s v) / sum(s)
//      kSum      sum(s v)
//      kWinner   v of the strongest rule; of equally strong ones, the first
//    On a circle, or with `within`, an average is taken about the strongest rule's value w: w + sum(s d) / sum(s), d the
//    (shortest) difference of v from w, over the rules with |d| <= within. On a circle this is the mean nearest to all
//    values at once (Frechet mean), provided that the values lie within half of the circle.
// 4. If no rule fires, the output takes its default. Then it is moved into its range (on a circle) or clamped to it.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "compiler/fuzzy/controller.h"

namespace kb::fuzzy {

/// In order of severity; the same as mts::FuzzyStatus.
enum class Status : std::uint8_t { kOk, kInputClamped, kOutputClamped, kNoRule, kBadInput };

template <class Real>
struct Outcome {
  std::vector<Real> outputs;
  std::vector<Real> strengths;   ///< by rule; 0 if its nest was skipped
  std::vector<Real> before;      ///< outputs before step 4 brings them into their ranges
  Status status = Status::kOk;
};

/// Degrees in exact arithmetic.
struct ExactDegrees {
  const Controller& controller;
  double operator()(std::uint32_t degree, double x) const { return mu(controller.shape_of(controller.degrees[degree]), x); }
};

/// `Degrees` is `Real(std::uint32_t degree, Real x)`, `Wrap` is `Real(Real x, Real low, Real period)`, `Root` is the square root;
/// for float they must be the runtime's.
template <class Real, class Degrees, class Wrap, class Root>
class Interpreter {
 public:
  Interpreter(const Controller& controller, Degrees degrees, Wrap wrap, Root root)
      : c_(controller), degrees_(std::move(degrees)), wrap_(std::move(wrap)), root_(std::move(root)) {}

  /// `inputs` by slot.
  [[nodiscard]] Outcome<Real> operator()(const std::vector<Real>& inputs) {
    Outcome<Real> out;
    out.strengths.assign(c_.rules.size(), Real(0));
    if (!take(inputs, out)) {
      for (const Output& output : c_.outputs) out.outputs.push_back(static_cast<Real>(output.default_value()));
      out.before = out.outputs;
      return out;
    }
    fire(out);
    for (std::uint32_t o = 0; o < c_.outputs.size(); ++o) conclude(o, out);
    return out;
  }

 private:
  static void raise(Outcome<Real>& out, Status status) { out.status = std::max(out.status, status); }

  [[nodiscard]] Real clamp(Real x, double low, double high) const {
    return std::min(std::max(x, static_cast<Real>(low)), static_cast<Real>(high));
  }
  [[nodiscard]] Real turn(double low, double high) const { return static_cast<Real>(high) - static_cast<Real>(low); }

  bool take(const std::vector<Real>& inputs, Outcome<Real>& out) {
    x_ = inputs;
    for (const Input& input : c_.inputs) {
      for (std::uint32_t e = 0; e < input.count; ++e) {
        Real& x = x_[input.first_slot + e];
        if (!std::isfinite(x)) {
          raise(out, Status::kBadInput);
        } else if (input.circular) {
          x = wrap_(x, static_cast<Real>(input.low), turn(input.low, input.high));
        } else {
          const Real inside = clamp(x, input.low, input.high);
          if (inside != x) raise(out, Status::kInputClamped);
          x = inside;
        }
      }
    }
    return out.status != Status::kBadInput;
  }

  [[nodiscard]] Real both(Real a, Real b) const { return c_.conjunction == And::kMin ? std::min(a, b) : a * b; }
  [[nodiscard]] Real either(Real a, Real b) const { return c_.disjunction == Or::kMax ? std::max(a, b) : a + b - a * b; }

  /// Recursion as deep as conditions nest.
  [[nodiscard]] Real holds(std::uint32_t id) const {
    const Node& node = c_.nodes[id];
    switch (node.op) {
      case Node::Op::kDegree: return degrees_(node.degree, x_[c_.degrees[node.degree].slot]);
      case Node::Op::kAnd: return both(holds(node.left), holds(node.right));
      case Node::Op::kOr: return either(holds(node.left), holds(node.right));
      case Node::Op::kNot: return Real(1) - holds(node.left);
      case Node::Op::kVery: {
        const Real a = holds(node.left);
        return a * a;
      }
      case Node::Op::kSomewhat: return root_(holds(node.left));
    }
    return Real(0);
  }

  void fire(Outcome<Real>& out) {
    std::vector<Real> nests;
    for (const Nest& nest : c_.nests) {
      const Real own = holds(nest.condition);
      nests.push_back(nest.parent == kNone ? own : both(nests[nest.parent], own));
    }
    for (std::size_t r = 0; r < c_.rules.size(); ++r) {
      const Rule& rule = c_.rules[r];
      const Real own = holds(rule.condition);
      const Real joined = rule.nest == kNone ? own : both(nests[rule.nest], own);
      out.strengths[r] = joined * static_cast<Real>(rule.weight);
    }
  }

  [[nodiscard]] Real value(const Consequent& consequent) const {
    Real sum = static_cast<Real>(consequent.constant);
    for (const auto& [slot, coefficient] : consequent.linear) sum = sum + static_cast<Real>(coefficient) * x_[slot];
    return sum;
  }

  struct Fired { Real strength, value; };

  [[nodiscard]] Real difference(const Output& output, Real to, Real from) const {
    const Real d = to - from;
    if (!output.circular) return d;
    const Real period = turn(output.low, output.high), half = Real(0.5) * period;
    return d > half ? d - period : d < -half ? d + period : d;
  }

  [[nodiscard]] Real combine(const Output& output, const std::vector<Fired>& fired) const {
    Fired strongest = fired.front();
    for (const Fired& one : fired) {
      if (one.strength > strongest.strength) strongest = one;
    }
    if (output.combine == Combine::kWinner) return strongest.value;
    const bool about = output.combine == Combine::kAverage && (output.circular || output.within < kInfinity);
    Real sum = Real(0), weight = Real(0);
    for (const Fired& one : fired) {
      const Real v = about ? difference(output, one.value, strongest.value) : one.value;
      if (about && std::fabs(v) > static_cast<Real>(output.within)) continue;
      sum = sum + one.strength * v;
      weight = weight + one.strength;
    }
    if (output.combine == Combine::kSum) return sum;
    return about ? strongest.value + sum / weight : sum / weight;
  }

  void conclude(std::uint32_t o, Outcome<Real>& out) {
    const Output& output = c_.outputs[o];
    std::vector<Fired> fired;
    for (std::size_t r = 0; r < c_.rules.size(); ++r) {
      if (!(out.strengths[r] > Real(0))) continue;
      for (const Consequent& consequent : c_.rules[r].consequents) {
        if (consequent.output != o) continue;
        Real v = value(consequent);
        if (output.circular) v = wrap_(v, static_cast<Real>(output.low), turn(output.low, output.high));
        fired.push_back({out.strengths[r], v});
      }
    }
    if (fired.empty()) raise(out, Status::kNoRule);
    const Real raw = fired.empty() ? static_cast<Real>(output.default_value()) : combine(output, fired);
    Real inside = output.circular ? wrap_(raw, static_cast<Real>(output.low), turn(output.low, output.high))
                                  : clamp(raw, output.low, output.high);
    if (!output.circular && inside != raw) raise(out, Status::kOutputClamped);
    out.before.push_back(raw);
    out.outputs.push_back(inside);
  }

  const Controller& c_;
  Degrees degrees_;
  Wrap wrap_;
  Root root_;
  std::vector<Real> x_;
};

/// What `controller` answers to `inputs` (by slot), exactly.
[[nodiscard]] Outcome<double> interpret(const Controller& controller, const std::vector<double>& inputs);

}  // namespace kb::fuzzy
