// What kind of word a token is. Private to this folder.
#pragma once

#include <span>
#include <string_view>

#include "compiler/syntax/tokens.h"

namespace kb::syntax {

/// How a token is written, or what it is called if it has many spellings ("name", "number").
[[nodiscard]] std::string_view spelling(TokenKind kind);
/// The name of a kind as `kbc dump tokens` prints it: "Identifier", "Rule".
[[nodiscard]] std::string_view kind_name(TokenKind kind);
/// The keyword that `text` is, or kIdentifier.
[[nodiscard]] TokenKind keyword(std::string_view text);
/// The words that begin a statement of the language, in the order of the reference.
[[nodiscard]] std::span<const std::string_view> statement_words();

/// Whether it opens, or closes, something that nests.
[[nodiscard]] constexpr bool is_left(TokenKind kind) {
  return kind == TokenKind::kLeftBrace || kind == TokenKind::kLeftParen || kind == TokenKind::kLeftBracket;
}
[[nodiscard]] constexpr bool is_right(TokenKind kind) {
  return kind == TokenKind::kRightBrace || kind == TokenKind::kRightParen || kind == TokenKind::kRightBracket;
}
/// Whether it begins a statement.
[[nodiscard]] constexpr bool begins_statement(TokenKind kind) {
  return kind >= TokenKind::kImport && kind <= TokenKind::kFuzzy;
}
/// Whether it begins an item of a map.
[[nodiscard]] constexpr bool begins_item(TokenKind kind) {
  return kind == TokenKind::kLandmark || kind == TokenKind::kRoad;
}
/// Whether it describes what is being declared; elsewhere it is a name.
[[nodiscard]] constexpr bool is_attribute_word(TokenKind kind) {
  return kind >= TokenKind::kNoise && kind <= TokenKind::kLazy;
}
[[nodiscard]] constexpr bool is_keyword(TokenKind kind) { return kind >= TokenKind::kImport; }
/// `fact` to `strategies`: the words that declare cells.
[[nodiscard]] constexpr bool is_declaration(TokenKind kind) {
  return kind >= TokenKind::kFact && kind <= TokenKind::kStrategies;
}

}  // namespace kb::syntax
