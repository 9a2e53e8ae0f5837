// Which knowledge bases a file is part of: a map alone says nothing of levels, so its messages are those of who imports it.
#pragma once

#include <string>
#include <vector>

#include "tools/kbc/lsp/open_files.h"

namespace kb::lsp {

/// Of the files in the same folder, in the one above, and of those that are open: those that import `path`, by whatever way,
/// and are not imported by another such file. `path` itself if there is none. All are canonical, in order of their names.
/// Cost: reads those files; the trees of those that may import it.
[[nodiscard]] std::vector<std::string> roots_of(const std::string& path, const OpenFiles& files, const std::string& library);

}  // namespace kb::lsp
