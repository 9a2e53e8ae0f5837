// Bit operations on planes, each made once: a fleet's kernel is built of them (fleet.h).
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace kb::tables {

/// One bit for each robot, at one moment of a tick: an operation of the kernel, perhaps negated (`operation << 1 | negated`).
using Ref = std::uint32_t;
inline constexpr Ref kZeros = 0, kOnes = 1;

/// One step of the kernel. Values are numbered by their place in the list of steps.
struct FleetStep {
  enum class Kind : std::uint8_t {
    kZero,     ///< step 0
    kLoad,     ///< the plane `what`, as the last tick or the host left it
    kLater,    ///< all ones, except on the first tick
    kAnd,      ///< a & b; no operand is negated
    kOr,       ///< a | b
    kAndNot,   ///< a & ~b
    kTimer,    ///< whether timer `what` is over; a: its condition, b: the condition on the last tick, c: whether it was over
    kHold,     ///< whether the last strategy has been held too long; a: none is active and one is held; b, c as for kTimer
    kPut,      ///< a becomes the plane `what`
    kFallBack, ///< the robots of a are left to the scalar engine on this tick, beside those of earlier kFallBack steps
    kWake,     ///< of a resting kernel: in the robots of a, planes that were at rest change; it gives up if there are any
    kTraced,   ///< all further steps are for traced fleets only
    kLevel,    ///< a remark: level `what` begins here
    kFire,     ///< a remark: rule `what` fires for the robots of a
  };
  Kind kind = Kind::kZero;
  std::uint32_t what = 0;
  Ref a = kZeros, b = kZeros, c = kZeros;
};

/// Makes steps; equal ones are one.
class FleetLogic {
 public:
  FleetLogic() { steps.push_back({}); }

  Ref load(std::uint32_t plane) { return make(FleetStep::Kind::kLoad, plane, kZeros, kZeros); }
  Ref later() { return make(FleetStep::Kind::kLater, 0, kZeros, kZeros); }
  /// a & b with as few negations as possible: the remaining steps are one processor instruction each.
  Ref both(Ref a, Ref b) {
    if (a > b) std::swap(a, b);
    if (a == kZeros || a == (b ^ 1u)) return kZeros;
    if (a == kOnes || a == b) return b;
    if ((a & b & 1u) != 0) return either(a ^ 1u, b ^ 1u) ^ 1u;
    if ((b & 1u) != 0) return make(FleetStep::Kind::kAndNot, 0, a, b ^ 1u);
    if ((a & 1u) != 0) return make(FleetStep::Kind::kAndNot, 0, b, a ^ 1u);
    return make(FleetStep::Kind::kAnd, 0, a, b);
  }
  Ref either(Ref a, Ref b) {
    if (((a | b) & 1u) != 0) return both(a ^ 1u, b ^ 1u) ^ 1u;
    if (a > b) std::swap(a, b);
    if (a == kZeros || a == b) return b;
    return make(FleetStep::Kind::kOr, 0, a, b);
  }
  /// Adds a step without looking for an equal one.
  Ref append(FleetStep step) {
    steps.push_back(step);
    return static_cast<Ref>(steps.size() - 1) << 1;
  }

  std::vector<FleetStep> steps;

 private:
  Ref make(FleetStep::Kind kind, std::uint32_t what, Ref a, Ref b) {
    const auto [at, fresh] = known_.try_emplace({kind, what, a, b}, 0);
    if (fresh) at->second = append({kind, what, a, b, kZeros});
    return at->second;
  }

  std::map<std::tuple<FleetStep::Kind, std::uint32_t, Ref, Ref>, Ref> known_;
};

}  // namespace kb::tables
