// Where the rules of a fuzzy controller fire: an exact search over regions of its inputs. Private to this folder.
//
// note [regions of a fuzzy controller]
//   Whether a degree is 0, 1 or between changes only at the corners of its shape. So the corners cut the range of an input
//   into points and open intervals, and on each of them every term is in one of three states. A region takes one of these
//   pieces for each input, and whether a condition holds at all (is above 0) is then a Boolean question: `a and b` is above
//   0 if both are, `not a` is if a is not 1, and so on; this is exact for min and product, max and sum. The search sets
//   inputs one by one, beginning with those that the question depends on, and after each asks in three-valued logic whether
//   the answer is already known.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiler/fuzzy/controller.h"

namespace kb::analysis {

/// A point, or an open interval.
struct Stretch {
  double low = 0.0, high = 0.0;          ///< equal: a point
  [[nodiscard]] double middle() const { return 0.5 * (low + high); }
};

/// All of one input's range on which its terms have the same states.
struct Piece {
  std::vector<Stretch> at;               ///< intervals before points, because they are better examples
  std::vector<std::uint8_t> states;      ///< by term: 0 not at all, 1 between, 2 completely
};

/// A result of the search: for each slot the pieces that it may lie in, ascending; none where it does not matter.
struct Region {
  std::vector<std::vector<std::uint32_t>> pieces;
  friend bool operator==(const Region&, const Region&) = default;
};

/// The places where the state of a shape changes; of smooth shapes, where it is 1 or becomes 0 in float.
void add_corners(const fuzzy::Shape& shape, std::vector<double>& to);

class FuzzyRegions {
 public:
  explicit FuzzyRegions(const fuzzy::Controller& controller);

  /// Regions where no rule that writes `output` fires. Empty only if there is none, or if the search was given up.
  [[nodiscard]] std::vector<Region> gaps(std::uint32_t output);
  /// Whether the rule fires anywhere.
  [[nodiscard]] bool fires(std::uint32_t rule);
  /// A search was given up because it cost too much; `gaps` then found not all, and `fires` answered true.
  [[nodiscard]] bool gave_up() const { return gave_up_; }

  /// "`bearing` lies between 45 and 90 deg and `free[0]` is 0.5", and a point of it: "bearing = 67.5 deg, free[0] = 0.5".
  [[nodiscard]] std::string text(const Region& region) const;
  [[nodiscard]] std::string witness(const Region& region) const;

 private:
  /// What is known of a degree or condition: whether it is above 0, and whether it is 1.
  struct Known { bool surely_above = false, maybe_above = true, surely_one = false, maybe_one = true; };

  [[nodiscard]] Known known(std::uint32_t node) const;
  [[nodiscard]] Known known_rule(const fuzzy::Rule& rule) const;
  [[nodiscard]] std::uint32_t open_slot(std::uint32_t node) const;
  [[nodiscard]] std::uint32_t open_slot(const fuzzy::Rule& rule) const;
  [[nodiscard]] const std::vector<Piece>& pieces_of(std::uint32_t slot) const { return pieces_[input_of_slot(c_, slot)]; }
  void search_gaps(const std::vector<std::uint32_t>& writers, std::vector<Region>& found);
  [[nodiscard]] Region widest(const std::vector<std::uint32_t>& writers);
  void join(std::vector<Region>& regions) const;
  bool search_fire(const fuzzy::Rule& rule);
  [[nodiscard]] bool none_fires(const std::vector<std::uint32_t>& writers) const;
  [[nodiscard]] bool spend();

  const fuzzy::Controller& c_;
  std::vector<std::vector<Piece>> pieces_;   // by input
  std::vector<Known> unset_;                 // by degree: over all pieces
  std::vector<std::uint32_t> set_;           // by slot: its piece, kNone if it is not set
  std::size_t steps_ = 0;
  bool gave_up_ = false;
};

}  // namespace kb::analysis
