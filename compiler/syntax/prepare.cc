#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "compiler/syntax/syntax.h"
#include "compiler/syntax/token_stream.h"
#include "compiler/syntax/words.h"

namespace kb::syntax {
namespace {

using diagnostics::Kind;

bool is_name_or_keyword(TokenKind kind) { return kind == TokenKind::kIdentifier || is_keyword(kind); }

// One pass over the tokens. The state is the statement that the last token belongs to.
class Preparation {
 public:
  Preparation(const source::Sources& sources, Scan scan)
      : sources_(sources), tokens_(std::move(scan.tokens)), errors_(std::move(scan.errors)) {}

  Prepared run() {
    for (at_ = 0; at_ < tokens_.size(); ++at_) step();
    tokens_.resize(made_);
    std::stable_sort(errors_.begin(), errors_.end(), [](const LexicalError& a, const LexicalError& b) {
      return a.span.begin < b.span.begin;
    });
    return {std::move(tokens_), std::move(errors_)};
  }

 private:
  // ---- looking at neighbouring tokens
  [[nodiscard]] TokenKind kind(std::size_t ahead = 0) const {
    return ahead == 0 ? token_.kind : at_ + ahead < tokens_.size() ? tokens_[at_ + ahead].kind : TokenKind::kEnd;
  }
  [[nodiscard]] TokenKind last(std::size_t behind = 0) const {
    return behind < made_ ? tokens_[made_ - 1 - behind].kind : TokenKind::kEnd;
  }
  [[nodiscard]] TokenKind bracket() const { return open_.empty() ? TokenKind::kEnd : open_.back(); }
  [[nodiscard]] bool in_rule_condition() const {
    return statement_ == TokenKind::kRule && (clause_ == TokenKind::kWhen || clause_ == TokenKind::kWhile);
  }

  [[nodiscard]] bool begins_effect(std::size_t ahead = 0) const {
    const bool sign = kind(ahead) == TokenKind::kPlus || kind(ahead) == TokenKind::kMinus;
    return (sign && is_name_or_keyword(kind(ahead + 1))) || kind(ahead) == TokenKind::kReset;
  }

  void step();
  void read();
  void begin_statement();
  void follow(TokenKind kind);
  [[nodiscard]] bool nests_too_deeply(const Token& token);
  void put(TokenKind kind, source::Span span);
  void put_clause(TokenKind kind, source::Span span) { put(kind, span), follow(kind); }

  // ---- see note [words in context]
  [[nodiscard]] bool goes_on_as_statement() const;
  [[nodiscard]] bool stands_for_a_name() const;
  [[nodiscard]] bool stands_for_a_name_in_brackets() const;
  [[nodiscard]] bool stands_for_an_attribute() const;
  [[nodiscard]] bool ends_a_declaration() const;
  [[nodiscard]] bool gives_rows_state();
  [[nodiscard]] TokenKind kind_of_name() const;

  [[nodiscard]] bool stands_for_a_name_in_fuzzy() const;
  [[nodiscard]] TokenKind kind_in_fuzzy() const;

  // ---- slips of the pen; each function returns whether it has used up the token
  void mend_word();
  [[nodiscard]] bool mend_sign();
  [[nodiscard]] bool mend_rule();

  // Reports a mistake that has been corrected.
  void mended(Kind kind, source::Span at, std::string_view first = {}, std::string_view second = {}) {
    errors_.push_back({kind, at, std::string(first), std::string(second), true});
  }

