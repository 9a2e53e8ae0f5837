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

/// All tokens of a file, comments included (marked as such), the last one `kEnd`. Bytes that form no token are
/// reported and skipped. O(bytes).
[[nodiscard]] std::vector<Token> lex(const source::Sources& sources, source::FileId file,
                                     diagnostics::Diagnostics& diagnostics);

/// Whether all of `text` is one name. Ask the lexer, since only it knows which letters beyond ASCII may stand in a name, or begin one.
[[nodiscard]] bool is_name(std::string_view text);
/// `text` with `_` for whatever cannot stand in a name, cut to 200 bytes to leave room for a prefix and a number. It may still be no name:
/// it may begin as none does, be empty, or be a word of the language.
[[nodiscard]] std::string worded(std::string_view text);

/// The tree of a file. Never fails as a whole: a statement that could not be read is reported and left out, and parsing goes on
/// with the next. O(tokens).
[[nodiscard]] Tree parse(const source::Sources& sources, source::FileId file, diagnostics::Diagnostics& diagnostics);

/// Calls `use` with each word of `text`: what lies between blanks and signs.
template <class Use>
void each_word(std::string_view text, Use use) {
  constexpr std::string_view kBetween = " \t\r\n.,:;()[]{}=+-*/<>~#\"";
  while (!text.empty()) {
    const std::size_t end = text.substr(0, text.find_first_of(kBetween)).size();
    if (end > 0) use(text.substr(0, end));
    text.remove_prefix(end < text.size() ? end + 1 : end);
  }
}

/// The words of the file that stand in no statement of its tree, in no landmark or road of a map, or in a fuzzy block: what could not
/// be read is among them, and what stands right before that. An empty one stands where a statement lacks its first word or
/// the name that it declares, and for letters that could not be read. Views into `sources`, in order of the text. O(bytes).
[[nodiscard]] std::vector<std::string_view> unread_words(const source::Sources& sources, const Tree& tree);

/// A piece of a file, for tools that display it. A word of the language counts as a name where only a name can stand.
struct Lexeme {
  enum class Class : std::uint8_t { kWord, kName, kNumber, kString, kComment, kSign };
  Class what = Class::kSign;
  source::Span span;
};
/// In order of the text. Reports nothing. O(bytes).
[[nodiscard]] std::vector<Lexeme> lexemes(const source::Sources& sources, source::FileId file);
/// The words of the language, in the order of grammar/tokens.def.
[[nodiscard]] std::span<const std::string_view> words();
/// Words that are words only in some places, such as a `fuzzy` block, and names elsewhere.
[[nodiscard]] std::span<const std::string_view> words_in_places();

/// Which names can stand at a place.
enum class NameKind : std::uint8_t {
  kNone, kAny,
  kLevel, kSet, kRelation, kRelationOrSet, kMap, kRoute, kCommand, kLandmark, kExit, kMethod, kStrategy, kFact, kFactOrStrategy, kSatellite,
  kCell,      ///< in a condition: anything that has a certainty
  kGroup,     ///< of cells, or a relation: after `any` and `no`
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
  std::vector<std::string_view> words;   ///< of the language; those that begin a statement only at the beginning of a line
  NameKind names = NameKind::kNone;
  std::uint32_t statement = 0;           ///< where the statement around the place begins; the place itself if there is none
};
/// What the grammar accepts at `offset`, whatever follows there. Nothing if the statement cannot be read that far. O(bytes before it).
[[nodiscard]] std::optional<Wanted> wanted_at(const source::Sources& sources, source::FileId file, std::uint32_t offset);

/// The tokens, one a line: `line:column kind text`.
[[nodiscard]] std::string print_tokens(const source::Sources& sources, const std::vector<Token>& tokens);
/// The tree, one item a line, indented.
[[nodiscard]] std::string print_tree(const source::Sources& sources, const Tree& tree);

/// The canonical layout of a file that parses without error: comments kept, idempotent, nothing but white space changed.
[[nodiscard]] std::string format(const source::Sources& sources, source::FileId file);

}  // namespace kb::syntax
