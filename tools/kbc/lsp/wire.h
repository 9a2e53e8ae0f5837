// Messages over two streams: a header that says how many bytes follow, an empty line, and that many bytes of JSON.
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace kb::lsp {

using Json = nlohmann::json;

class Wire {
 public:
  /// Neither is owned. `in`: a file descriptor.
  Wire(int in, std::FILE* out) : in_(in), out_(out) {}

  /// The next message's text. Nothing if the stream has ended, or the message is malformed (`error` says how).
  [[nodiscard]] std::optional<std::string> read();
  /// Whether something has arrived that was not read.
  [[nodiscard]] bool waiting() const;
  [[nodiscard]] const std::string& error() const { return error_; }

  /// Bytes that are not UTF-8 become U+FFFD.
  void write(const Json& message);

 private:
  [[nodiscard]] bool more();
  [[nodiscard]] std::optional<std::string> take(std::size_t bytes);
  [[nodiscard]] std::optional<std::string> line();

  int in_;
  std::FILE* out_;
  std::string come_;   // arrived and not read
  std::string error_;
};

}  // namespace kb::lsp
