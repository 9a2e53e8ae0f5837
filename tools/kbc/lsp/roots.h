// Which knowledge bases a file is part of: a map alone says nothing of levels, so its messages are those of who imports it.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "compiler/syntax/tree.h"
#include "tools/kbc/lsp/open_files.h"

namespace kb::lsp {

/// The file that an `import` in the file at `importer` means, in canonical form; empty if it names none.
[[nodiscard]] std::string imported_file(const syntax::Import& import, const std::string& importer, const OpenFiles& files, const std::string& library);

/// Who imports whom, as the files are now: each is read once, when it matters.
class Imports {
 public:
  /// All must outlive it. `folders`: of the editor's workspace. `known`: files that may import something, wherever they lie.
  Imports(const OpenFiles& files, const std::string& library, const std::set<std::string>& folders, std::set<std::string> known)
      : files_(files), library_(library), folders_(folders), known_(std::move(known)) {}

  /// Of the files that are known, open, in the same folder, in the one above, and anywhere in a folder of the workspace that holds the file: those that
  /// import `path`, by whatever way, and are not imported by another such file. `path` itself if there is none. All are canonical, in order of their names.
  [[nodiscard]] std::vector<std::string> roots_of(const std::string& path);

 private:
  [[nodiscard]] const std::set<std::string>& files_in(const std::string& folder, bool deep);
  [[nodiscard]] const std::set<std::string>& direct(const std::string& path);
  [[nodiscard]] std::set<std::string> parts_of(const std::string& path);

  const OpenFiles& files_;
  const std::string& library_;
  const std::set<std::string>& folders_;
  std::set<std::string> known_;
  std::map<std::string, std::set<std::string>> direct_;                      // by path
  std::map<std::pair<std::string, bool>, std::set<std::string>> files_in_;   // by folder, and whether in those below it as well
};

}  // namespace kb::lsp
