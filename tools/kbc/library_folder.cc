#include "tools/kbc/library_folder.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace kb::cli {

std::string named_library(std::string_view option) {
  const char* set = std::getenv("WAYMARK_LIBRARY");
  return option.empty() && set != nullptr ? std::string(set) : std::string(option);
}

bool is_library(const std::string& folder) {
  std::error_code ignored;
  return std::filesystem::is_directory(std::filesystem::path(folder) / "std", ignored);
}

std::optional<std::string> library_above(const std::string& folder) {
  const auto above = (std::filesystem::path(folder) / "").parent_path().parent_path();
  const std::string name = above.empty() ? "." : above.string();
  return is_library(name) ? std::optional(name) : std::nullopt;
}

std::string find_library(std::string_view asked) {
  if (std::string named = named_library(asked); !named.empty()) return named;
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path folder = self.parent_path().parent_path() / "share" / "waymark" / "stdlib_rules";
  return folder.string();
}

}  // namespace kb::cli
