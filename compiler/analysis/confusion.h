// Which perceived facts can be taken for one another, and at which readings.
//
// note [confusion]
// A definition is an `or` of `and`s of single readings, each a function of one sensor's value. So the greatest certainty that two
// facts can have at once is found exactly in the form: for each pair of their `and`s, each reading for itself takes the value
// at which the least certain of its parts is most certain; the least of these readings is what the pair can reach. Readings are
// taken as fresh: as wide as the sensor's noise. A fact that the host gives may have any certainty.
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
  std::string readings;     ///< "`compass` reads 225 deg": where they have it
};

/// How sure a perceived fact can be at all.
struct Surest {
  double degree = -1.0;
  std::string readings;     ///< "`compass` reads 225 deg": where it is
};

class Confusions {
 public:
  /// `program` must outlive it.
  explicit Confusions(const program::Program& program);
  ~Confusions();

  /// How much two perceived facts can be confused. Nothing is known of what is no more than `least` but that it is not more: most pairs are
  /// far from it, and cost a few hundred comparisons instead of a search. The first time each prototype costs some hundred evaluations.
  [[nodiscard]] Confusion between(program::CellId first, program::CellId second, double least = -2.0);
  /// The greatest certainty that the fact can have; or, if it is more than `enough`, one that is.
  [[nodiscard]] Surest surest(program::CellId fact, double enough);
  /// The greatest certainty that `yes` can have while `no` is certainly not so to the same degree; `least` as above.
  [[nodiscard]] double apart(program::CellId yes, program::CellId no, double least);
  /// Of a definition's `and`s, once it is written as an `or` of them, so many are looked into.
  static constexpr std::size_t kMostConjunctions = 512;
  /// Whether that is all of them.
  [[nodiscard]] bool looked_into(program::CellId fact);
  /// Whether both are made of some same reading.
  [[nodiscard]] bool share_readings(program::CellId first, program::CellId second) const;
  /// By the program's perceived facts: those before each that share a reading with it, ascending. They are asked for in order, each once.
  [[nodiscard]] std::vector<std::size_t> sharing_before(std::size_t perceived);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Every two perceived facts that share a reading, as a table of text: who, how much, and where.
[[nodiscard]] std::string print_confusion(const program::Program& program);

}  // namespace kb::analysis
