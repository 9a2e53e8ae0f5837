// The parts of the page, embedded while building from sim/report/page (see cmake/EmbedFiles.cmake).
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace kb::sim::report {

struct PagePart {
  std::string_view name;   ///< `page.html`, `page.css`, `data.js`, ...
  std::string_view text;
};
/// `page.html` first, then the style, then the scripts in the order in which they depend on each other.
[[nodiscard]] std::span<const PagePart> page_parts();

/// The page around its data: `drive` is from `data_of_drive`, `frames` from `data_of_frames`, both printed. `live` is the
/// path from which the page requests further frames, "" if none will come.
[[nodiscard]] std::string assemble_page(std::string_view title, std::string_view drive, std::string_view frames, std::string_view live);

}  // namespace kb::sim::report
