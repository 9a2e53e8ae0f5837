#include "compiler/tables/fuzzy.h"

#include <fmt/format.h>

#include <iterator>

#include "compiler/tables/lists.h"

namespace kb::tables {
namespace {

using fuzzy::Node;
namespace code = mts::fuzzy_code;

std::uint16_t narrow(std::size_t n) { return static_cast<std::uint16_t>(n); }

class Packer {
 public:
  explicit Packer(const fuzzy::Controller& controller) : c_(controller) {}

  FuzzyForm run() {
    to_.product = c_.conjunction == fuzzy::And::kProduct;
    to_.sum = c_.disjunction == fuzzy::Or::kSum;
    pack_inputs();
    pack_outputs();
    std::size_t nest = 0;
    std::vector<std::size_t> open;   // the steps of the open nests
    for (std::uint32_t r = 0; r <= c_.rules.size(); ++r) {
      while (!open.empty() && c_.nests[to_.origins[open.back()]].end_rule <= r) {
        to_.steps[open.back()].skip = narrow(to_.steps.size());
        open.pop_back();
      }
      for (; nest < c_.nests.size() && c_.nests[nest].first_rule == r; ++nest) {
        open.push_back(to_.steps.size());
        add_step(c_.nests[nest].condition, open.size() - 1, static_cast<std::uint32_t>(nest));
      }
      if (r < c_.rules.size()) pack_rule(r, open.size());
    }
    return std::move(to_);
  }

 private:
  void pack_inputs() {
    for (const fuzzy::Input& input : c_.inputs) {
      const std::size_t first_term = to_.terms.size();
      for (const fuzzy::Term& term : input.terms) to_.terms.push_back(row(term.shape));
      for (std::uint32_t e = 0; e < input.count; ++e) {
        to_.inputs.push_back({to_float(input.low), to_float(input.high), input.circular ? to_float(input.high) - to_float(input.low) : 0.0f});
        for (std::size_t t = 0; t < input.terms.size(); ++t) {
          to_.slot_of_degree.push_back(narrow(input.first_slot + e));
          to_.term_of_degree.push_back(narrow(first_term + t));
        }
      }
    }
  }

  void pack_outputs() {
    to_.writers.assign(c_.outputs.size(), 0);
    for (const fuzzy::Rule& rule : c_.rules) {
      for (const fuzzy::Consequent& consequent : rule.consequents) ++to_.writers[consequent.output];
    }
    for (std::size_t o = 0; o < c_.outputs.size(); ++o) {
      const fuzzy::Output& from = c_.outputs[o];
      const bool about = from.combine == fuzzy::Combine::kAverage && (from.circular || from.within < fuzzy::kInfinity);
      mts::FuzzyOutput output{};
      output.low = to_float(from.low);
      output.high = to_float(from.high);
      output.period = from.circular ? to_float(from.high) - to_float(from.low) : 0.0f;
      output.within = to_float(from.within);
      output.fallback = to_float(from.default_value());
      output.combine = about                                      ? mts::FuzzyCombine::kAverageAbout
                       : from.combine == fuzzy::Combine::kAverage ? mts::FuzzyCombine::kAverage
                       : from.combine == fuzzy::Combine::kSum     ? mts::FuzzyCombine::kSum
                                                                  : mts::FuzzyCombine::kWinner;
      output.first_fired = narrow(to_.fired);
      if (about) to_.fired += to_.writers[o];
      to_.outputs.push_back(output);
    }
  }

