#include "tools/kbc/lsp/mention.h"

#include <algorithm>

namespace kb::lsp {
namespace {

using syntax::Lexeme;

std::vector<const model::KnownName*> called(std::string_view name, const std::vector<model::KnownName>& names) {
  std::vector<const model::KnownName*> out;
  const auto at = std::ranges::lower_bound(names, name, {}, &model::KnownName::name);
  for (auto one = at; one != names.end() && one->name == name; ++one) {
    if (one->kind != "control") out.push_back(&*one);   // says something of a strategy, which is there as well
  }
  return out;
}

}  // namespace

std::optional<Mention> mention_at(const source::Sources& sources, source::FileId file, std::uint32_t offset) {
  const std::vector<Lexeme> all = syntax::lexemes(sources, file);
  const auto holds = [&](const Lexeme& one) { return one.what == Lexeme::Class::kName && one.span.begin <= offset && offset <= one.span.end; };
  const auto found = std::ranges::find_if(all, holds);
  if (found == all.end()) return std::nullopt;
  Mention out{found->span, sources.text(found->span), {}};
  for (auto at = found; at - all.begin() >= 2 && sources.text((at - 1)->span) == "." && (at - 2)->what == Lexeme::Class::kName; at -= 2) {
    out.before.insert(0, std::string(sources.text((at - 2)->span)) + ".");
  }
  return out;
}

std::vector<const model::KnownName*> meanings(const Mention& mention, const std::vector<model::KnownName>& names) {
  if (mention.before.empty()) return called(mention.name, names);
  std::string whole = mention.before + std::string(mention.name);
  auto out = called(whole, names);
  if (out.empty()) out = called(std::string_view(mention.before).substr(0, mention.before.size() - 1), names);
  return out;
}

}  // namespace kb::lsp
