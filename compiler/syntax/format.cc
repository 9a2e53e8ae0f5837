#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compiler/diagnostics/consumers.h"
#include "compiler/diagnostics/display.h"
#include "compiler/source/encoding.h"
#include "compiler/syntax/format_lines.h"
#include "compiler/syntax/scan.h"
#include "compiler/syntax/syntax.h"
#include "compiler/syntax/token_stream.h"
#include "compiler/syntax/words.h"

namespace kb::syntax {
namespace {

using T = TokenKind;

constexpr std::uint32_t kIndent = 4;
constexpr std::uint16_t kFarthestArrow = 60;
constexpr std::size_t kWidestRule = 120;   // on one line
constexpr std::uint16_t kFarthestAt = 30, kFarthestWhen = 45, kFarthestThen = 90;   // in such rules
constexpr std::uint16_t kFarthestAttribute = 40;   // a column behind a longer list would move the others too far away

// Whether a blank stands between two neighbours on a line. A sign stands right before what it belongs to.
bool is_apart(TokenKind before, TokenKind after) {
  switch (before) {
    case T::kLeftParen:
    case T::kLeftBracket:
    case T::kDot:
    case T::kPlus:
    case T::kMinus:
    case T::kRange:
    case T::kSlash: return false;
    default: break;
  }
  switch (after) {
    case T::kComma:
    case T::kColon:
    case T::kDot:
    case T::kRange:
    case T::kSlash:
    case T::kRightParen:
    case T::kRightBracket: return false;
    case T::kLeftParen:
    case T::kLeftBracket: return before != T::kIdentifier && before != T::kSubject && before != T::kRightBracket && before != T::kRightParen;
    case T::kRightBrace: return before != T::kLeftBrace;
    default: return true;
  }
}

// In `0.5*bearing - 2` the sign joins two terms and has blanks on both sides; a product has none.
bool is_joining_sign(TokenKind before, TokenKind sign) {
  return (sign == T::kPlus || sign == T::kMinus) &&
         (before == T::kNumber || before == T::kIdentifier || before == T::kRightBracket || before == T::kPercent);
}

// Turns tokens and comments into lines. Line breaks of the source stay, except where the layout demands one, or none.
class Formatter {
 public:
  Formatter(const source::Sources& sources, std::vector<Token> comments, std::vector<Token> tokens)
      : sources_(sources), comments_(std::move(comments)), tokens_(std::move(tokens)) {
    if (sources_.bytes(tokens_.front().span.file).starts_with(source::kByteOrderMark)) counted_to_ = static_cast<std::uint32_t>(source::kByteOrderMark.size());
  }

  std::vector<Line> run() {
    for (at_ = 0; at_ < tokens_.size(); ++at_) {
      const std::size_t taken = next_comment_;
      enter_statement();
      take_comments();
      if (token().kind == T::kEnd) break;
      place(next_comment_ > taken);
      follow();
    }
    return std::move(lines_);
  }

 private:
  [[nodiscard]] const Token& token(std::size_t back = 0) const { return tokens_[at_ - back]; }
  [[nodiscard]] TokenKind last() const { return at_ == 0 ? T::kEnd : token(1).kind; }
  [[nodiscard]] bool breaks_between(std::uint32_t from, std::uint32_t to, std::size_t lines = 1) const;
  [[nodiscard]] std::uint32_t column(const Token& token);
  [[nodiscard]] std::string_view comment_text(const Token& comment) const;

  void enter_statement();
  void take_comments();
  void take_comment(const Token& comment);
  void place(bool after_comment);
  void follow();
  void begin_line();
  void begin_row(Line& line);
  [[nodiscard]] bool wants_line(bool after_comment) const;
  [[nodiscard]] bool wants_own_line() const;
  [[nodiscard]] bool must_stay() const;
  [[nodiscard]] std::uint32_t indent() const;
  [[nodiscard]] Family family() const;
  struct Slot { std::uint32_t number; std::uint16_t gap, farthest = 0xFFFF; };
  [[nodiscard]] Slot slot() const;
  [[nodiscard]] bool table_on_one_line() const;
  [[nodiscard]] bool rule_on_one_line() const;
  [[nodiscard]] bool is_later_field(std::size_t at) const { return tokens_[at - 1].kind == T::kComma && tokens_[at + 1].kind == T::kColon; }

