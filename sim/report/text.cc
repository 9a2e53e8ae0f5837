#include "sim/report/text.h"

#include <fmt/format.h>

#include <cstddef>

namespace kb::sim::report {
std::string safe_in_script(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '<') out += "\\u003c";
    else if (c == '>') out += "\\u003e";
    else if (c == '&') out += "\\u0026";
    else if (json.substr(i, 3) == "\xE2\x80\xA8") out += "\\u2028", i += 2;
    else if (json.substr(i, 3) == "\xE2\x80\xA9") out += "\\u2029", i += 2;
    else out += c;
  }
  return out;
}

std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

}  // namespace kb::sim::report
