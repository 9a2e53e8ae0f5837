#include "tools/kbc/lsp/answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "compiler/diagnostics/allowed.h"
#include "compiler/diagnostics/consumers.h"
#include "compiler/syntax/syntax.h"
#include "tools/kbc/lsp/control_lines.h"
#include "tools/kbc/lsp/everywhere.h"
#include "tools/kbc/lsp/names.h"
#include "tools/kbc/lsp/roots.h"

namespace kb::lsp {
namespace {

/// The comment lines directly above a declaration, without their `#`.
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

std::string described(const source::Sources& sources, source::Span declared) {
  std::string_view line = sources.line_of(declared.file, declared.begin).text;
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  std::string out = fmt::format("\n```kb\n{}\n```\n", line);
  if (const std::string comment = comment_above(sources, declared); !comment.empty()) out += comment + "\n\n";
  return out + sources.origin(declared);
}

std::string described(const KnownController& controller) {
  std::string out = controller.about.empty() ? "" : "\n\n" + controller.about;
  for (const ControllerArgument& argument : controller.arguments) out += fmt::format("\n- `{}`: {}", label(argument), argument.about);
  return out;
}

/// The import statement that contains this byte of the file.
const syntax::Import* import_at(const OpenFile& file, std::uint32_t offset) {
  for (const syntax::Statement& statement : file.statements()) {
    const auto* const import = std::get_if<syntax::Import>(&statement.node);
    if (import != nullptr && statement.span.begin <= offset && offset <= statement.span.end) return import;
  }
  return nullptr;
}

Json location(const Workspace& workspace, const Knowledge& knowledge, source::Span span, Encoding encoding) {
  return {{"uri", workspace.uri(knowledge.path(span.file))}, {"range", range_of(knowledge, span, encoding)}};
}

constexpr int kRead = 2, kWrite = 3;   // of DocumentHighlightKind

Json message_json(const Workspace& workspace, const Knowledge& knowledge, const diagnostics::Diagnostic& message, Encoding encoding) {
  Json out{{"range", message.span.known() ? range_of(knowledge, message.span, encoding) : range_of({}, {})},
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

struct Better { std::string title; source::Span place; std::string text; };

/// Another import, where it belongs: on the line after the imports of the file.
Better another_import(const Knowledge& knowledge, source::FileId file, const std::string& import) {
  const source::Sources& sources = knowledge.compiled->sources;
  std::uint32_t at = 0;
  bool unended = false;   // the last import ends the file without a line break
  for (const syntax::Statement& statement : knowledge.statements(file)) {
    if (!std::holds_alternative<syntax::Import>(statement.node)) continue;
    const auto line = sources.line_of(file, statement.span.end);
    const std::string_view bytes = sources.bytes(file);
    const std::size_t end = bytes.find('\n', line.begin);
    unended = end == std::string_view::npos;
    at = static_cast<std::uint32_t>(unended ? bytes.size() : end + 1);
  }
  return {"Write `" + import + "`", {file, at, at}, unended ? "\n" + import : import + "\n"};
}

/// The text that replaces `written`. Messages name a file without its quotes, and a file of the library with the word before it.
std::string instead_of(std::string_view written, const std::string& suggestion) {
  constexpr std::string_view kImport = "import ";
  if (!written.starts_with('"')) return suggestion;
  return suggestion.starts_with(kImport) ? suggestion.substr(kImport.size()) : "\"" + suggestion + "\"";
}

/// Texts that could replace what a message is about, or say that it is meant so.
std::vector<Better> better_texts(const Knowledge& knowledge, const diagnostics::Diagnostic& message) {
  std::vector<Better> out;
  if (!message.suggestion.empty()) {
    const std::string better = instead_of(knowledge.compiled->sources.text(message.span), message.suggestion);
    out.push_back({"Write `" + better + "`", message.span, better});
  }
  for (const diagnostics::Note& note : message.notes) {
    if (note.kind != diagnostics::Kind::kImportBrings) continue;
    const std::string import = note.text.substr(1, note.text.rfind('`') - 1);   // the note begins with the import, in backticks
    out.push_back(another_import(knowledge, message.span.file, import));
  }
  if (const std::string_view flag = diagnostics::info(message.kind).flag; !flag.empty() && message.span.known()) {
    const auto statements = knowledge.statements(message.span.file);
    const auto around = std::ranges::find_if(statements, [&](const syntax::Statement& one) { return one.span.begin <= message.span.begin && message.span.begin < one.span.end; });
    const std::uint32_t begin = around == statements.end() ? message.span.begin : around->span.begin;
    const auto line = diagnostics::line_to_allow(knowledge.compiled->sources, message.span, begin);
    const std::string_view indent = line.text.substr(0, std::min(line.text.find_first_not_of(" \t"), line.text.size()));
    out.push_back({fmt::format("Allow it here: `# allow: {}`", flag), {message.span.file, line.begin, line.begin}, fmt::format("{}# allow: {}\n", indent, flag)});
  }
  return out;
}

}  // namespace

Json range_of(Position begin, Position end) {
  const auto json = [](Position at) { return Json{{"line", at.line}, {"character", at.character}}; };
  return {{"start", json(begin)}, {"end", json(end)}};
}

Json range_of(const Knowledge& knowledge, source::Span span, Encoding encoding) {
  return range_of(knowledge.places.position(span.file, span.begin, encoding), knowledge.places.position(span.file, span.end, encoding));
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
  const Use* const use = file.use_at(at);
  const auto what = use == nullptr ? std::nullopt : symbol(file.knowledge, *use);
  if (!what) return nullptr;
  const std::string_view name = file.sources().text(use->span);
  std::string text = fmt::format("{} `{}`", what->kind, name);
  if (!what->more.empty()) text += fmt::format(" `{}`", what->more);
  for (const Use& one : file.knowledge.same(*use)) {
    if (one.declares) text += described(file.sources(), one.span);
  }
  if (const auto controller = use->meaning.space == Meaning::Space::kController ? known_controller(file.knowledge, name) : std::nullopt) text += described(*controller);
  return {{"contents", {{"kind", "markdown"}, {"value", text}}}, {"range", file.range(use->span)}};
}

Json definition(const OpenFile& file, Position at) {
  if (const syntax::Import* const import = import_at(file, file.offset(at))) {
    const std::string meant = imported_file(*import, file.path, file.workspace.files(), file.workspace.library());
    if (!file.workspace.files().read(meant).bytes) return nullptr;
    return {{"uri", file.workspace.uri(meant)}, {"range", range_of({}, {})}};
  }
  const Use* const use = file.use_at(at);
  Json out = nullptr;
  for (const Use& one : use == nullptr ? std::vector<Use>() : file.knowledge.same(*use)) {
    if (one.declares) out.push_back(location(file.workspace, file.knowledge, one.span, file.encoding));
  }
  return out;
}

Json references(const OpenFile& file, Position at, bool with_declaration) {
  const Use* const use = file.use_at(at);
  if (use == nullptr) return nullptr;
  Json out = Json::array();
  std::set<std::pair<std::string, std::uint32_t>> told;   // two knowledge bases may have a file in common
  for (const Standing& base : everywhere(file.workspace, file.path, use->span.begin, false)) {
    const Knowledge& knowledge = *base.knowledge;
    for (const Use& one : base.uses) {
      if (knowledge.compiled->sources.standard(one.span.file) || (one.declares && !with_declaration)) continue;
      const std::string& path = knowledge.path(one.span.file);
      if (told.emplace(path, one.span.begin).second) out.push_back(location(file.workspace, knowledge, one.span, file.encoding));
    }
  }
  return out;
}

Json highlights(const OpenFile& file, Position at) {
  const Use* const use = file.use_at(at);
  if (use == nullptr) return nullptr;
  Json out = Json::array();
  for (const Use& one : file.knowledge.same(*use)) {
    if (one.span.file == file.id) out.push_back({{"range", file.range(one.span)}, {"kind", one.declares ? kWrite : kRead}});
  }
  return out;
}

Json formatting(const OpenFile& file) {
  diagnostics::CountingConsumer count;
  diagnostics::Diagnostics diagnostics(file.sources(), count);
  static_cast<void>(syntax::parse(file.sources(), file.id, diagnostics));
  if (diagnostics.failed()) return nullptr;
  const std::string_view before = file.text();
  const std::string laid_out = syntax::format(file.sources(), file.id);
  if (laid_out == before) return Json::array();
  // Lines at both ends that do not change are left out of the edit, so that the editor keeps its marks there.
  const auto first = std::ranges::mismatch(before, laid_out).in1;
  const std::size_t begin = before.substr(0, static_cast<std::size_t>(first - before.begin())).rfind('\n') + 1;
  std::size_t same = 0;
  for (std::size_t i = 1; i <= std::min(before.size(), laid_out.size()) - begin && before[before.size() - i] == laid_out[laid_out.size() - i]; ++i) {
    if (before[before.size() - i] == '\n') same = i - 1;
  }
  const source::Span changed{file.id, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(before.size() - same)};
  return {{{"range", file.range(changed)}, {"newText", laid_out.substr(begin, laid_out.size() - same - begin)}}};
}

Json quick_fixes(const OpenFile& file, Position begin, Position end) {
  Json out = Json::array();
  for (const auto& [root, knowledge] : file.workspace.all()) {
    const auto id = knowledge.file(file.path);
    if (!id) continue;
    const std::string_view bytes = knowledge.compiled->sources.bytes(*id);
    const std::uint32_t first = offset(bytes, begin, file.encoding), last = offset(bytes, end, file.encoding);
    for (const diagnostics::Diagnostic& message : knowledge.messages) {
      if (message.span.file != *id || message.span.end < first || last < message.span.begin) continue;
      for (const Better& better : better_texts(knowledge, message)) {
        const Json edit{{"range", range_of(knowledge, better.place, file.encoding)}, {"newText", better.text}};
        const Json fix{{"title", better.title}, {"kind", "quickfix"}, {"diagnostics", {message_json(file.workspace, knowledge, message, file.encoding)}}, {"edit", {{"changes", {{file.workspace.uri(file.path), {edit}}}}}}};
        if (std::ranges::find(out, fix) == out.end()) out.push_back(fix);
      }
    }
  }
  return out;
}

}  // namespace kb::lsp
