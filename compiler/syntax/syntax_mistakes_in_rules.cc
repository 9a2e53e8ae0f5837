// Mistakes in rules, maps, routes and orders.
#include <algorithm>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "compiler/diagnostics/display.h"
#include "compiler/source/encoding.h"
#include "compiler/syntax/syntax_mistakes.h"

namespace kb::syntax {
namespace {

using diagnostics::Kind;
using T = TokenKind;

constexpr std::size_t kFarthest = 64;   // tokens that are looked at on one side

/// Words that mean a value and no name.
bool is_truth(std::string_view name) {
  const std::string word = source::lower(std::string(name));
  constexpr std::string_view kTruths[] = {"on", "off", "true", "false", "yes", "no", "low", "zero", "high"};
  return std::ranges::find(kTruths, word) != std::end(kTruths);
}

}  // namespace

bool SyntaxError::is_rule_head() {
  if (statement_ != T::kRule) return false;
  if (wants(T::kWhen)) {
    if (kind_ == T::kIdentifier && text(last_.span) == "level") return say(Kind::kLevelWord, found_.span, {text()});
    constexpr std::string_view kModes[] = {"when", "while"};
    diagnostics_.report(Kind::kMissingWhen, place(), {found()})
        .suggest(kind_ == T::kIdentifier ? diagnostics::closest(text(), kModes) : std::nullopt);
    return true;
  }
  if (wants(T::kAt)) return say(Kind::kMissingLevel, place(), {text(last_.span), found()});
  return false;
}

bool SyntaxError::is_percept() {
  const bool compares = kind_ == T::kComparison || kind_ == T::kGreater || kind_ == T::kEqualEqual || kind_ == T::kNotEqual;
  if (!wants(T::kTilde) || (!compares && kind_ != T::kIs)) return false;
  return say(Kind::kNoLikeness, found_.span, {text()});
}

bool SyntaxError::is_condition() {
  const bool term = last_.kind == T::kIs || (last_.kind == T::kNot && stream_.behind(2).kind == T::kIs);
  if (term && is_keyword(kind_) && kind_ != T::kThen && !at_end()) {
    return say(Kind::kUnknownTerm, found_.span, {text()});
  }
  const bool inside = condition_may_begin(expected_) || wants(T::kThen) || wants(T::kAnd);
  if (!inside) return false;
  if (is_comparison() || is_dotted_term() || is_operator()) return true;
  if (statement_ == T::kRule && kind_ == T::kTilde) return say(Kind::kLikenessInRule, found_.span, {text()});
  if (wants(T::kThen) && at_end()) return say(Kind::kMissingThen, place());
  const bool number = kind_ == T::kNumber || (kind_ == T::kMinus && stream_.ahead(1).kind == T::kNumber);
  if (!condition_may_begin(expected_) || !number) return false;
  if (statement_ == T::kRow) return say(Kind::kNumberAsCondition, found_.span, {"value of a field", "a field holds a row, a cell, a member or a condition"});
  return say(Kind::kNumberAsCondition, found_.span, {"condition", "a condition names a cell"});
}

// `Charge > 0.8`, `Step == one`, `Step == Step.one`
bool SyntaxError::is_comparison() {
  const bool equality = kind_ == T::kEqual || kind_ == T::kEqualEqual || kind_ == T::kNotEqual;
  if (!equality && kind_ != T::kComparison && kind_ != T::kGreater) return false;
  auto message = diagnostics_.report(Kind::kComparison, found_.span, {text()});
  const bool dotted = stream_.ahead(2).kind == T::kDot;
  const bool other = stream_.behind(2).kind == T::kDot || (dotted && text(stream_.ahead(1).span) != text(last_.span));
  if (is_variable(last_) && is_variable(stream_.ahead(1))) message.note(Kind::kVariablesCompared, {}, {text(last_.span), text(stream_.ahead(1).span)});
  else if (equality && !other) note_member(message, last_, stream_.ahead(dotted ? 3 : 1), kind_ == T::kNotEqual);
  return true;
}

// A variable of the rule: it was declared as `name in SET`.
bool SyntaxError::is_variable(const Token& name) const {
  if (name.kind != T::kIdentifier || statement_ != T::kRule) return false;
  for (std::size_t i = 2; i < kFarthest && !stream_.behind(i).begins_statement; ++i) {
    if (stream_.behind(i).kind == T::kIn && text(stream_.behind(i + 1).span) == text(name.span)) return true;
  }
  return false;
}

// `Left xor Right`
bool SyntaxError::is_operator() {
  constexpr std::string_view kForms[][2] = {{"xor", "({0} or {1}) and not ({0} and {1})"}, {"nand", "not ({0} and {1})"}, {"nor", "not ({0} or {1})"}};
  if (kind_ != T::kIdentifier || !wants(T::kAnd)) return false;
  const auto form = std::ranges::find_if(kForms, [this](const auto& one) { return source::lower(std::string(text())) == one[0]; });
  if (form == std::end(kForms)) return false;
  constexpr T kBefore[] = {T::kWhen, T::kWhile, T::kLeftParen, T::kAnd, T::kOr}, kBehind[] = {T::kThen, T::kRightParen, T::kAnd, T::kOr};
  const bool alone = std::ranges::count(kBefore, stream_.behind(2).kind) > 0 && std::ranges::count(kBehind, stream_.ahead(2).kind) > 0;
  const bool simple = alone && last_.kind == T::kIdentifier && stream_.ahead(1).kind == T::kIdentifier;
  const std::string left(simple ? text(last_.span) : "<left>"), right(simple ? text(stream_.ahead(1).span) : "<right>");
  return say(Kind::kNoSuchOperator, found_.span, {text(), fmt::format(fmt::runtime((*form)[1]), left, right)});
}

// `Step is Step.one`
bool SyntaxError::is_dotted_term() {
  const bool negated = stream_.behind(2).kind == T::kNot;
  if (kind_ != T::kDot || last_.kind != T::kIdentifier || stream_.behind(negated ? 3 : 2).kind != T::kIs) return false;
  const source::Span whole = source::join(last_.span, stream_.ahead(1).span);
  auto message = diagnostics_.report(Kind::kUnknownTerm, whole, {text(whole)});
  note_member(message, last_, stream_.ahead(1), negated);
  return true;
}

void SyntaxError::note_member(diagnostics::Builder& message, const Token& group, const Token& member, bool negated) const {
  const bool names = group.kind == T::kIdentifier && member.kind == T::kIdentifier && !member.begins_line;
  if (!names || is_truth(text(member.span)) || text(member.span) == text(group.span)) return;
  std::string asked = negated ? "not " : "";
  asked.append(text(group.span)).append(".").append(text(member.span));
  message.note(Kind::kPerhapsMember, {}, {text(member.span), text(group.span), asked});
}

// The effect that is being read, from its beginning to the last token before the error.
source::Span SyntaxError::effect_so_far() const {
  int depth = 0;
  source::Span whole = last_.span;
  for (std::size_t i = 1; i < kFarthest; ++i) {
    const Token token = stream_.behind(i);
    if (is_right(token.kind)) ++depth;
    if (is_left(token.kind)) --depth;
    if (token.kind == T::kThen || (token.kind == T::kComma && depth == 0)) return whole;
    whole = source::join(whole, token.span);
  }
  return last_.span;
}

bool SyntaxError::is_effect() {
  if (statement_ != T::kRule) return false;
  if (wants(T::kReset) && kind_ == T::kNot) return say(Kind::kNegatedEffect, found_.span);
  const auto was = [&](std::size_t back, TokenKind kind) { return stream_.behind(back).kind == kind; };
  const bool call = kind_ == T::kColon && was(1, T::kIdentifier) && was(2, T::kLeftParen) && was(3, T::kIdentifier);   // `then drive(speed: ...)`
  if (call && (was(4, T::kThen) || was(4, T::kComma) || was(4, T::kPlus))) return say(Kind::kCalledController, stream_.behind(3).span, {text(stream_.behind(3).span)});
  if (wants(T::kComma) && statement_may_begin(expected_)) {
    if (kind_ == T::kAnd || kind_ == T::kOr) return say(Kind::kJoinedEffects, found_.span, {text()});
    const bool lasts = kind_ == T::kFor || text() == "until" || text() == "after" || text() == "in" || text() == "during";
    if (lasts) return say(Kind::kEffectDuration, found_.span, {text()});
  }
  if (is_called()) return true;
  if (last_.kind == T::kReset && kind_ == T::kIdentifier && !found_.begins_line) return say(Kind::kResetOf, found_.span, {text()});
  return is_effect_value() || is_unsigned_effect();
}

// `then drive(fast)`, without names of arguments
bool SyntaxError::is_called() {
  if (!wants(T::kEqual) || last_.kind != T::kRightParen) return false;
  const source::Span effect = effect_so_far();
  const std::string_view whole = text(effect), name = whole.substr(0, whole.find_first_of(" ("));
  const source::Span at{effect.file, effect.begin, static_cast<std::uint32_t>(effect.begin + name.size())};
  return !name.empty() && say(Kind::kCalledController, at, {name});
}

// `then +Lamp = 1`, `then Lamp = on`, `then Way = left`
bool SyntaxError::is_effect_value() {
  const source::Span effect = effect_so_far();
  const bool sign = kind_ == T::kEqual && wants(T::kComma) && (text(effect).front() == '+' || text(effect).front() == '-');
  const bool word = last_.kind == T::kEqual && wants(T::kNumber) && (kind_ == T::kIdentifier || is_keyword(kind_)) && !found_.begins_line;
  if (!sign && !word) return false;
  const source::Span all = source::join(effect, sign && stream_.ahead(1).kind != T::kEnd ? stream_.ahead(1).span : found_.span);
  std::string_view satellite = text(effect).substr(sign ? 1 : 0);
  satellite = satellite.substr(0, satellite.find_last_not_of(" :=") + 1);
  if (word && kind_ == T::kIdentifier && !is_truth(text())) return is_effect_member(effect, satellite);
  return say(Kind::kEffectValue, all, {text(all), satellite});
}

// `then Way = left`, `then Way = Way.left`: written as an assignment of a state; `then Way = Way + 0.1`
bool SyntaxError::is_effect_member(source::Span effect, std::string_view group) {
  const bool full = stream_.ahead(1).kind == T::kDot && stream_.ahead(2).kind == T::kIdentifier;
  const source::Span named = full ? source::join(found_.span, stream_.ahead(2).span) : found_.span, all = source::join(effect, named);
  const Token behind = stream_.ahead(full ? 3 : 1);
  const bool computes = behind.kind == T::kPlus || behind.kind == T::kMinus || behind.kind == T::kStar || behind.kind == T::kSlash;
  if (computes || (!full && text(named) == group)) {
    const source::Span whole = source::join(all, computes ? stream_.ahead(full ? 4 : 2).span : named);
    return say(Kind::kEffectSum, whole, {text(whole)});
  }
  const std::string member = (full ? std::string() : std::string(group) + ".") + std::string(text(named));
  return say(Kind::kEffectMember, all, {text(all), member});
}

// The last name from the found token on that stands on its line, whole: `sat Lamp`, `Turn.left`, `Turn[left]`.
source::Span SyntaxError::last_name_ahead() const {
  source::Span whole;
  int depth = 0;
  bool goes_on = false;
  for (std::size_t i = 0; i < kFarthest; ++i) {
    const Token token = i == 0 ? found_ : stream_.ahead(i);
    if (token.kind == T::kOn && !token.begins_line) continue;   // `switch on Lamp`
    const bool name = token.kind == T::kIdentifier || token.kind == T::kSat;
    const bool part = whole.known() && (depth > 0 || token.kind == T::kDot || token.kind == T::kLeftBracket);
    if (token.begins_line || !(name || part)) break;
    whole = part || goes_on ? source::join(whole, token.span) : token.span;
    depth += is_left(token.kind) ? 1 : is_right(token.kind) ? -1 : 0;
    goes_on = token.kind == T::kDot || token.kind == T::kSat;
  }
  return goes_on || depth > 0 ? source::Span{} : whole;
}

// `then toggle Lamp`, `then turn off Lamp`
bool SyntaxError::is_verb(source::Span effect) {
  const source::Span meant = last_name_ahead();
  if (!meant.known()) return false;
  const source::Span all = source::join(effect, meant);
  if (text(effect) == "goto" || text(effect) == "go") return say(Kind::kSendEffect, all, {text(all), text(meant)});
  return say(Kind::kEffectValue, all, {text(all), text(meant)});
}

// `then Lamp = 1`, `then Lamp`
bool SyntaxError::is_unsigned_effect() {
  const bool complete = last_.kind == T::kIdentifier || last_.kind == T::kRightBracket;
  if (!wants(T::kEqual) || !complete || wants(T::kThen)) return false;
  const source::Span effect = effect_so_far();
  if (text(effect).find('\n') != std::string_view::npos) return false;
  if (is_verb(effect)) return true;
  return say(Kind::kUnsignedEffect, effect, {text(effect)});
}

// ---- maps, routes, orders

bool SyntaxError::is_route() {
  if (statement_ != T::kRoute || last_.kind != T::kIdentifier) return false;
  if (wants(T::kOn)) return say(Kind::kRouteWithoutMap, place(), {found()});
  if (wants(T::kBy)) return say(Kind::kRouteWithoutCommand, place(), {found()});
  return false;
}

bool SyntaxError::is_road() {
  if (statement_ != T::kMap) return false;
  if (wants(T::kTwoWay)) return say(Kind::kRoadWithoutWay, place(), {found()});
  const TokenKind before = stream_.behind(2).kind;
  const bool end = before == T::kRoad || before == T::kTwoWay || before == T::kArrow;
  if (!end || !wants(T::kDot)) return false;
  const std::string_view landmark = text(last_.span);
  return say(Kind::kRoadWithoutExit, last_.span, {before == T::kRoad ? "leaves" : "reaches", landmark});
}

bool SyntaxError::is_order() {
  const bool order = statement_ == T::kLevels || statement_ == T::kPriority;
  if (!order || (kind_ != T::kComma && kind_ != T::kComparison)) return false;
  return say(Kind::kDescendingOrder, found_.span, {statement_ == T::kLevels ? "levels" : "strategies", found()});
}

}  // namespace kb::syntax
