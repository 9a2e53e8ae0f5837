// Planes that need not be kept, because they follow from others.
//
// note [derived planes]
// After a tick a plane often repeats what others say: a rule is disarmed exactly if a timer is over, a strategy is active exactly if
// its satellite is high and none of those before it is. Such a plane is *derived*: kernels and hosts compute its bits from the
// others, and a tick neither reads nor writes it. The relation must hold for every robot and tick, so the value after a tick has to
// be an expression of values that the same tick leaves in kept planes; a value that depends on the tick's facts or on the state
// before it does not qualify. Before the first tick all derived planes are 0. A tick on which rules contradict each other may leave
// values that no kernel would; such a robot stays with the scalar engine until its derived planes are right again.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/tables/fleet.h"

namespace kb::tables {

struct DerivedPlanes {
  /// A plane that is kept, or `a & b` of parts before this one (`part << 1 | negated`).
  struct Part {
    bool kept = false;
    FleetPlane plane{};
    Ref a = kZeros, b = kZeros;
  };
  struct Root {
    std::uint32_t part = 0;   ///< 0: the plane is 0 at all times
    bool later = false;       ///< on the first tick the parts give 1, but the plane is 0
  };
  std::vector<Part> parts{Part{}};   ///< the first is 0 at all times
  std::map<PlaneKey, Root> roots;
};

/// Pure. `form`: built without derived planes. Cost: linear in its steps.
[[nodiscard]] DerivedPlanes derived_planes(const FleetForm& form, const program::Program& program);

}  // namespace kb::tables
