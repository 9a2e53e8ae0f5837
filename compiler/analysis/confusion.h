// Which perceived facts can be taken for one another, and at which readings.
//
// note [confusion]
// A definition is an `or` of `and`s of single readings, each a function of one sensor's value. So the greatest certainty that two
// facts can have at once can be computed exactly. For each pair of their `and`s, every reading separately takes the value at which
// the least certain of its parts is most certain; the pair can reach the least of these. Readings are taken as fresh, that is, as
// wide as the sensor's noise. A fact that the host gives may have any certainty.
//
// note [exclusive facts]
// A reading grows wider with its age. Where it stands at x, a part with membership m(x) is certain by m(x) - 1 at least, and by m(x) at most,
// however old the reading is: possibility is m(x) at least, necessity m(x) at most. So two facts that at some age both reach a certainty of L
// can both reach L - 1 when fresh; if they cannot, they are exclusive. So are those of which each pair of `and`s has a part and its opposite.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compiler/program/program.h"

namespace kb::analysis {

/// Two perceived facts, `first` declared before `second`.
struct Confusion {
  program::CellId first{}, second{};
  double degree = -1.0;     ///< the greatest certainty that both can have at once
  std::string readings;     ///< "`compass` reads 225 deg": where that happens
};

/// The greatest certainty that a perceived fact can have.
struct Surest {
  double degree = -1.0;
  std::string readings;     ///< "`compass` reads 225 deg": where it has it
};

class Confusions {
 public:
  /// `program` must outlive it.
  explicit Confusions(const program::Program& program);
  ~Confusions();

  /// How much two perceived facts can be confused. A result of `least` or less says only that the true value is not more than `least`:
  /// most pairs are far below it and cost a few hundred comparisons instead of a search. The first use of each prototype costs some
  /// hundred evaluations.
  [[nodiscard]] Confusion between(program::CellId first, program::CellId second, double least = -2.0);
  /// The greatest certainty that the fact can have; or, if that is more than `enough`, some certainty above `enough` that it can have.
  [[nodiscard]] Surest surest(program::CellId fact, double enough);
  /// Whether `narrow` is a special case of `wide`: its definition speaks of `wide`; or `wide` is never less certain where `narrow` is
  /// likely, and at some readings is seen, above the certainty `seen`, while `narrow` is as certainly not so.
  [[nodiscard]] bool special_case(program::CellId narrow, program::CellId wide, double seen);
  /// Whether no readings, fresh or old, ever give both facts a certainty of `limit` or more: see note [exclusive facts]. `false` may also mean
  /// that it is not known. Facts of the host are exclusive with nothing.
  [[nodiscard]] bool exclusive(program::CellId first, program::CellId second, double limit);
  /// Whether comparing has taken so long that nothing is compared any more: `between` may find too little, and nothing is a special case or exclusive.
  [[nodiscard]] bool tired() const;
  /// Whether all `and`s of the fact's definition are examined.
  [[nodiscard]] bool looked_into(program::CellId fact);
  /// Whether some reading takes part in both definitions.
  [[nodiscard]] bool share_readings(program::CellId first, program::CellId second) const;
  /// Whether its definition asks for some reading of a number. To compare two such facts may cost some hundred evaluations.
  [[nodiscard]] bool reads_number(program::CellId fact) const;
  /// The perceived facts before this one that share a reading with it, ascending, as indexes into the program's perceived facts; without those
  /// that are another text of the same reading, if it is one as well. Must be called for each fact once, in order.
  [[nodiscard]] std::vector<std::size_t> sharing_before(std::size_t perceived);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Every two perceived facts that share a reading, as a table of text: which two, how much, and at which readings.
[[nodiscard]] std::string print_confusion(const program::Program& program);

}  // namespace kb::analysis
