// Places as editors write them: lines and characters from 0, and files as URIs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/source/source.h"

namespace kb::lsp {

/// The unit in which characters of a line are counted: bytes, or units of UTF-16 (the default of editors).
enum class Encoding : std::uint8_t { kUtf8, kUtf16 };

struct Position { std::uint32_t line = 0, character = 0; };

/// The places of the files of some sources. The cost of finding one does not grow with the length of its line, which may hold a whole
/// program.
class Places {
 public:
  Places() = default;
  /// `sources` must outlive it. O(their bytes).
  explicit Places(const source::Sources& sources);

  [[nodiscard]] Position position(source::FileId file, std::uint32_t offset, Encoding encoding) const;
  /// How many units a known span has.
  [[nodiscard]] std::uint32_t units(source::Span span, Encoding encoding) const;

 private:
  const source::Sources* sources_ = nullptr;
  std::vector<std::vector<std::uint32_t>> pairs_;   // by file: the beginnings of characters of two UTF-16 units
};

/// The byte at `at`; if the line or the text is shorter, its end. O(bytes).
[[nodiscard]] std::uint32_t offset(std::string_view bytes, Position at, Encoding encoding);

/// The path of a `file:` URI of this machine; nothing for any other.
[[nodiscard]] std::optional<std::string> path_of(std::string_view uri);

}  // namespace kb::lsp
