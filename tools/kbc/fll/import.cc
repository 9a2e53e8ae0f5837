// FLL to a fuzzy block, as text of the language.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "compiler/diagnostics/display.h"
#include "compiler/fuzzy/controller.h"
#include "tools/kbc/fll/import_parts.h"

namespace kb::fll {
namespace {

using diagnostics::Kind;
using Out = std::back_insert_iterator<std::string>;

class Writer {
 public:
  Writer(const Engine& engine, diagnostics::Diagnostics& diagnostics) : engine_(engine), diagnostics_(diagnostics) {}

  std::optional<std::string> run() {
    if (const std::string_view part = missing_part(); !part.empty()) refuse(engine_.line, fmt::format("the engine has no {}", part));
    write_comment(engine_.description, "");
    fmt::format_to(Out(out_), "fuzzy {} {{\n", kb_name(engine_.name));
    write_operators();
    for (const Variable& variable : engine_.variables) {
      if (!variable.output) write_input(variable);
    }
    for (const Variable& variable : engine_.variables) {
      if (variable.output) write_output(variable);
    }
    out_ += '\n';
    for (const Block& block : engine_.blocks) {
      write_comment(block.description, "    ");
      for (const Line& rule : block.rules) write_rule(rule, block);
    }
    out_ += "}\n";
    if (!good_) return std::nullopt;
    return std::move(out_);
  }

 private:
  /// A description is a comment in FLL, and stays one.
  void write_comment(std::string_view text, std::string_view indent) {
    if (!text.empty()) fmt::format_to(Out(out_), "{}# {}\n", indent, diagnostics::visible(text));
  }

  void refuse(const Line& line, std::string_view why) {
    diagnostics_.report(Kind::kFllNotTaken, line.span, {why});
    good_ = false;
  }

  /// What is missing for a `fuzzy` block; empty if nothing is.
  [[nodiscard]] std::string_view missing_part() const {
    const auto outputs = std::count_if(engine_.variables.begin(), engine_.variables.end(), [](const Variable& one) { return one.output; });
    if (static_cast<std::size_t>(outputs) == engine_.variables.size()) return "inputs";
    if (outputs == 0) return "outputs";
    return std::all_of(engine_.blocks.begin(), engine_.blocks.end(), [](const Block& one) { return one.rules.empty(); }) ? "rules" : "";
  }

  void write_operators() {
    std::string conjunction, disjunction;
    for (const Block& block : engine_.blocks) {
      const bool other = (!conjunction.empty() && !block.conjunction.empty() && conjunction != block.conjunction) ||
                         (!disjunction.empty() && !block.disjunction.empty() && disjunction != block.disjunction);
      if (other && !block.rules.empty()) refuse(block.rules.front(), "it stands in a block whose `and` or `or` is another than that of the block before");
      if (conjunction.empty()) conjunction = block.conjunction;
      if (disjunction.empty()) disjunction = block.disjunction;
    }
    if (!conjunction.empty()) fmt::format_to(Out(out_), "    and = {}\n", conjunction);
    if (!disjunction.empty()) fmt::format_to(Out(out_), "    or = {}\n", disjunction);
  }

  // ---- terms

