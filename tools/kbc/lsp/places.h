// Places as editors write them: lines and characters from 0, and files as URIs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/source/source.h"

namespace kb::lsp {

/// What a line's characters are counted in: bytes, or units of UTF-16 (what editors do that were not asked).
enum class Encoding : std::uint8_t { kUtf8, kUtf16 };

struct Position { std::uint32_t line = 0, character = 0; };

/// The places of the files of some sources. What it costs to find one does not grow with the length of its line: a program may stand on one.
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
  std::vector<std::vector<std::uint32_t>> pairs_;   // by file: where characters begin that are two units of UTF-16
};

/// The byte at `at`; of a line that is shorter its end, of a text that is shorter its end. O(bytes).
[[nodiscard]] std::uint32_t offset(std::string_view bytes, Position at, Encoding encoding);

/// The path of a `file:` URI of this machine; nothing for any other.
[[nodiscard]] std::optional<std::string> path_of(std::string_view uri);

}  // namespace kb::lsp
