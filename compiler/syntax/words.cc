#include "compiler/syntax/words.h"

#include <algorithm>
#include <array>

#include "compiler/syntax/syntax.h"

namespace kb::syntax {
namespace {

constexpr std::array kSpellings = std::to_array<std::string_view>({
#define KB_TOKEN(name, spelling) spelling,
#define KB_KEYWORD(name, spelling) spelling,
#include "grammar/tokens.def"
#undef KB_TOKEN
#undef KB_KEYWORD
});

constexpr std::array kNames = std::to_array<std::string_view>({
#define KB_TOKEN(name, spelling) #name,
#define KB_KEYWORD(name, spelling) #name,
#include "grammar/tokens.def"
#undef KB_TOKEN
#undef KB_KEYWORD
});

constexpr std::size_t kFirstKeyword = static_cast<std::size_t>(TokenKind::kImport);
constexpr std::size_t kKeywordCount = kSpellings.size() - kFirstKeyword;

/// Keywords in alphabetical order, and where each letter begins: a look-up compares two or three words.
struct Index {
  std::array<TokenKind, kKeywordCount> sorted{};
  std::array<std::uint8_t, 27> begin{};
};

consteval Index make_index() {
  Index index;
  for (std::size_t i = 0; i < kKeywordCount; ++i) index.sorted[i] = static_cast<TokenKind>(kFirstKeyword + i);
  std::sort(index.sorted.begin(), index.sorted.end(), [](TokenKind a, TokenKind b) {
    return kSpellings[static_cast<std::size_t>(a)] < kSpellings[static_cast<std::size_t>(b)];
  });
  std::size_t next = 0;
  for (std::size_t letter = 0; letter <= 26; ++letter) {
    while (next < kKeywordCount &&
           kSpellings[static_cast<std::size_t>(index.sorted[next])][0] < static_cast<char>('a' + letter)) {
      ++next;
    }
    index.begin[letter] = static_cast<std::uint8_t>(next);
  }
  return index;
}

constexpr Index kIndex = make_index();

}  // namespace

std::string_view spelling(TokenKind kind) { return kSpellings[static_cast<std::size_t>(kind)]; }
std::string_view kind_name(TokenKind kind) { return kNames[static_cast<std::size_t>(kind)]; }

TokenKind keyword(std::string_view text) {
  if (text.empty() || text[0] < 'a' || text[0] > 'z') return TokenKind::kIdentifier;
  const auto letter = static_cast<std::size_t>(text[0] - 'a');
  for (std::size_t i = kIndex.begin[letter]; i < kIndex.begin[letter + 1]; ++i) {
    if (spelling(kIndex.sorted[i]) == text) return kIndex.sorted[i];
  }
  return TokenKind::kIdentifier;
}

std::span<const std::string_view> words() { return std::span(kSpellings).subspan(kFirstKeyword); }

std::span<const std::string_view> words_in_places() {
  constexpr auto kFirst = static_cast<std::size_t>(TokenKind::kInput), kLast = static_cast<std::size_t>(TokenKind::kMore);
  return std::span(kSpellings).subspan(kFirst, kLast - kFirst + 1);
}

std::span<const std::string_view> statement_words() {
  constexpr std::size_t kCount = static_cast<std::size_t>(TokenKind::kFuzzy) - kFirstKeyword + 1;
  return std::span(kSpellings).subspan(kFirstKeyword, kCount);
}

}  // namespace kb::syntax