  /// A shape of the language; empty if there is none (reported).
  std::string shape(const Term& term) {
    struct Known { std::string_view kind; std::size_t count; };
    constexpr Known kKnown[] = {{"Triangle", 3}, {"Trapezoid", 4}, {"Rectangle", 2}, {"Ramp", 2}, {"Gaussian", 2},
                                {"GaussianProduct", 4}, {"Bell", 3}, {"Sigmoid", 2}};
    const auto* known = std::find_if(std::begin(kKnown), std::end(kKnown), [&](const Known& one) { return one.kind == term.kind; });
    if (known == std::end(kKnown)) return refused(term, fmt::format("terms of the kind `{}` are not known", term.kind));
    std::vector<double> p = term.numbers;
    if (p.size() == known->count + 1 && p.back() == 1.0) p.pop_back();
    if (p.size() == known->count + 1) return refused(term, "a term whose height is not 1 is not known");
    if (p.size() != known->count) return refused(term, fmt::format("a `{}` has {} numbers", term.kind, known->count));
    if (std::any_of(p.begin(), p.end(), [](double x) { return std::isnan(x); })) return refused(term, "NaN is no number that a term can have");
    if (term.kind == "Trapezoid" || term.kind == "Triangle") return corners(term, p);
    if (std::any_of(p.begin(), p.end(), [](double x) { return std::isinf(x); })) return refused(term, "an infinite number can stand in a `Trapezoid` only");
    if (term.kind == "Rectangle" && p[0] > p[1]) return refused(term, "its sides stand in the wrong order, so that it is 0 everywhere");
    if (term.kind == "Rectangle") return fmt::format("trapezoid({0}, {0}, {1}, {1})", p[0], p[1]);
    if (term.kind == "Ramp") return p[0] == p[1] ? refused(term, "a ramp leads from one number to another") : fmt::format("ramp({}, {})", p[0], p[1]);
    if (p[1] == 0.0 || (p.size() == 4 && p[3] == 0.0)) return refused(term, "a spread, a width or a slope of 0 is not known");
    if (term.kind == "Gaussian") return fmt::format("gaussian({}, {})", p[0], std::fabs(p[1]));
    if (term.kind == "GaussianProduct") {
      if (p[0] > p[2]) return refused(term, "the two means stand in the wrong order, so that it never reaches 1");
      return fmt::format("gaussian({}..{}, left {}, right {})", p[0], p[2], std::fabs(p[1]), std::fabs(p[3]));
    }
    if (term.kind == "Bell" && p[2] <= 0.0) return refused(term, "the slope of a bell must be above 0");
    if (term.kind == "Bell") return fmt::format("bell({}, {}, {})", p[0], std::fabs(p[1]), p[2]);
    return fmt::format("sigmoid({}, {})", p[0], p[1]);
  }

  std::string refused(const Term& term, std::string_view why) {
    refuse(term.line, why);
    return {};
  }

  /// A triangle or a trapezoid. If it is infinite on one side, it is a ramp.
  std::string corners(const Term& term, const std::vector<double>& p) {
    const auto finite = [](double x) { return std::isfinite(x); };
    if (!std::is_sorted(p.begin(), p.end())) return refused(term, "its corners must go upwards");
    if (std::all_of(p.begin(), p.end(), finite)) return fmt::format("{}({})", p.size() == 3 ? "triangle" : "trapezoid", fmt::join(p, ", "));
    if (p.size() == 4 && std::isinf(p[0]) && finite(p[2]) && finite(p[3]) && p[2] < p[3]) return fmt::format("ramp({}, {})", p[3], p[2]);
    if (p.size() == 4 && std::isinf(p[3]) && finite(p[0]) && finite(p[1]) && p[0] < p[1]) return fmt::format("ramp({}, {})", p[0], p[1]);
    if (p.size() == 3 && std::isinf(p[0]) && finite(p[1]) && finite(p[2]) && p[1] < p[2]) return fmt::format("ramp({}, {})", p[2], p[1]);
    if (p.size() == 3 && std::isinf(p[2]) && finite(p[0]) && finite(p[1]) && p[0] < p[1]) return fmt::format("ramp({}, {})", p[0], p[1]);
    return refused(term, "its infinite corners leave no flank that is known");
  }

  void write_input(const Variable& variable) {
    if (!variable.low || !variable.high) return refuse(variable.line, "it has no range");
    if (variable.terms.empty()) return refuse(variable.line, "it has no terms, so that no rule could speak of it");
    write_comment(variable.description, "    ");
    fmt::format_to(Out(out_), "    input  {} {}..{} {{\n", variable.kb, *variable.low, *variable.high);
    for (const Term& term : variable.terms) fmt::format_to(Out(out_), "        {} = {}\n", term.kb, shape(term));
    out_ += "    }\n";
  }

  // ---- outputs

  [[nodiscard]] std::vector<const Variable*> inputs() const {
    std::vector<const Variable*> all;
    for (const Variable& variable : engine_.variables) {
      if (!variable.output) all.push_back(&variable);
    }
    return all;
  }

  /// The least and the greatest value that a term of an output can have while the inputs are in their ranges.
  std::pair<double, double> hull(const Term& term) const {
    if (term.kind == "Constant") return {term.numbers.front(), term.numbers.front()};
    const auto in = inputs();
    double low = term.numbers.size() > in.size() ? term.numbers.back() : 0.0, high = low;
    for (std::size_t i = 0; i < std::min(in.size(), term.numbers.size()); ++i) {
      const double a = term.numbers[i] * in[i]->low.value_or(0.0), b = term.numbers[i] * in[i]->high.value_or(0.0);
      low += std::min(a, b);
      high += std::max(a, b);
    }
    return {low, high};
  }

