#include "tests/unit/fuzzy/random_controller.h"

#include <algorithm>
#include <limits>
#include <string>

#include "tests/unit/dice.h"

namespace kb::fuzzy::testing {
namespace {

class Dice : public tests::Dice {
 public:
  explicit Dice(std::uint64_t seed) : tests::Dice(seed * 0x9E3779B97F4A7C15u + 1) {}
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(tests::Dice::below(n)); }
  bool one_in(std::uint32_t n) { return below(n) == 0; }
  /// Of a grid of 1/64, so that corners meet now and then and all numbers are floats.
  double between(double low, double high) { return low + (high - low) * (below(65) / 64.0); }
};

class Maker {
 public:
  Maker(std::uint64_t seed, const Repertoire& repertoire) : dice_(seed), may_(repertoire) {}

  Controller run() {
    c_.name = "Random";
    c_.conjunction = dice_.one_in(2) ? And::kProduct : And::kMin;
    c_.disjunction = dice_.one_in(2) ? Or::kSum : Or::kMax;
    const std::uint32_t inputs = 1 + dice_.below(3), outputs = 1 + dice_.below(2);
    for (std::uint32_t i = 0; i < inputs; ++i) add_input(i);
    for (std::uint32_t o = 0; o < outputs; ++o) add_output(o);
    const std::uint32_t blocks = 2 + dice_.below(5);
    for (std::uint32_t b = 0; b < blocks; ++b) {
      if (may_.nests && dice_.one_in(3)) add_nest(kNone, 0);
      else add_rule(kNone);
    }
    return std::move(c_);
  }

  /// Each nest is made by the same throws for its form, and by others for its words.
  Controller run_row_of_nests() {
    c_.name = "Random";
    c_.conjunction = dice_.one_in(2) ? And::kProduct : And::kMin;
    c_.disjunction = dice_.one_in(2) ? Or::kSum : Or::kMax;
    add_plain_input();
    add_group();
    const std::uint32_t outputs = 1 + dice_.below(2), nests = 3 + dice_.below(8);
    for (std::uint32_t o = 0; o < outputs; ++o) add_output(o);
    if (dice_.one_in(2)) add_rule(kNone, dice_, false);
    const std::uint64_t form = dice_.bits();
    for (std::uint32_t n = 0; n < nests; ++n) add_nest_of_row(n, Dice(form));
    return std::move(c_);
  }

 private:
  /// Its terms are linear, side by side, each reaching into its neighbours.
  void add_plain_input() {
    Input input;
    input.name = "in0";
    input.circular = dice_.one_in(2);
    input.low = input.circular ? -180.0 : dice_.between(-4.0, 2.0);
    input.high = input.low + (input.circular ? 360.0 : 0.5 + dice_.between(0.0, 6.0));
    const std::uint32_t terms = 3 + dice_.below(8);
    const double step = (input.high - input.low) / terms;
    for (std::uint32_t t = 0; t < terms; ++t) {
      Shape s;
      const double at = input.low + step * t, reach = step * (0.25 + dice_.between(0.0, 0.5));
      s.kind = dice_.one_in(2) ? ShapeKind::kTriangle : ShapeKind::kTrapezoid;
      s.p = {at, at + reach, at + step, at + step + reach};
      if (s.kind == ShapeKind::kTriangle) s.p[3] = 0.0;
      if (input.circular) s.period = 360.0, s.range_low = input.low;
      input.terms.push_back({"t" + std::to_string(t), s});
    }
    put(std::move(input));
  }

  void add_group() {
    Input input;
    input.name = "in1";
    input.group = true;
    input.count = 4 + dice_.below(5);
    input.high = 1.0;
    const std::uint32_t terms = 1 + dice_.below(2);
    for (std::uint32_t t = 0; t < terms; ++t) input.terms.push_back({"t" + std::to_string(t), shape(input)});
    put(std::move(input));
  }

  void put(Input input) {
    input.first_slot = c_.slots;
    input.first_degree = static_cast<std::uint32_t>(c_.degrees.size());
    const auto id = static_cast<std::uint32_t>(c_.inputs.size()), terms = static_cast<std::uint32_t>(input.terms.size());
    for (std::uint32_t e = 0; e < input.count; ++e) {
      for (std::uint32_t t = 0; t < terms; ++t) c_.degrees.push_back({input.first_slot + e, id, t});
    }
    c_.slots += input.count;
    c_.inputs.push_back(std::move(input));
  }

  /// Of the plain input or of the group, as `form` says.
  std::uint32_t word(bool of_group) {
    const Input& input = c_.inputs[of_group ? 1 : 0];
    return ask(input.first_degree + dice_.below(input.count * static_cast<std::uint32_t>(input.terms.size())));
  }

