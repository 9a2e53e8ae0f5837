// Names of files for display.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace kb::trace {

/// `path` without `.`, and without `FOLDER/..` if that changes nothing: after a symbolic link `..` does not lead to the folder that holds
/// the link. If nothing exists at `path`, all of them are left out.
[[nodiscard]] inline std::string tidy_path(const std::filesystem::path& path) {
  const std::filesystem::path tidy = path.lexically_normal();
  std::error_code ignored;
  const bool needed = tidy != path && std::filesystem::exists(path, ignored) && !std::filesystem::equivalent(path, tidy, ignored);
  return (needed ? path : tidy).generic_string();
}

}  // namespace kb::trace