  bool sound(const Variable& variable) {
    bool sound = variable.low && variable.high;
    if (!sound) refuse(variable.line, "it has no range");
    if (variable.defuzzifier.empty()) {
      refuse(variable.line, "it has no defuzzifier");
      sound = false;
    }
    for (const Term& term : variable.terms) {
      const bool constant = term.kind == "Constant" && term.numbers.size() == 1;
      const bool linear = term.kind == "Linear" && term.numbers.size() <= inputs().size() + 1;
      const bool finite = std::all_of(term.numbers.begin(), term.numbers.end(), [](double x) { return std::isfinite(x); });
      if ((constant || linear) && finite) continue;
      refuse(term.line, constant || linear ? "a value must be finite" : "an output has terms `Constant`, with one number, and `Linear`, with at most one number more than there are inputs");
      sound = false;
    }
    return sound;
  }

  void write_output(const Variable& variable) {
    if (!sound(variable)) return;
    double low = *variable.low, high = *variable.high;
    if (!variable.lock_range) widen(variable, low, high);
    write_comment(variable.description, "    ");
    fmt::format_to(Out(out_), "    output {} {}..{} {{", variable.kb, low, high);
    for (const Term& term : variable.terms) {
      if (term.kind != "Constant") continue;
      fmt::format_to(Out(out_), "{}{} = {}", out_.ends_with('{') ? " " : "  ", term.kb, term.numbers.front());
    }
    out_ += " }";
    if (variable.defuzzifier == "WeightedSum") out_ += " by sum";
    if (variable.fallback) {
      const double inside = std::clamp(*variable.fallback, low, high);
      if (inside != *variable.fallback) refuse(variable.line, "its default lies outside its range");
      fmt::format_to(Out(out_), " default {}", inside);
    }
    out_ += '\n';
  }

  /// Widens the range of an output to all values that it can have, because fuzzylite does not clamp this output to its range.
  void widen(const Variable& variable, double& low, double& high) {
    double least = low, most = high, below = 0.0, above = 0.0;
    for (const Term& term : variable.terms) {
      const auto [a, b] = hull(term);
      least = std::min(least, a);
      most = std::max(most, b);
      below = std::min(below, a);
      above = std::max(above, b);
    }
    if (variable.defuzzifier == "WeightedSum") {
      std::size_t rules = 0;
      for (const Block& block : engine_.blocks) rules += block.rules.size();
      least = std::min(least, below * static_cast<double>(rules));
      most = std::max(most, above * static_cast<double>(rules));
    }
    if (least == low && most == high) return;
    low = least;
    high = most;
    diagnostics_.report(Kind::kFllAdapted, variable.line.span, {fmt::format("its range becomes {}..{}, so that nothing is clamped", low, high)});
  }

  // ---- rules

  void write_rule(const Line& line, const Block& block) {
    std::string spaced;
    for (const char c : line.value) spaced += c == '(' || c == ')' ? fmt::format(" {} ", c) : std::string(1, c);
    const auto all = words(spaced);
    const auto then = std::find(all.begin(), all.end(), "then");
    const auto with = std::find(then, all.end(), "with");
    if (all.empty() || all.front() != "if" || then == all.end()) return refuse(line, "a rule is `if ... then ...`");
    std::string text = "    ";
    if (!write_condition(line, block, {all.begin() + 1, then}, text) || !write_conclusions(line, {then + 1, with}, text)) return;
    if (with != all.end()) {
      const double weight = with + 2 == all.end() ? number(*(with + 1)).value_or(-1.0) : -1.0;
      if (!(weight > 0.0 && weight <= 1.0)) return refuse(line, "its weight must be a number above 0 and not above 1");
      if (weight != 1.0) text += fmt::format(" weight {}", weight);
    }
    out_ += text + "\n";
  }

  /// Why `part` cannot stand behind `is`; empty if it can. A hedge comes before a term of its name, as in fuzzylite.
  static std::string fault_behind_is(const Variable& input, std::string_view part) {
    if (part == "extremely" || part == "seldom" || part == "any") return fmt::format("the hedge `{}` is not known", part);
    return fuzzy::hedge_of(part) || input.terms.find(part) != nullptr ? "" : fmt::format("`{}` has no term `{}`", input.name, part);
  }
  static std::string fault_behind_term(const Block& block, std::string_view part) {
    if (part != "and" && part != "or") return fmt::format("`{}` has no meaning behind a term", part);
    const bool known = !(part == "and" ? block.conjunction : block.disjunction).empty();
    return known ? "" : fmt::format("it has an `{}`, of which its block does not say what it is", part);
  }

