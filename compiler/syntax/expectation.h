// What would have been right, in words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compiler/syntax/syntax.h"
#include "compiler/syntax/token_stream.h"

namespace kb::syntax {

/// What the language expects where the last token of `stream` stands: "a level after `at`", "`and`, `or` or `then`".
[[nodiscard]] std::string expectation(const TokenStream& stream, const TokenSet& expected);

/// The same for an editor: the last token of `stream` marks where the user is writing.
[[nodiscard]] Wanted wanted(const TokenStream& stream, const TokenSet& expected);

/// The words of the language that fit where the last token of `stream` stands. One that begins a statement fits only if that token begins
/// a line.
[[nodiscard]] std::vector<std::string_view> expected_words(const TokenStream& stream, const TokenSet& expected);

/// A token that was found instead: "`when`", "the number `3`", "the next statement, `rule`", "the end of the file".
[[nodiscard]] std::string found_text(const source::Sources& sources, const Token& found);

/// Whether one of the words that begin a statement could stand here.
[[nodiscard]] inline bool statement_may_begin(const TokenSet& expected) { return expected.contains(TokenKind::kRule); }
/// Whether a condition could begin here.
[[nodiscard]] inline bool condition_may_begin(const TokenSet& expected) { return expected.contains(TokenKind::kSeen); }

}  // namespace kb::syntax
