#include "compiler/program/text.h"

#include <fmt/format.h>

#include <iterator>

namespace kb::program {

void append_number(std::string& out, float value) { fmt::format_to(std::back_inserter(out), "{}", value); }
void append_number(std::string& out, double value) { fmt::format_to(std::back_inserter(out), "{}", value); }

void append_seconds(std::string& out, std::int64_t time_us) {
  constexpr std::int64_t kMicro = 1'000'000;
  fmt::format_to(std::back_inserter(out), "{}", time_us / kMicro);
  const std::int64_t rest = time_us % kMicro;
  if (rest == 0) return;
  std::string digits = fmt::format(".{:06}", rest);
  digits.erase(digits.find_last_not_of('0') + 1);
  out += digits;
}

std::string seconds_text(std::int64_t time_us) {
  std::string text;
  append_seconds(text, time_us);
  return text;
}

void append_key(std::string& out, std::string_view key) {
  out += ",\"";
  out += key;
  out += "\":";
}

void append_json(std::string& out, std::string_view text) {
  out += '"';
  std::size_t written = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte >= 0x20 && byte != '"' && byte != '\\') continue;
    out.append(text, written, i - written);
    written = i + 1;
    if (byte < 0x20) fmt::format_to(std::back_inserter(out), "\\u{:04x}", byte);
    else (out += '\\') += text[i];
  }
  out.append(text, written);
  out += '"';
}

}  // namespace kb::program
