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
using N = NameKind;

// What comes after the token `after` in a statement that begins with `statement` (kEnd: in any statement). The first line that fits
// is taken, so lines for a special statement stand before those that hold everywhere.
struct Slot {
  TokenKind statement, after;
  std::string_view what;
  NameKind names = NameKind::kNone;
};
constexpr Slot kSlots[] = {
    {T::kImport, T::kImport, "a file in quotes or a library such as `std.navigation`"},
    {T::kImport, T::kDot, "a library"},
    {T::kLevels, T::kLevels, "a level"},
    {T::kLevels, T::kGreater, "a level"},
    {T::kSet, T::kSet, "a setting", N::kSetting},
    {T::kSet, T::kComma, "a setting", N::kSetting},
    {T::kSet, T::kEqual, "a number or a word", N::kSettingWord},
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
    {T::kPriority, T::kPriority, "a strategy", N::kStrategy},
    {T::kPriority, T::kGreater, "a strategy", N::kStrategy},
    {T::kRelation, T::kRelation, "the name of the relation"},
    {T::kRelation, T::kLeftParen, "a field"},
    {T::kRelation, T::kComma, "a field"},
    {T::kRelation, T::kOf, "a field"},
    {T::kRow, T::kRow, "the name of the row or `in`"},
    {T::kRow, T::kIn, "a relation", N::kRelation},
    {T::kRow, T::kLeftParen, "a field such as `from: A`", N::kRowField},
    {T::kRow, T::kComma, "a field such as `from: A`", N::kRowField},
    {T::kRow, T::kColon, "a row, a member or a condition", N::kValue},
    {T::kMap, T::kMap, "the name of the map"},
    {T::kMap, T::kLandmark, "the name of the landmark"},
    {T::kMap, T::kRoad, "a landmark", N::kLandmark},
    {T::kMap, T::kTwoWay, "a landmark", N::kLandmark},
    {T::kMap, T::kArrow, "a landmark", N::kLandmark},
    {T::kMap, T::kDot, "an exit", N::kExit},
    {T::kMap, T::kBy, "a method", N::kMethod},
    {T::kMap, T::kAt, "a point such as `(1, 2)`"},
    {T::kMap, T::kMost, "a speed such as `0.3 m/s`"},
    {T::kMap, T::kThrough, "a point such as `(1, 2)`"},
    {T::kMap, T::kLeftParen, "a coordinate"},
    {T::kRoute, T::kRoute, "the name of the route"},
    {T::kRoute, T::kOn, "a map", N::kMap},
    {T::kRoute, T::kBy, "a command", N::kCommand},
    {T::kRoute, T::kColon, "a landmark", N::kLandmark},
    {T::kRoute, T::kArrow, "a landmark", N::kLandmark},
    {T::kRoute, T::kDot, "an exit", N::kExit},
    {T::kDetour, T::kDetour, "a landmark", N::kLandmark},
    {T::kDetour, T::kArrow, "a landmark", N::kLandmark},
    {T::kDetours, T::kDetours, "`on` and a route"},
    {T::kTable, T::kTable, "the name of the table"},
    {T::kTable, T::kLeftParen, "a set", N::kSet},
    {T::kTable, T::kComma, "a set", N::kSet},
    {T::kTable, T::kArrow, "the set of its values", N::kSet},
    {T::kTable, T::kLeftBrace, "a member", N::kMember},
    {T::kTable, T::kColon, "a member", N::kMember},
    {T::kRule, T::kRule, "the name of the rule"},
    {T::kRule, T::kAt, "a level", N::kLevel},
    {T::kRule, T::kThen, "an effect", N::kSatellite},
    {T::kRule, T::kPlus, "a satellite", N::kSatellite},
    {T::kRule, T::kMinus, "a satellite", N::kSatellite},
    {T::kRule, T::kIn, "a relation or a set", N::kRelationOrSet},
    {T::kControl, T::kControl, "a strategy", N::kStrategy},
    {T::kControl, T::kEqual, "a controller", N::kController},
    {T::kControl, T::kLeftParen, "an argument such as `speed: 0.4 m/s`"},
    {T::kControl, T::kComma, "an argument such as `speed: 0.4 m/s`"},
    {T::kControl, T::kColon, "a number or a word"},
    {T::kFuzzy, T::kFuzzy, "the name of the controller"},
    {T::kFuzzy, T::kInput, "the name of the input"},
    {T::kFuzzy, T::kOutput, "the name of the output"},
    {T::kFuzzy, T::kGiven, "a condition such as `bearing is ahead`", N::kInput},
    {T::kFuzzy, T::kArrow, "a conclusion such as `speed = full`", N::kOutput},
    {T::kFuzzy, T::kIs, "a term", N::kTerm},
    {T::kFuzzy, T::kBy, "`average`, `sum` or `winner`", N::kFuzzyOutput},
    {T::kFuzzy, T::kStar, "an input", N::kInput},
    {T::kFuzzy, T::kNot, "a condition such as `bearing is ahead`", N::kInput},
    {T::kFuzzy, T::kAnd, "a condition such as `bearing is ahead`", N::kInput},
    {T::kFuzzy, T::kOr, "a condition such as `bearing is ahead`", N::kInput},
    {T::kFuzzy, T::kLeftBrace, ""},
    {T::kFuzzy, T::kEqual, ""},
    {T::kPrototype, T::kPrototype, "the name of the prototype"},
    {T::kPrototype, T::kEqual, "a membership function such as `gaussian(0.9, 0.15)`", N::kShape},
    {T::kPrototype, T::kLeftParen, "a number"},
    {T::kPrototype, T::kComma, "a number"},
    {T::kPrototype, T::kRange, "a number"},
    {T::kSensor, T::kSensor, "the name of the sensor"},
    {T::kSensor, T::kLeftBracket, "how many there are, a number"},
    {T::kSensor, T::kIdentifier, "a range such as `0..4 m`, or `text`", N::kText},
    {T::kSensor, T::kRightBracket, "a range such as `0..4 m`, or `text`", N::kText},
    {T::kSensor, T::kRange, "the end of the range"},
    {T::kSensor, T::kNoise, "a number such as `0.02 m`"},
    {T::kSensor, T::kStale, "a duration such as `200 ms`"},
    {T::kPerceive, T::kPerceive, "a fact", N::kFact},
    {T::kPerceive, T::kRightBracket, "a fact", N::kFact},
    {T::kPerceive, T::kEqual, "what it is perceived by, such as `range ~ near`", N::kPercept},
    {T::kPerceive, T::kIn, "a relation or a set", N::kRelationOrSet},
    {T::kEnd, T::kTilde, "a prototype, a membership function or a text", N::kShape},
    {T::kPerceive, T::kAnd, "a fact, or a sensor and what it is like", N::kPercept},
    {T::kPerceive, T::kOr, "a fact, or a sensor and what it is like", N::kPercept},
    {T::kPerceive, T::kNot, "a fact, or a sensor and what it is like", N::kPercept},
    {T::kFact, T::kAnd, "a fact, or a sensor and what it is like", N::kPercept},
    {T::kFact, T::kOr, "a fact, or a sensor and what it is like", N::kPercept},
    {T::kFact, T::kNot, "a fact, or a sensor and what it is like", N::kPercept},
    {T::kFact, T::kEqual, "a number, or what it is perceived by, such as `range ~ near`", N::kPercept},
    {T::kFacts, T::kEqual, "a number, or what it is perceived by, such as `range ~ near`", N::kPercept},
    {T::kEnd, T::kWhen, "a condition", N::kCell},
    {T::kEnd, T::kWhile, "a condition", N::kCell},
    {T::kEnd, T::kAnd, "a condition", N::kCell},
    {T::kEnd, T::kOr, "a condition", N::kCell},
    {T::kEnd, T::kOn, "a route", N::kRoute},
    {T::kEnd, T::kIs, "`low`, `zero` or `high`", N::kState},
    {T::kEnd, T::kFor, "a duration such as `300 ms`"},
    {T::kEnd, T::kLost, "a fact", N::kFact},
    {T::kEnd, T::kSeen, "a fact", N::kFact},
    {T::kEnd, T::kAny, "a group", N::kGroup},
    {T::kEnd, T::kNo, "a group", N::kGroup},
    {T::kEnd, T::kOf, "a fact, a landmark or a strategy", N::kCell},
    {T::kEnd, T::kEqual, "a number"},
    {T::kEnd, T::kDot, "a field or a member"},
    {T::kEnd, T::kSlash, "a unit", N::kUnit},
    {T::kEnd, T::kLeftBrace, "a member"},
};

