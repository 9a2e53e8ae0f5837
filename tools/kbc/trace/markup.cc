#include "tools/kbc/trace/markup.h"

#include <algorithm>

#include "compiler/diagnostics/display.h"

namespace kb::trace {

std::string escape_markup(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t size = 0; !text.empty(); text.remove_prefix(std::max<std::size_t>(size, 1))) {
    size = diagnostics::code_point(text).bytes;
    const char c = text.front();
    const bool control = static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += size == 0 || control ? "?" : text.substr(0, size);
    }
  }
  return out;
}

}  // namespace kb::trace
