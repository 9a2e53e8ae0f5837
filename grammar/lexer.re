// The tokens of the language, for re2c. Everything about spelling is here; grammar/README.md says it in EBNF.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

#include "compiler/source/encoding.h"
#include "compiler/source/utf8.h"
#include "compiler/syntax/scan.h"
#include "compiler/syntax/syntax.h"
#include "compiler/syntax/words.h"

namespace kb::syntax {
namespace {

using diagnostics::Kind;

/// At most this many errors are kept. A file with more is not a text of this language.
constexpr std::size_t kMaxLexicalErrors = 1000;

std::string hexadecimal(std::uint32_t value, std::size_t least_digits) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text;
  for (; value != 0 || text.size() < least_digits; value >>= 4) text.insert(text.begin(), kDigits[value & 15u]);
  return text;
}

std::string point_name(std::string_view text) { return "U+" + hexadecimal(source::code_point(text).value, 4); }

/// `#include "map.kb"`: in this language a comment.
bool is_include(std::string_view comment) {
  constexpr std::string_view kInclude = "#include";
  const std::string_view rest = comment.substr(std::min(kInclude.size(), comment.size()));
  const std::string_view path = source::trimmed(rest);
  return comment.starts_with(kInclude) && (path.starts_with('"') || path.starts_with('<'));
}

/*!include:re2c "unicode_categories.re" */
/*!re2c
  re2c:api = default;
  re2c:yyfill:enable = 0;
  re2c:eof = 0;
  re2c:define:YYCTYPE = "unsigned char";
  re2c:define:YYCURSOR = cursor_;
  re2c:define:YYLIMIT = limit_;
  re2c:define:YYMARKER = marker_;
  re2c:define:YYCTXMARKER = context_marker_;
  re2c:tags = 0;

  blank = [ \t\n] | "\r\n";
  // Not shown, although some are letters or marks: two names must not differ in these alone.
  no_width = [\u00ad\u034f\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b-\u200f\u2060-\u2064\u3164\ufe00-\ufe0f\ufeff\uffa0\U000e0100-\U000e01ef];
  letter = (L | Nl | "_") \ no_width;
  follow = (letter | Mn | Mc | Nd | Pc) \ no_width;
  digits = [0-9]+;
  number = digits ("." digits)? ([eE] [+\-]? digits)?;
  scalar = [\x80-\ud7ff\ue000-\U0010ffff];
  control = [\x01-\x08\x0b-\x1f\x7f-\x9f];
  direction = [\u202a-\u202e\u2066-\u2069];
  foreign_space = [\u00a0\u1680\u2000-\u200a\u2028\u2029\u202f\u205f\u3000];
  foreign_quote = ['\u2018-\u201f\u00ab\u00bb];
  plain = ([\t\x20-\x21\x23-\x7e] | scalar) \ control \ direction;
*/

/// Neighbours of this kind are one mistake: a run of bad bytes, not two operators side by side.
bool is_run(Kind kind) {
  return kind != Kind::kForeignOperator && kind != Kind::kForeignQuote && kind != Kind::kForeignComment &&
         kind != Kind::kSemicolon;
}

class Scanner {
 public:
  Scanner(const source::Sources& sources, source::FileId file, Comments comments)
      : file_(file), keep_comments_(comments == Comments::kKeep) {
    const std::string_view bytes = sources.bytes(file);
    text_.reserve(bytes.size() + 1);
    (text_ += bytes) += '\n';   // so that every token has a byte after it
    first_ = reinterpret_cast<const unsigned char*>(text_.data());
    limit_ = first_ + text_.size();
    cursor_ = first_;
    if (text_.starts_with(source::kByteOrderMark)) cursor_ += source::kByteOrderMark.size();
    out_.tokens.reserve(text_.size() / 4 + 2);
  }

