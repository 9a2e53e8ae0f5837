#include "compiler/syntax/syntax_error.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "compiler/syntax/syntax_mistakes.h"

namespace kb::syntax {
namespace {

using diagnostics::Kind;
using T = TokenKind;

TokenKind closing(TokenKind left) {
  return left == T::kLeftBrace ? T::kRightBrace : left == T::kLeftParen ? T::kRightParen : T::kRightBracket;
}
std::string_view singular(TokenKind declaration) {
  switch (declaration) {
    case T::kFacts: return spelling(T::kFact);
    case T::kSatellites: return spelling(T::kSatellite);
    case T::kStrategies: return spelling(T::kStrategy);
    default: return spelling(declaration);
  }
}

}  // namespace

void SyntaxError::report() {
  if (stream_.is_spoilt() || stream_.is_reported()) return;
  const bool known = is_comment() || is_import() || is_decimal_comma() || is_decimal_comma_in_place() || is_hyphen() || is_name_behind_attributes() || is_late_of() || is_trailing_comma() ||
                     is_other_bracket() || is_row_without_fields() || is_empty_list() || is_range() || is_fuzzy() || is_bracket() || is_unknown_statement() ||
                     is_names_as_set() || is_map_line() || is_rule_head() || is_percept() || is_condition() || is_effect() || is_route() || is_road() || is_order() ||
                     is_quoted_name() || is_missing_comma() || is_type() || is_unknown_attribute() || is_word_as_name();
  if (!known) report_unexpected();
}

// ---- statements and brackets

// `-- ...`, `(* ... *)`: these signs have a meaning elsewhere, so the scanner lets them pass.
bool SyntaxError::is_comment() {
  const bool ways = statement_ == T::kMap || statement_ == T::kRoute || statement_ == T::kDetour;
  if (kind_ == T::kTwoWay && !ways) return say(Kind::kForeignComment, found_.span, {"--"});
  const bool opens = kind_ == T::kLeftParen && stream_.ahead(1).kind == T::kStar && stream_.ahead(1).span.begin == found_.span.end;
  const bool inside = kind_ == T::kStar && last_.kind == T::kLeftParen && last_.span.end == found_.span.begin && stream_.behind(2).kind != T::kIdentifier;
  return (opens || inside) && say(Kind::kForeignComment, opens ? found_.span : last_.span, {"(*"});
}

// `import map.kb`, `import plant/map.kb`: a path without quotes that is not a sequence of names.
bool SyntaxError::is_import() {
  const bool path = is_keyword(kind_) || kind_ == T::kSlash || kind_ == T::kMinus || kind_ == T::kDot || kind_ == T::kRange;
  if (statement_ != T::kImport || at_end() || !path) return false;
  const source::Span word = stream_.statement().span;
  const source::Sources::Line line = stream_.sources().line_of(word.file, word.begin);
  const std::string_view rest = line.text.substr(word.end - line.begin);
  const std::size_t first = std::min(rest.find_first_not_of(" \t"), rest.size());
  std::string_view written = rest.substr(first, rest.find_first_of(" \t\"#", first) - first);
  const auto begin = static_cast<std::uint32_t>(word.end + first);
  const source::Span all{word.file, begin, static_cast<std::uint32_t>(begin + written.size())};
  if (found_.span.begin < all.begin || found_.span.end > all.end || written.starts_with("std.")) return false;
  if (written.ends_with(".kb")) written.remove_suffix(3);
  return say(Kind::kImportUnquoted, all, {written});
}

// `0,5`: noticed at the comma, or after it if a list may continue there.
bool SyntaxError::is_decimal_comma() {
  const bool behind = kind_ == T::kNumber && last_.kind == T::kComma;
  const Token whole = stream_.behind(behind ? 2 : 1);
  const Token comma = behind ? last_ : found_;
  const Token part = behind ? found_ : stream_.ahead(1);
  const bool number = whole.kind == T::kNumber && comma.kind == T::kComma && part.kind == T::kNumber;
  if (!number || whole.span.end != comma.span.begin || comma.span.end != part.span.begin) return false;
  return say_decimal_comma(source::join(whole.span, part.span));
}

bool SyntaxError::say_decimal_comma(source::Span number) {
  std::string meant(text(number));
  std::ranges::replace(meant, ',', '.');
  diagnostics_.report(Kind::kMalformedNumber, number, {text(number)}).suggest(meant);
  return true;
}

// `(2,5, 0)`: noticed at the second comma, where two numbers have been read.
bool SyntaxError::is_decimal_comma_in_place() {
  const Token part = last_, comma = stream_.behind(2), whole = stream_.behind(3);
  const bool numbers = kind_ == T::kComma && part.kind == T::kNumber && comma.kind == T::kComma && whole.kind == T::kNumber;
  if (!numbers || !wants(T::kRightParen) || whole.span.end != comma.span.begin || comma.span.end != part.span.begin) return false;
  return say_decimal_comma(source::join(whole.span, part.span));
}

// `Wall-Left`, without blanks. (A name after a number would be the number's unit.)
bool SyntaxError::is_hyphen() {
  if (kind_ != T::kMinus || last_.kind != T::kIdentifier || stream_.behind(2).kind == T::kNumber) return false;
  std::string name(text(last_.span));
  source::Span all = last_.span;
  for (std::size_t i = 0;; i += 2) {
    const Token hyphen = i == 0 ? found_ : stream_.ahead(i), next = stream_.ahead(i + 1);
    const bool part = next.kind == T::kIdentifier || is_keyword(next.kind) || (next.kind == T::kNumber && text(next.span).find('.') == std::string_view::npos);
    if (hyphen.kind != T::kMinus || !part || hyphen.span.begin != all.end || next.span.begin != hyphen.span.end) break;
    name += '_';
    name += text(next.span);
    all = source::join(all, next.span);
  }
  if (all == last_.span) return false;
  diagnostics_.report(Kind::kHyphen, all, {text(all)}).suggest(name);
  return true;
}

// `satellite Y, Z = 0.5, W`
bool SyntaxError::is_name_behind_attributes() {
  const Token next = stream_.ahead(1);
  if (kind_ != T::kComma || !is_declaration(statement_) || !wants(T::kExclusive) || next.kind != T::kIdentifier) return false;
  return say(Kind::kNameBehindAttributes, found_.span, {singular(statement_), text(next.span)});
}

// `satellite Y = 1 of A`
bool SyntaxError::is_late_of() {
  const bool satellites = statement_ == T::kSatellite || statement_ == T::kSatellites;
  if (!satellites || kind_ != T::kOf || !wants(T::kExclusive) || last_.kind == T::kIdentifier || is_right(last_.kind)) return false;
  return say(Kind::kOfBehindValue, found_.span, {text(stream_.ahead(1).span)});
}

bool SyntaxError::is_trailing_comma() {
  if (last_.kind != T::kComma || !(is_right(kind_) || at_end())) return false;
  return say(Kind::kTrailingComma, last_.span);
}

// `row x in R()`, `row x in R`
bool SyntaxError::is_row_without_fields() {
  if (statement_ != T::kRow) return false;
  const bool empty = last_.kind == T::kLeftParen && kind_ == T::kRightParen && stream_.behind(3).kind == T::kIn;
  const bool none = last_.kind == T::kIdentifier && stream_.behind(2).kind == T::kIn && (at_end() || found_.begins_statement);
  if (!empty && !none) return false;
  const source::Span relation = empty ? stream_.behind(2).span : last_.span;
  return say(Kind::kRowWithoutFields, empty ? source::join(relation, found_.span) : relation, {text(relation)});
}

bool SyntaxError::is_empty_list() {
  if (!is_left(last_.kind) || kind_ != closing(last_.kind)) return false;
  const source::Span both = source::join(last_.span, found_.span);
  const Token name = stream_.behind(2);
  if (statement_ == T::kRule && kind_ == T::kRightParen && name.kind == T::kIdentifier) return say(Kind::kEmptyCall, both, {text(name.span)});
  return say(Kind::kEmptyList, both, {spelling(last_.kind), spelling(kind_), wanted()});
}

// `0 to 3 m`, `0 - 3 m`, `0, 3 m` or `m 0..3`, where only a range can stand.
bool SyntaxError::is_range() {
  if (wants(T::kNumber) && kind_ == T::kIdentifier && stream_.ahead(1).kind == T::kNumber && stream_.ahead(2).kind == T::kRange) {
    return say(Kind::kRange, found_.span, {found()});
  }
  if (!wants(T::kRange)) return false;
  if (kind_ == T::kNumber && stream_.behind(2).kind == T::kNumber && last_.kind == T::kIdentifier) {
    return say(Kind::kRange, last_.span, {found_text(stream_.sources(), last_)});
  }
  const bool sign = (kind_ == T::kMinus || kind_ == T::kComma) && last_.kind == T::kNumber && stream_.ahead(1).kind == T::kNumber;
  return sign && say(Kind::kRange, found_.span, {found()});
}

// `-> y = b weight 0.9, z = c`, `-> y = b weight 90% z = c`, `-> weight 0.9 y = b`: the word, if conclusions follow it.
std::optional<source::Span> SyntaxError::early_weight() const {
  if (kind_ == T::kWeight && last_.kind == T::kArrow) return found_.span;
  const std::size_t number = kind_ == T::kEqual ? 2 : 1;   // behind a comma, or a name
  if (kind_ != T::kComma && (kind_ != T::kEqual || last_.kind != T::kSubject)) return std::nullopt;
  for (const std::size_t unit : {std::size_t{0}, std::size_t{1}}) {
    const Token word = stream_.behind(number + unit + 1);
    if (word.kind == T::kWeight && stream_.behind(number + unit).kind == T::kNumber) return word.span;
  }
  return std::nullopt;
}

// `if gap is near then speed = slow`, `gap near -> ...`, `{ near = ..., far = ... }`
bool SyntaxError::is_fuzzy() {
  if (statement_ != T::kFuzzy || at_end()) return false;
  if (const auto weight = early_weight()) return say(Kind::kEarlyWeight, *weight);
  if (kind_ == T::kComma && wants(T::kRightBrace)) return say(Kind::kTermComma, found_.span);
  const bool rule = wants(T::kGiven) && !is_right(kind_) && !near_expected_word();
  const bool arrow = wants(T::kArrow) && kind_ == T::kThen;
  return (rule || arrow) && say(Kind::kFuzzyRule, found_.span, {found()});
}

bool SyntaxError::is_bracket() {
  const Token open = stream_.open_bracket();
  if (open.kind == T::kEnd) {
    return is_right(kind_) && say(Kind::kNotOpened, found_.span, {text()});
  }
  const bool other = is_right(kind_) && kind_ != closing(open.kind);
  const bool clause = is_keyword(kind_) && wants(closing(open.kind)) && statement_ != T::kMap;
  if (!at_end() && !other && !clause) return false;
  diagnostics_.report(Kind::kNotClosed, place(), {spelling(closing(open.kind)), found()})
      .note(Kind::kOpenedHere, open.span, {spelling(open.kind)});
  return true;
}

bool SyntaxError::is_unknown_statement() {
  if (!statement_may_begin(expected_) || kind_ != T::kIdentifier) return false;
  if (statement_ == T::kRule && (text() == "else" || text() == "otherwise" || text() == "elif")) {
    return say(Kind::kElseBranch, found_.span, {text()});
  }
  if (!found_.begins_line && statement_ != T::kEnd) return false;
  const bool setting = (text() == "idle" || text() == "hold_limit" || text() == "firing") && stream_.ahead(1).kind == T::kEqual;
  auto message = diagnostics_.report(Kind::kUnknownStatement, found_.span, {diagnostics::beginning(text())});
  if (text() == kForeignRule) message.note(Kind::kRuleForm, {});
  else message.suggest(setting ? std::optional("set " + std::string(text())) : diagnostics::closest(text(), statement_words()));
  return true;
}

// `rule turn(s in Side)`, `table other[Side]`
bool SyntaxError::is_other_bracket() {
  const bool rule = statement_ == T::kRule && kind_ == T::kLeftParen && wants(T::kAt), table = statement_ == T::kTable && kind_ == T::kLeftBracket;
  if (last_.kind != T::kIdentifier || !(rule || table)) return false;
  const std::string name = (rule ? "rule " : "table ") + std::string(text(last_.span));
  return say(Kind::kOtherWord, found_.span, {name + (rule ? "(" : "["), name + (rule ? "[" : "(")});
}

// `set Side { left, right }`
bool SyntaxError::is_names_as_set() {
  if (statement_ != T::kSet || kind_ != T::kLeftBrace || last_.kind != T::kIdentifier || !wants(T::kEqual)) return false;
  const std::string name(text(last_.span));
  return say(Kind::kOtherWord, found_.span, {"set " + name + " {", "names " + name + " {"});
}

bool SyntaxError::is_map_line() {
  if (found_.begins_line && (kind_ == T::kLandmark || kind_ == T::kRoad) && statement_may_begin(expected_)) {
    return say(Kind::kOutsideMap, found_.span, {text()});
  }
  if (statement_ != T::kMap || !wants(T::kLandmark)) return false;
  constexpr std::string_view kLines[] = {"landmark", "road"};
  if (!found_.begins_line && last_.kind != T::kLeftBrace) return false;
  diagnostics_.report(Kind::kMapLine, found_.span, {found()})
      .suggest(kind_ == T::kIdentifier ? diagnostics::closest(text(), kLines) : std::nullopt);
  return true;
}

// ---- names

bool SyntaxError::is_quoted_name() {
  if (kind_ != T::kString || !wants(T::kIdentifier)) return false;
  return say(Kind::kQuotedName, found_.span, {wanted(), found()});
}

bool SyntaxError::is_missing_comma() {
  const bool list = wants(T::kComma) && stream_.open_bracket().kind != T::kEnd;
  if (!list || kind_ != T::kIdentifier || last_.kind != T::kIdentifier) return false;
  return say(Kind::kMissingComma, behind_last(), {text(last_.span), text()});
}

// `fact Door: bool`, `fact Lit(r: Room)`, `relation Next(x: Room)`
bool SyntaxError::is_type() {
  if (last_.kind != T::kIdentifier || (kind_ != T::kColon && kind_ != T::kLeftParen)) return false;
  if (statement_ == T::kRelation && kind_ == T::kColon && wants(T::kComma)) return say(Kind::kFieldType, found_.span, {text(last_.span)});
  if (!is_declaration(statement_) || !wants(T::kExclusive)) return false;
  return say(Kind::kCellType, found_.span, {singular(statement_), text(last_.span)});
}

bool SyntaxError::is_unknown_attribute() {
  if (statement_ == T::kRelation && (kind_ == T::kKeep || kind_ == T::kOutput)) return say(Kind::kUnknownAttribute, found_.span, {text(), singular(statement_)});
  const bool list = is_declaration(statement_) && wants(T::kExclusive) && !found_.begins_line;
  if (!list || kind_ != T::kIdentifier) return false;
  constexpr std::string_view kAttributes[] = {"exclusive", "keep", "output", "sat", "event", "attention", "of"};
  const auto better = diagnostics::closest(text(), kAttributes);
  const bool valued = stream_.ahead(1).kind == T::kNumber || stream_.ahead(1).kind == T::kEqual;
  if (!better && !valued && last_.kind == T::kIdentifier && wants(T::kComma)) {   // `facts Line Wall`
    const bool one = statement_ != T::kFacts && statement_ != T::kSatellites && statement_ != T::kStrategies && stream_.behind(2).kind == statement_;
    if (!one) return say(Kind::kMissingComma, behind_last(), {text(last_.span), text()});
    const std::string joined = std::string(text(last_.span)) + "_" + std::string(text());   // `fact Battery low`
    diagnostics_.report(Kind::kMissingComma, source::join(last_.span, found_.span), {text(last_.span), text()}).suggest(joined);
    return true;
  }
  diagnostics_.report(Kind::kUnknownAttribute, found_.span, {text(), singular(statement_)}).suggest(better);
  return true;
}

// A keyword where only a name can stand, unless the name was forgotten and the keyword is what should follow it.
bool SyntaxError::is_word_as_name() {
  const bool next_begins = found_.begins_statement && found_.begins_line;
  if (!is_keyword(kind_) || !wants(T::kIdentifier) || wants(T::kReset) || wants(T::kNumber) || next_begins) return false;   // where an effect can stand, more than a name can
  const bool only_name = !condition_may_begin(expected_) && !wants(T::kComma);
  const T next = stream_.ahead(1).kind;
  const bool effects = kind_ == T::kThen && (next == T::kPlus || next == T::kMinus || next == T::kReset);
  const bool forgotten = next == T::kIdentifier || effects;
  if (!(only_name && !forgotten) && !begins_statement(kind_)) return false;
  return say(Kind::kWordAsName, found_.span, {wanted(), text()});
}

// ---- the rest

std::optional<std::string> SyntaxError::near_expected_word() const {
  if (kind_ != T::kIdentifier) return std::nullopt;
  std::vector<std::string_view> words = expected_words(stream_, expected_);
  std::erase(words, spelling(T::kMore));
  return diagnostics::closest(text(), words);
}

void SyntaxError::report_unexpected() {
  const bool statement = found_.begins_line && is_keyword(kind_) && !begins_statement(kind_) && statement_may_begin(expected_);   // `event Bump`
  if (statement) {
    auto message = diagnostics_.report(Kind::kUnknownStatement, found_.span, {text()});
    if (kind_ == T::kWhen || kind_ == T::kWhile) message.note(Kind::kRuleForm, {});
    return;
  }
  auto message = diagnostics_.report(Kind::kUnexpected, place(), {wanted(), found()});
  const bool level = last_.kind == T::kAt || statement_ == T::kLevels;
  if (at_end() && begins_statement(kind_) && wants(T::kIdentifier) && (level || last_.kind == T::kDot)) {
    message.note(Kind::kNameBeginsLine, {}, {text()});   // it could stand for a name there
  }
  message.suggest(near_expected_word());
}

void diagnose_syntax_error(const TokenStream& stream, const TokenSet& expected, diagnostics::Diagnostics& diagnostics) {
  SyntaxError(stream, expected, diagnostics).report();
}

}  // namespace kb::syntax
