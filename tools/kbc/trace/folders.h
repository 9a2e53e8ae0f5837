// Names of files for display, and what lies in folders.
#pragma once

#include <filesystem>
#include <functional>
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

/// All regular files in `folder` and below it, tidy and sorted, without those of hidden folders. Ends at the first folder that cannot be read:
/// `unreadable` is told which it is, and why.
[[nodiscard]] std::vector<std::string> files_below(const std::string& folder, const std::function<void(const std::string&, std::error_code)>& unreadable);

}  // namespace kb::trace
