#include "tools/kbc/library_folder.h"

#include <sys/auxv.h>

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
  return (own_program().parent_path().parent_path() / "share" / "waymark" / "stdlib_rules").string();
}

std::filesystem::path own_program() {
  std::error_code error;
  if (auto self = std::filesystem::read_symlink("/proc/self/exe", error); !error) return self;
  const std::filesystem::path called = reinterpret_cast<const char*>(getauxval(AT_EXECFN));   // there may be no /proc
  auto self = std::filesystem::canonical(called, error);
  return error ? called : self;
}

}  // namespace kb::cli
