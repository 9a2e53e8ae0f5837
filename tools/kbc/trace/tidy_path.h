// Names of files as they are shown.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace kb::trace {

/// `path` without `.`, and without `FOLDER/..` where that changes nothing: behind a symbolic link `..` leads elsewhere than to the folder
/// that the link stands in. Of what is not there all is left out.
[[nodiscard]] inline std::string tidy_path(const std::filesystem::path& path) {
  const std::filesystem::path tidy = path.lexically_normal();
  std::error_code ignored;
  const bool needed = tidy != path && std::filesystem::exists(path, ignored) && !std::filesystem::equivalent(path, tidy, ignored);
  return (needed ? path : tidy).generic_string();
}

}  // namespace kb::trace
