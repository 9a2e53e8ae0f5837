// What can be written at a place, and how what is written is coloured.
#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "compiler/syntax/syntax.h"
#include "tools/kbc/lsp/answers.h"
#include "tools/kbc/lsp/kinds.h"
#include "tools/kbc/lsp/mention.h"

namespace kb::lsp {
namespace {

namespace fs = std::filesystem;
using syntax::Lexeme;

constexpr std::string_view kImport = "import ";
constexpr int kKeyword = 14, kMember = 20, kModule = 9;   // of CompletionItemKind

/// The part of a line before a place, without the name that is being written.
std::string_view before_name(std::string_view text) {
  text.remove_prefix(text.rfind('\n') + 1);
  while (!text.empty() && in_name(text.back())) text.remove_suffix(1);
  return text;
}

/// What stands before the dot at the end of `text`.
std::string_view owner(std::string_view text) {
  text.remove_suffix(1);
  std::size_t begin = text.size();
  while (begin > 0 && in_name(text[begin - 1])) --begin;
  return text.substr(begin);
}

/// The set that exits of roads are in: that of a road; where there is none yet, the directions of the standard library.
const model::FiniteSet* exits(const model::Model& model) {
  const auto road = std::ranges::find(model.relations, "Road", &model::Relation::name);
  const model::Value* const exit = road == model.relations.end() || road->rows.empty() ? nullptr : model.field(model[road->rows.front()], "exit");
  if (const auto* member = exit == nullptr ? nullptr : std::get_if<model::Member>(exit)) return &model.sets[index(member->set)];
  const auto set = std::ranges::find(model.sets, "Direction", &model::FiniteSet::name);
  return set == model.sets.end() ? nullptr : &*set;
}

/// What can stand at the end of `before`, a part of a line that ends in a dot.
Json members(const Knowledge& knowledge, std::string_view before) {
  const std::string_view of = owner(before);
  before.remove_prefix(std::min(before.find_first_not_of(' '), before.size()));
  bool landmark = before.starts_with("road ");   // it may be too new to be known
  std::set<std::string_view> labels;
  Json out = Json::array();
  const auto add = [&](const model::FiniteSet* set) {
    if (set == nullptr) return;
    for (const std::string& member : set->members) {
      if (labels.insert(member).second) out.push_back({{"label", member}, {"kind", kMember}});
    }
  };
  for (const model::KnownName& name : knowledge.names) {
    if (name.name != of) continue;
    add(name.members);
    landmark = landmark || name.kind == "Landmark";
  }
  if (landmark) add(exits(knowledge.compiled->model));
  return out;
}

/// The whole of what stands behind `import` becomes one of these: editors do not agree on where a word with dots begins.
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

constexpr std::array<std::string_view, 4> kPlainTokens{"keyword", "number", "string", "comment"};
constexpr std::size_t kNoToken = 0xFFFF'FFFFu;

std::size_t plain_token(Lexeme::Class what) {
  switch (what) {
    case Lexeme::Class::kWord: return 0;
    case Lexeme::Class::kNumber: return 1;
    case Lexeme::Class::kString: return 2;
    case Lexeme::Class::kComment: return 3;
    default: return kNoToken;
  }
}

/// Names of classes of text, in the order of their numbers.
const std::vector<std::string_view>& legend() {
  static const std::vector<std::string_view> tokens = [] {
    std::vector<std::string_view> out(kPlainTokens.begin(), kPlainTokens.end());
    for (const EditorKind& kind : kEditorKinds) {
      if (std::ranges::find(out, kind.token) == out.end()) out.push_back(kind.token);
    }
    return out;
  }();
  return tokens;
}

/// The number of what a name stands for; that of nothing if nobody knows it.
std::size_t token_of(const Knowledge* knowledge, const Mention& mention) {
  const auto found = knowledge == nullptr ? std::vector<const model::KnownName*>() : meanings(mention, knowledge->names);
  if (found.empty()) return kNoToken;
  return static_cast<std::size_t>(std::ranges::find(legend(), editor_kind(found.front()->kind).token) - legend().begin());
}

}  // namespace

Json completion(const OpenFile& file, Position at) {
  const std::string& text = file.workspace.files().texts().at(file.path);
  const std::string_view before = before_name(std::string_view(text).substr(0, offset(text, at, file.encoding)));
  if (before.starts_with(kImport)) return before.ends_with('"') ? Json::array() : library_files(file.workspace.library(), {at.line, kImport.size()}, at);
  const Knowledge* const knowledge = file.workspace.of(file.path);
  if (before.ends_with('.')) return knowledge == nullptr ? Json::array() : members(*knowledge, before);
  Json out = Json::array();
  for (const std::string_view word : syntax::words()) out.push_back({{"label", word}, {"kind", kKeyword}});
  for (const std::string_view word : syntax::words_in_places()) out.push_back({{"label", word}, {"kind", kKeyword}});
  if (knowledge == nullptr) return out;
  std::string_view last;
  for (const model::KnownName& name : knowledge->names) {
    const bool asked = name.kind != "rule" && name.kind != "control" && std::ranges::all_of(name.name, in_name);   // a leg, `Errand.1:Inn>Well`, cannot be written
    if (!asked || name.name == last) continue;   // nothing asks for rules by name
    last = name.name;
    out.push_back({{"label", name.name}, {"kind", editor_kind(name.kind).completion}, {"detail", std::string(name.kind) + (name.more.empty() ? "" : " " + name.more)}});
  }
  return out;
}

Json token_legend() { return legend(); }

Json semantic_tokens(const OpenFile& file) {
  const Text text(file);
  const Knowledge* const knowledge = file.workspace.of(file.path);
  Json data = Json::array();
  Position last;
  std::string before;   // of a name behind a dot
  for (const Lexeme& one : syntax::lexemes(text.sources, text.file)) {
    const std::string_view written = text.sources.text(one.span);
    const bool name = one.what == Lexeme::Class::kName;
    const std::size_t token = name ? token_of(knowledge, {one.span, written, before.ends_with('.') ? before : ""}) : plain_token(one.what);
    before = name ? (before.ends_with('.') ? before : std::string()) + std::string(written) : written == "." ? before + "." : std::string();
    if (token == kNoToken) continue;
    const Position at = position(text.sources, text.file, one.span.begin, file.encoding);
    data.insert(data.end(), {at.line - last.line, at.line == last.line ? at.character - last.character : at.character, units(written, file.encoding), token, 0});
    last = at;
  }
  return {{"data", data}};
}

}  // namespace kb::lsp
