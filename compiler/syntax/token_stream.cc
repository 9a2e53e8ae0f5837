#include "compiler/syntax/token_stream.h"

#include <utility>

#include "compiler/syntax/words.h"

namespace kb::syntax {
namespace {

// An empty place just before `token`, for a token that stands in no file.
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
  if (std::exchange(closing_, false)) {
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

void TokenStream::recover(bool complete) {
  const bool map = in_map();
  std::size_t i = handed_ - 1;
  for (;; ++i) {
    const Token& here = tokens_[i];
    const TokenKind kind = here.kind;
    if (kind == TokenKind::kEnd || (here.begins_statement && here.begins_line)) {
      closing_ = map;
      break;
    }
    const bool map_line = here.begins_line && (kind == TokenKind::kLandmark || kind == TokenKind::kRoad);
    if (map && (map_line || kind == TokenKind::kRightBrace)) break;
  }
  spoilt_ = false;
  open_.resize(map ? 1 : 0);
  if (complete && statement_ != kNone) {
    replay_end_ = handed_ - 1;
    replay_next_ = i;
    i = statement_;
  }
  if (!map) statement_ = kNone;
  resuming_ = tokens_[handed_ - 1].kind != TokenKind::kEnd;   // else it was handed out: from an error at its end no parser comes back
  handed_ = i;
  last_is_accepted_ = true;
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

bool TokenStream::in_map() const {
  return statement().kind == TokenKind::kMap && !open_.empty() && open_.front() == statement_ + 2;
}

}  // namespace kb::syntax
