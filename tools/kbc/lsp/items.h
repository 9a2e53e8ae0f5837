// The items of a completion. Private to completion.
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "compiler/model/model.h"
#include "compiler/syntax/syntax.h"
#include "tools/kbc/lsp/answers.h"

namespace kb::lsp {

inline constexpr int kText = 1, kField = 5, kUnit = 11, kKeyword = 14, kMember = 20;   ///< of CompletionItemKind

/// A list of items with each label once.
class Items {
 public:
  void add(std::string_view label, int kind, std::string detail = {}) {
    if (!labels_.insert(std::string(label)).second) return;
    all_.push_back({{"label", label}, {"kind", kind}});
    if (!detail.empty()) all_.back()["detail"] = std::move(detail);
  }
  [[nodiscard]] Json take() { return std::move(all_); }

 private:
  std::set<std::string> labels_;
  Json all_ = Json::array();
};

/// The exits of roads or, if there is no road yet, the directions of the standard library. Null if there are none.
[[nodiscard]] const model::FiniteSet* exits(const model::Model& model);

/// What the grammar accepts at `offset`, where a name begins: words, and names of the kinds that can stand there.
[[nodiscard]] Json wanted(const OpenFile& file, std::span<const syntax::Lexeme> lexemes, std::uint32_t offset);

}  // namespace kb::lsp