// What stands in a slot; no text if none fits.
struct Place {
  std::string_view what;
  NameKind names = NameKind::kAny;
};

// Slots that are known only by more than one token before them.
Place special_slot(const TokenStream& stream, const TokenSet& expected) {
  const TokenKind last = stream.behind(1).kind;
  const bool declares = is_declaration(stream.statement().kind);
  const TokenKind before = stream.behind(2).kind;
  const bool of_each = last == T::kSat || last == T::kEvent || last == T::kLost || last == T::kSeen;
  if (of_each && (before == T::kAny || before == T::kNo)) return {"a group", N::kGroup};
  if (condition_may_begin(expected) && last != T::kColon) return {"a condition", N::kCell};   // behind `:` a field, which has its own slot
  if (last == T::kNot && before == T::kIs) {
    return stream.statement().kind == T::kFuzzy ? Place{"a term", N::kTerm} : Place{"`low`, `zero` or `high`", N::kState};
  }
  if (last == T::kEvent || last == T::kAttention) return declares ? Place{"a number", N::kNone} : Place{"a fact", N::kFact};
  if (last == T::kSat && !expected.contains(T::kEqual)) return {"a fact or a strategy", N::kFactOrStrategy};
  if (expected.contains(T::kMost)) return {"`most` and a speed such as `0.3 m/s`", N::kNone};
  if (expected.contains(T::kReset)) return {"an effect such as `+Lamp`, `-Lamp` or `reset`", N::kSatellite};
  if (expected.contains(T::kLabel) && last == T::kIdentifier) return {"a member, a line such as `N: S`, or `}`", N::kMember};
  const TokenKind bracket = stream.open_bracket().kind;
  const bool first = last == T::kLeftBracket || last == T::kComma || last == T::kLeftParen;
  if (first && expected.contains(T::kStar)) return {"an index", N::kIndex};
  if (first && bracket == T::kLeftBracket) return declares ? Place{"a set", N::kSet} : Place{"a variable", N::kNone};
  if (last == T::kComma && bracket == T::kLeftBrace) return {"a member", N::kNone};
  return {};
}

