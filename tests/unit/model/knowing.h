// Knowledge bases for tests: `.kb` text in memory, over the real standard library.
//
//   Known known("import std.basics\nfact Line\n");
//   EXPECT_EQ(known.said(), "");
//   EXPECT_TRUE(known.cell("sat Line"));
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compiler/model/model.h"

namespace kb::model::testing {

/// Everything that was said, one message a line: `main.kb:2:5: KB0401 nothing is called `Lin`` and, with two spaces before
/// them, its notes; a suggestion at the end of its message as ` -> Line`.
class Listener final : public diagnostics::Consumer {
 public:
  explicit Listener(const source::Sources& sources) : sources_(sources) {}
  void consume(const diagnostics::Diagnostic& diagnostic) override;
  [[nodiscard]] const std::string& said() const { return said_; }
  [[nodiscard]] const std::vector<diagnostics::Kind>& kinds() const { return kinds_; }

 private:
  const source::Sources& sources_;
  std::string said_;
  std::vector<diagnostics::Kind> kinds_;
};

class Known {
 public:
  /// `text` is the file `main.kb`; `others` are further files by name.
  explicit Known(std::string text, std::vector<std::pair<std::string, std::string>> others = {});

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const Forest& forest() const { return forest_; }
  [[nodiscard]] const source::Sources& sources() const { return sources_; }
  [[nodiscard]] const std::string& said() const { return listener_.said(); }
  /// Was a message of this kind given, and no other error?
  [[nodiscard]] bool said_only(diagnostics::Kind kind) const;
  [[nodiscard]] bool said(diagnostics::Kind kind) const;

  [[nodiscard]] const Cell* cell(std::string_view name) const;
  [[nodiscard]] const Rule* rule(std::string_view name) const;
  [[nodiscard]] const Row* row(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> rows(std::string_view relation) const;
  [[nodiscard]] std::size_t instances(std::string_view rule) const;
  /// The condition of a rule, and its effects, in words.
  [[nodiscard]] std::string condition(std::string_view rule) const;
  [[nodiscard]] std::string effects(std::string_view rule) const;
  /// A field of a row in words: a name, or a condition.
  [[nodiscard]] std::string field(std::string_view row, std::string_view name) const;
  /// Names of cells, joined.
  [[nodiscard]] std::string names(std::span<const CellId> cells) const;

 private:
  [[nodiscard]] std::string words(CondId id) const;
  source::Sources sources_;
  Listener listener_{sources_};
  Forest forest_;
  Model model_;
};

/// The labyrinth of the experiments, as text.
[[nodiscard]] std::string labyrinth();

}  // namespace kb::model::testing
