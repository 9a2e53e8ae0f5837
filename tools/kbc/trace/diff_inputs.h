// One recording for two knowledge bases: what it may name, and what each of them takes of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compiler/program/program.h"
#include "tools/kbc/trace/facts_csv.h"

namespace kb::trace {

/// A program that has the facts and sensors of both, the old one's first, and no rules: what a recording for both is read
/// with. Perceived in it is what no recording of readings needs to give: what is perceived by each that has the fact.
[[nodiscard]] program::Program union_of_inputs(const program::Program& before, const program::Program& after);

/// A name that cannot be one column of readings for both: texts and numbers, metres and degrees, a sensor and a given fact.
struct TornColumn { std::string name, before, after; };
/// The first there is.
[[nodiscard]] std::optional<TornColumn> torn_column(const program::Program& before, const program::Program& after);

/// What one of the two takes of a row that was read with the union.
class Share {
 public:
  Share(const program::Program& program, const program::Program& all);
  /// In the program's own numbers. Valid until the next call.
  [[nodiscard]] const FactsRow& of(const FactsRow& row);

 private:
  /// Of a reading of the union: its number here, or kNone, and of each text the number here.
  struct Reading {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    std::uint32_t here = kNone;
    std::vector<float> texts;
  };

  std::vector<std::size_t> facts_;   // of each fact, its place in the union
  std::vector<Reading> readings_;
  std::vector<float> given_;
  std::vector<ReadingUpdate> updates_;
  FactsRow row_;
};

}  // namespace kb::trace
