// The outline of a file: its statements, and what they declare.
#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <set>

#include "compiler/source/encoding.h"
#include "compiler/syntax/syntax.h"
#include "tools/kbc/lsp/answers.h"
#include "tools/kbc/lsp/kinds.h"
#include "tools/kbc/lsp/names.h"
#include "tools/kbc/lsp/roots.h"

namespace kb::lsp {
namespace {

using Space = Meaning::Space;

/// An entry of the outline.
Json entry(const OpenFile& file, const Use& use, source::Span whole) {
  const Symbol what = symbol(file.knowledge, use).value_or(Symbol{});
  return {{"name", file.sources().text(use.span)}, {"detail", detail(what)}, {"kind", editor_kind(what.kind).symbol}, {"range", file.range(whole)}, {"selectionRange", file.range(use.span)}};
}

/// Whether the name alone identifies it.
bool by_itself(const Use& use) { return use.meaning.space == Space::kName || use.meaning.space == Space::kLevel || use.meaning.space == Space::kRule; }

/// What a statement declares, in its order.
std::vector<Use> declared(const OpenFile& file, source::Span statement) {
  const std::vector<Use>& uses = file.knowledge.uses;
  const auto begin = [](const Use& use) { return std::pair(use.span.file, use.span.begin); };
  const auto first = std::ranges::lower_bound(uses, std::pair(statement.file, statement.begin), {}, begin);
  const auto end = std::ranges::lower_bound(first, uses.end(), std::pair(statement.file, statement.end), {}, begin);
  std::vector<Use> out;
  std::copy_if(first, end, std::back_inserter(out), [](const Use& use) { return use.declares && use.meaning.space != Space::kVariable; });
  return out;
}

/// A control line declares nothing, but users look for it.
Json entry(const OpenFile& file, const syntax::Control& control, source::Span whole) {
  const source::Span strategy = (*file.knowledge.tree(file.id))[control.strategy].span;
  const std::string drives = "control = " + std::string(control.controller.text);
  return {{"name", file.sources().text(strategy)}, {"detail", drives}, {"kind", editor_kind("control").symbol}, {"range", file.range(whole)}, {"selectionRange", file.range(strategy)}};
}

void add_symbols(const OpenFile& file, const syntax::Statement& statement, Json& out) {
  if (const auto* control = std::get_if<syntax::Control>(&statement.node)) return out.push_back(entry(file, *control, statement.span));
  const std::vector<Use> all = declared(file, statement.span);
  const bool map = std::holds_alternative<syntax::Map>(statement.node);
  Json* owner = nullptr;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (owner != nullptr && (map || !by_itself(all[i]))) {
      (*owner)["children"].push_back(entry(file, all[i], all[i].span));
      continue;
    }
    const auto next = map ? all.end() : std::find_if(all.begin() + static_cast<std::ptrdiff_t>(i) + 1, all.end(), by_itself);
    const source::Span whole{statement.span.file, owner == nullptr ? statement.span.begin : all[i].span.begin, next == all.end() ? statement.span.end : next->span.begin};
    out.push_back(entry(file, all[i], whole));
    if (by_itself(all[i])) owner = &out.back();
  }
}

}  // namespace

Json symbols(const OpenFile& file) {
  Json out = Json::array();
  for (const syntax::Statement& statement : file.statements()) add_symbols(file, statement, out);
  return out;
}

