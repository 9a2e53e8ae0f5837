// What an editor asks of a file that it has open, and what it is told. All results are as the Language Server Protocol 3.17 has them;
// null where there is nothing to say.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "tools/kbc/lsp/places.h"
#include "tools/kbc/lsp/workspace.h"

namespace kb::lsp {

using Json = nlohmann::json;

[[nodiscard]] Json range_of(Position begin, Position end);
[[nodiscard]] Json range_of(const Knowledge& knowledge, source::Span span, Encoding encoding);

/// A file that is open, as the one who asks counts characters. `workspace` is compiled.
struct OpenFile {
  const Workspace& workspace;
  const Knowledge& knowledge;   ///< that it is judged with
  source::FileId id;            ///< there
  std::string path;
  Encoding encoding = Encoding::kUtf16;
  bool versioned = false;       ///< the editor takes edits of versions of files (`documentChanges`)

  [[nodiscard]] const source::Sources& sources() const { return knowledge.compiled->sources; }
  [[nodiscard]] std::span<const syntax::Statement> statements() const { return knowledge.statements(id); }
  [[nodiscard]] std::string_view text() const { return sources().bytes(id); }
  [[nodiscard]] std::uint32_t offset(Position at) const { return lsp::offset(text(), at, encoding); }
  [[nodiscard]] const Use* use_at(Position at) const { return knowledge.use_at(id, offset(at)); }
  [[nodiscard]] Json range(source::Span span) const { return range_of(knowledge, span, encoding); }
};

/// The messages of all knowledge bases, by the URI of their file.
[[nodiscard]] std::map<std::string, Json> messages_by_uri(const Workspace& workspace, Encoding encoding);

/// What a name is, its declaration, and the comment above that.
[[nodiscard]] Json hover(const OpenFile& file, Position at);
/// Where a name is declared; the file that an `import` means.
[[nodiscard]] Json definition(const OpenFile& file, Position at);
/// Wherever the name stands in all knowledge bases that it is part of, the library aside.
[[nodiscard]] Json references(const OpenFile& file, Position at, bool with_declaration);
/// Wherever it stands in this file.
[[nodiscard]] Json highlights(const OpenFile& file, Position at);
/// What can be renamed here: its place, and its name. Null where no name stands that is declared.
[[nodiscard]] Json prepare_rename(const OpenFile& file, Position at);
/// The edits in all files of all knowledge bases that the name is part of. Null if it is called so already.
[[nodiscard]] Json rename(const OpenFile& file, Position at, const std::string& new_name);
/// Why something is not renamed, by either; in words for the user.
struct Refused final : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The canonical layout, as one edit; null if the file has errors of syntax.
[[nodiscard]] Json formatting(const OpenFile& file);
/// For messages from `begin` to `end` that know what was meant: to write that instead.
[[nodiscard]] Json quick_fixes(const OpenFile& file, Position begin, Position end);

// ---- outline.cc

/// What the file declares: statements, and what belongs to them.
[[nodiscard]] Json symbols(const OpenFile& file);
/// What all knowledge bases declare whose name has the letters of `query` in it, in whatever case; the library aside.
[[nodiscard]] Json workspace_symbols(const Workspace& workspace, const std::string& query, Encoding encoding);
/// Statements, and comments, of more than one line.
[[nodiscard]] Json folds(const OpenFile& file);
/// What can be selected round a place: the word, the part of a condition, ..., the file; the inner one first, with its `parent`.
[[nodiscard]] Json selections(const OpenFile& file, Position at);
/// The imports, and the files that they mean.
[[nodiscard]] Json links(const OpenFile& file);

// ---- completion.cc

/// Names, words of the language, and what can stand behind a dot, or in a control line.
[[nodiscard]] Json completion(const OpenFile& file, Position at);
/// What the controller takes in whose parentheses `at` is.
[[nodiscard]] Json signature(const OpenFile& file, Position at);

// ---- colours.cc

/// Names of classes of text, in the order in which `semantic_tokens` numbers them.
[[nodiscard]] Json token_legend();
[[nodiscard]] Json semantic_tokens(const OpenFile& file);

}  // namespace kb::lsp
