// What each name in a text stands for, told by where it stands: of a fact `left` and a member `left` of a set the letters are the same.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "compiler/driver/compile.h"
#include "compiler/model/known_names.h"

namespace kb::lsp {

/// Names of one space and owner that are written alike stand for one thing.
struct Meaning {
  enum class Space : std::uint8_t {
    kName,        ///< cells, groups, sets, relations, rows, tables, maps, prototypes, sensors, fuzzy controllers
    kLevel,
    kRule,
    kMember,      ///< of a finite set; `owner`: its number in the model
    kField,       ///< of a relation; `owner`: its number in the model
    kVariable,    ///< of a rule, a `perceive` or a `control`; `owner`: where that stands
    kInput, kOutput,   ///< `owner`: the how manieth fuzzy block it is of
    kTerm,        ///< `owner`: that, and the how manieth input or output of it
    kController,  ///< that no fuzzy block is: of Waymark, or of the user's program
    kArgument,    ///< `owner`: which of these it is of
  };
  Space space = Space::kName;
  std::uint64_t owner = 0;
  friend bool operator==(const Meaning&, const Meaning&) = default;
};

struct Use {
  source::Span span;
  Meaning meaning;
  bool declares = false;
};

/// All places of names, in order of files and texts. Words that only a program understands are none, such as the `right` of `side: right`. Certain of a
/// knowledge base without errors. `names`: of its model. O(its text).
[[nodiscard]] std::vector<Use> uses(const driver::Compilation& compiled, const std::vector<model::KnownName>& names);

[[nodiscard]] std::optional<model::RelationId> relation_called(const model::Model& model, std::string_view name);
/// The set of which that field of roads holds members: `exit`, `by`; nothing where no road has one.
[[nodiscard]] std::optional<model::SetId> set_of_roads(const model::Model& model, std::string_view field);
/// The relation whose rows that field holds; nothing if it holds something else, or nobody knows. O(rows).
[[nodiscard]] std::optional<model::RelationId> rows_in(const model::Model& model, model::RelationId relation, std::string_view field);

/// Whether the byte can be part of a name; of letters that are not ASCII only the lexer knows more.
[[nodiscard]] constexpr bool in_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || (static_cast<unsigned char>(c) & 0x80u) != 0;
}

}  // namespace kb::lsp
