// The files that an editor has open, and the compiler's results for them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/driver/compile.h"
#include "compiler/model/known_names.h"
#include "tools/kbc/lsp/open_files.h"
#include "tools/kbc/lsp/places.h"
#include "tools/kbc/lsp/roots.h"
#include "tools/kbc/lsp/uses.h"

namespace kb::lsp {

/// One knowledge base, compiled as far as it goes.
struct Knowledge {
  std::unique_ptr<driver::Compilation> compiled;
  std::vector<std::string> paths;        ///< canonical, by file
  Places places;
  std::vector<diagnostics::Diagnostic> messages;
  std::vector<model::KnownName> names;   ///< from the statements that could be read
  std::vector<Use> uses;                 ///< likewise

  /// Its file of that canonical path.
  [[nodiscard]] std::optional<source::FileId> file(std::string_view path) const;
  /// The name that holds that byte, or ends there; null if none does.
  [[nodiscard]] const Use* use_at(source::FileId file, std::uint32_t offset) const;
  /// All places of what it stands for, in order of files and texts. O(uses).
  [[nodiscard]] std::vector<Use> same(const Use& use) const;
  /// The tree of the file, as far as it was read; null if it could not be read at all.
  [[nodiscard]] const syntax::Tree* tree(source::FileId file) const;
  [[nodiscard]] std::span<const syntax::Statement> statements(source::FileId file) const;
  [[nodiscard]] const std::string& path(source::FileId file) const { return paths[static_cast<std::size_t>(file)]; }
};

class Workspace {
 public:
  /// `library`: the folder that holds `std/`.
  Workspace(std::string library, diagnostics::WarningOptions warnings) : library_(std::move(library)), warnings_(std::move(warnings)) {}

  // ---- what happens in the editor; paths are canonical

  /// `uri`: as the editor writes it; it may use another path for the file and encode other characters.
  void open(const std::string& path, std::string uri, std::string text);
  /// Does nothing if the file is not open.
  void change(const std::string& path, std::string text);
  /// The editor's version number for the text of an open file.
  void set_version(const std::string& path, std::int64_t version) { versions_[path] = version; }
  void close(const std::string& path);
  /// Files on the disk have changed, or a file was saved: imports are looked up anew.
  void look_again();
  /// Adds a folder of the editor's workspace, by its canonical path.
  void add_folder(std::string path) { folders_.insert(std::move(path)); }
  void remove_folder(const std::string& path) { folders_.erase(path); }

  [[nodiscard]] bool changed() const { return !stale_.empty(); }
  /// Compiles what has changed. Cost: that of `kbc check` for each knowledge base that a changed file is part of.
  void compile();

  // ---- what is known; after `compile`

  [[nodiscard]] const OpenFiles& files() const { return files_; }
  [[nodiscard]] const std::string& library() const { return library_; }
  [[nodiscard]] std::string canonical(std::string_view path) const { return files_.canonical(path); }
  /// The URI of a file; for an open file, the one that the editor gave.
  [[nodiscard]] std::string uri(const std::string& path) const;
  /// The version of a file; nothing if it is not open, or the editor gives no versions.
  [[nodiscard]] std::optional<std::int64_t> version(const std::string& path) const;
  /// All knowledge bases, by the path of the main file.
  [[nodiscard]] const std::map<std::string, Knowledge>& all() const { return now_; }
  /// The first knowledge base that the open file is part of; null if it is not open.
  [[nodiscard]] const Knowledge* of(const std::string& path) const;
  /// As the files are now.
  [[nodiscard]] Imports imports() const;
  /// A knowledge base compiled with the texts of `files`.
  [[nodiscard]] Knowledge compiled(const std::string& root, const OpenFiles& files) const;

 private:
  void mark(const std::string& path);
  void settle();
  void forget_unused();

  std::string library_;
  diagnostics::WarningOptions warnings_;
  OpenFiles files_;
  std::map<std::string, std::string> uris_;                 // by open file
  std::map<std::string, std::int64_t> versions_;            // by open file
  std::map<std::string, std::vector<std::string>> roots_;   // by open file
  std::set<std::string> folders_;                           // of the editor's workspace
  std::map<std::string, Knowledge> now_;                    // by main file
  std::set<std::string> stale_;                             // main files to compile
};

}  // namespace kb::lsp
