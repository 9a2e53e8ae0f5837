// What the fuzz targets read with, and what they demand of a text that was made of their input.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "compiler/diagnostics/consumers.h"
#include "compiler/syntax/syntax.h"

namespace kb {

struct Reading {
  source::Sources sources;
  diagnostics::CountingConsumer consumer;
  diagnostics::Diagnostics messages{sources, consumer};
};

/// A knowledge base that kbc writes has to be one.
inline void require_parse(Reading& in, const std::string& text) {
  const std::size_t before = in.messages.errors();
  static_cast<void>(syntax::parse(in.sources, in.sources.add("made.kb", text), in.messages));
  if (in.messages.errors() == before) return;
  std::fprintf(stderr, "does not parse:\n%s\n", text.c_str());
  std::abort();
}

/// The first line, without its end, which is cut off.
inline std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(line.size() < text.size() ? line.size() + 1 : line.size());
  return line;
}

/// A file that is nowhere but in memory, for what reads files itself.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes = {}) : file_(memfd_create("fuzz", MFD_CLOEXEC)) {
    if (file_ < 0 || ::write(file_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) std::abort();
    rewind();
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(file_); }
  [[nodiscard]] int file() const { return file_; }
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }
  void rewind() const {
    if (::lseek(file_, 0, SEEK_SET) != 0) std::abort();
  }

 private:
  int file_;
};

}  // namespace kb
