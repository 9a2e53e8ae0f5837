#include "tools/kbc/trace/folders.h"

#include <algorithm>

namespace kb::trace {

namespace fs = std::filesystem;

std::vector<std::string> files_below(const std::string& folder, const std::function<void(const std::string&, std::error_code)>& unreadable) {
  std::vector<std::string> files;
  std::error_code failed, ignored;
  std::string entered = folder;
  fs::recursive_directory_iterator at(folder, failed);
  while (!failed && at != fs::recursive_directory_iterator()) {
    if (at->is_directory(ignored) && at->path().filename().string().starts_with('.')) {
      at.disable_recursion_pending();
    } else if (at->is_regular_file(ignored)) {
      files.push_back(tidy_path(at->path()));
    }
    entered = tidy_path(at->path());
    at.increment(failed);
  }
  if (failed) unreadable(entered, failed);
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace kb::trace
