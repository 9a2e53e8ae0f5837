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

/// A file that is open, as the one who asks counts characters. `workspace` is compiled.
struct OpenFile {
  const Workspace& workspace;
  std::string path;
  Encoding encoding = Encoding::kUtf16;
  bool versioned = false;   ///< the editor takes edits of versions of files (`documentChanges`)
};

/// The text of an open file by itself.
struct Text {
  explicit Text(const OpenFile& of) : file(sources.add(of.path, of.workspace.files().texts().at(of.path))) {}
  source::Sources sources;
  source::FileId file;
};

[[nodiscard]] Json range_of(Position begin, Position end);

/// The messages of all knowledge bases, by the URI of their file.
[[nodiscard]] std::map<std::string, Json> messages_by_uri(const Workspace& workspace, Encoding encoding);

/// What a name is, its declaration, and the comment above that.
[[nodiscard]] Json hover(const OpenFile& file, Position at);
/// Where a name is declared; the file that an `import` means.
[[nodiscard]] Json definition(const OpenFile& file, Position at);
/// Wherever the same name stands in the knowledge base, its library aside.
[[nodiscard]] Json references(const OpenFile& file, Position at, bool with_declaration);
/// What can be renamed here: its place, and its name. Null where no name stands.
[[nodiscard]] Json prepare_rename(const OpenFile& file, Position at);
/// The edits in all files of all knowledge bases that the name is part of. Null if it is called so already.
[[nodiscard]] Json rename(const OpenFile& file, Position at, const std::string& new_name);
/// Why something is not renamed, by either; in words for the user.
struct Refused final : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// What the file declares.
[[nodiscard]] Json symbols(const OpenFile& file);
/// The canonical layout, as one edit; null if the file has errors of syntax.
[[nodiscard]] Json formatting(const OpenFile& file);
/// For messages from `begin` to `end` that know what was meant: to write that instead.
[[nodiscard]] Json quick_fixes(const OpenFile& file, Position begin, Position end);
/// Names, words of the language, and what can stand behind a dot.
[[nodiscard]] Json completion(const OpenFile& file, Position at);

/// Names of classes of text, in the order in which `semantic_tokens` numbers them.
[[nodiscard]] Json token_legend();
[[nodiscard]] Json semantic_tokens(const OpenFile& file);

}  // namespace kb::lsp
