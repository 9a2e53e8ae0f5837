// Cells, rules and patterns by the names that people type.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "compiler/program/program.h"

namespace kb::trace {

/// One spelling for all spellings of a name: `Cross[right, mark]` and `Cross.right.mark`, `In[N]` and `In.N` are the
/// same.
[[nodiscard]] std::string plain_name(std::string_view name);

/// Finds cells by name in either spelling. Built once in O(cells).
class CellNames {
 public:
  /// `program` must outlive it.
  explicit CellNames(const program::Program& program);
  /// `CellId::kNone` if there is none.
  [[nodiscard]] program::CellId find(std::string_view name) const;
  /// The name nearest to `name` among the cells of one kind, or of any; of a group its first member.
  [[nodiscard]] std::optional<std::string> closest(std::string_view name,
                                                   std::optional<program::CellKind> kind = std::nullopt) const;
  /// The cells of one kind, or of any, that a group or a pattern means; empty if it is neither.
  [[nodiscard]] std::vector<std::string_view> members(std::string_view name, std::optional<program::CellKind> kind = std::nullopt) const;

 private:
  const program::Program& program_;
  std::unordered_map<std::string, program::CellId> cells_;  // by plain name; only looked up, never iterated
};

/// The cells that `names` means, separated by blanks: each is one cell, a group, for all of its members, or a pattern (see `matches`). Ascending.
/// Those that mean no cell are added to `vain`.
[[nodiscard]] std::vector<program::CellId> find_cells(const program::Program& program, std::string_view names, std::vector<std::string>* vain = nullptr);

/// The rules that `name` means: all instances of a template, or the one instance. Ascending; empty if there is none.
[[nodiscard]] std::vector<program::RuleId> find_rules(const program::Program& program, std::string_view name);
/// The name of a template or an instance that is nearest to `name`.
[[nodiscard]] std::optional<std::string> closest_rule(const program::Program& program, std::string_view name);

/// True if `pattern` (`*` any characters, `?` any one, all others themselves) matches all of `name`, in either
/// spelling. There may be several patterns separated by blanks, of which one has to match. O(pattern * name).
[[nodiscard]] bool matches(std::string_view pattern, std::string_view name);

/// True if one of the patterns is this name, in either spelling, without `*` and `?`.
[[nodiscard]] bool is_named(std::string_view pattern, std::string_view name);

/// The patterns in `pattern` that match no cell; all of `pattern`, if it is blank.
[[nodiscard]] std::vector<std::string> vain_patterns(const program::Program& program, std::string_view pattern);
/// The probable meaning of a pattern that matches no cell: the members of a group, several patterns joined by commas, a similar name.
[[nodiscard]] std::optional<std::string> meant_by(const program::Program& program, const std::string& pattern);

}  // namespace kb::trace
