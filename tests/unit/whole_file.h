// Reads a file for a test.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace kb {

/// Its bytes; empty if it cannot be read.
[[nodiscard]] inline std::string whole_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace kb
