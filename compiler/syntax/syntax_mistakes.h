// Well-known mistakes of syntax, one function for each.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "compiler/syntax/expectation.h"
#include "compiler/syntax/syntax_error.h"
#include "compiler/syntax/words.h"

namespace kb::syntax {

// One error. Each `is_...` looks for one well-known mistake and reports it if found; `report` tries them in the order in which
// they stand here, from the certain to the likely.
class SyntaxError {
 public:
  SyntaxError(const TokenStream& stream, const TokenSet& expected, diagnostics::Diagnostics& diagnostics)
      : stream_(stream),
        expected_(expected),
        diagnostics_(diagnostics),
        found_(stream.behind(0)),
        kind_(found_.kind),
        last_(stream.behind(1)),
        statement_(stream.statement().kind) {}

  void report();

 private:
  [[nodiscard]] bool is_comment();
  [[nodiscard]] bool is_import();
  [[nodiscard]] bool is_decimal_comma();
  [[nodiscard]] bool is_decimal_comma_in_place();
  bool say_decimal_comma(source::Span number);
  [[nodiscard]] bool is_hyphen();
  [[nodiscard]] bool is_name_behind_attributes();
  [[nodiscard]] bool is_late_of();
  [[nodiscard]] bool is_trailing_comma();
  [[nodiscard]] bool is_row_without_fields();
  [[nodiscard]] bool is_empty_list();
  [[nodiscard]] bool is_range();
  [[nodiscard]] bool is_fuzzy();
  [[nodiscard]] bool is_bracket();
  [[nodiscard]] bool is_unknown_statement();
  [[nodiscard]] bool is_names_as_set();
  [[nodiscard]] bool is_other_bracket();
  [[nodiscard]] bool is_map_line();
  [[nodiscard]] bool is_rule_head();
  [[nodiscard]] bool is_percept();
  [[nodiscard]] bool is_condition();
  [[nodiscard]] bool is_comparison();
  [[nodiscard]] bool is_variable(const Token& name) const;
  [[nodiscard]] bool is_operator();
  [[nodiscard]] bool is_dotted_term();
  void note_member(diagnostics::Builder& message, const Token& group, const Token& member, bool negated) const;
  [[nodiscard]] bool is_effect();
  [[nodiscard]] bool is_called();
  [[nodiscard]] bool is_effect_value();
  [[nodiscard]] bool is_effect_member(source::Span effect, std::string_view group);
  [[nodiscard]] bool is_verb(source::Span effect);
  [[nodiscard]] bool is_unsigned_effect();
  [[nodiscard]] bool is_route();
  [[nodiscard]] bool is_road();
  [[nodiscard]] bool is_order();
  [[nodiscard]] bool is_quoted_name();
  [[nodiscard]] bool is_missing_comma();
  [[nodiscard]] bool is_type();
  [[nodiscard]] bool is_unknown_attribute();
  [[nodiscard]] bool is_word_as_name();
  void report_unexpected();

  bool say(diagnostics::Kind kind, source::Span at, std::initializer_list<std::string_view> arguments = {}) {
    diagnostics_.report(kind, at, arguments);
    return true;
  }
  [[nodiscard]] std::string_view text(source::Span span) const { return stream_.sources().text(span); }
  [[nodiscard]] std::string_view text() const { return text(found_.span); }
  [[nodiscard]] std::string found() const { return found_text(stream_.sources(), found_); }
  [[nodiscard]] std::string wanted() const { return expectation(stream_, expected_); }
  [[nodiscard]] bool wants(TokenKind kind) const { return expected_.contains(kind); }
  // Whether the statement has ended too early.
  [[nodiscard]] bool at_end() const { return kind_ == TokenKind::kEnd || (found_.begins_statement && found_.begins_line); }
  // Where something is missing: for a statement that ends too early, at its own end, not where the next begins.
  [[nodiscard]] source::Span place() const {
    return !at_end() || !last_.span.known() ? found_.span : behind_last();
  }
  [[nodiscard]] source::Span behind_last() const { return {last_.span.file, last_.span.end, last_.span.end}; }
  [[nodiscard]] std::optional<std::string> near_expected_word() const;
  [[nodiscard]] source::Span effect_so_far() const;
  [[nodiscard]] std::optional<source::Span> early_weight() const;
  [[nodiscard]] source::Span last_name_ahead() const;

  const TokenStream& stream_;
  const TokenSet& expected_;
  diagnostics::Diagnostics& diagnostics_;
  const Token found_;
  const TokenKind kind_;
  const Token last_;
  const TokenKind statement_;
};

}  // namespace kb::syntax
