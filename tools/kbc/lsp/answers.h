// Answers to an editor's questions about an open file. All results are as in the Language Server Protocol 3.17; null if there is no
// answer.
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

/// An open file, with the way in which the editor counts characters. `workspace` must be compiled.
struct OpenFile {
  const Workspace& workspace;
  const Knowledge& knowledge;   ///< the knowledge base in whose context answers are given
  source::FileId id;            ///< its id in `knowledge`
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

/// What a name is, its declaration, and the comment above the declaration.
[[nodiscard]] Json hover(const OpenFile& file, Position at);
/// The place where a name is declared; for an `import`, the file that it names.
[[nodiscard]] Json definition(const OpenFile& file, Position at);
/// All places of the name in all knowledge bases that contain it, except in the library.
[[nodiscard]] Json references(const OpenFile& file, Position at, bool with_declaration);
/// All places of the name in this file.
[[nodiscard]] Json highlights(const OpenFile& file, Position at);
/// What can be renamed here: the place and the name. Null if there is no declared name.
[[nodiscard]] Json prepare_rename(const OpenFile& file, Position at);
/// The edits in all files of all knowledge bases that contain the name. Null if the name is the same already.
[[nodiscard]] Json rename(const OpenFile& file, Position at, const std::string& new_name);
/// Thrown by both: why something cannot be renamed, in words for the user.
struct Refused final : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The canonical layout, as one edit; null if the file has errors of syntax.
[[nodiscard]] Json formatting(const OpenFile& file);
/// For messages from `begin` to `end` that know what was meant: edits that write that instead.
[[nodiscard]] Json quick_fixes(const OpenFile& file, Position begin, Position end);

// ---- outline.cc

/// What the file declares: statements and their parts.
[[nodiscard]] Json symbols(const OpenFile& file);
/// Declarations in all knowledge bases, except in the library, whose name contains the letters of `query` in any case.
[[nodiscard]] Json workspace_symbols(const Workspace& workspace, const std::string& query, Encoding encoding);
/// Statements and comments of more than one line.
[[nodiscard]] Json folds(const OpenFile& file);
/// What can be selected round a place: the word, the part of a condition, ..., the file; the innermost first, each with its `parent`.
[[nodiscard]] Json selections(const OpenFile& file, Position at);
/// The imports, with the files that they name.
[[nodiscard]] Json links(const OpenFile& file);

// ---- completion.cc

/// Names, words of the language, and what can stand after a dot or in a control line.
[[nodiscard]] Json completion(const OpenFile& file, Position at);
/// The arguments of the controller whose parentheses contain `at`.
[[nodiscard]] Json signature(const OpenFile& file, Position at);

// ---- colours.cc

/// Names of classes of text, in the order in which `semantic_tokens` numbers them.
[[nodiscard]] Json token_legend();
[[nodiscard]] Json semantic_tokens(const OpenFile& file);

}  // namespace kb::lsp
