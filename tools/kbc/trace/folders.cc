#include "tools/kbc/trace/folders.h"

#include <algorithm>

namespace kb::trace {

namespace fs = std::filesystem;

Listing files_below(const std::string& folder) {
  Listing listing{{}, folder, {}};
  std::error_code ignored;
  fs::recursive_directory_iterator at(folder, listing.why);
  while (!listing.why && at != fs::recursive_directory_iterator()) {
    if (at->is_directory(ignored) && at->path().filename().string().starts_with('.')) {
      at.disable_recursion_pending();
    } else if (at->is_regular_file(ignored)) {
      listing.files.push_back(tidy_path(at->path()));
    }
    listing.unreadable = tidy_path(at->path());
    at.increment(listing.why);
  }
  std::sort(listing.files.begin(), listing.files.end());
  return listing;
}

}  // namespace kb::trace
