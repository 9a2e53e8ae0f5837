#include "tools/kbc/fll/import_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compiler/fuzzy/controller.h"
#include "compiler/source/encoding.h"
#include "compiler/source/numbers.h"
#include "compiler/syntax/syntax.h"
#include "compiler/syntax/words.h"

namespace kb::fll {
namespace {

using diagnostics::Kind;

constexpr std::string_view kTakenAsEnd = "values outside the range are taken as its nearest end";

}  // namespace

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find_first_not_of(" \t\r", at);
    if (begin == std::string_view::npos) break;
    const std::size_t end = std::min(text.find_first_of(" \t\r", begin), text.size());
    out.push_back(text.substr(begin, end - begin));
    at = end;
  }
  return out;
}

std::string kb_name(std::string_view text) {
  std::string out = syntax::worded(text);
  if (!out.empty() && out[0] >= '0' && out[0] <= '9') out.insert(0, 1, '_');
  const auto foreign = [](char c) { return static_cast<unsigned char>(c) >= 0x80; };
  if (!out.empty() && foreign(out[0]) && !syntax::is_name(out)) std::replace_if(out.begin(), out.end(), foreign, '_');   // no name can begin with that letter
  const bool word = syntax::keyword(out) != syntax::TokenKind::kIdentifier || fuzzy::hedge_of(out);
  return out.empty() || word ? out + '_' : out;
}

std::optional<double> number(std::string_view text) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  if (text == "inf" || text == "+inf") return kInf;
  if (text == "-inf") return -kInf;
  if (text == "nan" || text == "-nan") return std::numeric_limits<double>::quiet_NaN();
  double value = 0.0;
  return source::read_number(source::without_plus(text), value) ? std::optional(value) : std::nullopt;
}

Reader::Reader(const source::Sources& sources, source::FileId file, diagnostics::Diagnostics& diagnostics)
    : sources_(sources), file_(file), diagnostics_(diagnostics) {}

Engine Reader::run() {
  engine_.line.span = {file_, 0, 0};
  if (sources_.bytes(file_).starts_with(source::kByteOrderMark)) at_ = source::kByteOrderMark.size();
  while (const auto line = next_line()) {
    if (line->key.empty() && line->value.empty()) continue;
    take(*line);
  }
  for (const Variable& variable : engine_.variables) {
    if (!variable.output && !variable.range_told) adapt(variable.line, kTakenAsEnd);   // without such a line fuzzylite does not lock the range
  }
  if (engine_.name.empty()) engine_.name = "Engine";
  return std::move(engine_);
}

// The next line, without its comment. Nothing at the end of the file.
std::optional<Line> Reader::next_line() {
  const std::string_view bytes = sources_.bytes(file_);
  if (at_ >= bytes.size()) return std::nullopt;
  const std::size_t end = std::min(bytes.find('\n', at_), bytes.size());
  std::string_view text = bytes.substr(at_, end - at_);
  text = source::trimmed(text.substr(0, text.find('#')));
  at_ = end + 1;
  Line line;
  if (text.empty()) return line;
  const auto begin = static_cast<std::uint32_t>(text.data() - bytes.data());
  line.span = {file_, begin, begin + static_cast<std::uint32_t>(text.size())};
  const std::size_t colon = text.find(':');
  line.key = source::trimmed(text.substr(0, colon));
  line.value = colon == std::string_view::npos ? text.substr(text.size()) : source::trimmed(text.substr(colon + 1));
  if (colon == std::string_view::npos) {
    refuse(line, begun_ ? "it is no `key: value`" : "a file in FLL has lines `key: value`, the first of which is `Engine: NAME`; FCL is another language");
    if (!begun_) return std::nullopt;
    return Line{};
  }
  begun_ = true;
  return line;
}

void Reader::refuse(const Line& line, std::string_view why) {
  diagnostics_.report(Kind::kFllNotTaken, line.span, {why});
  good_ = false;
}

void Reader::adapt(const Line& line, std::string_view how) { diagnostics_.report(Kind::kFllAdapted, line.span, {how}); }

