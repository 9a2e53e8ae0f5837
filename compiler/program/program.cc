#include "compiler/program/program.h"

#include "compiler/program/tick.h"

namespace kb::program {

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
