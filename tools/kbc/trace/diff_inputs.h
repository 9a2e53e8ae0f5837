// One recording for two knowledge bases: the names that it may use, and what each of them takes from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compiler/program/program.h"
#include "tools/kbc/trace/facts_csv.h"

namespace kb::trace {

/// A program with the facts and sensors of both, the old one's first, and no rules; a recording for both is read with it. A fact is
/// perceived in it, so that a recording of readings need not give it, if each program that has the fact perceives it.
[[nodiscard]] program::Program union_of_inputs(const program::Program& before, const program::Program& after);

/// A name that cannot be one column of readings for both: texts and numbers, metres and degrees, a sensor and a given fact.
struct TornColumn { std::string name, before, after; };
/// The first such column, if any.
[[nodiscard]] std::optional<TornColumn> torn_column(const program::Program& before, const program::Program& after);

/// The part of a row, read with the union, that one of the two takes.
class Share {
 public:
  Share(const program::Program& program, const program::Program& all);
  /// In the program's own numbers. Valid until the next call.
  [[nodiscard]] const FactsRow& of(const FactsRow& row);

 private:
  /// For a reading of the union: its number here, or kNone, and the number here of each text.
  struct Reading {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    std::uint32_t here = kNone;
    std::vector<float> texts;
  };

  std::vector<std::size_t> facts_;   // by fact: its place in the union
  std::vector<Reading> readings_;
  std::vector<float> given_;
  std::vector<ReadingUpdate> updates_;
  FactsRow row_;
};

}  // namespace kb::trace
