#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compiler/source/utf8.h"
#include "sim/report/data.h"
#include "sim/report/page.h"
#include "sim/report/report.h"

namespace kb::sim::report {
namespace {

// Replaces each `{{name}}` of page.html by the filling of that name.
std::string fill_page(std::string_view page, const std::vector<std::pair<std::string_view, std::string_view>>& fillings) {
  std::string out;
  while (true) {
    const std::size_t open = page.find("{{");
    const std::size_t close = open == page.npos ? page.npos : page.find("}}", open);
    if (close == page.npos) return out.append(page);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    out.append(page.substr(0, open));
    for (const auto& [key, text] : fillings) {
      if (key == name) out.append(text);
    }
    page.remove_prefix(close + 2);
  }
}

}  // namespace

std::string assemble_page(std::string_view title, std::string_view drive, std::string_view frames, std::string_view live) {
  std::string style, script;
  for (const PagePart& part : page_parts()) {
    if (part.name.ends_with(".css")) style += part.text;
    if (part.name.ends_with(".js")) script += part.text;
  }
  const std::string data = fmt::format("{{\"drive\":{},\n\"frames\":{},\n\"live\":{}}}", drive, frames, print_data(std::string(live)));
  return fill_page(page_parts().front().text, {{"title", source::escape_markup(title)}, {"style", style}, {"data", data}, {"script", script}});
}

std::string html(const Recording& recording) {
  const Span all{0, static_cast<std::uint32_t>(recording.frames.size())};
  return assemble_page(recording.title, print_data(data_of_drive(recording)), print_data(data_of_frames(recording, all)), "");
}

}  // namespace kb::sim::report
