#include "tools/kbc/lsp/control_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include <waymark/controllers/registry.h>

#include "sim/mind/control_words.h"

namespace kb::lsp {
namespace {

using syntax::Lexeme;

ControllerArgument argument_of(const mts::Parameter& parameter) {
  ControllerArgument out{parameter.name, {}, parameter.about, {}};
  const mts::Words words = mts::words_of(parameter.values);
  for (std::size_t i = 0; i < words.count; ++i) out.words.emplace_back(words.first[i]);
  out.takes = words.count > 0 ? fmt::format("{}", fmt::join(out.words, ", ")) : sim::range_text(parameter, sim::kRobot);
  return out;
}

}  // namespace

std::optional<KnownController> known_controller(const Knowledge& knowledge, std::string_view name) {
  KnownController out{std::string(name), {}, {}};
  const auto& blocks = knowledge.compiled->model.fuzzy;
  if (const auto block = std::ranges::find(blocks, name, &fuzzy::Controller::name); block != blocks.end()) {
    for (const fuzzy::Input& input : block->inputs) {
      if (!input.group) out.arguments.push_back({input.name, fmt::format("{:g} to {:g}{}{}", input.low, input.high, input.unit.empty() ? "" : " ", input.unit), {}, {}});
    }
    return out;
  }
  const mts::ControllerEntry* const entry = mts::find_controller(out.name.c_str());
  if (entry == nullptr) return std::nullopt;
  out.about = fmt::format("{}; needs {}", entry->about, entry->needs);
  mts::for_each_parameter(entry->id, [&](const mts::Parameter& parameter) { out.arguments.push_back(argument_of(parameter)); });
  return out;
}

std::string label(const ControllerArgument& argument) { return argument.name + ": " + argument.takes; }

std::string label(const KnownController& controller) {
  std::string out;
  for (const ControllerArgument& argument : controller.arguments) out += (out.empty() ? "" : ", ") + label(argument);
  return controller.name + "(" + out + ")";
}

std::optional<ControlLine> control_line_at(const OpenFile& file, std::span<const Lexeme> lexemes, std::uint32_t offset) {
  const source::Sources& sources = file.sources();
  std::vector<Lexeme> all;
  std::ranges::copy_if(lexemes, std::back_inserter(all), [&](const Lexeme& one) { return one.what != Lexeme::Class::kComment && one.span.end <= offset; });
  const auto text = [&](const auto& one) { return sources.text(one->span); };
  const auto word = std::find_if(all.rbegin(), all.rend(), [&](const Lexeme& one) { return one.what == Lexeme::Class::kWord && sources.text(one.span) == "control"; }).base();
  const auto open = std::find_if(word, all.end(), [&](const Lexeme& one) { return sources.text(one.span) == "("; });
  if (word == all.begin() || open == all.end() || open - word < 3 || text(open - 2) != "=") return std::nullopt;
  ControlLine out{text(open - 1), {}, {}};
  for (auto at = open + 1; at != all.end(); ++at) {
    if (text(at) == ")" || at->what == Lexeme::Class::kWord) return std::nullopt;
    if (text(at) == ",") out.argument = {};
    if (text(at) != ":") continue;
    out.argument = text(at - 1);
    out.given.push_back(out.argument);
  }
  return out;
}

Json signature(const OpenFile& file, Position at) {
  const auto line = control_line_at(file, syntax::lexemes(file.sources(), file.id), file.offset(at));
  const auto controller = line ? known_controller(file.knowledge, line->controller) : std::nullopt;
  if (!controller) return nullptr;
  Json parameters = Json::array();
  for (const ControllerArgument& argument : controller->arguments) parameters.push_back({{"label", label(argument)}, {"documentation", argument.about}});
  Json one{{"label", label(*controller)}, {"parameters", parameters}};
  if (!controller->about.empty()) one["documentation"] = controller->about;
  const auto now = std::ranges::find(controller->arguments, line->argument, &ControllerArgument::name);
  // Arguments have names and may come in any order, so until a name is written none of them is the active one.
  return {{"signatures", {one}}, {"activeSignature", 0}, {"activeParameter", now - controller->arguments.begin()}};
}

}  // namespace kb::lsp
