// How facts are perceived: sensors, what their readings are compared with, and the facts defined by that.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiler/fuzzy/shape.h"
#include "compiler/source/kinds.h"
#include "compiler/source/source.h"

namespace kb::program {

enum class CellId : std::uint32_t;
enum class CondId : std::uint32_t;
struct Program;

enum class PerceptId : std::uint32_t {};

/// A sensor; its elements are the readings `first` to `first + count - 1`.
struct Sensor {
  std::string name;
  bool text = false;
  bool array = false;
  double low = 0.0, high = 0.0;      ///< SI, degrees kept
  std::string unit;
  bool circular = false;
  double noise = 0.0;
  std::optional<double> stale_s;     ///< none: readings do not age
  double growth = 0.0;               ///< how much the square of the spread grows a second; see note [how readings age]
  std::uint32_t first = 0, count = 1;
  std::vector<std::string> texts;    ///< those that some fact asks for, ascending
  source::Span declared;
  bool strict = false;               ///< a reading outside of the range is none
};

/// note [how readings age]
/// The square of a reading's spread grows evenly, like that of a random walk. It begins at the square of the noise and reaches the
/// square of half the range at the age `stale`: growth = ((range/2)^2 - noise^2) / stale. A reading of that age is about as wide
/// as the sensor's whole range, so hardly anything follows from it, and its certainty of fitting anything is near 0.
[[nodiscard]] double growth_of(const Sensor& sensor);

struct Prototype { fuzzy::Shape shape; std::string text; };

/// A part of what defines a fact; parts stand before the whole.
struct Percept {
  using Op = PerceptOp;
  Op op = Op::kAnd;
  std::uint32_t reading = 0;          ///< kFits, kReads
  std::uint32_t prototype = 0;        ///< kFits
  std::string text;                   ///< kReads
  CellId cell{};                      ///< kFact
  std::vector<PerceptId> children;
};

struct Perceived {
  CellId fact{};
  PerceptId percept{};
  bool lazy = false;
  source::Span span;
};

struct Perception {
  std::vector<Sensor> sensors;
  std::vector<Prototype> prototypes;
  std::vector<Percept> percepts;
  std::vector<Perceived> perceived;   ///< a fact stands after those that define it

  [[nodiscard]] bool empty() const { return perceived.empty() && sensors.empty(); }
  [[nodiscard]] std::uint32_t readings() const { return sensors.empty() ? 0 : sensors.back().first + sensors.back().count; }
  [[nodiscard]] const Percept& operator[](PerceptId id) const { return percepts[static_cast<std::size_t>(id)]; }
  /// Ascending by their places in `perceived`.
  [[nodiscard]] std::vector<CellId> lazy_facts() const;
  /// The sensor that a reading belongs to.
  [[nodiscard]] const Sensor& sensor_of(std::uint32_t reading) const;
  /// `compass`, `line[0]`.
  [[nodiscard]] std::string reading_name(std::uint32_t reading) const;
};

/// A term of a satellite that must hold, or must not.
struct Demand { CellId cell{}; Term term{}; bool negated = false; };

/// note [waiting for a fact]
/// A lazy fact is waited for if one of its alternatives holds in the satellites as the last tick left them. An alternative is one
/// of its own satellites being high; or, for a rule that reads the fact, everything that the rule's condition asks of satellites as
/// plain parts of its `and` (`X`, `not X`, `X is low`). A rule whose demands are not met can fire on this tick only if a higher
/// level meets them first; the fact is then looked at from the next tick on.
using Alternatives = std::vector<std::vector<Demand>>;
/// The alternatives of each of `facts`, in their order. Cost: linear in the conditions, and in what is returned.
[[nodiscard]] std::vector<Alternatives> alternatives(const Program& program, std::span<const CellId> facts);

/// What a condition asks of satellites as plain parts of its `and`.
[[nodiscard]] std::vector<Demand> demands(const Program& program, CondId condition);

/// What defines a fact, in the language's own words.
[[nodiscard]] std::string percept_text(const Program& program, PerceptId percept);

}  // namespace kb::program
