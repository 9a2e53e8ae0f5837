// Turns rows of a recording into the facts of ticks: as given, or perceived from readings.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/program/tick.h"
#include "compiler/tables/perception.h"
#include "tools/kbc/trace/engine.h"
#include "tools/kbc/trace/facts_csv.h"
#include "tools/kbc/trace/sighting.h"

namespace kb::trace {

/// Statistics of perception in a run: the work done, and bad readings.
struct Looks {
  std::uint64_t fits = 0, facts = 0, asleep = 0;
  std::uint64_t bad = 0;   ///< readings that were NaN, infinite or out of range, tick by tick
};

/// Perception for an engine. A row without readings passes through unchanged.
class Senses {
 public:
  /// `program` must outlive it. With kBoth the plain perception looks too and is compared.
  Senses(const program::Program& program, EngineKind kind);

  /// The facts of this row's tick. `value(cell)` is the certainty that a cell has after the last tick.
  template <class Value>
  std::span<const float> look(const FactsRow& row, Value value) {
    if (!row.has_readings) return row.facts;
    for (std::size_t i = program_.facts; i < cells_.size(); ++i) cells_[i] = value(program::CellId{static_cast<std::uint32_t>(i)});
    return look_at(row);
  }

  /// The perceived facts whose certainty the last look changed.
  [[nodiscard]] const std::vector<program::CellValue>& changed() const { return changed_; }
  /// Why a perceived fact has its certainty: its definition, and each of its readings and facts as the last look found them; or that it
  /// is lazy and asleep. Nothing for a given fact, and without readings.
  [[nodiscard]] std::optional<Sighting> explain(program::CellId fact) const;
  [[nodiscard]] const Looks& looks() const { return looks_; }
  /// How the two perceptions differ, in words; empty if they agree or there is only one.
  [[nodiscard]] const std::string& disagreement() const { return disagreement_; }

 private:
  std::span<const float> look_at(const FactsRow& row);
  /// A percept that is compared with a reading: the last one, and how certain that makes it.
  [[nodiscard]] Sighting::Part compared(program::PerceptId percept) const;

  const program::Program& program_;
  tables::PerceptionForm form_;
  tables::ReadingTable readings_;
  std::unique_ptr<tables::Looker> looker_, second_;
  std::vector<float> cells_, facts_, before_;
  std::vector<program::CellValue> changed_;
  Looks looks_;
  std::string disagreement_;
  std::int64_t now_us_ = 0;
  bool looked_ = false;
};

}  // namespace kb::trace