Json workspace_symbols(const Workspace& workspace, const std::string& query, Encoding encoding) {
  const auto alike = [&](char a, char b) { return source::lower(a) == source::lower(b); };
  Json out = Json::array();
  std::set<std::pair<std::string, std::uint32_t>> told;   // two knowledge bases may have a file in common
  for (const auto& [root, knowledge] : workspace.all()) {
    const source::Sources& sources = knowledge.compiled->sources;
    for (const Use& use : knowledge.uses) {
      if (!use.declares || use.meaning.space == Space::kVariable || sources.standard(use.span.file)) continue;
      const std::string_view name = sources.text(use.span);
      if (std::search(name.begin(), name.end(), query.begin(), query.end(), alike) == name.end()) continue;
      const std::string& path = knowledge.path(use.span.file);
      if (!told.emplace(path, use.span.begin).second) continue;
      const Symbol what = symbol(knowledge, use).value_or(Symbol{});
      out.push_back({{"name", name}, {"kind", editor_kind(what.kind).symbol}, {"containerName", detail(what)}, {"location", {{"uri", workspace.uri(path)}, {"range", range_of(knowledge, use.span, encoding)}}}});
    }
  }
  return out;
}

Json folds(const OpenFile& file) {
  const source::Sources& sources = file.sources();
  Json out = Json::array();
  const auto line_of = [&](std::uint32_t offset) { return sources.locate(file.id, offset).line - 1; };
  const auto add = [&](std::uint32_t first, std::uint32_t last, std::string_view kind) {
    if (first < last) out.push_back({{"startLine", first}, {"endLine", last}, {"kind", kind}});
  };
  for (const syntax::Statement& statement : file.statements()) add(line_of(statement.span.begin), line_of(statement.span.end - 1), "region");
  std::optional<std::pair<std::uint32_t, std::uint32_t>> run;   // of comments, each on a line of its own
  for (const syntax::Lexeme& one : syntax::lexemes(sources, file.id)) {
    const source::Sources::Line line = sources.line_of(file.id, one.span.begin);
    if (one.what != syntax::Lexeme::Class::kComment || line.text.find_first_not_of(" \t") != one.span.begin - line.begin) continue;
    const std::uint32_t number = line_of(one.span.begin);
    if (run && run->second + 1 != number) add(run->first, run->second, "comment");
    if (!run || run->second + 1 != number) run = {number, number};
    run->second = number;
  }
  if (run) add(run->first, run->second, "comment");
  return out;
}

Json selections(const OpenFile& file, Position at) {
  const std::uint32_t here = file.offset(at);
  std::vector<source::Span> spans{{file.id, 0, static_cast<std::uint32_t>(file.text().size())}};
  const auto add = [&](source::Span span) {
    if (span.file == file.id && span.begin <= here && here <= span.end) spans.push_back(span);
  };
  for (const syntax::Lexeme& one : syntax::lexemes(file.sources(), file.id)) add(one.span);
  if (const syntax::Tree* const tree = file.knowledge.tree(file.id)) {
    for (const syntax::Statement& one : tree->statements) add(one.span);
    for (const syntax::Cond& one : tree->conds) add(one.span);
    for (const syntax::Percept& one : tree->percepts) add(one.span);
    for (const syntax::Shape& one : tree->shapes) add(one.span);
    for (const syntax::Ref& one : tree->refs) add(one.span);
  }
  std::ranges::sort(spans, std::greater(), [](source::Span span) { return std::pair(span.end - span.begin, span.begin); });
  Json out = nullptr;
  source::Span last = spans.front();
  for (const source::Span& span : spans) {
    const bool within = last.begin <= span.begin && span.end <= last.end;   // a place between two names is both the end of one and the beginning of the other
    Json range = file.range(span);
    if (!within || (!out.is_null() && out["range"] == range)) continue;
    Json inner{{"range", std::move(range)}};
    if (!out.is_null()) inner["parent"] = std::move(out);
    out = std::move(inner);
    last = span;
  }
  return out;
}

Json links(const OpenFile& file) {
  Json out = Json::array();
  for (const syntax::Statement& statement : file.statements()) {
    const auto* const import = std::get_if<syntax::Import>(&statement.node);
    if (import == nullptr) continue;
    const std::string meant = imported_file(*import, file.path, file.workspace.files(), file.workspace.library());
    if (file.workspace.files().read(meant).bytes) out.push_back({{"range", file.range(import->path_span)}, {"target", file.workspace.uri(meant)}});
  }
  return out;
}

}  // namespace kb::lsp
