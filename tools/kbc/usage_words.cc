#include "tools/kbc/usage_words.h"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/diagnostics/display.h"
#include "compiler/source/encoding.h"

namespace kb::cli {
namespace {

/// "--color: allways not in {auto,always,never}"
std::string none_of(std::string_view name, std::string_view word, std::string_view choices) {
  const std::vector<std::string_view> known = source::split(choices, ',');
  std::string text = fmt::format("{}: {} is none of {}", name, diagnostics::quoted_code(word), diagnostics::listed(known, known.size()));
  if (const auto better = diagnostics::closest(word, known)) text += "; did you mean `" + *better + "`?";
  return text;
}

/// The parts of `text` around `between`; the second is empty if it is not there.
std::pair<std::string_view, std::string_view> split(std::string_view text, std::string_view between) {
  const std::size_t at = text.find(between);
  if (at == std::string_view::npos) return {text, {}};
  return {text.substr(0, at), text.substr(at + between.size())};
}

}  // namespace

std::string usage_words(const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::string& kind = error.get_name();
  if (kind == "ExcludesError") {
    if (const auto [one, other] = split(text, " excludes "); !other.empty()) return fmt::format("{} and {} do not go together", one, other);
  } else if (kind == "RequiresError") {
    if (const auto [one, other] = split(text, " requires "); !other.empty()) return fmt::format("{} is of use only with {}", one, other);
  } else if (kind == "ArgumentMismatch") {
    const auto [name, what] = split(text, ": ");
    if (what.starts_with("At Most 1 required")) return fmt::format("{} is there more than once", name);
    if (what.starts_with("1 required ") && what.ends_with(" missing")) return fmt::format("{} needs a value: {}", name, what.substr(11, what.size() - 19));
  } else if (kind == "ValidationError") {
    const auto [name, what] = split(text, ": ");
    const std::size_t at = what.rfind(" not in {");
    if (at != std::string_view::npos && what.ends_with('}')) return none_of(name, what.substr(0, at), what.substr(at + 9, what.size() - at - 10));
  }
  return text;
}

}  // namespace kb::cli
