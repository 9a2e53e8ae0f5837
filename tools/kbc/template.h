// The files that `kbc new` makes, embedded from tools/kbc/template (see cmake/EmbedFiles.cmake).
#pragma once

#include <span>
#include <string_view>

namespace kb::cli {

/// `@NAME@` in both stands for the name of the project.
struct TemplateFile {
  std::string_view path;
  std::string_view text;
};
[[nodiscard]] std::span<const TemplateFile> template_files();

}  // namespace kb::cli
