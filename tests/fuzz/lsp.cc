// What an editor may send to `kbc lsp`. An input that begins with `{` is a session of messages, a line each; one that begins with `C` is the
// bytes of the stream, headers and all; any other is a text in which places are counted.
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

#include "tests/fuzz/reading.h"
#include "tools/kbc/lsp/places.h"
#include "tools/kbc/lsp/server.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace kb;

std::string framed(std::string_view lines) {
  std::string stream;
  while (!lines.empty()) {
    const std::string_view line = take_line(lines);
    stream += "Content-Length: " + std::to_string(line.size()) + "\r\n\r\n";
    stream += line;
  }
  return stream;
}

/// All that the server says is messages, and no place of theirs ends before it begins.
void require_places(const lsp::Json& json) {
  if (json.is_object() && json.contains("start") && json.contains("end")) {
    const auto& start = json["start"];
    const auto& end = json["end"];
    if (std::pair(end["line"].get<std::uint64_t>(), end["character"].get<std::uint64_t>()) <
        std::pair(start["line"].get<std::uint64_t>(), start["character"].get<std::uint64_t>())) {
      std::abort();
    }
  }
  for (const auto& part : json) {
    if (part.is_structured()) require_places(part);
  }
}

void serve(std::string_view bytes) {
  const MemoryFile in(bytes), out;
  std::FILE* const file = ::fdopen(::dup(out.file()), "w");
  lsp::Wire wire(in.file(), file);
  static_cast<void>(lsp::Server(wire, lsp::Workspace("/no/library", {}), "0").run());
  std::fclose(file);
  out.rewind();
  lsp::Wire said(out.file(), nullptr);
  while (const auto text = said.read()) {
    const auto message = lsp::Json::parse(*text, nullptr, false);
    if (!message.is_object() || message.value("jsonrpc", "") != "2.0") std::abort();
    if (message.contains("params")) require_places(message["params"]);
  }
  if (!said.error().empty()) std::abort();
}

/// There and back, for the beginning of each character.
void count_places(std::string_view text, lsp::Encoding encoding) {
  source::Sources sources;
  const auto file = sources.add("text", std::string(text));
  const lsp::Places places(sources);
  for (std::uint32_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0u) == 0x80u) continue;
    const auto at = places.position(file, i, encoding);
    const std::uint32_t there = lsp::offset(text, at, encoding);
    const auto again = places.position(file, std::min(there, static_cast<std::uint32_t>(text.size())), encoding);
    if (there > text.size() || again.line != at.line || again.character != at.character) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.starts_with('{')) {
    serve(framed(bytes));
  } else if (bytes.starts_with('C')) {
    serve(bytes);
  } else {
    count_places(bytes, lsp::Encoding::kUtf8);
    count_places(bytes, lsp::Encoding::kUtf16);
  }
  return 0;
}