  std::uint32_t words(Dice& form, int depth) {
    Node node;
    const std::uint32_t kind = depth > 1 ? 0 : form.below(6);
    if (kind <= 1) return word(!form.one_in(4));
    constexpr Node::Op kOps[] = {Node::Op::kNot, Node::Op::kVery, Node::Op::kSomewhat};
    node.op = kind == 2 ? kOps[form.below(3)] : form.one_in(3) ? Node::Op::kOr : Node::Op::kAnd;
    node.left = words(form, depth + 1);
    if (kind > 2) node.right = words(form, depth + 1);
    return add(node);
  }

  void add_nest_of_row(std::uint32_t n, Dice form) {
    // Mostly the n-th word of the plain input: an index finds it.
    const std::uint32_t condition = form.one_in(3) ? words(form, 0) : ask(n % static_cast<std::uint32_t>(c_.inputs[0].terms.size()));
    const auto id = static_cast<std::uint32_t>(c_.nests.size());
    c_.nests.push_back({kNone, condition, static_cast<std::uint32_t>(c_.rules.size()), 0, {}});
    const std::uint32_t rules = 1 + form.below(4);
    for (std::uint32_t r = 0; r < rules; ++r) add_rule(id, form, false);
    c_.nests[id].end_rule = static_cast<std::uint32_t>(c_.rules.size());
  }

  void add_input(std::uint32_t i) {
    Input input;
    input.name = "in" + std::to_string(i);
    input.group = may_.circles && dice_.one_in(4);
    input.count = input.group ? 2 + dice_.below(2) : 1;
    input.circular = may_.circles && dice_.one_in(3);
    input.low = input.circular ? (dice_.one_in(2) ? -180.0 : 0.0) : dice_.between(-4.0, 2.0);
    input.high = input.low + (input.circular ? 360.0 : 0.5 + dice_.between(0.0, 6.0));
    const std::uint32_t terms = 1 + dice_.below(4);
    for (std::uint32_t t = 0; t < terms; ++t) input.terms.push_back({"t" + std::to_string(t), shape(input)});
    put(std::move(input));
  }

  Shape shape(const Input& input) {
    const double width = input.high - input.low;
    Shape s;
    if (input.circular) {
      s.period = width;
      s.range_low = input.low;
    }
    std::array<double, 4> at{};
    const double reach = input.circular ? 0.9 : 1.0;
    for (double& x : at) x = dice_.between(input.low, input.low + reach * width);
    std::sort(at.begin(), at.end());
    do {
      s.kind = static_cast<ShapeKind>(dice_.below(7));
    } while ((input.circular && (s.kind == ShapeKind::kSigmoid || s.kind == ShapeKind::kRamp)) ||
             (!may_.negations && s.kind == ShapeKind::kSingleton));
    switch (s.kind) {
      case ShapeKind::kTriangle: s.p = {at[0], at[1], at[2], 0.0}; break;
      case ShapeKind::kTrapezoid: s.p = at; break;
      case ShapeKind::kRamp: s.p = {at[0], at[3] + 0.25, 0.0, 0.0}; break;
      case ShapeKind::kGaussian:
        s.p = {at[1], dice_.one_in(2) ? at[1] : at[2], width * (0.05 + dice_.between(0.0, 0.5)), width * (0.05 + dice_.between(0.0, 0.5))};
        if (may_.negations && dice_.one_in(4)) s.p[2 + dice_.below(2)] = kInfinity;
        break;
      case ShapeKind::kBell: s.p = {at[1], width * (0.1 + dice_.between(0.0, 0.5)), 0.5 + dice_.between(0.0, 4.0), 0.0}; break;
      case ShapeKind::kSigmoid: s.p = {at[1], (dice_.one_in(2) ? -1.0 : 1.0) * (0.5 + dice_.between(0.0, 12.0)) / width, 0.0, 0.0}; break;
      case ShapeKind::kSingleton: s.p = {at[1], 0.0, 0.0, 0.0}; break;
    }
    if (s.kind == ShapeKind::kRamp && dice_.one_in(2)) std::swap(s.p[0], s.p[1]);
    return s;
  }

  void add_output(std::uint32_t o) {
    Output output;
    output.name = "out" + std::to_string(o);
    output.circular = may_.circles && dice_.one_in(3);
    output.low = output.circular ? -180.0 : dice_.between(-20.0, 0.0);
    output.high = output.circular ? 180.0 : output.low + 1.0 + dice_.between(0.0, 40.0);
    for (std::uint32_t t = 0; t < 3; ++t) output.terms.push_back({"v" + std::to_string(t), dice_.between(output.low, output.high), {}});
    if (dice_.one_in(2)) output.fallback = dice_.between(output.low, output.high);
    const std::uint32_t how = dice_.below(may_.reach ? 4 : 3);
    if (how == 2 && !output.circular) output.combine = Combine::kSum;
    if (how == 3) output.combine = Combine::kWinner;
    if (how == 1 && may_.reach && dice_.one_in(2)) output.within = 1.0 + dice_.between(0.0, 60.0);
    c_.outputs.push_back(std::move(output));
  }

