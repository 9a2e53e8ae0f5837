#include "compiler/syntax/token_stream.h"

#include <algorithm>
#include <utility>

#include "compiler/syntax/words.h"

namespace kb::syntax {
namespace {

// A token that is in no file; its place is the empty one just before `token`.
Token before(TokenKind kind, const Token& token) {
  return {kind, {token.span.file, token.span.begin, token.span.begin}};
}

}  // namespace

TokenStream::TokenStream(const source::Sources& sources, Prepared prepared, diagnostics::Diagnostics& diagnostics)
    : sources_(sources),
      diagnostics_(diagnostics),
      tokens_(std::move(prepared.tokens)),
      errors_(std::move(prepared.errors)) {}

Token TokenStream::next() {
  if (std::exchange(resuming_, false)) return before(TokenKind::kResume, tokens_[handed_]);
  if (closing_ > 0) {
    --closing_;
    open_.clear();
    return before(TokenKind::kRightBrace, tokens_[handed_]);
  }
  if (!last_is_accepted_) accept_last();
  if (handed_ == replay_end_) {
    replay_end_ = kNone;
    handed_ = replay_next_;
    statement_ = kNone;
    last_is_accepted_ = true;
    return before(TokenKind::kResume, tokens_[handed_]);
  }
  if (handed_ == tokens_.size()) return tokens_.back();
  last_is_accepted_ = false;
  const Token token = tokens_[handed_++];
  if (reported_ < errors_.size()) report_before(token.span.end);
  return token.kind == TokenKind::kEnd ? before(TokenKind::kResume, token) : token;   // see `recover`
}

void TokenStream::report_before(std::uint32_t end) {
  const bool last = handed_ == tokens_.size();
  while (reported_ < errors_.size() && (last || errors_[reported_].span.begin < end)) {
    spoilt_ = spoilt_ || !errors_[reported_].repaired;
    report(errors_[reported_++], diagnostics_);
  }
}

void TokenStream::accept_last() {
  const std::size_t last = handed_ - 1;
  last_is_accepted_ = true;
  switch (tokens_[last].kind) {
    case TokenKind::kLeftBrace:
    case TokenKind::kLeftParen:
    case TokenKind::kLeftBracket: open_.push_back(last); break;
    case TokenKind::kRightBrace:
    case TokenKind::kRightParen:
    case TokenKind::kRightBracket:
      if (!open_.empty()) open_.pop_back();
      break;
    default:
      if (!tokens_[last].begins_statement) break;
      statement_ = last;
      spoilt_ = false;
      open_.clear();
  }
}

/// How many lists are open in which reading can go on at the next line: a map, or a fuzzy block and the braces of each `given` in it.
std::size_t TokenStream::open_lists() const {
  const TokenKind kind = statement().kind;
  if ((kind != TokenKind::kMap && kind != TokenKind::kFuzzy) || open_.empty() || open_.front() != statement_ + 2) return 0;
  std::size_t lists = 1;
  for (; kind == TokenKind::kFuzzy && lists < open_.size() && tokens_[open_[lists]].kind == TokenKind::kLeftBrace; ++lists) {
    std::size_t head = open_[lists];
    while (head > open_[lists - 1] && tokens_[head].kind != TokenKind::kGiven && tokens_[head].kind != TokenKind::kInput && tokens_[head].kind != TokenKind::kOutput) --head;
    if (tokens_[head].kind != TokenKind::kGiven) break;
  }
  return lists;
}

/// Whether a line of the innermost list certainly begins there. If in doubt no: reading that starts again at the same mistake would
/// never end.
bool TokenStream::begins_line_of_list(std::size_t token, std::size_t lists) const {
  if (!tokens_[token].begins_line) return false;
  const TokenKind kind = tokens_[token].kind, next = tokens_[std::min(token + 1, tokens_.size() - 1)].kind;
  if (statement().kind == TokenKind::kMap) return begins_item(kind);
  switch (kind) {
    case TokenKind::kGiven:
    case TokenKind::kNot:
    case TokenKind::kLeftParen: return true;
    case TokenKind::kSubject: return next == TokenKind::kIs || next == TokenKind::kLeftBracket;   // before `=` it may continue a conclusion
    case TokenKind::kInput:
    case TokenKind::kOutput: return lists == 1;
    case TokenKind::kAnd:
    case TokenKind::kOr: return lists == 1 && next == TokenKind::kEqual;
    default: return false;
  }
}

/// Whether the current statement cannot continue there.
bool TokenStream::ends_statement(std::size_t token) const {
  const Token& here = tokens_[token];
  return here.kind == TokenKind::kEnd || (here.begins_statement && here.begins_line);
}

/// The place where reading can go on: the next line of the innermost list, the list's closing brace, or else the next statement.
std::size_t TokenStream::end_of_fault(std::size_t lists) const {
  std::size_t braces = 0;   // opened within the line
  for (std::size_t i = lists; i < open_.size(); ++i) braces += tokens_[open_[i]].kind == TokenKind::kLeftBrace ? 1 : 0;
  for (std::size_t i = handed_ - 1;; ++i) {
    if (ends_statement(i)) return i;
    if (lists == 0) continue;
    const TokenKind kind = tokens_[i].kind;
    if (kind == TokenKind::kLeftBrace) ++braces;
    if (braces == 0 && (kind == TokenKind::kRightBrace || begins_line_of_list(i, lists))) return i;
    if (kind == TokenKind::kRightBrace) --braces;
  }
}

void TokenStream::recover(bool complete) {
  const std::size_t lists = open_lists();
  std::size_t i = end_of_fault(lists);
  const Token& fault = tokens_[handed_ - 1];
  if (fault.begins_line && sources_.text(fault.span) == kForeignRule) forget_slips_before(tokens_[i].span.begin);
  closing_ = ends_statement(i) ? lists : 0;
  spoilt_ = false;
  open_.resize(lists);
  if (complete && statement_ != kNone) {
    replay_end_ = handed_ - 1;
    replay_next_ = i;
    i = statement_;
  }
  if (lists == 0) statement_ = kNone;
  resuming_ = tokens_[handed_ - 1].kind != TokenKind::kEnd;   // kEnd has been handed out already: after an error at the end the parser does not come back
  handed_ = i;
  last_is_accepted_ = true;
}

/// In a statement of another language each `==` and `;` is as it should be there.
void TokenStream::forget_slips_before(std::uint32_t end) {
  const auto first = errors_.begin() + static_cast<std::ptrdiff_t>(reported_);
  errors_.erase(std::remove_if(first, errors_.end(), [end](const LexicalError& error) { return error.repaired && error.span.begin < end; }), errors_.end());
}

void TokenStream::stop(Wanted at) {
  wanted_ = std::move(at);
  recover(false);
}

Token TokenStream::behind(std::size_t distance) const {
  return distance < handed_ ? tokens_[handed_ - 1 - distance] : Token{};
}

Token TokenStream::ahead(std::size_t distance) const {
  const std::size_t i = handed_ - 1 + distance;
  return i < tokens_.size() ? tokens_[i] : tokens_.back();
}

std::size_t TokenStream::ahead_in_braces(TokenKind kind) const {
  std::size_t count = 0;
  for (std::size_t i = handed_; i < tokens_.size() && tokens_[i].kind != TokenKind::kRightBrace; ++i) count += tokens_[i].kind == kind ? 1 : 0;
  return count;
}

Token TokenStream::statement() const {
  return statement_ == kNone ? Token{TokenKind::kEnd, {}} : tokens_[statement_];
}

Token TokenStream::open_bracket() const {
  return open_.empty() ? Token{TokenKind::kEnd, {}} : tokens_[open_.back()];
}

}  // namespace kb::syntax
