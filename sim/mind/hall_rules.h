// A fuzzy controller of the knowledge base that crosses halls: the rules behind `control Move.open = GoToGoal()`.
#pragma once

#include <vector>

#include <waymark/controllers/host.h>
#include "compiler/diagnostics/diagnostics.h"
#include "compiler/program/program.h"
#include "compiler/tables/fuzzy.h"

namespace kb::sim {

/// Whether a fuzzy controller has the inputs `bearing` (degrees, all of them) and `free[8]` (0 to 1) and the outputs `turn` (degrees) and
/// `speed` (0 to 1), and no other inputs except those that the control line fixes. Reports what is missing (KB1323).
[[nodiscard]] bool check_rules(const fuzzy::Controller& controller, const program::Control& control, diagnostics::Diagnostics& diagnostics);

class HallRules {
 public:
  /// The controller must have passed `check_rules`.
  HallRules(const fuzzy::Controller& controller, const program::Control& control);
  /// mts::Host::decide.
  [[nodiscard]] mts::RulesOutput decide(const mts::RulesInput& input);

 private:
  tables::FuzzyForm form_;
  std::vector<float> numbers_;       // by slot; fixed ones stay as they are
  std::uint32_t bearing_ = 0, free_ = 0, turn_ = 0, speed_ = 0;
  bool bearing_fixed_ = false;
};

}  // namespace kb::sim