  std::uint32_t add(Node node) {
    c_.nodes.push_back(node);
    return static_cast<std::uint32_t>(c_.nodes.size() - 1);
  }

  /// How well the degree's input fits its term.
  std::uint32_t ask(std::uint32_t degree) {
    Node node;
    node.degree = degree;
    return add(node);
  }

  std::uint32_t condition(int depth) {
    Node node;
    const std::uint32_t kind = depth > 2 ? 0 : dice_.below(6);
    if (kind <= 2) {
      const std::uint32_t plain = ask(dice_.below(static_cast<std::uint32_t>(c_.degrees.size())));
      if (!dice_.one_in(3)) return plain;
      Node hedge;
      hedge.left = plain;
      constexpr Node::Op kHedges[] = {Node::Op::kNot, Node::Op::kVery, Node::Op::kSomewhat};
      hedge.op = kHedges[dice_.below(3)];
      return add(hedge);
    }
    node.left = condition(depth + 1);
    if (kind == 5 && may_.negations) {
      node.op = Node::Op::kNot;
      return add(node);
    }
    node.op = dice_.one_in(3) ? Node::Op::kOr : Node::Op::kAnd;
    node.right = condition(depth + 1);
    return add(node);
  }

  void add_rule(std::uint32_t nest) { add_rule(nest, dice_, true); }
  /// `form` says all but the words. Not `free`: over the inputs of a row of nests, with constants.
  void add_rule(std::uint32_t nest, Dice& form, bool free) {
    Rule rule;
    rule.nest = nest;
    rule.condition = free ? condition(0) : words(form, 0);
    if (form.one_in(3)) rule.weight = 0.125 * (1 + form.below(8));
    for (std::uint32_t o = 0; o < c_.outputs.size(); ++o) {
      if (o == 0 || !dice_.one_in(3)) rule.consequents.push_back(consequent(o, free));
    }
    c_.rules.push_back(std::move(rule));
  }

  Consequent consequent(std::uint32_t o, bool free) {
    Consequent one;
    one.output = o;
    const Output& output = c_.outputs[o];
    if (dice_.one_in(2)) {
      one.term = dice_.below(3);
      one.constant = output.terms[one.term].number;
      return one;
    }
    one.constant = dice_.between(output.low, output.high);
    for (std::uint32_t slot = 0; free && slot < c_.slots; ++slot) {
      if (dice_.one_in(3)) one.linear.emplace_back(slot, dice_.between(-2.0, 2.0) + 0.0625);
    }
    return one;
  }

  void add_nest(std::uint32_t parent, int depth) {
    const auto id = static_cast<std::uint32_t>(c_.nests.size());
    c_.nests.push_back({parent, condition(1), static_cast<std::uint32_t>(c_.rules.size()), 0, {}});
    const std::uint32_t blocks = 1 + dice_.below(3);
    for (std::uint32_t b = 0; b < blocks; ++b) {
      if (depth < 2 && dice_.one_in(4)) add_nest(id, depth + 1);
      else add_rule(id);
    }
    c_.nests[id].end_rule = static_cast<std::uint32_t>(c_.rules.size());
  }

  Dice dice_;
  Repertoire may_;
  Controller c_;
};

}  // namespace

Controller random_controller(std::uint64_t seed, const Repertoire& repertoire) { return Maker(seed, repertoire).run(); }
Controller random_row_of_nests(std::uint64_t seed) { return Maker(seed, {}).run_row_of_nests(); }

std::vector<double> random_inputs(const Controller& controller, std::uint64_t seed, bool wild) {
  Dice dice(seed ^ 0xABCDEF);
  std::vector<double> x;
  for (const Input& input : controller.inputs) {
    for (std::uint32_t e = 0; e < input.count; ++e) {
      const double width = input.high - input.low;
      double value = input.low + width * (static_cast<double>(dice.bits() >> 40) / static_cast<double>(1u << 24));
      if (dice.one_in(4)) value = input.terms[dice.below(static_cast<std::uint32_t>(input.terms.size()))].shape.p[dice.below(2)];
      if (!wild) value = std::clamp(value, input.low, input.high);
      if (wild && dice.one_in(6)) value = input.low + width * dice.between(-2.0, 3.0);
      if (wild && dice.one_in(40)) value = dice.one_in(2) ? kInfinity : std::numeric_limits<double>::quiet_NaN();
      x.push_back(static_cast<double>(static_cast<float>(value)));
    }
  }
  return x;
}

}  // namespace kb::fuzzy::testing
