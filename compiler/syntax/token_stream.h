// What the parser reads: the tokens of a file, made ready, and the way on after an error.
//
// note [words in context]
//   The words of a statement (`map`, `at`, `when`, ...) are wanted as names too: a level `map`, a field `when`. The lexer
//   cannot know; the grammar, told to accept both, would have conflicts. But in each such place nothing but a name can
//   stand, and the place is known from its neighbours: after a `.`, between the parentheses of a relation, before a `:`,
//   ... `prepare` holds that list as a table and turns the words found there into identifiers.
//   A statement word at the beginning of a line, followed by what its statement would go on with, stays one: else a
//   forgotten name or brace would swallow the next statement.
#pragma once

#include <bitset>
#include <cstddef>
#include <optional>
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

/// What the parser will read, and what is already known to be wrong, in order of the text.
struct Prepared {
  std::vector<Token> tokens;   ///< the last one is `kEnd`
  std::vector<LexicalError> errors;
};

/// Tells words from names, puts right slips that have one obvious meaning, and leaves out statements that are nested too
/// deeply. `scan` holds no comments; its tokens become those that are returned, where they lie. O(tokens).
[[nodiscard]] Prepared prepare(const source::Sources& sources, Scan scan);

/// Hands prepared tokens to the parser, one by one, and knows where in its statement the parser stands.
class TokenStream {
 public:
  /// Errors found earlier are reported as the tokens behind them are handed out, so that messages come in order.
  TokenStream(const source::Sources& sources, Prepared prepared, diagnostics::Diagnostics& diagnostics);

  [[nodiscard]] Token next();
  /// Called after an error at the token handed out last: the next token will be `kResume`, and then reading goes on where
  /// a statement (in a map or a fuzzy block: one of its lines) begins. A map or a block that is not closed is closed.
  ///
  /// note [a statement before an error]
  ///   `fact A` is complete before `satelite B`, but the parser cannot know until it sees what may follow, and drops it
  ///   when it sees what may not. So, if a statement could begin at the token and a line does (`complete`), the statement
  ///   before it is handed out once more, with a `kResume` behind it.
  void recover(bool complete);

  /// Called in place of that at a `kComment`, which no grammar takes and `wanted_at` puts where it asks: keeps `at`, and ends there.
  void stop(Wanted at);
  [[nodiscard]] const std::optional<Wanted>& wanted() const { return wanted_; }

  [[nodiscard]] const source::Sources& sources() const { return sources_; }
  /// The token handed out last, and those before it: `behind(1)` is its predecessor; `kEnd` before the first.
  [[nodiscard]] Token behind(std::size_t distance) const;
  [[nodiscard]] Token ahead(std::size_t distance) const;
  /// How many tokens of that kind stand before the next closing brace.
  [[nodiscard]] std::size_t ahead_in_braces(TokenKind kind) const;
  /// The word that began the statement of the token handed out last, as far as it was read; `kEnd` if there is none.
  [[nodiscard]] Token statement() const;
  /// The innermost bracket that was opened in this statement before the last token and not closed; `kEnd` if none.
  [[nodiscard]] Token open_bracket() const;
  /// Whether something in this statement was no token and was reported: what follows from it need not be.
  [[nodiscard]] bool is_spoilt() const { return spoilt_; }
 private:
  void accept_last();
  [[nodiscard]] std::size_t open_lists() const;
  [[nodiscard]] std::size_t end_of_fault(std::size_t lists) const;
  [[nodiscard]] bool begins_line_of_list(std::size_t token, std::size_t lists) const;
  void report_before(std::uint32_t end);

  const source::Sources& sources_;
  diagnostics::Diagnostics& diagnostics_;
  std::vector<Token> tokens_;
  std::vector<LexicalError> errors_;
  std::size_t reported_ = 0;           // how many of `errors_`
  bool spoilt_ = false;
  std::optional<Wanted> wanted_;
  std::size_t handed_ = 0;             // how many were handed out, or stepped over
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
