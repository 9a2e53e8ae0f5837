// What the parser reads: the prepared tokens of a file, and recovery after an error.
//
// note [words in context]
//   The words of statements (`map`, `at`, `when`, ...) are useful as names too: a level `map`, a field `when`. The lexer cannot
//   tell which is meant, and a grammar that accepted both would have conflicts. But where such a name is useful nothing but a
//   name can stand, and its neighbours show the place: after a `.`, between the parentheses of a relation, before a `:`, ...
//   `prepare` has a table of these places and turns the words found there into identifiers.
//   A statement word stays one if it begins a line and is followed by what its statement would continue with. Otherwise a
//   forgotten name or brace would swallow the next statement.
#pragma once

#include <bitset>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"
#include "compiler/syntax/scan.h"
#include "compiler/syntax/syntax.h"
#include "compiler/syntax/tokens.h"

namespace kb::syntax {

/// A set of kinds of token.
class TokenSet {
 public:
  void insert(TokenKind kind) { bits_.set(static_cast<std::size_t>(kind)); }
  [[nodiscard]] bool contains(TokenKind kind) const { return bits_.test(static_cast<std::size_t>(kind)); }

 private:
  std::bitset<128> bits_;
};

/// With this word other languages begin a rule.
inline constexpr std::string_view kForeignRule = "if";

/// What the parser will read, and the errors found so far, in order of the text.
struct Prepared {
  std::vector<Token> tokens;   ///< the last one is `kEnd`
  std::vector<LexicalError> errors;
};

/// Tells words from names, corrects slips that have one obvious meaning, and leaves out statements that are nested too deeply.
/// `scan` must hold no comments; its tokens are changed in place and returned. O(tokens).
[[nodiscard]] Prepared prepare(const source::Sources& sources, Scan scan);

/// Hands prepared tokens to the parser one by one, and keeps track of where in a statement the parser is.
class TokenStream {
 public:
  /// Errors found earlier are reported as the tokens behind them are handed out, so that messages come in order.
  TokenStream(const source::Sources& sources, Prepared prepared, diagnostics::Diagnostics& diagnostics);

  [[nodiscard]] Token next();
  /// Called after an error at the token handed out last: the next token will be `kResume`, and then reading goes on where
  /// a statement (in a map or a fuzzy block: one of its lines) begins. An open map or block is closed.
  ///
  /// note [a statement before an error]
  ///   `fact A` is complete before `satelite B`, but the parser knows that only when it sees something that may follow, and drops
  ///   the statement when it sees something that may not. So, if a statement could begin at the token and the token begins a line
  ///   (`complete`), the statement before it is handed out once more, with a `kResume` after it.
  void recover(bool complete);

  /// Called instead of `recover` at a `kComment`: `wanted_at` puts one at the place that it asks about, and no grammar accepts it.
  /// Keeps `at` and ends the stream there.
  void stop(Wanted at);
  [[nodiscard]] const std::optional<Wanted>& wanted() const { return wanted_; }

  [[nodiscard]] const source::Sources& sources() const { return sources_; }
  /// The token handed out last, and those before it: `behind(1)` is its predecessor; `kEnd` before the first.
  [[nodiscard]] Token behind(std::size_t distance) const;
  [[nodiscard]] Token ahead(std::size_t distance) const;
  /// How many tokens of that kind stand before the next closing brace.
  [[nodiscard]] std::size_t ahead_in_braces(TokenKind kind) const;
  /// The word that began the statement that the last token belongs to; `kEnd` if there is none.
  [[nodiscard]] Token statement() const;
  /// The innermost bracket opened in this statement before the last token and still open; `kEnd` if there is none.
  [[nodiscard]] Token open_bracket() const;
  /// Whether something in this statement was reported as no token; errors that follow from it need no report.
  [[nodiscard]] bool is_spoilt() const { return spoilt_; }
  /// Whether the last token itself was reported, even if it is clear what it means.
  [[nodiscard]] bool is_reported() const { return reported_ > 0 && errors_[reported_ - 1].span.end > behind(0).span.begin; }

 private:
  void accept_last();
  [[nodiscard]] std::size_t open_lists() const;
  [[nodiscard]] bool ends_statement(std::size_t token) const;
  [[nodiscard]] std::size_t end_of_fault(std::size_t lists) const;
  [[nodiscard]] bool begins_line_of_list(std::size_t token, std::size_t lists) const;
  void report_before(std::uint32_t end);
  void forget_slips_before(std::uint32_t end);

  const source::Sources& sources_;
  diagnostics::Diagnostics& diagnostics_;
  std::vector<Token> tokens_;
  std::vector<LexicalError> errors_;
  std::size_t reported_ = 0;           // how many of `errors_`
  bool spoilt_ = false;
  std::optional<Wanted> wanted_;
  std::size_t handed_ = 0;             // how many were handed out or skipped
  std::size_t statement_ = kNone;      // index of the word that began the statement
  std::vector<std::size_t> open_;      // indices of open brackets, the last token not counted
  bool last_is_accepted_ = true;       // the last token is not, or no longer, to be followed
  bool resuming_ = false;              // `kResume` is due
  std::size_t replay_end_ = kNone;     // before this token `kResume` is due, and then
  std::size_t replay_next_ = 0;        // ... this one
  std::size_t closing_ = 0;            // so many braces of a map or a fuzzy block are due
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
};

}  // namespace kb::syntax
