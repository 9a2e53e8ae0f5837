// What each name in a text stands for, told by where it stands: of a fact `left` and a member `left` of a set the letters are the same.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "tools/kbc/lsp/workspace.h"

namespace kb::lsp {

/// Names of one space and owner that are written alike stand for one thing.
struct Meaning {
  enum class Space : std::uint8_t {
    kName,      ///< cells, groups, sets, relations, rows, tables, maps, prototypes, sensors, fuzzy controllers
    kLevel,
    kRule,
    kMember,    ///< of a finite set; `owner`: its number in the model
    kVariable,  ///< of a rule, a `perceive` or a `control`; `owner`: where that stands
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

/// All places where `text` is a name of one of these kinds, in order of files and texts. Fields, what belongs to a fuzzy block, and words that
/// only the program understands are none. Certain of a knowledge base without errors. O(its text).
[[nodiscard]] std::vector<Use> uses(const Knowledge& knowledge, std::string_view text);
/// Those that mean the same as the one at byte `begin` of the file at `path`, which is in canonical form; none if there is none.
[[nodiscard]] std::vector<Use> uses_of_same(const Knowledge& knowledge, std::string_view text, std::string_view path, std::uint32_t begin);

}  // namespace kb::lsp