Place find_slot(const TokenStream& stream) {
  const TokenKind last = stream.behind(1).kind;
  const TokenKind statement = stream.statement().kind;
  const auto* slot = std::find_if(std::begin(kSlots), std::end(kSlots), [&](const Slot& one) {
    return one.after == last && (one.statement == statement || one.statement == T::kEnd);
  });
  return slot == std::end(kSlots) ? Place{} : Place{slot->what, slot->names};
}

Place place_of(const TokenStream& stream, const TokenSet& expected) {
  const Place special = special_slot(stream, expected);
  return special.what.empty() ? find_slot(stream) : special;
}

// Tokens that can nearly always follow a name; naming them would tell the user little.
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

// Lists the tokens themselves.
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
  const std::string_view slot = place_of(stream, expected).what;
  const std::string what = slot.empty() ? listed(expected) : std::string(slot);
  const std::string_view last = stream.sources().text(stream.behind(1).span);
  return last.empty() || last.size() > 40 ? what : fmt::format("{} after {}", what, diagnostics::quoted_code(last));
}

namespace {

/// The names that fit in a fuzzy block, whose slots are not in the table but follow from the tokens that the parser expects.
NameKind names_in_fuzzy(const TokenStream& stream, const TokenSet& expected) {
  if (expected.contains(T::kGiven)) return N::kInput;   // a rule may begin
  if (stream.behind(1).kind != T::kEqual || stream.behind(2).kind != T::kSubject) return N::kNone;
  return expected.contains(T::kNumber) ? N::kTerm : N::kShape;
}

NameKind names(const TokenStream& stream, const TokenSet& expected) {
  const bool name = expected.contains(T::kIdentifier) || expected.contains(T::kSubject) || expected.contains(T::kLabel);
  if (!name) return N::kNone;
  if (stream.behind(1).kind == T::kNumber) return N::kUnit;
  const Place place = place_of(stream, expected);
  return place.what.empty() && stream.statement().kind == T::kFuzzy ? names_in_fuzzy(stream, expected) : place.names;
}

}  // namespace

std::vector<std::string_view> expected_words(const TokenStream& stream, const TokenSet& expected) {
  std::vector<std::string_view> out;
  for (auto i = static_cast<std::size_t>(T::kInput); i <= static_cast<std::size_t>(T::kReset); ++i) {
    const auto word = static_cast<T>(i);
    const bool out_of_place = begins_statement(word) && !stream.behind(0).begins_line;   // `sensor s 0..9 m round` means no route
    if (expected.contains(word) && word != T::kResume && !out_of_place) out.push_back(spelling(word));
  }
  return out;
}

Wanted wanted(const TokenStream& stream, const TokenSet& expected) {
  Wanted out{expected_words(stream, expected), names(stream, expected)};
  const Token statement = stream.statement();
  out.statement = statement.kind == T::kEnd ? stream.behind(0).span.begin : statement.span.begin;
  return out;
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