  const source::Sources& sources_;
  std::vector<Token> comments_;
  std::vector<Token> tokens_;
  std::vector<Line> lines_;
  std::size_t at_ = 0;
  std::size_t next_comment_ = 0;
  std::uint32_t last_end_ = 0;        // of the token or comment before
  std::uint32_t counted_to_ = 0, column_ = 0;   // where `column` was asked for last
  TokenKind statement_ = T::kEnd;
  std::uint32_t braces_ = 0, brackets_ = 0;
  bool in_clause_ = false;            // behind `when`, `while` or `then` of a rule
  bool inline_table_ = false, inline_rule_ = false;
  bool in_head_ = false;              // of an input or an output of a fuzzy block: before its brace
  bool in_terms_ = false;             // between its braces
  bool in_value_ = false;             // behind the arrow of a fuzzy rule
  std::string_view relation_;         // of the last row
  std::vector<std::string_view> fields_;   // of its rows, but for the first in each: they have columns in this order
};

bool Formatter::breaks_between(std::uint32_t from, std::uint32_t to, std::size_t lines) const {
  const std::string_view gap = sources_.bytes(token().span.file).substr(from, to - from);
  return static_cast<std::size_t>(std::count(gap.begin(), gap.end(), '\n')) >= lines;
}

// Tokens and comments are asked for in their order. To count each from the beginning of its line would cost too much in long lines.
std::uint32_t Formatter::column(const Token& token) {
  const std::string_view passed = sources_.bytes(token.span.file).substr(counted_to_, token.span.begin - counted_to_);
  const std::size_t line_break = passed.rfind('\n');
  if (line_break != std::string_view::npos) column_ = 0;
  column_ += static_cast<std::uint32_t>(diagnostics::columns(passed.substr(line_break + 1)));
  counted_to_ = token.span.begin;
  return column_;
}

std::string_view Formatter::comment_text(const Token& comment) const {
  std::string_view text = sources_.text(comment.span);
  while (text.ends_with(' ') || text.ends_with('\t') || text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

void Formatter::enter_statement() {
  if (!tokens_[at_].begins_statement && token().kind != T::kEnd) return;
  statement_ = token().kind;
  braces_ = brackets_ = 0;
  in_clause_ = inline_table_ = in_head_ = in_terms_ = in_value_ = false;
  inline_rule_ = statement_ == T::kRule && rule_on_one_line();
}

void Formatter::take_comments() {
  while (next_comment_ < comments_.size() && comments_[next_comment_].span.begin < token().span.begin) {
    take_comment(comments_[next_comment_++]);
  }
  if (token().kind != T::kEnd) return;
  while (next_comment_ < comments_.size()) take_comment(comments_[next_comment_++]);
}

void Formatter::take_comment(const Token& comment) {
  const bool own_line = lines_.empty() || breaks_between(last_end_, comment.span.begin);
  if (own_line) {
    const Line* above = lines_.empty() || lines_.back().comment.empty() ? nullptr : &lines_.back();
    Line line;
    line.blank_before = breaks_between(last_end_, comment.span.begin, 2);
    line.begins_block = true;
    const bool hangs = above != nullptr && (!above->cells.empty() || above->continues_comment);
    const std::uint32_t alone = token().kind == T::kRightBrace ? braces_ * kIndent : indent();
    // If the comment stands where a comment alone on its line would stand, it is one; it is below the other only by chance.
    line.continues_comment = hangs && !line.blank_before && above->comment_column == column(comment) && column(comment) != alone;
    line.indent = line.continues_comment ? 0 : alone;
    lines_.push_back(std::move(line));
  }
  lines_.back().comment = comment_text(comment);
  lines_.back().comment_column = column(comment);
  last_end_ = comment.span.end;
}

void Formatter::place(bool after_comment) {
  const bool first = wants_line(after_comment);
  if (first) begin_line();
  if (const Slot here = slot(); here.number > lines_.back().cells.back().slot) {
    lines_.back().cells.push_back({{}, column(token()), here.number, here.gap, here.farthest});
  } else if (first) {
    // Nothing stands before it.
  } else if (inline_table_ && token().kind == T::kLabel && last() != T::kLeftBrace) {
    lines_.back().cells.back().text += "  ";
  } else if (statement_ == T::kFuzzy && (last() == T::kStar || token().kind == T::kStar)) {
    // A product.
  } else if (last() == T::kInput) {
    lines_.back().cells.back().text += "  ";   // under each other: `input  x`, `output y`
  } else if (in_terms_ && token().kind == T::kSubject && last() != T::kLeftBrace) {
    lines_.back().cells.back().text += "  ";
  } else if (is_apart(last(), token().kind) || (in_value_ && is_joining_sign(token(2).kind, last()))) {
    lines_.back().cells.back().text += ' ';
  }
  lines_.back().cells.back().text += sources_.text(token().span);
  last_end_ = token().span.end;
}

void Formatter::begin_line() {
  Line line;
  const bool inside = statement_ == T::kRule && !tokens_[at_].begins_statement;
  line.blank_before = !inside && last() != T::kLeftBrace && token().kind != T::kRightBrace &&
                      breaks_between(last_end_, token().span.begin, 2);
  line.indent = indent();
  line.family = family();
  line.begins_block = line.family == Family::kNone;
  line.cells.push_back({{}, 0, 0, 0});
  if (line.family == Family::kRow) begin_row(line);
  lines_.push_back(std::move(line));
}

// Rows of one relation share columns; a field that a row leaves out leaves its column empty.
void Formatter::begin_row(Line& line) {
  for (std::size_t at = at_ + 1; at + 1 < tokens_.size() && !tokens_[at].begins_statement; ++at) {
    const std::string_view text = sources_.text(tokens_[at].span);
    if (tokens_[at - 1].kind == T::kIn && tokens_[at + 1].kind == T::kLeftParen && text != relation_) {
      line.begins_block = true;
      fields_.clear();
      relation_ = text;
    }
    if (is_later_field(at) && std::find(fields_.begin(), fields_.end(), text) == fields_.end()) fields_.push_back(text);
  }
}

void Formatter::follow() {
  switch (token().kind) {
    case T::kInput:
    case T::kOutput: in_head_ = true; break;
    case T::kArrow: in_value_ = statement_ == T::kFuzzy; break;
    case T::kIs:
    case T::kGiven: in_value_ = false; break;
    case T::kLeftBrace:
      in_terms_ = std::exchange(in_head_, false);
      ++braces_;
      inline_table_ = statement_ == T::kTable && table_on_one_line();
      break;
    case T::kRightBrace:
      in_terms_ = in_value_ = false;
      --braces_;
      break;
    case T::kLeftParen:
    case T::kLeftBracket: ++brackets_; break;
    case T::kRightParen:
    case T::kRightBracket: --brackets_; break;
    case T::kWhen:
    case T::kWhile:
    case T::kThen: in_clause_ = true; break;
    default: break;
  }
}

bool Formatter::table_on_one_line() const {
  std::size_t end = at_;
  while (tokens_[end].kind != T::kRightBrace && end + 1 < tokens_.size()) ++end;
  return !breaks_between(token().span.begin, tokens_[end].span.begin);
}

/// Whether it was written so, and fits. Columns do not count, so that formatting twice gives the same.
bool Formatter::rule_on_one_line() const {
  std::size_t end = at_ + 1, width = diagnostics::columns(sources_.text(token().span));
  for (; tokens_[end].kind != T::kEnd && !tokens_[end].begins_statement; ++end) {
    width += diagnostics::columns(sources_.text(tokens_[end].span)) + (is_apart(tokens_[end - 1].kind, tokens_[end].kind) ? 1 : 0);
  }
  return width <= kWidestRule && !breaks_between(token().span.begin, tokens_[end - 1].span.begin);
}

/// Whether the token is a name that would begin a statement if a line began with it.
bool Formatter::must_stay() const {
  return token().kind == T::kIdentifier && !token().begins_line && begins_statement(keyword(sources_.text(token().span)));
}

bool Formatter::wants_line(bool after_comment) const {
  if (at_ == 0 || after_comment || tokens_[at_].begins_statement || (wants_own_line() && !must_stay())) return true;
  if (token().kind == T::kLeftBrace) return false;
  return breaks_between(token(1).span.end, token().span.begin);
}

bool Formatter::wants_own_line() const {
  switch (statement_) {
    case T::kRule: {
      const TokenKind kind = token().kind;
      return !inline_rule_ && brackets_ == 0 && (kind == T::kWhen || kind == T::kWhile || kind == T::kThen);
    }
    case T::kMap:
      return braces_ > 0 && (begins_item(token().kind) || token().kind == T::kRightBrace);
    case T::kTable:
      if (braces_ == 0 || inline_table_) return false;
      return token().kind == T::kLabel || last() == T::kLeftBrace || token().kind == T::kRightBrace;
    default: return false;
  }
}

std::uint32_t Formatter::indent() const {
  if (tokens_[at_].begins_statement || token().kind == T::kEnd) return 0;
  if (token().kind == T::kRightBrace) return (braces_ - 1) * kIndent;
  if (braces_ == 0) return in_clause_ && !wants_own_line() ? 2 * kIndent : kIndent;
  const bool goes_on = (statement_ == T::kMap && !begins_item(token().kind)) ||
                       (statement_ == T::kTable && token().kind != T::kLabel && last() != T::kLeftBrace);
  return (braces_ + (goes_on ? 1 : 0)) * kIndent;
}

Family Formatter::family() const {
  const TokenKind kind = token().kind;
  if (statement_ == T::kMap) {
    return kind == T::kLandmark ? Family::kLandmark : kind == T::kRoad ? Family::kRoad : Family::kNone;
  }
  if (statement_ == T::kTable && braces_ > 0) {
    return wants_own_line() && kind != T::kRightBrace ? Family::kTable : Family::kNone;
  }
  if (statement_ == T::kFuzzy && braces_ > 0) {
    const bool rule = braces_ <= 2 && (kind == T::kSubject || kind == T::kNot || kind == T::kLeftParen);
    return rule ? Family::kFuzzyRule : Family::kNone;
  }
  if (!tokens_[at_].begins_statement) return Family::kNone;
  if (is_declaration(kind) || kind == T::kPriority) return Family::kDeclaration;
  switch (kind) {
    case T::kNames: return Family::kNames;
    case T::kControl:
    case T::kPrototype:
    case T::kPerceive: return Family::kControl;
    case T::kSensor: return Family::kSensor;
    case T::kRow: return Family::kRow;
    case T::kDetour: return Family::kPlan;
    case T::kRule: return inline_rule_ ? Family::kRule : Family::kNone;
    default: return Family::kNone;
  }
}

// The column in which the token begins, among those that lines of its kind have; 0 if it continues the cell before.
Formatter::Slot Formatter::slot() const {
  const TokenKind kind = token().kind;
  const Family family = tokens_[at_].begins_statement ? Family::kNone : lines_.back().family;
  const bool outside = braces_ == 0 && brackets_ == 0;
  switch (family) {
    case Family::kDeclaration: {
      if (tokens_[at_ - 1].begins_statement) return {1, 1};
      const bool attribute = kind == T::kExclusive || kind == T::kKeep || kind == T::kSat || kind == T::kEvent ||
                             kind == T::kAttention || kind == T::kEqual || kind == T::kLazy || kind == T::kOutput;
      return outside && attribute ? Slot{2, 1, kFarthestAttribute} : Slot{0, 0};
    }
    case Family::kNames: return kind == T::kLeftBrace ? Slot{1, 1} : Slot{0, 0};
    case Family::kControl: return kind == T::kEqual ? Slot{1, 1} : Slot{0, 0};
    case Family::kSensor: {
      const bool name = last() == T::kRightBracket || (last() == T::kIdentifier && tokens_[at_ - 2].begins_statement);
      if (outside && name && kind != T::kLeftBracket) return {1, 1};
      return kind == T::kNoise ? Slot{2, 2} : kind == T::kStale ? Slot{3, 2} : kind == T::kCircular ? Slot{4, 2} : kind == T::kStrict ? Slot{5, 2} : Slot{0, 0};
    }
    case Family::kRow: {
      if (kind == T::kIn && outside) return {1, 1};
      if (brackets_ != 1 || !is_later_field(at_)) return {0, 0};
      const auto field = std::find(fields_.begin(), fields_.end(), sources_.text(token().span));
      return {static_cast<std::uint32_t>(field - fields_.begin()) + 2, 1, kFarthestArrow};
    }
    case Family::kPlan: return kind == T::kOn ? Slot{1, 2} : kind == T::kWhen ? Slot{2, 2} : Slot{0, 0};
    case Family::kRule:
      if (brackets_ > 0) return {0, 0};
      return kind == T::kAt ? Slot{1, 1, kFarthestAt} : kind == T::kWhen || kind == T::kWhile ? Slot{2, 1, kFarthestWhen} : kind == T::kThen ? Slot{3, 1, kFarthestThen} : Slot{0, 0};
    case Family::kLandmark: return kind == T::kAt ? Slot{1, 1} : Slot{0, 0};
    case Family::kRoad:
      if (kind == T::kTwoWay || kind == T::kArrow) return {1, 1};
      return kind == T::kBy ? Slot{2, 2} : kind == T::kAt ? Slot{3, 2} : kind == T::kThrough ? Slot{4, 2} : Slot{0, 0};
    case Family::kTable:
      if (kind != T::kIdentifier) break;
      return {lines_.back().cells.back().slot + 1, 2};
    case Family::kFuzzyRule:
      return kind == T::kArrow ? Slot{1, 1, kFarthestArrow} : Slot{0, 0};
    case Family::kNone: break;
  }
  return {0, 0};
}

}  // namespace

std::string format(const source::Sources& sources, source::FileId file) {
  diagnostics::CountingConsumer consumer;
  diagnostics::Diagnostics diagnostics(sources, consumer);
  (void)parse(sources, file, diagnostics);
  if (diagnostics.failed()) return std::string(sources.bytes(file));

  Scan all = scan(sources, file, Comments::kKeep);
  std::vector<Token> comments;
  std::erase_if(all.tokens, [&](const Token& token) {
    if (token.kind == T::kComment) comments.push_back(token);
    return token.kind == T::kComment;
  });
  Prepared prepared = prepare(sources, std::move(all));
  return with_line_ends_of(sources.bytes(file), print_lines(Formatter(sources, std::move(comments), std::move(prepared.tokens)).run()));
}

}  // namespace kb::syntax
