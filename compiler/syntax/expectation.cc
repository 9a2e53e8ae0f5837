#include "compiler/syntax/expectation.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "compiler/syntax/words.h"

namespace kb::syntax {
namespace {

using T = TokenKind;

// What comes after the token `after` in a statement that begins with `statement` (kEnd: in any). The first line that
// fits holds, so what is special to a statement stands before what holds everywhere.
struct Slot {
  TokenKind statement, after;
  std::string_view what;
};
constexpr Slot kSlots[] = {
    {T::kImport, T::kImport, "a file in quotes or a library such as `std.navigation`"},
    {T::kImport, T::kDot, "a library"},
    {T::kLevels, T::kLevels, "a level"},
    {T::kLevels, T::kGreater, "a level"},
    {T::kSet, T::kSet, "a setting"},
    {T::kSet, T::kComma, "a setting"},
    {T::kSet, T::kEqual, "a number or a word"},
    {T::kNames, T::kNames, "the name of the set"},
    {T::kNames, T::kLeftBrace, "a member"},
    {T::kNames, T::kComma, "a member"},
    {T::kFact, T::kFact, "the name of the fact"},
    {T::kFacts, T::kFacts, "the name of the facts"},
    {T::kCommand, T::kCommand, "the name of the command"},
    {T::kSatellite, T::kSatellite, "the name of the satellite"},
    {T::kSatellites, T::kSatellites, "the name of the satellites"},
    {T::kStrategy, T::kStrategy, "the name of the strategy"},
    {T::kStrategies, T::kStrategies, "the name of the strategies"},
    {T::kPriority, T::kPriority, "a strategy"},
    {T::kPriority, T::kGreater, "a strategy"},
    {T::kRelation, T::kRelation, "the name of the relation"},
    {T::kRelation, T::kLeftParen, "a field"},
    {T::kRelation, T::kComma, "a field"},
    {T::kRelation, T::kOf, "a field"},
    {T::kRow, T::kRow, "the name of the row or `in`"},
    {T::kRow, T::kIn, "a relation"},
    {T::kRow, T::kLeftParen, "a field such as `from: A`"},
    {T::kRow, T::kComma, "a field such as `from: A`"},
    {T::kRow, T::kColon, "a row, a member or a condition"},
    {T::kMap, T::kMap, "the name of the map"},
    {T::kMap, T::kLandmark, "the name of the landmark"},
    {T::kMap, T::kRoad, "a landmark"},
    {T::kMap, T::kTwoWay, "a landmark"},
    {T::kMap, T::kArrow, "a landmark"},
    {T::kMap, T::kDot, "an exit"},
    {T::kMap, T::kBy, "a method"},
    {T::kMap, T::kAt, "a point such as `(1, 2)`"},
    {T::kMap, T::kThrough, "a point such as `(1, 2)`"},
    {T::kMap, T::kLeftParen, "a coordinate"},
    {T::kRoute, T::kRoute, "the name of the route"},
    {T::kRoute, T::kOn, "a map"},
    {T::kRoute, T::kBy, "a command"},
    {T::kRoute, T::kColon, "a landmark"},
    {T::kRoute, T::kArrow, "a landmark"},
    {T::kRoute, T::kDot, "an exit"},
    {T::kDetour, T::kDetour, "a landmark"},
    {T::kDetour, T::kArrow, "a landmark"},
    {T::kDetours, T::kDetours, "`on` and a route"},
    {T::kTable, T::kTable, "the name of the table"},
    {T::kTable, T::kLeftParen, "a set"},
    {T::kTable, T::kComma, "a set"},
    {T::kTable, T::kArrow, "the set of its values"},
    {T::kTable, T::kColon, "a member"},
    {T::kRule, T::kRule, "the name of the rule"},
    {T::kRule, T::kAt, "a level"},
    {T::kRule, T::kThen, "an effect"},
    {T::kRule, T::kPlus, "a satellite"},
    {T::kRule, T::kMinus, "a satellite"},
    {T::kRule, T::kIn, "a relation or a set"},
    {T::kControl, T::kControl, "a strategy"},
    {T::kControl, T::kEqual, "a controller"},
    {T::kControl, T::kLeftParen, "an argument such as `speed: 0.4 m/s`"},
    {T::kControl, T::kComma, "an argument such as `speed: 0.4 m/s`"},
    {T::kControl, T::kColon, "a number or a word"},
    {T::kFuzzy, T::kFuzzy, "the name of the controller"},
    {T::kFuzzy, T::kInput, "the name of the input"},
    {T::kFuzzy, T::kOutput, "the name of the output"},
    {T::kFuzzy, T::kGiven, "a condition such as `bearing is ahead`"},
    {T::kFuzzy, T::kArrow, "a conclusion such as `speed = full`"},
    {T::kFuzzy, T::kIs, "a term"},
    {T::kFuzzy, T::kBy, "`average`, `sum` or `winner`"},
    {T::kFuzzy, T::kStar, "an input"},
    {T::kFuzzy, T::kNot, "a condition such as `bearing is ahead`"},
    {T::kFuzzy, T::kAnd, "a condition such as `bearing is ahead`"},
    {T::kFuzzy, T::kOr, "a condition such as `bearing is ahead`"},
    {T::kFuzzy, T::kLeftBrace, ""},
    {T::kFuzzy, T::kEqual, ""},
    {T::kPrototype, T::kPrototype, "the name of the prototype"},
    {T::kPrototype, T::kEqual, "a membership function such as `gaussian(0.9, 0.15)`"},
    {T::kPrototype, T::kLeftParen, "a number"},
    {T::kPrototype, T::kComma, "a number"},
    {T::kPrototype, T::kRange, "a number"},
    {T::kSensor, T::kSensor, "the name of the sensor"},
    {T::kSensor, T::kLeftBracket, "how many there are, a number"},
    {T::kSensor, T::kIdentifier, "a range such as `0..4 m`, or `text`"},
    {T::kSensor, T::kRightBracket, "a range such as `0..4 m`, or `text`"},
    {T::kSensor, T::kRange, "the end of the range"},
    {T::kSensor, T::kNoise, "a number such as `0.02 m`"},
    {T::kSensor, T::kStale, "a duration such as `200 ms`"},
    {T::kPerceive, T::kPerceive, "a fact"},
    {T::kPerceive, T::kRightBracket, "a fact"},
    {T::kPerceive, T::kEqual, "what it is perceived by, such as `range ~ near`"},
    {T::kPerceive, T::kIn, "a relation or a set"},
    {T::kEnd, T::kTilde, "a prototype, a membership function or a text"},
    {T::kPerceive, T::kAnd, "a fact, or a sensor and what it is like"},
    {T::kPerceive, T::kOr, "a fact, or a sensor and what it is like"},
    {T::kPerceive, T::kNot, "a fact, or a sensor and what it is like"},
    {T::kFact, T::kAnd, "a fact, or a sensor and what it is like"},
    {T::kFact, T::kOr, "a fact, or a sensor and what it is like"},
    {T::kFact, T::kNot, "a fact, or a sensor and what it is like"},
    {T::kFact, T::kEqual, "a number, or what it is perceived by, such as `range ~ near`"},
    {T::kFacts, T::kEqual, "a number, or what it is perceived by, such as `range ~ near`"},
    {T::kEnd, T::kWhen, "a condition"},
    {T::kEnd, T::kWhile, "a condition"},
    {T::kEnd, T::kAnd, "a condition"},
    {T::kEnd, T::kOr, "a condition"},
    {T::kEnd, T::kOn, "a route"},
    {T::kEnd, T::kIs, "`low`, `zero` or `high`"},
    {T::kEnd, T::kFor, "a duration such as `300 ms`"},
    {T::kEnd, T::kLost, "a fact"},
    {T::kEnd, T::kSeen, "a fact"},
    {T::kEnd, T::kAny, "a group"},
    {T::kEnd, T::kNo, "a group"},
    {T::kEnd, T::kOf, "a fact, a landmark or a strategy"},
    {T::kEnd, T::kEqual, "a number"},
    {T::kEnd, T::kDot, "a field or a member"},
    {T::kEnd, T::kSlash, "a unit"},
    {T::kEnd, T::kLeftBrace, "a member"},
};

// Slots that need more than one look back; empty if none fits.
std::string_view special_slot(const TokenStream& stream, const TokenSet& expected) {
  const TokenKind last = stream.behind(1).kind;
  if (condition_may_begin(expected) && last != T::kColon) return "a condition";   // behind `:` a field, which has its own slot
  if (last == T::kNot && stream.behind(2).kind == T::kIs) return "`low`, `zero` or `high`";
  if (last == T::kEvent || last == T::kAttention) return is_declaration(stream.statement().kind) ? "a number" : "a fact";
  if (last == T::kSat && !expected.contains(T::kEqual)) return "a fact or a strategy";
  if (expected.contains(T::kReset)) return "an effect such as `+Lamp`, `-Lamp` or `reset`";
  if (expected.contains(T::kLabel) && last == T::kIdentifier) return "a member, a line such as `N: S`, or `}`";
  const TokenKind bracket = stream.open_bracket().kind;
  const bool first = last == T::kLeftBracket || last == T::kComma || last == T::kLeftParen;
  if (first && expected.contains(T::kStar)) return "an index";
  if (first && bracket == T::kLeftBracket) return is_declaration(stream.statement().kind) ? "a set" : "a variable";
  if (last == T::kComma && bracket == T::kLeftBrace) return "a member";
  return {};
}

std::string_view find_slot(const TokenStream& stream) {
  const TokenKind last = stream.behind(1).kind;
  const TokenKind statement = stream.statement().kind;
  const auto* slot = std::find_if(std::begin(kSlots), std::end(kSlots), [&](const Slot& one) {
    return one.after == last && (one.statement == statement || one.statement == T::kEnd);
  });
  return slot == std::end(kSlots) ? std::string_view{} : slot->what;
}

// Tokens that may nearly always go on after a name; they say little.
bool says_little(TokenKind kind) {
  return kind == T::kDot || kind == T::kLeftBracket || kind == T::kLeftParen || kind == T::kSlash || kind == T::kPercent ||
         kind == T::kIdentifier || kind == T::kPlus || kind == T::kMinus;
}

std::string listed(const std::vector<std::string>& parts) {
  std::string out;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) out += i + 1 == parts.size() ? " or " : ", ";
    out += parts[i];
  }
  return out;
}