/// The name for `text` that is none of `others`. Reported if it is not `text` itself.
template <typename One>
std::string Reader::name_beside(const Named<One>& others, const Line& line, std::string_view text) {
  std::string name = kb_name(text);
  if (others.find(text) != nullptr) {
    refuse(line, fmt::format("a second `{}`", text));
    return name;
  }
  while (others.has_kb(name)) name += '_';
  if (name != text) adapt(line, fmt::format("the name becomes `{}`", name));
  return name;
}

/// The number that `text` is, which may be infinite or NaN. Nothing, reported, if it is none, or too large or small for the language.
std::optional<double> Reader::number_of(const Line& line, std::string_view text) {
  const auto value = number(text);
  const double size = std::fabs(value.value_or(0.0));
  if (!value) refuse(line, fmt::format("`{}` is not a number", text));
  const bool out_of_reach = std::isfinite(size) && size != 0.0 && (size < 1e-18 || size > 1e18);
  if (out_of_reach) refuse(line, fmt::format("the size of `{}` does not lie between 1e-18 and 1e18", text));
  return out_of_reach ? std::nullopt : value;
}

bool Reader::boolean(const Line& line) {
  if (line.value == "true" || line.value == "false") return line.value == "true";
  refuse(line, "it wants `true` or `false`");
  return false;
}

void Reader::take(const Line& line) {
  if (line.key == "InputVariable" || line.key == "OutputVariable" || line.key == "RuleBlock") told_.clear();
  if (line.key == "Engine") {
    section_ = Section::kEngine;
    if (!engine_.name.empty()) return refuse(line, "a second engine");
    engine_.name = std::string(line.value);
    engine_.line = line;
    if (!line.value.empty() && kb_name(line.value) != line.value) adapt(line, fmt::format("the name becomes `{}`", kb_name(line.value)));
    return;
  }
  if (line.key == "InputVariable" || line.key == "OutputVariable") {
    section_ = Section::kVariable;
    Variable variable;
    variable.output = line.key == "OutputVariable";
    variable.name = std::string(line.value);
    variable.line = line;
    variable.kb = name_beside(engine_.variables, line, line.value);
    engine_.variables.add(std::move(variable));
    return;
  }
  if (line.key == "RuleBlock") {
    section_ = Section::kBlock;
    engine_.blocks.emplace_back();
    return;
  }
  if (line.key == "description") return take_description(line.value);
  if (line.key == "enabled") {
    if (!boolean(line) && section_ != Section::kNone) refuse(line, "a part that is switched off would be on here; remove it");
    return;
  }
  if (line.key != "term" && line.key != "rule" && !told_.insert(line.key).second) return refuse(line, fmt::format("a second `{}`", line.key));
  switch (section_) {
    case Section::kVariable: return engine_.variables.back().output ? take_output(engine_.variables.back(), line) : take_input(engine_.variables.back(), line);
    case Section::kBlock: return take_block(engine_.blocks.back(), line);
    default: return refuse(line, fmt::format("`{}` is not known", line.key));
  }
}

void Reader::take_description(std::string_view text) {
  if (section_ == Section::kVariable) engine_.variables.back().description = text;
  else if (section_ == Section::kBlock) engine_.blocks.back().description = text;
  else engine_.description = text;
}

void Reader::take_range(Variable& variable, const Line& line) {
  const auto parts = words(line.value);
  if (parts.size() == 2) {
    variable.low = number_of(line, parts[0]);
    variable.high = number_of(line, parts[1]);
    if (!variable.low || !variable.high) {   // has been reported
      variable.low = 0.0;
      variable.high = 1.0;
      return;
    }
  }
  const bool sound = variable.low && variable.high && std::isfinite(*variable.low) && std::isfinite(*variable.high) && *variable.low < *variable.high;
  if (!sound) refuse(line, "a range is two finite numbers, the smaller one first");
}

void Reader::take_input(Variable& variable, const Line& line) {
  if (line.key == "range") return take_range(variable, line);
  if (line.key == "term") return take_term(variable, line);
  if (line.key != "lock-range") return refuse(line, fmt::format("`{}` is not known of an input", line.key));
  variable.lock_range = boolean(line);
  if (!variable.lock_range) adapt(line, kTakenAsEnd);
  variable.range_told = true;
}

