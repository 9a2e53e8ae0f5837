#include "compiler/program/program.h"

#include <algorithm>

#include "compiler/program/tick.h"

namespace kb::program {

RuleRange rules_of(const Program& program, std::uint32_t level) {
  const auto first_of = [&](std::uint32_t wanted) {
    const auto first = std::partition_point(program.rules.begin(), program.rules.end(), [wanted](const Rule& rule) { return rule.level < wanted; });
    return static_cast<std::uint32_t>(first - program.rules.begin());
  };
  return {first_of(level), first_of(level + 1)};
}

Thresholds thresholds(const Cell& fact) {
  return {static_cast<float>(fact.event), static_cast<float>(fact.event - fact.attention)};
}

const char* status_text(Status status) {
  switch (status) {
    case Status::kOk: return "ok";
    case Status::kNoStrategy: return "no_strategy";
    case Status::kHolding: return "holding";
    case Status::kHoldExpired: return "hold_expired";
    case Status::kBadFact: return "bad_fact";
    case Status::kConflict: return "conflict";
    case Status::kTwoStrategies: return "two_strategies";
  }
  return "unknown";
}

}  // namespace kb::program