  /// Recursion as deep as conditions nest.
  void add_code(std::uint32_t id) {
    const Node& node = c_.nodes[id];
    switch (node.op) {
      case Node::Op::kDegree: to_.code.push_back(narrow(node.degree)); return;
      case Node::Op::kAnd:
        add_code(node.left);
        if (c_.nodes[node.right].op == Node::Op::kDegree) {
          to_.code.push_back(narrow(code::kAndDegree + c_.nodes[node.right].degree));
          return;
        }
        add_code(node.right);
        to_.code.push_back(code::kAnd);
        return;
      case Node::Op::kOr:
        add_code(node.left);
        add_code(node.right);
        to_.code.push_back(code::kOr);
        return;
      case Node::Op::kNot:
      case Node::Op::kVery:
      case Node::Op::kSomewhat:
        add_code(node.left);
        to_.code.push_back(node.op == Node::Op::kNot ? code::kNot : node.op == Node::Op::kVery ? code::kVery : code::kSomewhat);
        return;
    }
  }

  mts::FuzzyStep& add_step(std::uint32_t condition, std::size_t depth, std::uint32_t origin) {
    mts::FuzzyStep step{};
    step.first_code = narrow(to_.code.size());
    add_code(condition);
    step.end_code = narrow(to_.code.size());
    step.depth = static_cast<std::uint8_t>(depth);
    step.weight = 1.0f;
    while (c_.nodes[condition].op == Node::Op::kAnd) condition = c_.nodes[condition].left;
    step.conjunctive = c_.nodes[condition].op == Node::Op::kDegree;
    to_.steps.push_back(step);
    to_.origins.push_back(origin);
    return to_.steps.back();
  }

  void pack_rule(std::uint32_t r, std::size_t depth) {
    const fuzzy::Rule& rule = c_.rules[r];
    mts::FuzzyStep& step = add_step(rule.condition, depth, r);
    step.weight = to_float(rule.weight);
    step.first_consequent = narrow(to_.consequents.size());
    for (const fuzzy::Consequent& from : rule.consequents) {
      mts::FuzzyConsequent consequent{to_float(from.constant), narrow(from.output), narrow(to_.parts.size()), 0};
      for (const auto& [slot, coefficient] : from.linear) to_.parts.push_back({to_float(coefficient), narrow(slot)});
      consequent.end_part = narrow(to_.parts.size());
      to_.consequents.push_back(consequent);
    }
    step.end_consequent = narrow(to_.consequents.size());
  }