void Reader::take_output(Variable& variable, const Line& line) {
  if (line.key == "range") return take_range(variable, line);
  if (line.key == "term") return take_term(variable, line);
  if (line.key == "lock-range") {
    variable.lock_range = boolean(line);
  } else if (line.key == "lock-previous" || line.key == "lock-valid") {
    if (boolean(line)) refuse(line, "an output has no memory; give it a default");
  } else if (line.key == "aggregation" || line.key == "accumulation") {
    if (line.value != "none" && !line.value.empty()) adapt(line, "an aggregation does nothing to weighted outputs");
  } else if (line.key == "default") {
    const auto value = number_of(line, line.value);
    if (value && std::isinf(*value)) refuse(line, "a default is a finite number or `nan`");
    if (value && std::isfinite(*value)) variable.fallback = value;
    if (value && std::isnan(*value)) adapt(line, "where no rule fires there is a number of the range and the status `no_rule`, not NaN");
  } else if (line.key == "defuzzifier") {
    const auto parts = words(line.value);
    const bool weighted = !parts.empty() && (parts[0] == "WeightedAverage" || parts[0] == "WeightedSum");
    const bool sugeno = parts.size() == 1 || (parts.size() == 2 && (parts[1] == "Automatic" || parts[1] == "TakagiSugeno"));
    variable.defuzzifier = parts.empty() ? "" : std::string(parts[0]);
    if (!weighted || !sugeno) return refuse(line, "only `WeightedAverage` and `WeightedSum` of Takagi-Sugeno engines are known, not engines of Mamdani, whose conclusions are fuzzy");
  } else {
    refuse(line, fmt::format("`{}` is not known of an output", line.key));
  }
}

void Reader::take_term(Variable& variable, const Line& line) {
  const auto parts = words(line.value);
  if (parts.size() < 2) return refuse(line, "a term is a name, a kind and numbers");
  Term term;
  term.name = std::string(parts[0]);
  term.kind = std::string(parts[1]);
  term.line = line;
  term.kb = name_beside(variable.terms, line, parts[0]);
  if (term.kind == "Function" || term.kind == "Discrete") return refuse(line, fmt::format("terms of the kind `{}` are not known", term.kind));
  for (std::size_t i = 2; i < parts.size(); ++i) {
    const auto value = number_of(line, parts[i]);
    if (!value) return;
    term.numbers.push_back(*value);
  }
  variable.terms.add(std::move(term));
}

/// The language's word for the norm that a line names for `and` or `or` (`word`): that of `one` or of `other`. Empty if it names none. An
/// unknown norm is reported and taken for `one`.
std::string Reader::norm(const Line& line, std::string_view word, const Norm& one, const Norm& other) {
  if (line.value.empty() || line.value == "none") return {};
  if (line.value == other.fll) return std::string(other.kb);
  if (line.value != one.fll) refuse(line, fmt::format("`{}` by `{}` is not known; `{}` and `{}` are", word, line.value, one.fll, other.fll));
  return std::string(one.kb);
}

void Reader::take_block(Block& block, const Line& line) {
  if (line.key == "rule") {
    block.rules.push_back(line);
  } else if (line.key == "conjunction") {
    block.conjunction = norm(line, "and", {"Minimum", "min"}, {"AlgebraicProduct", "product"});
  } else if (line.key == "disjunction") {
    block.disjunction = norm(line, "or", {"Maximum", "max"}, {"AlgebraicSum", "sum"});
  } else if (line.key == "implication" || line.key == "activation") {
    if (line.key == "implication" && line.value != "none" && !line.value.empty()) adapt(line, "an implication does nothing to weighted outputs");
    if (line.key == "activation" && line.value != "General" && line.value != "none" && !line.value.empty()) refuse(line, "only the activation `General` is known");
  } else {
    refuse(line, fmt::format("`{}` is not known of a block of rules", line.key));
  }
}

}  // namespace kb::fll
