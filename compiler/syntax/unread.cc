#include <algorithm>
#include <variant>

#include "compiler/syntax/scan.h"
#include "compiler/syntax/syntax.h"
#include "compiler/syntax/words.h"

namespace kb::syntax {
namespace {

/// What was read, in order of the text.
std::vector<source::Span> read_spans(const Tree& tree) {
  std::vector<source::Span> out;
  for (const Statement& statement : tree.statements) {
    const auto* const map = std::get_if<Map>(&statement.node);
    if (map != nullptr) {
      for (const Landmark& landmark : map->landmarks) out.push_back(landmark.span);
      for (const Road& road : map->roads) out.push_back(road.span);
    } else if (!std::holds_alternative<Fuzzy>(statement.node)) {
      out.push_back(statement.span);
    }
  }
  std::ranges::sort(out, {}, &source::Span::begin);
  return out;
}

/// Whether a name has to follow, which is then declared.
constexpr bool names_something(TokenKind kind) {
  switch (kind) {
    case TokenKind::kNames:
    case TokenKind::kRelation:
    case TokenKind::kMap:
    case TokenKind::kRoute:
    case TokenKind::kTable:
    case TokenKind::kPrototype:
    case TokenKind::kSensor:
    case TokenKind::kFuzzy:
    case TokenKind::kLandmark: return true;
    default: return is_declaration(kind);
  }
}

/// Whether it does not stand between statements, or between the items of a map.
constexpr bool goes_on(TokenKind kind) {
  return !begins_statement(kind) && !begins_item(kind) && kind != TokenKind::kLeftBrace && kind != TokenKind::kRightBrace && kind != TokenKind::kEnd;
}

/// Goes through the tokens of a file and what was read of it at once.
class Unread {
 public:
  Unread(const source::Sources& sources, const Tree& tree)
      : bytes_(sources.bytes(tree.file)), tokens_(scan(sources, tree.file, Comments::kKeep).tokens), read_(read_spans(tree)) {}

  std::vector<std::string_view> words() {
    doubt_before_unread();
    std::uint32_t end = 0;
    TokenKind before = TokenKind::kEnd;   // kEnd: it was read
    bool lone = false;                    // the first token that was not read is a name, perhaps a misspelt word
    each_token([&](const Token& token, const source::Span* read) {
      if (token.kind != TokenKind::kComment) {
        const bool name = token.kind == TokenKind::kIdentifier, first = read == nullptr && before == TokenKind::kEnd;
        const bool headless = first ? !name && goes_on(token.kind) : lone && !name;
        if (headless || (names_something(before) && !name)) out_.emplace_back();
        lone = first && name;
        before = read != nullptr ? TokenKind::kEnd : token.kind;
      }
      if (read == nullptr) refused(bytes_.substr(end, token.span.begin - end));
      if (read == nullptr && token.kind != TokenKind::kComment) split(bytes_.substr(token.span.begin, token.span.end - token.span.begin));
      end = token.span.end;
    });
    return std::move(out_);
  }

 private:
  /// What stands before unread text may have another meaning than it had alone: in `landmark at (1, 2)` a name is missing.
  void doubt_before_unread() {
    std::vector<std::uint32_t> doubtful;   // where they begin
    const source::Span* before = nullptr;
    each_token([&](const Token& token, const source::Span* read) {
      if (token.kind == TokenKind::kComment) return;
      if (read == nullptr && before != nullptr && goes_on(token.kind)) doubtful.push_back(before->begin);
      before = read;
    });
    std::erase_if(read_, [&](const source::Span& span) { return std::ranges::binary_search(doubtful, span.begin); });
  }

  /// Calls `use` with each token and the span that it was read in, or null.
  template <class Use>
  void each_token(Use use) const {
    auto span = read_.begin();
    for (const Token& token : tokens_) {
      while (span != read_.end() && span->end <= token.span.begin) ++span;
      use(token, span != read_.end() && span->begin <= token.span.begin ? &*span : nullptr);
    }
  }

  /// What is no token. Bytes that are not ASCII, or no text, may be letters of any name.
  void refused(std::string_view text) {
    const auto foreign = [](char c) { return static_cast<unsigned char>(c) >= 0x7F || (c < ' ' && c != '\t' && c != '\n' && c != '\r'); };
    if (std::ranges::any_of(text, foreign)) out_.emplace_back();
    split(text);
  }

  void split(std::string_view text) {
    each_word(text, [this](std::string_view word) { out_.push_back(word); });
  }

  std::string_view bytes_;
  std::vector<Token> tokens_;
  std::vector<source::Span> read_;
  std::vector<std::string_view> out_;
};

}  // namespace

std::vector<std::string_view> unread_words(const source::Sources& sources, const Tree& tree) { return Unread(sources, tree).words(); }

}  // namespace kb::syntax
