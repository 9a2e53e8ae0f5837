// Rules of a fuzzy controller that earlier ones make needless. Private to this folder.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compiler/fuzzy/controller.h"

namespace kb::analysis {

/// An earlier rule that shadows another; `same`: both have the same condition.
struct Shadow {
  std::uint32_t rule = 0;
  bool same = false;
};

/// note [conditions as parts]
///   A condition is compared as the set of the parts of its `and`, nests included; a part that is an `or` has alternatives, each a
///   set of parts. The order of operands has no meaning. A rule holds no more strongly than another if each part of the other is
///   one of its own, or an `or` with an alternative that it has, or an `or` with all alternatives of one of its own. This finds not
///   all cases, but each that it finds is real, whichever operators the block takes.
class FuzzyShadows {
 public:
  explicit FuzzyShadows(const fuzzy::Controller& controller);

  /// The earliest rule before `later` that shadows it. Must be called for the rules in order; rules left out shadow nothing.
  [[nodiscard]] std::optional<Shadow> next(std::uint32_t later);

 private:
  using Parts = std::vector<std::uint32_t>;   // numbers of parts, ascending
  using Texts = std::map<std::string, std::uint32_t>;

  [[nodiscard]] std::string key(std::uint32_t node) const;
  void operands(std::uint32_t node, fuzzy::Node::Op op, std::vector<std::uint32_t>& to) const;
  std::uint32_t number(std::uint32_t node, Texts& texts);
  Parts parts(const std::vector<std::uint32_t>& nodes, Texts& texts);
  [[nodiscard]] Parts handles(std::uint32_t rule) const;
  [[nodiscard]] Parts questions(std::uint32_t rule) const;
  [[nodiscard]] bool never_weaker(std::uint32_t first, std::uint32_t later) const;
  [[nodiscard]] bool shadows(std::uint32_t first, std::uint32_t later) const;

  const fuzzy::Controller& c_;
  std::vector<std::vector<Parts>> alternatives_;               // by part: those of an `or`, ascending
  std::vector<std::uint32_t> uses_;                            // by part: how many rules have it
  std::vector<Parts> of_;                                      // by rule
  std::map<std::uint32_t, std::vector<std::uint32_t>> rules_;  // by part: earlier rules that can be found by it, ascending
};

}  // namespace kb::analysis
