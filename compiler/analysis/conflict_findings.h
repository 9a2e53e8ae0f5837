// What conflicts.cc finds, and how it is told.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/subject.h"

namespace kb::analysis {

/// A cell about which two rules disagree; if the other rule raises another cell of the same group, that cell as well.
struct Disagreement {
  program::CellId cell = program::CellId::kNone;
  program::CellId other = program::CellId::kNone;
};

constexpr std::size_t kMostCounted = 1'000;  ///< conflicts of one pair of rules as written

/// Two rules, as written, that disagree: their first instances, and how many pairs of instances disagree.
struct Finding {
  program::RuleId first = program::RuleId::kNone, second = program::RuleId::kNone;
  Disagreement about;
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;   ///< of instances; a pair may disagree about several cells
};

using Findings = std::map<std::pair<std::uint32_t, std::uint32_t>, Finding>;   // by families

/// note [many rules about one thing]
/// Of n rules that raise members of one group nearly n * n / 2 pairs may disagree, and what settles one mostly settles all. So of the pairs of one
/// level about one cell or group only the first few are told, and the last of these says how many more there are. Pairs that nobody would be told
/// of, such as those that a comment allows, do not count.
void report_conflicts(const Subject& subject, Satisfier& satisfier, const Findings& found);

}  // namespace kb::analysis
