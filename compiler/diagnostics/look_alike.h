// Names that a reader takes for one another and the compiler does not: letters of other scripts that look the same, full-width letters,
// letters with marks that are written as one code point or as two.
#pragma once

#include <string>
#include <string_view>

namespace kb::diagnostics {

/// What a reader sees of a name: each letter replaced by the plainest one that looks like it, marks separated from their letters. Two
/// names look alike if their appearances are equal; a name of ASCII alone is its own appearance. Bytes that are not UTF-8 stay. Not for
/// printing.
[[nodiscard]] std::string appearance(std::string_view name);

[[nodiscard]] bool look_alike(std::string_view a, std::string_view b);

/// The letters in which two look-alike names differ, three at most: "`С` is U+0421 (Cyrillic) in the one, U+0043 (Latin) in the other".
[[nodiscard]] std::string difference(std::string_view a, std::string_view b);

}  // namespace kb::diagnostics