// The tokens themselves.
std::string listed(const TokenSet& expected) {
  std::vector<std::string> parts;
  const bool any_statement = statement_may_begin(expected);
  for (const bool little : {false, true}) {
    for (std::size_t i = 0; i <= static_cast<std::size_t>(T::kReset) && (!little || parts.empty()); ++i) {
      const auto kind = static_cast<TokenKind>(i);
      const bool of_statement = any_statement && (begins_statement(kind) || kind == T::kEnd);
      if (!expected.contains(kind) || says_little(kind) != little || of_statement || kind == T::kResume) continue;
      if (kind == T::kSubject && expected.contains(T::kIdentifier)) continue;
      const bool named = kind == T::kIdentifier || kind == T::kSubject || kind == T::kNumber || kind == T::kString || kind == T::kEnd;
      parts.push_back(named ? fmt::format("a {}", spelling(kind)) : fmt::format("`{}`", spelling(kind)));
    }
  }
  if (any_statement) parts.emplace_back("the next statement");
  return listed(parts);
}

}  // namespace

std::string expectation(const TokenStream& stream, const TokenSet& expected) {
  const std::string_view special = special_slot(stream, expected);
  const std::string_view slot = special.empty() ? find_slot(stream) : special;
  const std::string what = slot.empty() ? listed(expected) : std::string(slot);
  const std::string_view last = stream.sources().text(stream.behind(1).span);
  return last.empty() || last.size() > 40 ? what : fmt::format("{} after {}", what, diagnostics::quoted_code(last));
}

std::string found_text(const source::Sources& sources, const Token& found) {
  const std::string text = diagnostics::quoted_code(sources.text(found.span));
  switch (found.kind) {
    case T::kEnd: return "the end of the file";
    case T::kNumber: return fmt::format("the number {}", text);
    case T::kString: return fmt::format("the string {}", text);
    default: break;
  }
  if (found.begins_statement && found.begins_line) return fmt::format("the next statement, {}", text);
  return text;
}

}  // namespace kb::syntax
