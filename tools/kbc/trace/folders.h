// Names of files for display, and what lies in folders.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace kb::trace {

/// `path` without `.`, and without `FOLDER/..` if that changes nothing: after a symbolic link `..` does not lead to the folder that holds
/// the link. If nothing exists at `path`, all of them are left out.
[[nodiscard]] inline std::string tidy_path(const std::filesystem::path& path) {
  const std::filesystem::path tidy = path.lexically_normal();
  std::error_code ignored;
  const bool needed = tidy != path && std::filesystem::exists(path, ignored) && !std::filesystem::equivalent(path, tidy, ignored);
  return (needed ? path : tidy).generic_string();
}

struct Listing {
  std::vector<std::string> files;   ///< tidy, sorted
  std::string unreadable;           ///< the folder at which the listing ended early; meaningful if `why` is set
  std::error_code why;
};
/// All regular files in `folder` and below it, without those of hidden folders, up to the first folder that cannot be read.
[[nodiscard]] Listing files_below(const std::string& folder);

}  // namespace kb::trace
