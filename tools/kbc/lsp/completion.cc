// Completion: what can be written at a place.
#include <algorithm>
#include <filesystem>
#include <set>
#include <span>

#include "compiler/syntax/syntax.h"
#include "tools/kbc/lsp/answers.h"
#include "tools/kbc/lsp/control_lines.h"
#include "tools/kbc/lsp/items.h"

namespace kb::lsp {
namespace {

namespace fs = std::filesystem;
using syntax::Lexeme;

constexpr std::string_view kImport = "import ", kQuoted = "import \"";
constexpr int kModule = 9, kFile = 17;   // of CompletionItemKind, as those of items.h

/// A part of a line without the name at its end.
std::string_view before_name(std::string_view text) {
  while (!text.empty() && in_name(text.back())) text.remove_suffix(1);
  return text;
}

// ---- behind a dot. The statement cannot be read as it is, so its names are known by their letters.

/// `{l, next}` of `... l.next.`
std::vector<std::string_view> owners(std::string_view text) {
  std::vector<std::string_view> out;
  while (text.ends_with('.')) {
    text.remove_suffix(1);
    std::size_t begin = text.size();
    while (begin > 0 && in_name(text[begin - 1])) --begin;
    out.insert(out.begin(), text.substr(begin));
    text.remove_suffix(text.size() - begin);
  }
  return out;
}

/// What the variable of this name, the last one declared before `end`, ranges over; empty if there is none.
std::string_view range_of_variable(const OpenFile& file, std::span<const Lexeme> all, std::string_view name, std::uint32_t end) {
  const auto text = [&](const Lexeme& one) { return file.sources().text(one.span); };
  std::string_view out;
  for (std::size_t i = 2; i < all.size() && all[i].span.end <= end; ++i) {
    if (text(all[i - 1]) == "in" && text(all[i - 2]) == name && all[i - 1].what == Lexeme::Class::kWord) out = text(all[i]);
  }
  return out;
}

/// What can stand at the end of `before`, a part of a line that ends in a dot, at `offset`.
Json members(const OpenFile& file, std::span<const Lexeme> lexemes, std::string_view before, std::uint32_t offset) {
  const model::Model& model = file.knowledge.compiled->model;
  const std::vector<std::string_view> path = owners(before);
  before.remove_prefix(std::min(before.find_first_not_of(' '), before.size()));
  bool landmark = before.starts_with("road ");   // a new landmark may not be known yet
  Items out;
  const auto add = [&](const model::FiniteSet* set) {
    for (const std::string& member : set == nullptr ? std::vector<std::string>() : set->members) out.add(member, kMember);
  };
  auto rows = relation_called(model, range_of_variable(file, lexemes, path.front(), offset));
  for (const model::KnownName& name : file.knowledge.names) {
    if (rows || name.name != path.front()) continue;
    if (path.size() == 1) add(name.members);
    landmark = landmark || name.kind == "Landmark";
    rows = landmark ? std::nullopt : relation_called(model, name.kind);   // the kind of a row is its relation
  }
  if (!rows && !landmark && path.front() == "leg") rows = relation_called(model, "Leg");   // in the condition of a detour
  for (std::size_t i = 1; i < path.size() && rows; ++i) rows = rows_in(model, *rows, path[i]);
  for (const std::string& field : rows ? model[*rows].fields : std::vector<std::string>()) out.add(field, kField, "field of " + model[*rows].name);
  if (landmark && !rows) add(exits(model));
  return out.take();
}

// ---- files and control lines

/// Files of the library. An item replaces everything after `import`, because editors do not agree on where a word with dots begins.
Json library_files(const std::string& library, Position begin, Position end) {
  std::set<std::string> files;
  std::error_code error;
  for (fs::directory_iterator at(library + "/std", error); !error && at != fs::directory_iterator(); at.increment(error)) {
    if (at->path().extension() == ".kb") files.insert("std." + at->path().stem().string());
  }
  Json out = Json::array();
  for (const std::string& file : files) {
    out.push_back({{"label", file}, {"kind", kModule}, {"textEdit", {{"range", range_of(begin, end)}, {"newText", file}}}});
  }
  return out;
}

/// Files and folders beside this file; `written` is the text after the quote.
Json files_beside(const OpenFile& file, std::string_view written, Position at) {
  const std::size_t slash = written.rfind('/') + 1;   // 0 without one
  const Position begin = file.knowledge.places.position(file.id, file.offset(at) - static_cast<std::uint32_t>(written.size() - slash), file.encoding);
  std::set<std::string> names;
  std::error_code error;
  for (fs::directory_iterator one(fs::path(file.path).parent_path() / written.substr(0, slash), error); !error && one != fs::directory_iterator(); one.increment(error)) {
    std::error_code ignored;
    const bool folder = one->is_directory(ignored);
    const std::string name = one->path().filename().string();
    if (!name.starts_with('.') && (folder || one->path().extension() == ".kb") && one->path() != file.path) names.insert(name + (folder ? "/" : ""));
  }
  Json out = Json::array();
  for (const std::string& name : names) out.push_back({{"label", name}, {"kind", kFile}, {"textEdit", {{"range", range_of(begin, at)}, {"newText", name}}}});
  return out;
}

/// Within the parentheses of a control line: arguments that are not given yet, or the words that an argument takes.
Json arguments(const ControlLine& line, const KnownController& controller) {
  Items out;
  for (const ControllerArgument& argument : controller.arguments) {
    if (line.argument == argument.name) {
      for (const std::string_view word : argument.words) out.add(word, kMember);
    } else if (line.argument.empty() && std::ranges::find(line.given, argument.name) == line.given.end()) {
      out.add(argument.name, kField, label(argument));
    }
  }
  return out.take();
}

bool in_comment(std::span<const Lexeme> all, std::uint32_t offset) {
  return std::ranges::any_of(all, [&](const Lexeme& one) { return one.what == Lexeme::Class::kComment && one.span.begin < offset && offset <= one.span.end; });
}

}  // namespace

Json completion(const OpenFile& file, Position at) {
  const std::uint32_t here = file.offset(at);
  std::string_view line = file.text().substr(0, here);
  line.remove_prefix(line.rfind('\n') + 1);
  if (line.starts_with(kQuoted)) return line.find('"', kQuoted.size()) == std::string_view::npos ? files_beside(file, line.substr(kQuoted.size()), at) : Json::array();
  if (line.starts_with(kImport)) return library_files(file.workspace.library(), {at.line, kImport.size()}, at);
  const std::string_view before = before_name(line);
  const std::vector<Lexeme> lexemes = syntax::lexemes(file.sources(), file.id);
  if (in_comment(lexemes, here)) return Json::array();
  if (before.ends_with('.')) return members(file, lexemes, before, here);
  const auto control = control_line_at(file, lexemes, here);
  if (const auto controller = control ? known_controller(file.knowledge, control->controller) : std::nullopt) return arguments(*control, *controller);
  return wanted(file, lexemes, here - static_cast<std::uint32_t>(line.size() - before.size()));
}

}  // namespace kb::lsp