  const fuzzy::Controller& c_;
  FuzzyForm to_;
};

// Like FuzzyScratch, with a size that is known only at run time.
struct Room {
  std::vector<float> degrees;
  std::vector<mts::FuzzySums> sums;
  std::vector<mts::FuzzyStrongest> strongest;
  std::vector<std::uint32_t> counts;
  std::vector<mts::FuzzyFired> list;
};
struct RoomView {
  float* degrees;
  mts::FuzzySums* sums;
  mts::FuzzyStrongest* strongest;
  std::uint32_t* counts;
  mts::FuzzyFired* fired;
};

std::string code_text(const fuzzy::Controller& c, const FuzzyForm& form, const mts::FuzzyStep& step) {
  std::string out;
  for (std::size_t i = step.first_code; i < step.end_code; ++i) {
    const std::uint16_t word = form.code[i];
    if (!out.empty()) out += ' ';
    if (word >= code::kOperation && word < code::kAndDegree) {
      out += fuzzy::kOpWords[word - code::kOperation + 1u];   // no operation says `is`
      continue;
    }
    const fuzzy::Degree& degree = c.degrees[word & 0x7FFFu];
    out += fmt::format("{}{}:{}", word >= code::kAndDegree ? "&" : "", fuzzy::slot_name(c, degree.slot), c.input_of(degree).terms[degree.term].name);
  }
  return out;
}

}  // namespace

mts::Membership row(const fuzzy::Shape& shape) {
  using fuzzy::ShapeKind;
  const auto& p = shape.p;
  const float period = to_float(shape.period), low = to_float(shape.range_low);
  switch (shape.kind) {
    case ShapeKind::kTriangle: return mts::triangle(to_float(p[0]), to_float(p[1]), to_float(p[2]), period, low);
    case ShapeKind::kTrapezoid: return mts::trapezoid(to_float(p[0]), to_float(p[1]), to_float(p[2]), to_float(p[3]), period, low);
    case ShapeKind::kGaussian: return mts::gaussian(to_float(p[0]), to_float(p[1]), to_float(p[2]), to_float(p[3]), period, low);
    case ShapeKind::kBell: return mts::bell(to_float(p[0]), to_float(p[1]), to_float(p[2]), period, low);
    case ShapeKind::kSigmoid: return mts::sigmoid(to_float(p[0]), to_float(p[1]));
    case ShapeKind::kRamp: return mts::ramp(to_float(p[0]), to_float(p[1]));
    case ShapeKind::kSingleton: return mts::singleton(to_float(p[0]), period, low);
  }
  return {};
}

FuzzyForm pack(const fuzzy::Controller& controller) { return Packer(controller).run(); }

mts::FuzzyTables view(const FuzzyForm& form) {
  mts::FuzzyTables t{};
  t.inputs = form.inputs.data();
  t.terms = form.terms.data();
  t.slot_of_degree = form.slot_of_degree.data();
  t.term_of_degree = form.term_of_degree.data();
  t.code = form.code.data();
  t.steps = form.steps.data();
  t.consequents = form.consequents.data();
  t.parts = form.parts.data();
  t.outputs = form.outputs.data();
  t.slot_count = narrow(form.inputs.size());
  t.degrees = narrow(form.slot_of_degree.size());
  t.step_count = narrow(form.steps.size());
  t.output_count = narrow(form.outputs.size());
  t.product = form.product;
  t.sum = form.sum;
  return t;
}

FuzzyAnswer evaluate(const FuzzyForm& form, std::span<const float> x) {
  Room room;
  room.degrees.resize(form.slot_of_degree.size() + 1);
  room.sums.resize(form.outputs.size());
  room.strongest.resize(form.outputs.size());
  room.counts.resize(form.outputs.size());
  room.list.resize(form.fired + 1);
  RoomView seen{room.degrees.data(), room.sums.data(), room.strongest.data(), room.counts.data(), room.list.data()};
  std::vector<float> inputs(x.begin(), x.end());
  FuzzyAnswer answer;
  answer.outputs.resize(form.outputs.size());
  answer.status = mts::evaluate(view(form), inputs.data(), answer.outputs.data(), seen);
  return answer;
}

std::size_t bytes(const FuzzyForm& form) {
  const auto of = [](const auto& list) { return list.size() * sizeof(list[0]); };
  return of(form.inputs) + of(form.terms) + of(form.slot_of_degree) + of(form.term_of_degree) + of(form.code) + of(form.steps) +
         of(form.consequents) + of(form.parts) + of(form.outputs);
}

std::string print(const fuzzy::Controller& c, const FuzzyForm& form) {
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "fuzzy {} slots={} degrees={} steps={} code={} fired={} bytes={}\n", c.name, form.inputs.size(),
                 form.slot_of_degree.size(), form.steps.size(), form.code.size(), form.fired, bytes(form));
  for (std::size_t s = 0; s < form.steps.size(); ++s) {
    const mts::FuzzyStep& step = form.steps[s];
    fmt::format_to(out, "fuzzy {} step {} {} depth={} [{}]", c.name, s, step.skip != 0 ? "given" : "rule", step.depth, code_text(c, form, step));
    if (step.skip != 0) fmt::format_to(out, " skip={}", step.skip);
    for (std::size_t k = step.first_consequent; k < step.end_consequent; ++k) {
      const mts::FuzzyConsequent& consequent = form.consequents[k];
      fmt::format_to(out, " {}={}", c.outputs[consequent.output].name, consequent.constant);
      for (std::size_t p = consequent.first_part; p < consequent.end_part; ++p) {
        fmt::format_to(out, "+{}*{}", form.parts[p].coefficient, fuzzy::slot_name(c, form.parts[p].slot));
      }
    }
    fmt::format_to(out, "\n");
  }
  return text;
}

}  // namespace kb::tables
