// What each name in a text stands for. Its place decides: a fact `left` and a member `left` of a set are spelt alike.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "compiler/driver/compile.h"
#include "compiler/model/known_names.h"
#include "compiler/source/encoding.h"

namespace kb::lsp {

/// Equal names with the same space and owner stand for one thing.
struct Meaning {
  enum class Space : std::uint8_t {
    kName,        ///< cells, groups, sets, relations, rows, tables, maps, prototypes, sensors, fuzzy controllers
    kLevel,
    kRule,
    kMember,      ///< of a finite set; `owner`: its number in the model
    kField,       ///< of a relation; `owner`: its number in the model
    kVariable,    ///< of a rule, a `perceive` or a `control`; `owner`: the place of that
    kInput, kOutput,   ///< `owner`: the number of its fuzzy block
    kTerm,        ///< `owner`: the number of its fuzzy block, and that of its input or output
    kController,  ///< one that is no fuzzy block: Waymark's, or of the user's program
    kArgument,    ///< `owner`: the number of its controller
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

/// All places of names, in order of files and texts. Words that only a controller understands, such as the `right` of `side: right`, are
/// not names. Reliable only for a knowledge base without errors. `names`: those of its model. O(its text).
[[nodiscard]] std::vector<Use> uses(const driver::Compilation& compiled, const std::vector<model::KnownName>& names);

[[nodiscard]] std::optional<model::RelationId> relation_called(const model::Model& model, std::string_view name);
/// The set whose members that field of roads holds (`exit`, `by`); nothing if no road has the field.
[[nodiscard]] std::optional<model::SetId> set_of_roads(const model::Model& model, std::string_view field);
/// The relation whose rows that field holds; nothing if it holds something else, or that is unknown. O(rows).
[[nodiscard]] std::optional<model::RelationId> rows_in(const model::Model& model, model::RelationId relation, std::string_view field);

/// Whether the byte can be part of a name; for letters beyond ASCII only the lexer knows for certain.
[[nodiscard]] constexpr bool in_name(char c) { return source::is_letter_or_digit(c) || c == '_' || (static_cast<unsigned char>(c) & 0x80u) != 0; }

}  // namespace kb::lsp