  Scan run() {
    const std::string_view bytes = std::string_view(text_).substr(0, text_.size() - 1);
    const std::size_t lone = bytes.find('\n') == std::string_view::npos ? source::find_lone_return(bytes) : std::string_view::npos;
    const std::string_view other = source::other_format(bytes);
    if (source::is_utf16(bytes)) {
      error(Kind::kUtf16, {file_, 0, 2});
    } else if (!other.empty()) {
      error(Kind::kNotText, {file_, 0, 2}, std::string(other));
    } else if (const std::size_t nul = bytes.find('\0'); lone != std::string_view::npos && nul < bytes.size()) {
      error(Kind::kNulByte, {file_, static_cast<std::uint32_t>(nul), static_cast<std::uint32_t>(nul + 1)});
    } else if (lone != std::string_view::npos) {   // no line of the file ends, so a comment would take in all that follows
      lone_return(first_ + lone);
    } else {
      while (next()) {
      }
    }
    const auto size = static_cast<std::uint32_t>(text_.size() - 1);
    out_.tokens.push_back({TokenKind::kEnd, {file_, size, size}});
    return std::move(out_);
  }

 private:
  /// Reads one token, or what is none. False at the end of the file.
  bool next();
  /// The rest of a comment or a string: to the end of the line (true), or behind the closing quote (false).
  bool text_to_line_end(bool in_string);
  void string();
  void comment();
  void foreign_comment(bool block);
  bool foreign_quote();
  void identifier();
  void number();

  [[nodiscard]] source::Span span() const {
    return {file_, static_cast<std::uint32_t>(begin_ - first_), static_cast<std::uint32_t>(cursor_ - first_)};
  }
  [[nodiscard]] std::string_view text() const { return view(begin_); }
  [[nodiscard]] std::string_view view(const unsigned char* from) const {
    return std::string_view(text_).substr(static_cast<std::size_t>(from - first_),
                                          static_cast<std::size_t>(cursor_ - from));
  }

  bool token(TokenKind kind) {
    out_.tokens.push_back({kind, span()});
    return true;
  }
  bool bracket(TokenKind kind, int opens) {
    open_ = std::max(open_ + opens, 0);
    return token(kind);
  }
  /// Within parentheses it was meant to separate, elsewhere to end a statement. At the end of a line the parenthesis was forgotten.
  bool semicolon() {
    const unsigned char* next = cursor_;
    while (*next == ' ' || *next == '\t') ++next;
    const bool separates = open_ > 0 && *next != '\n' && *next != '\r' && *next != '#';
    return separates ? foreign(TokenKind::kComma) : error(Kind::kSemicolon, span(), {}, {}, true);
  }
  bool error(Kind kind, source::Span at, std::string first = {}, std::string second = {}, bool repaired = false) {
    auto& errors = out_.errors;
    if (is_run(kind) && !errors.empty() && errors.back().kind == kind && errors.back().span.end == at.begin) {
      errors.back().span.end = at.end;   // one message for a run
    } else if (errors.size() < kMaxLexicalErrors) {
      errors.push_back({kind, at, std::move(first), std::move(second), repaired});
    }
    return true;
  }
  /// What was meant is clear: say so, and go on as if it stood there.
  bool foreign(TokenKind meant) {
    error(Kind::kForeignOperator, span(), shown(text()), std::string(spelling(meant)), true);
    return token(meant);
  }
  /// Many foreign signs look like the right one: the number of the character tells them apart.
  static std::string shown(std::string_view sign) {
    const std::string code = "`" + std::string(sign) + "`";
    return source::code_point(sign).value < 0x80 ? code : code + " (" + point_name(sign) + ")";
  }
  /// What a long dash stands for: `--` behind a name, as between the ends of a road, else the `-` of a number or an effect.
  [[nodiscard]] TokenKind dash() const {
    const std::vector<Token>& tokens = out_.tokens;
    const std::size_t count = tokens.size();
    const bool name = count > 0 && tokens.back().kind == TokenKind::kIdentifier;
    const bool field = count > 1 && tokens[count - 2].kind == TokenKind::kDot;
    return name || field ? TokenKind::kTwoWay : TokenKind::kMinus;
  }
  /// Whether the next token begins an effect: the last of the words that a rule is made of was `then`.
  [[nodiscard]] bool in_effects() const {
    constexpr std::size_t kFarthest = 64;   // tokens that are looked at
    const std::vector<Token>& tokens = out_.tokens;
    const bool begins = !tokens.empty() && (tokens.back().kind == TokenKind::kThen || tokens.back().kind == TokenKind::kComma);
    const auto first = tokens.rbegin(), last = first + static_cast<std::ptrdiff_t>(std::min<std::size_t>(tokens.size(), kFarthest));
    const auto word = std::find_if(first, last, [](const Token& token) {
      return token.kind == TokenKind::kThen || token.kind == TokenKind::kWhen || token.kind == TokenKind::kWhile || begins_statement(token.kind);
    });
    return begins && word != last && word->kind == TokenKind::kThen;
  }
  /// Only the first one of a file is reported.
  bool lone_return(const unsigned char* from) {
    const auto at = static_cast<std::uint32_t>(from - first_);
    if (!lone_return_said_) error(Kind::kLoneReturn, {file_, at, at + 1});
    return lone_return_said_ = true;
  }
  /// An error about the bytes [from, cursor).
  bool bad_text(Kind kind, const unsigned char* from) {
    const source::Span at{file_, static_cast<std::uint32_t>(from - first_),
                          static_cast<std::uint32_t>(cursor_ - first_)};
    if (kind == Kind::kBytesNotUtf8) return error(kind, at, "0x" + hexadecimal(*from, 2));
    if (kind == Kind::kUnknownCharacter) return error(kind, at, std::string(view(from)), point_name(view(from)));
    if (kind == Kind::kForeignQuote) return error(kind, at, std::string(view(from)));
    return error(kind, at, point_name(view(from)));
  }

