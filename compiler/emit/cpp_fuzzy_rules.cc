#include "compiler/emit/cpp_fuzzy_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace kb::emit {
namespace {

// note [when rules are stepped over together]
//   A jump that the processor predicts wrongly costs about as much as four rules. If each of the p parts of a shared beginning is 0 half of
//   the time, the jump goes the rarer way once in 2^p times. So it pays from three parts and four rules on. If the parts are never 0, the
//   jump is always predicted correctly and costs nothing.
constexpr std::size_t kLeastShared = 3, kLeastRules = 4;

using Rules = std::vector<StraightRule>;

class RuleWriter {
 public:
  RuleWriter(std::string given, Joint joint, std::string& out) : given_(std::move(given)), joint_(joint), out_(out) {}

  /// Recursion as deep as beginnings nest; each level removes at least two factors.
  void write(const Rules& rules, std::size_t depth) {
    for (std::size_t first = 0; first < rules.size();) {
      std::size_t end = first + 1;
      while (end < rules.size() && shared(rules[first], rules[end]) >= kLeastShared) ++end;
      if (end - first < kLeastRules) {
        write(rules[first++], depth);
        continue;
      }
      std::size_t common = rules[first].factors.size();
      for (std::size_t i = first; i < end; ++i) common = std::min(common, shared(rules[first], rules[i]));
      Rules rest(rules.begin() + static_cast<std::ptrdiff_t>(first), rules.begin() + static_cast<std::ptrdiff_t>(end));
      write_together(rest, common, depth);
      first = end;
    }
  }

 private:
  [[nodiscard]] static std::size_t shared(const StraightRule& a, const StraightRule& b) {
    const auto at = std::mismatch(a.factors.begin(), a.factors.end(), b.factors.begin(), b.factors.end());
    return static_cast<std::size_t>(at.first - a.factors.begin());
  }
  [[nodiscard]] std::string join(const std::vector<std::string>& factors, std::size_t count) const {
    std::string joined = factors[0];
    for (std::size_t i = 1; i < count; ++i) joined = joint_.both(joined, factors[i]);
    return joined;
  }

  void write_together(Rules& rules, std::size_t common, std::size_t depth) {
    const std::string name = fmt::format("all_{}", names_++);
    fmt::format_to(std::back_inserter(out_), "{}if (const float {} = {}; {} != 0.0f) {{\n", std::string(2 * depth, ' '), name,
                   join(rules[0].factors, common), name);
    for (StraightRule& rule : rules) {
      rule.factors.erase(rule.factors.begin() + 1, rule.factors.begin() + static_cast<std::ptrdiff_t>(common));
      rule.factors[0] = name;
    }
    write(rules, depth + 1);
    out_ += std::string(2 * depth, ' ') + "}\n";
  }

  void write(const StraightRule& rule, std::size_t depth) {
    const std::string indent(2 * depth, ' ');
    std::string strength = join(rule.factors, rule.factors.size());
    if (!given_.empty()) strength = joint_.both(given_, strength);
    strength += rule.weight;
    fmt::format_to(std::back_inserter(out_), "{}// {}\n", indent, rule.comment);
    if (rule.statements.empty()) {
      fmt::format_to(std::back_inserter(out_), "{}firings.add({}, {});\n", indent, strength, rule.number);
      return;
    }
    fmt::format_to(std::back_inserter(out_), "{0}{{\n{0}  const float s = {1};\n", indent, strength);
    if (!rule.number.empty()) fmt::format_to(std::back_inserter(out_), "{}  firings.add(s, {});\n", indent, rule.number);
    for (const std::string& statement : rule.statements) fmt::format_to(std::back_inserter(out_), "{}  {}\n", indent, statement);
    out_ += indent + "}\n";
  }

  std::string given_;
  Joint joint_;
  std::string& out_;
  unsigned names_ = 0;
};

}  // namespace

std::string Joint::both(const std::string& a, const std::string& b) const {
  return product ? fmt::format("({} * {})", a, b) : fmt::format("mts::least({}, {})", a, b);
}

void emit_rules(Rules rules, const std::string& given, Joint joint, std::size_t depth, std::string& out) {
  RuleWriter(given, joint, out).write(rules, depth);
}

}  // namespace kb::emit
