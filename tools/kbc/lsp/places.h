// Places as editors write them: lines and characters from 0, and files as URIs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "compiler/source/source.h"

namespace kb::lsp {

/// What a line's characters are counted in: bytes, or units of UTF-16 (what editors do that were not asked).
enum class Encoding : std::uint8_t { kUtf8, kUtf16 };

struct Position { std::uint32_t line = 0, character = 0; };

/// How many units `text` has. A byte that is no UTF-8 counts as one.
[[nodiscard]] std::uint32_t units(std::string_view text, Encoding encoding);

[[nodiscard]] Position position(const source::Sources& sources, source::FileId file, std::uint32_t offset, Encoding encoding);

/// The byte at `at`; of a line that is shorter its end, of a text that is shorter its end. O(bytes).
[[nodiscard]] std::uint32_t offset(std::string_view bytes, Position at, Encoding encoding);

/// The path of a `file:` URI of this machine; nothing for any other.
[[nodiscard]] std::optional<std::string> path_of(std::string_view uri);

}  // namespace kb::lsp