  source::FileId file_;
  bool keep_comments_;
  bool lone_return_said_ = false;
  std::string text_;
  const unsigned char* first_ = nullptr;
  const unsigned char* limit_ = nullptr;
  const unsigned char* cursor_ = nullptr;
  const unsigned char* marker_ = nullptr;
  const unsigned char* context_marker_ = nullptr;
  int open_ = 0;   // parentheses and brackets that are open
  const unsigned char* begin_ = nullptr;
  Scan out_;
};

bool Scanner::next() {
  begin_ = cursor_;
  /*!re2c
    blank+               { return true; }
    $                    { return false; }
    "#"                  { comment(); return true; }
    letter follow*       { identifier(); return true; }
    number               { number(); return true; }
    "\""                 { string(); return true; }

    "{"                  { return bracket(TokenKind::kLeftBrace, -open_); }   // what is open before a block was forgotten
    "}"                  { return bracket(TokenKind::kRightBrace, -open_); }
    "("                  { return bracket(TokenKind::kLeftParen, 1); }
    ")"                  { return bracket(TokenKind::kRightParen, -1); }
    "["                  { return bracket(TokenKind::kLeftBracket, 1); }
    "]"                  { return bracket(TokenKind::kRightBracket, -1); }
    ","                  { return token(TokenKind::kComma); }
    ":"                  { return token(TokenKind::kColon); }
    "."                  { return token(TokenKind::kDot); }
    ">"                  { return token(TokenKind::kGreater); }
    "="                  { return token(TokenKind::kEqual); }
    "+"                  { return token(TokenKind::kPlus); }
    "-"                  { return token(TokenKind::kMinus); }
    "*"                  { return token(TokenKind::kStar); }
    "/"                  { return token(TokenKind::kSlash); }
    "%"                  { return token(TokenKind::kPercent); }
    "->"                 { return token(TokenKind::kArrow); }
    "--"                 { return token(TokenKind::kTwoWay); }
    "~"                  { return token(TokenKind::kTilde); }
    ".."                 { return token(TokenKind::kRange); }

    digits ("." digits){2,} | "." digits | digits "_" [0-9_]* | "0" [xX] [0-9a-fA-F]+ {
      error(Kind::kMalformedNumber, span(), std::string(text()), {}, true);
      return token(TokenKind::kNumber);
    }
    digits "." / [^.0-9] {
      error(Kind::kMalformedNumber, span(), std::string(text()), {}, true);
      return token(TokenKind::kNumber);
    }
    digits ("." digits)? [eE] [+\-]? / [\x00-\x2f\x3a-\x40\x5b-\x5e\x60\x7b-\x7f] {
      error(Kind::kExponentWithoutDigits, span(), std::string(text()), {}, true);
      return token(TokenKind::kNumber);
    }

    "&" | "&&"           { return foreign(TokenKind::kAnd); }
    "|" | "||"           { return foreign(TokenKind::kOr); }
    "!"                  { return foreign(in_effects() ? TokenKind::kMinus : TokenKind::kNot); }
    "=>"                 { return token(TokenKind::kFatArrow); }
    "=="                 { return token(TokenKind::kEqualEqual); }
    "!=" | "<>"          { return token(TokenKind::kNotEqual); }
    "<" | "<=" | ">="    { return token(TokenKind::kComparison); }
    [\u2192\u21d2] | [\u2010-\u2015\u2212] ">" { return foreign(TokenKind::kArrow); }   // a text editor makes one dash of two
    ":="                 { return foreign(TokenKind::kEqual); }
    [\u2013\u2014]       { return foreign(dash()); }
    [\u2010-\u2012\u2015\u2212\ufe63\uff0d] { return foreign(TokenKind::kMinus); }
    [\uff0c\u3001\uff64\u060c] { return foreign(TokenKind::kComma); }
    "\uff08"             { return foreign(TokenKind::kLeftParen); }
    "\uff09"             { return foreign(TokenKind::kRightParen); }
    [\uff3b\u3010]       { return foreign(TokenKind::kLeftBracket); }
    [\uff3d\u3011]       { return foreign(TokenKind::kRightBracket); }
    "\uff5b"             { return foreign(TokenKind::kLeftBrace); }
    "\uff5d"             { return foreign(TokenKind::kRightBrace); }
    "\uff1a"             { return foreign(TokenKind::kColon); }
    "\uff1d"             { return foreign(TokenKind::kEqual); }
    "\uff1e"             { return foreign(TokenKind::kGreater); }
    "\uff0b"             { return foreign(TokenKind::kPlus); }
    "\uff0e"             { return foreign(TokenKind::kDot); }
    [\uff5e\u223c]       { return foreign(TokenKind::kTilde); }
    ";" / (blank* [+\-]) { return foreign(TokenKind::kComma); }   // no statement begins with a sign, but the second of two effects does
    ";"                  { return semicolon(); }
    "//"                 { foreign_comment(false); return true; }
    "/*"                 { foreign_comment(true); return true; }

    "\x00"               { return error(Kind::kNulByte, span()); }
    "\r"                 { return lone_return(begin_); }
    control              { return bad_text(Kind::kControlCharacter, begin_); }
    direction            { return bad_text(Kind::kDirectionControl, begin_); }
    no_width             { return bad_text(Kind::kNoWidth, begin_); }
    foreign_space        { return bad_text(Kind::kForeignSpace, begin_); }
    foreign_quote        { return foreign_quote(); }
    scalar | [\x21-\x7e] { return bad_text(Kind::kUnknownCharacter, begin_); }
    *                    { return bad_text(Kind::kBytesNotUtf8, begin_); }
  */
}

bool Scanner::text_to_line_end(bool in_string) {
  for (;;) {
    const unsigned char* const from = cursor_;
    /*!re2c
      plain+             { continue; }
      "\""               { if (in_string) return false; continue; }
      "\n" | "\r\n"      { cursor_ = from; return true; }
      $                  { return true; }
      "\x00"             { error(Kind::kNulByte, {file_, static_cast<std::uint32_t>(from - first_),
                                                  static_cast<std::uint32_t>(cursor_ - first_)}); continue; }
      "\r"               { lone_return(from); continue; }
      control            { bad_text(Kind::kControlCharacter, from); continue; }
      direction          { bad_text(Kind::kDirectionControl, from); continue; }
      *                  { bad_text(Kind::kBytesNotUtf8, from); continue; }
    */
  }
}

void Scanner::string() {
  if (text_to_line_end(true)) error(Kind::kUnterminatedString, span(), {}, {}, true);
  token(TokenKind::kString);
}

void Scanner::comment() {
  text_to_line_end(false);
  if (is_include(text())) error(Kind::kIncludeComment, span(), std::string(text()), {}, true);
  if (keep_comments_) token(TokenKind::kComment);
}

void Scanner::foreign_comment(bool block) {
  error(Kind::kForeignComment, span(), std::string(text()), {}, true);
  if (!block) {
    text_to_line_end(false);
    return;
  }
  const auto end = text_.find("*/", static_cast<std::size_t>(cursor_ - first_));
  cursor_ = end == std::string::npos ? limit_ - 1 : first_ + end + 2;
}

// `import 'map.kb'`: the mark and what it encloses are one mistake. Elsewhere names are meant, and each mark is one.
bool Scanner::foreign_quote() {
  const bool import = !out_.tokens.empty() && out_.tokens.back().kind == TokenKind::kImport;
  const std::size_t begin = static_cast<std::size_t>(cursor_ - first_), end = std::min(text_.find_first_of("\r\n#", begin), text_.size());
  const std::string_view rest = source::trimmed(std::string_view(text_).substr(begin, end - begin));
  std::size_t closes = rest.find_first_of("'\"");
  for (const std::string_view mark : source::kForeignQuotes) closes = std::min(closes, rest.find(mark));
  const std::string_view path = source::trimmed(rest.substr(0, closes));
  if (!import || path.empty()) return bad_text(Kind::kForeignQuote, begin_);
  cursor_ = first_ + end;
  while (cursor_[-1] == ' ' || cursor_[-1] == '\t') --cursor_;
  const bool library = path.starts_with("std.") && !path.ends_with(".kb");
  return error(Kind::kForeignQuotes, span(), std::string(text()), library ? std::string(path) : "\"" + std::string(path) + "\"");
}

void Scanner::identifier() {
  const std::string_view word = text();
  if (word.size() > kMaxIdentifierBytes) {
    error(Kind::kIdentifierTooLong, span(), std::to_string(word.size()), std::to_string(kMaxIdentifierBytes), true);
  }
  token(keyword(word));
}

/// Of a number that is too large or too small for a double: whether its first digit that is not 0 stands behind the point.
bool is_tiny(std::string_view digits) {
  const std::size_t e = std::min(digits.find_first_of("eE"), digits.size());
  const std::string_view mantissa = digits.substr(0, e);
  const std::size_t first = mantissa.find_first_of("123456789"), point = std::min(mantissa.find('.'), mantissa.size());
  if (first == std::string_view::npos) return true;
  std::string_view written = digits.substr(std::min(e + 1, digits.size()));
  const bool down = written.starts_with('-');
  if (down || written.starts_with('+')) written.remove_prefix(1);
  double exponent = 0.0;   // a huge one stays inside of a double's range unless it has 309 digits
  if (std::from_chars(written.data(), written.data() + written.size(), exponent).ec == std::errc::result_out_of_range) return down;
  const double leading = first < point ? static_cast<double>(point - first) - 1.0 : -static_cast<double>(first - point);
  return leading + (down ? -exponent : exponent) < 0.0;
}

void Scanner::number() {
  const std::string_view digits = text();
  double value = 0.0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  // A number too small for a double is 0, and from_chars says the same of both; only the large one is a mistake.
  if (code == std::errc::result_out_of_range && !is_tiny(digits)) {
    error(Kind::kNumberTooLarge, span(), std::string(digits), {}, true);
  }
  token(TokenKind::kNumber);
}

}  // namespace

Scan scan(const source::Sources& sources, source::FileId file, Comments comments) {
  return Scanner(sources, file, comments).run();
}

}  // namespace kb::syntax
