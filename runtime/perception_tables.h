// The tables of perception, as the compiler makes them; perception.h reads them.
#pragma once

#include <cstdint>

#include "shape.h"
#include "table.h"

namespace mts {

/// The most values on the stack while one fact is computed: two for each of the 64 levels of parentheses.
inline constexpr std::uint32_t kMaxPerceptDepth = 132;

/// One sensor; all elements of an array share it. For `kText`, of `noise` and the fields after it only `stale_s` has a meaning.
struct Sensor {
  float low = 0.0f, high = 0.0f;
  float period = 0.0f;    ///< circular: high - low, else 0
  float noise = 0.0f;     ///< spread of a fresh reading, >= 0
  float growth = 0.0f;    ///< growth of the squared spread per second: see aged_spread
  float stale_s = 0.0f;   ///< age from which a reading counts as stale; infinity: never
  bool text = false;
  bool strict = false;    ///< a reading outside of the range is none; else it is taken into the range
};

template <class Ix>
struct FitRow { Ix reading, prototype; };   ///< of a text: its number, from 1, in place of the prototype

enum class PerceptOp : std::uint8_t {
  kFits,   ///< pushes a reading against a prototype; `argument` into `fits`
  kReads,  ///< pushes a text against a text; `argument` into `fits`
  kFact,   ///< pushes a fact's certainty; `argument` a perceived fact before this one, or `facts` + a given fact. The last that pushes
  kNot,    ///< the top becomes its negative
  kAnd,    ///< the two on top become the smaller one
  kOr,     ///< ... the larger one
};
template <class Ix>
struct PerceptStep { PerceptOp op; Ix argument; };

/// A term of a cell that must hold, or must not: `term` 0 low, 1 zero, 2 high.
template <class Ix>
struct Demand { Ix cell; std::uint8_t term; bool negated; };

struct PerceptionShape {
  std::uint32_t readings = 0, fits = 0, facts = 0;
  std::uint32_t lazy = 0;   ///< how many of the facts
};

/// Everything that perception knows. Arrays indexed by the next item's beginning have one item more than their count.
template <class Ix>
struct PerceptionTables {
  std::uint32_t abi = kAbi;
  PerceptionShape shape;
  const Sensor* sensors = nullptr;
  const Ix* sensor_of = nullptr;            // readings
  const Membership* prototypes = nullptr;
  const Ix* fits_begin = nullptr;           // readings + 1: into `fits`, which is ordered by reading
  const FitRow<Ix>* fits = nullptr;
  const Ix* fact = nullptr;                 // perceived facts, those that others are defined by first: the fact of the mind
  const Ix* steps_begin = nullptr;          // facts + 1
  const PerceptStep<Ix>* steps = nullptr;   // postfix
  const std::uint8_t* lazy = nullptr;      // facts; null if none is lazy, and then so are all that follow
  const Ix* uses_begin = nullptr;           // facts + 1: into `uses`
  const Ix* uses = nullptr;                 // lazy facts that the fact is defined by
  const Ix* alternatives_begin = nullptr;   // facts + 1: into `demands_begin`
  const Ix* demands_begin = nullptr;        // alternatives + 1: into `demands`
  const Demand<Ix>* demands = nullptr;
};

}  // namespace mts
