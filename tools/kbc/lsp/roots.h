// Finds the knowledge bases that a file is part of. A map alone has no levels, for instance, so it is checked with the files that import it.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "compiler/syntax/tree.h"
#include "tools/kbc/lsp/open_files.h"

namespace kb::lsp {

/// The canonical path of the file that an `import` in the file at `importer` names; empty if it names none.
[[nodiscard]] std::string imported_file(const syntax::Import& import, const std::string& importer, const OpenFiles& files, const std::string& library);

/// Which files import which, as the files are now. Each is read once, when needed.
class Imports {
 public:
  /// All must outlive it. `folders`: those of the editor's workspace. `known`: further files that may import something, wherever they are.
  Imports(const OpenFiles& files, const std::string& library, const std::set<std::string>& folders, std::set<std::string> known)
      : files_(files), library_(library), folders_(folders), known_(std::move(known)) {}

  /// The files that import `path`, directly or not, and are not imported by another such file; `path` itself if there are none. Searched are
  /// files that are known, open, in the same folder, in the one above, and anywhere in a workspace folder that contains the file. All paths
  /// are canonical, in order of their names.
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
  std::map<std::pair<std::string, bool>, std::set<std::string>> files_in_;   // by folder, and whether those below it are included
};

}  // namespace kb::lsp
