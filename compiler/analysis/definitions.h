// The definitions of perceived facts, each written as an `or` of `and`s of single readings. Private to this folder.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "compiler/program/program.h"

namespace kb::analysis {

/// A reading compared with a prototype or a text, or a fact that the host gives.
struct Literal {
  bool given = false;
  std::uint32_t subject = 0;     // reading, or cell
  std::uint32_t prototype = 0;
  std::string text;
  bool negated = false;
  friend auto operator<=>(const Literal&, const Literal&) = default;
};
using Conjunction = std::vector<Literal>;   ///< ascending, each once
using Disjunction = std::vector<Conjunction>;

/// The definition of a fact, or of its opposite, as an `or` of `and`s; `cut`: it has more of them, or longer ones, than are looked at.
struct Definition {
  Disjunction terms;
  bool cut = false;
  friend auto operator<=>(const Definition&, const Definition&) = default;
};

class Definitions {
 public:
  /// At most so many `and`s of a definition are kept, and looked into, and only those of at most so many parts.
  static constexpr std::size_t kMostTerms = 512, kMostParts = 256;
  /// Once all that are kept have so many parts, of each further definition a single `and` is kept.
  static constexpr std::size_t kMostKept = 1'000'000;

  /// `program` must outlive it.
  explicit Definitions(const program::Program& program);

  /// The definition of a perceived fact, or of its opposite; equal definitions are the same object. Cost: the first time, the size of
  /// what is returned and of all definitions that it is built of.
  const Definition& of(program::CellId fact, bool negated);
  /// Where the fact stands among the program's perceived facts; none if the host gives it.
  [[nodiscard]] std::optional<std::size_t> place(program::CellId fact) const;
  /// Whether the definition of `fact` speaks of `part`, itself or through other facts.
  [[nodiscard]] bool built_on(program::CellId fact, program::CellId part) const;

 private:
  using Polar = std::pair<program::CellId, bool>;   // a fact, or its opposite

  Disjunction expand(program::PerceptId id, bool negated);
  Disjunction product(const Disjunction& a, const Disjunction& b);
  void find_parts(program::PerceptId id, bool negated, std::vector<Polar>& found) const;
  void find_facts(program::PerceptId id, std::vector<program::CellId>& found) const;

  const program::Program& program_;
  std::map<program::CellId, std::size_t> place_;
  std::set<Definition> definitions_;   // each once
  std::map<Polar, const Definition*> expanded_;
  std::size_t kept_ = 0;               // parts of all definitions
  bool cut_ = false;                   // the definition that is being expanded has more `and`s than are kept, or longer ones
};

}  // namespace kb::analysis