  /// Checks a condition and copies it: it is written alike in both languages, except that ours also allows `not` before parentheses.
  bool write_condition(const Line& line, const Block& block, const std::vector<std::string_view>& parts, std::string& text) {
    enum class Next : std::uint8_t { kInput, kIs, kTerm, kJoin } next = Next::kInput;
    const Variable* input = nullptr;
    std::string fault;
    int open = 0;
    for (const std::string_view part : parts) {
      std::string word(part);
      if (next == Next::kInput && part == "(") {
        ++open;
        text += part;
        continue;
      }
      if (next == Next::kJoin && part == ")" && open-- > 0) {
        text.back() = ')';
        text += ' ';
        continue;
      }
      if (next == Next::kInput) {
        input = engine_.variables.find(part);
        if (input == nullptr || input->output) fault = fmt::format("`{}` is no input", part);
        else word = input->kb;
        next = Next::kIs;
      } else if (next == Next::kIs) {
        if (part != "is") fault = fmt::format("`is` comes behind an input, not `{}`", part);
        next = Next::kTerm;
      } else if (next == Next::kTerm) {
        fault = fault_behind_is(*input, part);
        if (fault.empty() && !fuzzy::hedge_of(part)) word = input->terms.find(part)->kb;
        if (!fuzzy::hedge_of(part)) next = Next::kJoin;
      } else {
        fault = fault_behind_term(block, part);
        next = Next::kInput;
      }
      if (!fault.empty()) break;
      text += word + ' ';
    }
    if (fault.empty() && (next != Next::kJoin || open != 0)) fault = "its condition is not complete";
    if (!fault.empty()) refuse(line, fault);
    text += "->";
    return fault.empty();
  }

  bool write_conclusions(const Line& line, const std::vector<std::string_view>& parts, std::string& text) {
    std::set<const Variable*> given;
    for (std::size_t i = 0; i <= parts.size(); i += 4) {
      const bool whole = i + 2 < parts.size() && parts[i + 1] == "is" && (i + 3 == parts.size() || parts[i + 3] == "and");
      const Variable* output = whole ? engine_.variables.find(parts[i]) : nullptr;
      if (output == nullptr || !output->output) {
        refuse(line, "a conclusion is `output is term`, without hedges, joined by `and`");
        return false;
      }
      if (!given.insert(output).second) {
        refuse(line, fmt::format("it gives `{}` two values", output->name));
        return false;
      }
      const Term* const term = output->terms.find(parts[i + 2]);
      if (term == nullptr) {
        refuse(line, fmt::format("`{}` has no term `{}`", output->name, parts[i + 2]));
        return false;
      }
      text += fmt::format("{} {} = {}", i == 0 ? "" : ",", output->kb, value(*term));
    }
    return true;
  }

  [[nodiscard]] std::string value(const Term& term) const {
    if (term.kind == "Constant") return term.kb;
    const auto in = inputs();
    std::string sum;
    for (std::size_t i = 0; i < std::min(in.size(), term.numbers.size()); ++i) {
      const double k = term.numbers[i];
      if (k == 0.0) continue;
      sum += fmt::format("{}{}*{}", sum.empty() ? (k < 0 ? "-" : "") : (k < 0 ? " - " : " + "), std::fabs(k), in[i]->kb);
    }
    const double rest = term.numbers.size() > in.size() ? term.numbers.back() : 0.0;
    if (sum.empty()) return fmt::format("{}", rest);
    if (rest != 0.0) sum += fmt::format(" {} {}", rest < 0 ? "-" : "+", std::fabs(rest));
    return sum;
  }

  const Engine& engine_;
  diagnostics::Diagnostics& diagnostics_;
  std::string out_;
  bool good_ = true;
};

}  // namespace

std::optional<std::string> import_engine(const source::Sources& sources, source::FileId file, diagnostics::Diagnostics& diagnostics) {
  Reader reader(sources, file, diagnostics);
  const Engine engine = reader.run();
  if (reader.foreign()) return std::nullopt;
  auto text = Writer(engine, diagnostics).run();
  if (!reader.good()) return std::nullopt;
  return text;
}

}  // namespace kb::fll
