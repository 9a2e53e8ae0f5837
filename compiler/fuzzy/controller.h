// A fuzzy controller in its core form: all names resolved, groups of inputs written out, conditions as trees over degrees.
// The language's `fuzzy` blocks are compiled to it. The program holds it, the interpreter (interpret.h) defines its meaning, and
// compiler/tables packs it for the robot.
//
// Takagi and Sugeno, "Fuzzy identification of systems and its applications to modeling and control", 1985: a rule
// `if C then y = f(x)` with f constant (order zero) or linear (order one).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compiler/fuzzy/shape.h"
#include "compiler/source/source.h"

namespace kb::fuzzy {

inline constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// How degrees are joined. The block says which; the first of each is the default.
enum class And : std::uint8_t { kMin, kProduct };
enum class Or : std::uint8_t { kMax, kSum };   ///< kSum: a + b - ab
/// How the values of the rules that fire become one number: see interpret.h.
enum class Combine : std::uint8_t { kAverage, kSum, kWinner };
/// By Combine: the words that the language has for it.
inline constexpr std::array<std::string_view, 3> kCombineWords{"average", "sum", "winner"};

struct Term {
  std::string name;
  Shape shape;
};

/// An input, or a group of them with the same range and terms: `free[8]`.
struct Input {
  std::string name;
  bool group = false;
  std::uint32_t count = 1;          ///< 1 if it is no group
  std::uint32_t first_slot = 0;     ///< its numbers are slots first_slot .. first_slot + count - 1
  std::uint32_t first_degree = 0;   ///< the degree of element e in term t is first_degree + e * terms.size() + t
  double low = 0.0, high = 0.0;     ///< SI (degrees kept)
  std::string unit;                 ///< SI unit, empty if there is none
  std::string written_unit;         ///< the unit of its range in the text
  bool circular = false;
  std::vector<Term> terms;
  source::Span declared;
};

struct Value {
  std::string name;
  double number = 0.0;
  source::Span span;
};

struct Output {
  std::string name;
  double low = 0.0, high = 0.0;
  std::string unit;
  bool circular = false;
  std::vector<Value> terms;
  Combine combine = Combine::kAverage;
  double within = kInfinity;        ///< kAverage: values farther than this from the strongest rule's take no part
  std::optional<double> fallback;   ///< `default`: the value if no rule fires; if not given, the number of the range nearest to 0
  source::Span declared;

  [[nodiscard]] double default_value() const {
    return fallback ? *fallback : low > 0.0 ? low : high < 0.0 ? high : 0.0;
  }
};

/// How well one slot fits one term.
struct Degree { std::uint32_t slot = 0, input = 0, term = 0; };

/// A node of a condition.
struct Node {
  enum class Op : std::uint8_t { kDegree, kAnd, kOr, kNot, kVery, kSomewhat };
  Op op = Op::kDegree;
  std::uint32_t degree = 0;         ///< kDegree
  std::uint32_t left = kNone;       ///< a node made before this one
  std::uint32_t right = kNone;      ///< kAnd, kOr
};

/// By Node::Op: the words that the language has for it.
inline constexpr std::array<std::string_view, 6> kOpWords{"is", "and", "or", "not", "very", "somewhat"};
/// Those of kOpWords that stand before a term and change its degree.
inline constexpr std::array<std::string_view, 3> kHedges{"not", "very", "somewhat"};
/// The operation of a hedge; nothing for any other word.
[[nodiscard]] constexpr std::optional<Node::Op> hedge_of(std::string_view word) {
  for (std::size_t op = static_cast<std::size_t>(Node::Op::kNot); op < kOpWords.size(); ++op) {
    if (kOpWords[op] == word) return static_cast<Node::Op>(op);
  }
  return std::nullopt;
}

/// One conclusion: `speed = full`, `turn = 0.5*bearing + 2`.
struct Consequent {
  std::uint32_t output = 0;
  double constant = 0.0;
  std::vector<std::pair<std::uint32_t, double>> linear;   ///< slot, coefficient; in order of the slots, each once
  std::uint32_t term = kNone;       ///< the output's term that it names, if it names one
  source::Span span;
};

struct Rule {
  std::uint32_t nest = kNone;       ///< the innermost `given` that it stands in
  std::uint32_t condition = 0;      ///< a node
  double weight = 1.0;              ///< in (0, 1]
  std::vector<Consequent> consequents;
  source::Span span;
};

/// `given C { ... }`: its rules fire at most as strongly as C holds, and are skipped if C does not hold at all.
struct Nest {
  std::uint32_t parent = kNone;
  std::uint32_t condition = 0;
  std::uint32_t first_rule = 0, end_rule = 0;   ///< its rules and those of the nests in it
  source::Span span;
};

struct Controller {
  std::string name;
  And conjunction = And::kMin;
  Or disjunction = Or::kMax;
  std::vector<Input> inputs;
  std::vector<Output> outputs;
  std::vector<Degree> degrees;
  std::vector<Node> nodes;
  std::vector<Rule> rules;          ///< in order of the text
  std::vector<Nest> nests;          ///< in order of the text: a parent before the nests in it
  std::uint32_t slots = 0;          ///< how many numbers it takes
  bool standard = false;            ///< from the standard library
  source::Span declared;            ///< its name

  [[nodiscard]] const Input& input_of(const Degree& degree) const { return inputs[degree.input]; }
  [[nodiscard]] const Shape& shape_of(const Degree& degree) const { return inputs[degree.input].terms[degree.term].shape; }
};

/// A range as the language writes it: `0..360 deg circular`.
[[nodiscard]] std::string range_text(double low, double high, std::string_view unit, bool circular);
/// The name of a slot: `bearing`, `free[3]`.
[[nodiscard]] std::string slot_name(const Controller& controller, std::uint32_t slot);
/// The input that a slot belongs to. Cost: a binary search.
[[nodiscard]] std::uint32_t input_of_slot(const Controller& controller, std::uint32_t slot);
/// A condition as the language writes it, with as few parentheses as it needs.
[[nodiscard]] std::string text(const Controller& controller, std::uint32_t node);
[[nodiscard]] std::string text(const Controller& controller, const Consequent& consequent);
/// `if` part and `then` part of a rule, without the conditions of its nests.
[[nodiscard]] std::string text(const Controller& controller, const Rule& rule);
/// The controller, one item a line, with source places if `sources` is not null: for `kbc dump`.
[[nodiscard]] std::string print(const Controller& controller, const source::Sources* sources);

/// The faults of a controller; empty if it is sound. Any fault is a bug of the compiler.
[[nodiscard]] std::vector<std::string> verify(const Controller& controller);

}  // namespace kb::fuzzy
