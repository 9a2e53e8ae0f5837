// From bytes to a tree, and back to text.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"
#include "compiler/syntax/tokens.h"
#include "compiler/syntax/tree.h"

namespace kb::syntax {

/// Deepest nesting of parentheses, `not`, `for` and index brackets; deeper is KB0802. Recursion over a tree is bounded by it.
inline constexpr int kMaxNesting = 64;
/// Longest identifier in bytes; longer is KB0803.
inline constexpr std::size_t kMaxIdentifierBytes = 255;

/// All tokens of a file, comments included (marked as such), the last one `kEnd`. Bytes that are no token are reported
/// and skipped. O(bytes).
[[nodiscard]] std::vector<Token> lex(const source::Sources& sources, source::FileId file,
                                     diagnostics::Diagnostics& diagnostics);

/// Whether all of `text` is one name: of letters that are not ASCII only the lexer can tell which may stand in one, and which begin one.
[[nodiscard]] bool is_name(std::string_view text);
/// `text` with `_` for what cannot stand in a name, cut to 200 bytes, so that a prefix and a number have room. It may still begin as no name
/// does, be empty, or be a word of the language.
[[nodiscard]] std::string worded(std::string_view text);

/// The tree of a file. Never fails as a whole: a statement that could not be read is reported and left out, the next one
/// is read. O(tokens).
[[nodiscard]] Tree parse(const source::Sources& sources, source::FileId file, diagnostics::Diagnostics& diagnostics);

/// What stands in a file for those who show it. A word of the language that stands where only a name can stand is a name.
struct Lexeme {
  enum class Class : std::uint8_t { kWord, kName, kNumber, kString, kComment, kSign };
  Class what = Class::kSign;
  source::Span span;
};
/// In order of the text. Reports nothing. O(bytes).
[[nodiscard]] std::vector<Lexeme> lexemes(const source::Sources& sources, source::FileId file);
/// The words of the language, in the order of grammar/tokens.def.
[[nodiscard]] std::span<const std::string_view> words();
/// What is a word only in some places, as in a `fuzzy` block, and a name elsewhere.
[[nodiscard]] std::span<const std::string_view> words_in_places();

/// Whose names can stand at a place.
enum class NameKind : std::uint8_t {
  kNone, kAny,
  kLevel, kSet, kRelation, kRelationOrSet, kMap, kRoute, kCommand, kLandmark, kExit, kMethod, kStrategy, kFact, kFactOrStrategy, kSatellite,
  kCell,      ///< of a condition: whatever has a certainty
  kGroup,     ///< of cells, or a relation: behind `any` and `no`
  kPercept,   ///< facts and sensors
  kMember, kIndex, kValue,   ///< of a set; in brackets, or as an argument of a table; of a row's field
  kRowField,
  kController, kShape, kInput, kOutput, kTerm, kFuzzyOutput,
  kState,     ///< `low`, `zero`, `high`
  kUnit, kSetting, kSettingWord,
  kText,      ///< `text`
};
/// What can be written at a place.
struct Wanted {
  std::vector<std::string_view> words;   ///< of the language; what begins a statement only where a line begins
  NameKind names = NameKind::kNone;
  std::uint32_t statement = 0;           ///< where the statement begins that the place is in; the place itself if it is in none
};
/// What the grammar takes at `offset`, whatever stands behind it. Nothing if the statement cannot be read as far as that. O(bytes before it).
[[nodiscard]] std::optional<Wanted> wanted_at(const source::Sources& sources, source::FileId file, std::uint32_t offset);

/// The tokens, one a line: `line:column kind text`.
[[nodiscard]] std::string print_tokens(const source::Sources& sources, const std::vector<Token>& tokens);
/// The tree, one item a line, indented.
[[nodiscard]] std::string print_tree(const source::Sources& sources, const Tree& tree);

/// The canonical layout of a file that parses without error: comments kept, idempotent, nothing but white space changed.
[[nodiscard]] std::string format(const source::Sources& sources, source::FileId file);

}  // namespace kb::syntax
