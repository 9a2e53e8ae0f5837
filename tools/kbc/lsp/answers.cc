#include "tools/kbc/lsp/answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "compiler/diagnostics/consumers.h"
#include "compiler/syntax/syntax.h"
#include "tools/kbc/lsp/kinds.h"
#include "tools/kbc/lsp/mention.h"
#include "tools/kbc/lsp/uses.h"

namespace kb::lsp {
namespace {

using syntax::Lexeme;

Json range_of(const source::Sources& sources, source::Span span, Encoding encoding) {
  return lsp::range_of(position(sources, span.file, span.begin, encoding), position(sources, span.file, span.end, encoding));
}

Json location(const Workspace& workspace, const Knowledge& knowledge, source::Span span, Encoding encoding) {
  return {{"uri", workspace.uri(knowledge.path(span.file))}, {"range", range_of(knowledge.compiled->sources, span, encoding)}};
}

struct Found {
  source::Span span;   ///< of the name, in the text
  const Knowledge* knowledge = nullptr;
  std::vector<const model::KnownName*> meanings;
};

Found find(const OpenFile& file, const Text& text, Position at) {
  const Knowledge* const knowledge = file.workspace.of(file.path);
  const auto mention = mention_at(text.sources, text.file, offset(text.sources.bytes(text.file), at, file.encoding));
  if (knowledge == nullptr || !mention) return {};
  return {mention->span, knowledge, meanings(*mention, knowledge->names)};
}

/// The comment lines right above a declaration, without their signs.
std::string comment_above(const source::Sources& sources, source::Span declared) {
  std::vector<std::string_view> lines;
  for (std::uint32_t begin = sources.line_of(declared.file, declared.begin).begin; begin > 0;) {
    const auto line = sources.line_of(declared.file, begin - 1);
    const std::size_t sign = line.text.find_first_not_of(" \t");
    if (sign == std::string_view::npos || line.text[sign] != '#') break;
    const std::size_t at = line.text.find_first_not_of("# ", sign);
    lines.push_back(at == std::string_view::npos ? std::string_view() : line.text.substr(at));
    begin = line.begin;
  }
  return fmt::format("{}", fmt::join(lines.rbegin(), lines.rend(), "\n"));
}

std::string described(const Knowledge& knowledge, const model::KnownName& name) {
  std::string out = fmt::format("{} `{}`", name.kind, name.name);
  if (!name.more.empty()) out += fmt::format(" `{}`", name.more);
  if (!name.declared.known()) return out;
  const source::Sources& sources = knowledge.compiled->sources;
  std::string_view line = sources.line_of(name.declared.file, name.declared.begin).text;
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  out += fmt::format("\n```kb\n{}\n```\n", line);
  if (const std::string comment = comment_above(sources, name.declared); !comment.empty()) out += comment + "\n\n";
  return out + sources.origin(name.declared);
}

/// The file that an `import` on the line at `offset` means.
std::optional<std::string> imported_at(const OpenFile& file, const Text& text, std::uint32_t offset) {
  const auto line = text.sources.line_of(text.file, offset);
  const std::vector<Lexeme> all = syntax::lexemes(text.sources, text.file);
  const auto word = std::ranges::find_if(all, [&](const Lexeme& one) { return one.span.begin >= line.begin; });
  if (word == all.end() || text.sources.text(word->span) != "import" || word->span.begin > offset || word + 1 == all.end()) return std::nullopt;
  if ((word + 1)->what == Lexeme::Class::kString) {
    const std::string_view quoted = text.sources.text((word + 1)->span);
    const std::string_view written = quoted.substr(1, quoted.size() - std::min<std::size_t>(quoted.size(), 2));
    return (std::filesystem::path(file.path).parent_path() / written).string();
  }
  std::string path;
  for (auto part = word + 1; part != all.end() && part->span.begin < line.begin + line.text.size() && part->what != Lexeme::Class::kComment; ++part) {
    path += text.sources.text(part->span);
  }
  std::ranges::replace(path, '.', '/');
  return file.workspace.library() + "/" + path + ".kb";
}

Json message_json(const Workspace& workspace, const Knowledge& knowledge, const diagnostics::Diagnostic& message, Encoding encoding) {
  Json out{{"range", message.span.known() ? range_of(knowledge.compiled->sources, message.span, encoding) : lsp::range_of({}, {})},
           {"severity", message.severity == diagnostics::Severity::kError ? 1 : message.severity == diagnostics::Severity::kWarning ? 2 : 3},
           {"source", "kbc"},
           {"message", message.message}};
  if (diagnostics::info(message.kind).code != 0) out["code"] = diagnostics::code_text(message.kind);
  std::string& text = out["message"].get_ref<std::string&>();
  if (!message.suggestion.empty()) text += fmt::format("\ndid you mean `{}`?", message.suggestion);
  for (const diagnostics::Note& note : message.notes) {
    if (note.span.known()) out["relatedInformation"].push_back({{"location", location(workspace, knowledge, note.span, encoding)}, {"message", note.text}});
    else text += "\n" + note.text;
  }
  return out;
}

/// What stands in the place of `written`: messages name a file without its quotes, and one of the library with the word before it.
std::string instead_of(std::string_view written, const std::string& suggestion) {
  constexpr std::string_view kImport = "import ";
  if (!written.starts_with('"')) return suggestion;
  return suggestion.starts_with(kImport) ? suggestion.substr(kImport.size()) : "\"" + suggestion + "\"";
}

}  // namespace

Json range_of(Position begin, Position end) {
  const auto json = [](Position at) { return Json{{"line", at.line}, {"character", at.character}}; };
  return {{"start", json(begin)}, {"end", json(end)}};
}

std::map<std::string, Json> messages_by_uri(const Workspace& workspace, Encoding encoding) {
  std::map<std::string, Json> out;
  for (const auto& [root, knowledge] : workspace.all()) {
    for (const diagnostics::Diagnostic& message : knowledge.messages) {
      const std::string& path = message.span.known() ? knowledge.path(message.span.file) : root;
      Json& all = out.try_emplace(workspace.uri(path), Json::array()).first->second;
      const Json one = message_json(workspace, knowledge, message, encoding);
      if (std::ranges::find(all, one) == all.end()) all.push_back(one);   // two knowledge bases may have a file in common
    }
  }
  return out;
}

Json hover(const OpenFile& file, Position at) {
  const Text text(file);
  const Found found = find(file, text, at);
  if (found.meanings.empty()) return nullptr;
  std::vector<std::string> parts;
  for (const model::KnownName* name : found.meanings) parts.push_back(described(*found.knowledge, *name));
  return {{"contents", {{"kind", "markdown"}, {"value", fmt::format("{}", fmt::join(parts, "\n\n---\n"))}}}, {"range", range_of(text.sources, found.span, file.encoding)}};
}

Json definition(const OpenFile& file, Position at) {
  const Text text(file);
  const std::uint32_t place = offset(text.sources.bytes(text.file), at, file.encoding);
  if (const auto imported = imported_at(file, text, place)) {
    if (!file.workspace.files().read(*imported).bytes) return nullptr;
    return {{"uri", file.workspace.uri(file.workspace.canonical(*imported))}, {"range", lsp::range_of({}, {})}};
  }
  const Found found = find(file, text, at);
  Json out = nullptr;
  for (const model::KnownName* name : found.meanings) {
    if (name->declared.known()) out.push_back(location(file.workspace, *found.knowledge, name->declared, file.encoding));
  }
  return out;
}

Json references(const OpenFile& file, Position at, bool with_declaration) {
  const Text text(file);
  const Knowledge* const knowledge = file.workspace.of(file.path);
  const auto mention = mention_at(text.sources, text.file, offset(text.sources.bytes(text.file), at, file.encoding));
  if (knowledge == nullptr || !mention) return nullptr;
  const source::Sources& sources = knowledge->compiled->sources;
  const auto id = knowledge->file(file.path);
  const bool as_it_is = id && sources.bytes(*id) == text.sources.bytes(text.file);   // else it cannot be read, and is known from before
  const std::vector<Use> found = as_it_is ? uses_of_same(*knowledge, mention->name, file.path, mention->span.begin) : uses(*knowledge, mention->name);
  if (found.empty()) return nullptr;
  Json out = Json::array();
  for (const Use& use : found) {
    if (!sources.standard(use.span.file) && (with_declaration || !use.declares)) out.push_back(location(file.workspace, *knowledge, use.span, file.encoding));
  }
  return out;
}

Json symbols(const OpenFile& file) {
  const Knowledge* const knowledge = file.workspace.of(file.path);
  const auto id = knowledge == nullptr ? std::nullopt : knowledge->file(file.path);
  if (!id) return nullptr;
  std::vector<const model::KnownName*> declared;
  for (const model::KnownName& name : knowledge->names) {
    if (name.declared.file == *id) declared.push_back(&name);
  }
  std::ranges::stable_sort(declared, {}, [](const model::KnownName* name) { return name->declared.begin; });
  Json out = Json::array();
  for (const model::KnownName* name : declared) {
    const Json range = range_of(knowledge->compiled->sources, name->declared, file.encoding);
    out.push_back({{"name", name->name}, {"detail", name->more.empty() ? std::string(name->kind) : fmt::format("{} {}", name->kind, name->more)}, {"kind", editor_kind(name->kind).symbol}, {"range", range}, {"selectionRange", range}});
  }
  return out;
}

Json formatting(const OpenFile& file) {
  const Text text(file);
  diagnostics::CountingConsumer count;
  diagnostics::Diagnostics diagnostics(text.sources, count);
  static_cast<void>(syntax::parse(text.sources, text.file, diagnostics));
  if (diagnostics.failed()) return nullptr;
  const std::string_view before = text.sources.bytes(text.file);
  const std::string laid_out = syntax::format(text.sources, text.file);
  if (laid_out == before) return Json::array();
  const source::Span whole{text.file, 0, static_cast<std::uint32_t>(before.size())};
  return {{{"range", range_of(text.sources, whole, file.encoding)}, {"newText", laid_out}}};
}

Json quick_fixes(const OpenFile& file, Position begin, Position end) {
  Json out = Json::array();
  for (const auto& [root, knowledge] : file.workspace.all()) {
    const auto id = knowledge.file(file.path);
    if (!id) continue;
    const source::Sources& sources = knowledge.compiled->sources;
    const std::uint32_t first = offset(sources.bytes(*id), begin, file.encoding), last = offset(sources.bytes(*id), end, file.encoding);
    for (const diagnostics::Diagnostic& message : knowledge.messages) {
      const source::Span span = message.span;
      if (message.suggestion.empty() || span.file != *id || span.end < first || last < span.begin) continue;
      const std::string better = instead_of(sources.text(span), message.suggestion);
      const Json edit{{"range", range_of(sources, span, file.encoding)}, {"newText", better}};
      const Json fix{{"title", "Write `" + better + "`"}, {"kind", "quickfix"}, {"diagnostics", {message_json(file.workspace, knowledge, message, file.encoding)}}, {"edit", {{"changes", {{file.workspace.uri(file.path), {edit}}}}}}};
      if (std::ranges::find(out, fix) == out.end()) out.push_back(fix);
    }
  }
  return out;
}

}  // namespace kb::lsp