  const source::Sources& sources_;
  std::vector<Token> tokens_;               // up to `made_` as the parser will get them; after `at_` as they were scanned
  std::vector<LexicalError> errors_;
  std::size_t made_ = 0, at_ = 0;           // at most one more token was made than was read
  Token token_;                             // the token that was read last, at `at_`
  bool begins_line_ = true;
  TokenKind statement_ = TokenKind::kEnd;
  TokenKind clause_ = TokenKind::kEnd;      // the last of `at`, `when`, `while`, `then` in a rule; `=` in a definition
  std::size_t statement_begin_ = 0;         // in `tokens_`
  std::vector<TokenKind> open_;
  std::size_t nots_ = 0;                    // in a row
  bool skipping_ = false;                   // the rest of a statement that is nested too deeply
};

void Preparation::read() {
  const std::uint32_t end = token_.span.end;   // of the token before
  token_ = tokens_[at_];
  const std::string_view between = sources_.bytes(token_.span.file).substr(end, token_.span.begin - end);
  begins_line_ = at_ == 0 || between.find('\n') != std::string_view::npos;
}

void Preparation::put(TokenKind kind, source::Span span) {
  if (made_ > at_) {   // two tokens were made from one, and none was left out before: make room, also for the next such pair
    const std::size_t more = tokens_.size() / 8 + 1;
    tokens_.insert(tokens_.begin() + static_cast<std::ptrdiff_t>(made_), more, Token{});
    at_ += more;
  }
  Token& made = tokens_[made_++] = {kind, span};
  made.begins_line = begins_line_;
}

void Preparation::step() {
  read();
  if (is_keyword(token_.kind)) {
    const bool first = begins_statement(token_.kind) || begins_item(token_.kind);
    const bool breaks_line = begins_line_ && first && goes_on_as_statement();
    if (!breaks_line && (stands_for_a_name() || (is_attribute_word(token_.kind) && !stands_for_an_attribute()))) {
      if (!skipping_) put(kind_of_name(), token_.span);
      return;
    }
    if (gives_rows_state()) return put(TokenKind::kRowSatellites, token_.span);
    if (begins_statement(token_.kind) && (begins_line_ || open_.empty())) {
      return begin_statement();
    }
  }
  if (skipping_ && token_.kind != TokenKind::kEnd) return;
  mend_word();
  if (nests_too_deeply(token_)) return;
  if (mend_sign() || mend_rule()) return;
  if (token_.kind == TokenKind::kIdentifier) return put(kind_of_name(), token_.span);
  put(token_.kind, token_.span);
  follow(token_.kind);
}

void Preparation::begin_statement() {
  statement_ = token_.kind;
  clause_ = TokenKind::kEnd;
  open_.clear();
  skipping_ = false;
  statement_begin_ = made_;
  put(token_.kind, token_.span);
  tokens_[statement_begin_].begins_statement = true;
}

void Preparation::follow(TokenKind kind) {
  if (is_left(kind)) open_.push_back(kind);
  if (is_right(kind) && !open_.empty()) open_.pop_back();
  if (statement_ == TokenKind::kRule &&
      (kind == TokenKind::kAt || kind == TokenKind::kWhen || kind == TokenKind::kWhile || kind == TokenKind::kThen)) {
    clause_ = kind;
  }
  if (is_declaration(statement_) || statement_ == TokenKind::kPerceive) {
    if (kind == TokenKind::kEqual || kind == TokenKind::kComma) clause_ = kind;
  }
}

// Such tokens are refused here, so that the parser's stack does not grow with the nesting.
bool Preparation::nests_too_deeply(const Token& token) {
  constexpr auto kMost = static_cast<std::size_t>(kMaxNesting);
  nots_ = token.kind == TokenKind::kNot ? nots_ + 1 : 0;
  if (nots_ <= kMost && !(is_left(token.kind) && open_.size() >= kMost)) return false;
  mended(Kind::kNestingTooDeep, token.span, std::to_string(kMaxNesting));
  made_ = statement_begin_;
  skipping_ = true;
  return true;
}

// ---- words that are names

// After a word that begins statements, at the beginning of a line: whether its statement follows. Otherwise it is a name where one may stand:
// in a list, a level (`at route when`), the input of a fuzzy rule (`map is near`).
bool Preparation::goes_on_as_statement() const {
  const TokenKind next = kind(1);
  if (next == TokenKind::kIs || next == TokenKind::kWhen || next == TokenKind::kWhile) return false;
  return is_name_or_keyword(next) || next == TokenKind::kString;
}

bool Preparation::stands_for_a_name() const {
  const TokenKind word = kind(), next = kind(1), before = last();
  if (before == TokenKind::kDot) return true;
  if (bracket() != TokenKind::kEnd) return stands_for_a_name_in_brackets();
  switch (statement_) {
    case TokenKind::kRule:  // a level: `at map when`, and even `at when when`
      return before == TokenKind::kAt && (next == TokenKind::kWhen || next == TokenKind::kWhile ||
                                          (word != TokenKind::kWhen && word != TokenKind::kWhile && word != TokenKind::kThen));
    case TokenKind::kLevels: return before == TokenKind::kLevels || before == TokenKind::kGreater;
    case TokenKind::kSet:
      return next == TokenKind::kEqual || before == TokenKind::kEqual ||
             ((before == TokenKind::kSet || before == TokenKind::kComma) && !begins_statement(word));   // `=` is missing: `set event 0.7`
    case TokenKind::kControl: return before == TokenKind::kEqual;
    case TokenKind::kRelation:  // `satellites of from, by`
      return word != TokenKind::kExclusive && (before == TokenKind::kOf || before == TokenKind::kComma);
    default: return false;
  }
}

bool Preparation::stands_for_a_name_in_brackets() const {
  const TokenKind word = kind(), before = last();
  const bool labelled = kind(1) == TokenKind::kColon;
  if (statement_ == TokenKind::kFuzzy) return stands_for_a_name_in_fuzzy();
  switch (bracket()) {
    case TokenKind::kLeftBracket:
      return word != TokenKind::kIn && (is_right(kind(1)) || kind(1) == TokenKind::kComma || kind(1) == TokenKind::kDot);
    case TokenKind::kLeftParen:
      return statement_ == TokenKind::kRelation || (labelled && statement_ == TokenKind::kRow) ||
             (statement_ == TokenKind::kControl && (labelled || before == TokenKind::kColon));
    default:
      if (statement_ == TokenKind::kMap) {
        return before == TokenKind::kLandmark || before == TokenKind::kRoad || before == TokenKind::kBy ||
               before == TokenKind::kTwoWay || before == TokenKind::kArrow;
      }
      if (is_declaration(statement_)) return before == TokenKind::kLeftBrace || before == TokenKind::kComma;
      return statement_ == TokenKind::kNames || statement_ == TokenKind::kTable;
  }
}

// Attributes: `sensor range 0..4 m noise 0.02 m strict`, `fact Line = ... lazy`. Names: `sensor noise 0..1`, `fact A = lazy and B`.
bool Preparation::stands_for_an_attribute() const {
  const TokenKind before = last();
  if (!open_.empty() || before == statement_) return false;
  return kind() == TokenKind::kLazy ? ends_a_declaration() : statement_ == TokenKind::kSensor;
}

// Whether the word is an attribute because the cell's name stands before it: in `satellite Slow output`, not in `satellite output`.
bool Preparation::ends_a_declaration() const {
  const TokenKind before = last();
  return is_declaration(statement_) && open_.empty() && before != statement_ && before != TokenKind::kComma && before != TokenKind::kEqual &&
         before != TokenKind::kAnd && before != TokenKind::kOr && before != TokenKind::kNot && before != TokenKind::kTilde && before != TokenKind::kOf &&
         before != TokenKind::kDot;
}

// In a fuzzy block any word may be the name of a term, an input or an output: grammar/README.md lists where. But `and = product` is a
// setting.
bool Preparation::stands_for_a_name_in_fuzzy() const {
  const TokenKind word = kind(), next = kind(1), before = last();
  if (word == TokenKind::kAnd || word == TokenKind::kOr || word == TokenKind::kNot || word == TokenKind::kIs) return false;
  if (next == TokenKind::kEqual || next == TokenKind::kIs || next == TokenKind::kLeftBracket) return true;
  if (word == TokenKind::kThen) return false;   // meant as an arrow, and reported as such
  std::size_t hedges = 0;
  while (last(hedges) == TokenKind::kIdentifier || last(hedges) == TokenKind::kNot) ++hedges;
  return last(hedges) == TokenKind::kIs || before == TokenKind::kEqual || before == TokenKind::kStar ||
         before == TokenKind::kInput || before == TokenKind::kOutput || before == TokenKind::kDefault;
}

// A name with which a new term or rule begins is a subject: it may follow a number directly, where any other name would be the
// number's unit. The block's own words are keywords unless they stand for a name.
TokenKind Preparation::kind_in_fuzzy() const {
  constexpr TokenKind kWords[] = {TokenKind::kInput,   TokenKind::kOutput, TokenKind::kGiven,   TokenKind::kWithin,
                                  TokenKind::kDefault, TokenKind::kWeight, TokenKind::kCircular};
  const TokenKind next = kind(1);
  if (next == TokenKind::kEqual || next == TokenKind::kIs || next == TokenKind::kLeftBracket) return TokenKind::kSubject;
  if (bracket() != TokenKind::kLeftBrace || stands_for_a_name_in_fuzzy()) return TokenKind::kIdentifier;
  const std::string_view text = sources_.text(token_.span);
  for (const TokenKind kind : kWords) {
    if (text == spelling(kind)) return kind;
  }
  return TokenKind::kIdentifier;
}

// Whether `satellites` is the clause of `relation R(...) satellites ...` and not the next statement. A name follows only in a statement.
bool Preparation::gives_rows_state() {
  const TokenKind next = kind(1);
  const bool after_fields = statement_ == TokenKind::kRelation && last() == TokenKind::kRightParen && open_.empty();
  if (!after_fields || next == TokenKind::kIdentifier) return false;
  if (kind() == TokenKind::kSatellites) return true;
  const bool clause = next == TokenKind::kOf || next == TokenKind::kExclusive || !begins_line_;
  if (kind() != TokenKind::kSatellite || !clause) return false;
  mended(Kind::kRowSatellite, token_.span);
  return true;
}

TokenKind Preparation::kind_of_name() const {
  if (statement_ == TokenKind::kFuzzy && !open_.empty()) return kind_in_fuzzy();
  if (kind(1) == TokenKind::kColon && statement_ == TokenKind::kTable && bracket() == TokenKind::kLeftBrace) {
    return TokenKind::kLabel;
  }
  const bool in_map = statement_ == TokenKind::kMap && bracket() == TokenKind::kLeftBrace;
  if (in_map && last() == TokenKind::kAt && sources_.text(token_.span) == "most") return TokenKind::kMost;
  if (ends_a_declaration() && sources_.text(token_.span) == "output") return TokenKind::kOutput;
  const bool extends = last() == TokenKind::kIdentifier && open_.empty() &&
                       (last(1) == TokenKind::kNames || last(1) == TokenKind::kTable);
  return extends && sources_.text(token_.span) == "more" ? TokenKind::kMore : TokenKind::kIdentifier;
}

// ---- slips

// `NOT Line AND Gate`. Where two names or a name and a parenthesis stand side by side, the one is no name.
void Preparation::mend_word() {
  const bool plain = open_.empty() || open_.back() == TokenKind::kLeftParen;
  if (token_.kind != TokenKind::kIdentifier || !in_rule_condition() || !plain) return;
  const std::string_view word = sources_.text(token_.span);
  const bool behind = last() == TokenKind::kIdentifier || is_right(last());
  const bool before = kind(1) == TokenKind::kIdentifier || kind(1) == TokenKind::kLeftParen || is_keyword(kind(1));
  const TokenKind meant = word == "NOT" ? TokenKind::kNot : word == "AND" ? TokenKind::kAnd : word == "OR" ? TokenKind::kOr : TokenKind::kIdentifier;
  const bool fits = meant == TokenKind::kNot ? !behind && kind(1) != TokenKind::kAnd && kind(1) != TokenKind::kOr : behind;
  if (meant == TokenKind::kIdentifier || !before || !fits || kind(1) == TokenKind::kThen) return;
  mended(Kind::kOtherWord, token_.span, word, spelling(meant));
  token_.kind = meant;
}

bool Preparation::mend_sign() {
  const source::Span span = token_.span;
  const bool asks = in_rule_condition();
  const bool defined = statement_ != TokenKind::kRule && clause_ == TokenKind::kEqual;
  const bool equality = kind() == TokenKind::kEqualEqual || kind() == TokenKind::kNotEqual;
  const std::string_view next = at_ + 1 < tokens_.size() ? sources_.text(tokens_[at_ + 1].span) : "";
  const bool term = std::find(kTermWords.begin(), kTermWords.end(), next) != kTermWords.end();
  if (equality && (defined || (asks && !term))) return false;   // a comparison
  switch (kind()) {
    case TokenKind::kEqualEqual:
      mended(Kind::kEqualitySign, span, "==",
             asks ? "a condition says `is`" : statement_ == TokenKind::kRule ? "an effect says `=`" : "one `=` is enough here");
      put(asks ? TokenKind::kIs : TokenKind::kEqual, span);
      return true;
    case TokenKind::kNotEqual:
      mended(Kind::kEqualitySign, span, sources_.text(span), "a condition says `is not`");
      put(TokenKind::kIs, span);
      put(TokenKind::kNot, span);
      return true;
    case TokenKind::kFatArrow:
      mended(Kind::kOtherWord, span, "=>", asks ? "then" : "->");
      put_clause(asks ? TokenKind::kThen : TokenKind::kArrow, span);
      return true;
    default: return false;
  }
}

bool Preparation::mend_rule() {
  if (statement_ != TokenKind::kRule || !open_.empty()) return false;
  const source::Span span = token_.span;
  if (kind() == TokenKind::kIdentifier && last(1) == TokenKind::kAt && sources_.text(span) == "if") {
    mended(Kind::kIfForWhen, span);
    put_clause(TokenKind::kWhen, span);
    return true;
  }
  const bool arrow = kind() == TokenKind::kArrow || sources_.text(span) == "do";   // `when Line -> +Stopped`
  if (arrow && in_rule_condition() && begins_effect(1)) {
    mended(Kind::kOtherWord, span, sources_.text(span), "then");
    put_clause(TokenKind::kThen, span);
    return true;
  }
  const bool hyphen = kind() == TokenKind::kMinus && last() == TokenKind::kIdentifier && tokens_[made_ - 1].span.end == span.begin;   // `Wall-Left`
  if (begins_effect() && !hyphen && in_rule_condition() && !is_keyword(last())) {   // no condition ends with a keyword
    mended(Kind::kMissingThen, {span.file, span.begin, span.begin});
    put_clause(TokenKind::kThen, {span.file, span.begin, span.begin});
  }
  return false;
}

}  // namespace

Prepared prepare(const source::Sources& sources, Scan scan) { return Preparation(sources, std::move(scan)).run(); }

}  // namespace kb::syntax
