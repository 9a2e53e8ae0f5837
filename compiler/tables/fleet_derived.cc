#include "compiler/tables/fleet_derived.h"

#include <algorithm>
#include <optional>

namespace kb::tables {
namespace {

using StepKind = FleetStep::Kind;
using PlaneKind = FleetPlane::Kind;

/// How many operations of its own a derived plane may cost. With more, storing the plane and reading it again is cheaper.
constexpr std::size_t kMostNewParts = 6;
/// How many planes and operations a host may have to go through to read one derived plane.
constexpr std::uint32_t kMostReads = 64;

bool may_be_derived(PlaneKind kind) {
  switch (kind) {
    case PlaneKind::kActive:
    case PlaneKind::kRuns:
    case PlaneKind::kHeld:
    case PlaneKind::kSeveral:
    case PlaneKind::kDone:
    case PlaneKind::kTimerOn:
    case PlaneKind::kHoldOn: return true;
    default: return false;
  }
}

class Deriver {
 public:
  Deriver(const FleetForm& form, const program::Program& program) : form_(form), p_(program), last_(form.planes.size(), kZeros) {}

  DerivedPlanes run() {
    for (const FleetStep& step : form_.steps) {
      if (step.kind == StepKind::kTraced) break;
      if (step.kind == StepKind::kPut) last_[step.what] = step.a;
    }
    // A value that is just as the host gave it, or as the last tick left another plane, is not derived, but others may be derived from it.
    for (std::uint32_t i = form_.given; i < form_.plain_planes; ++i) {
      if (!may_be_derived(form_.planes[i].kind) || form_.steps[last_[i] >> 1].kind == StepKind::kLoad) keep(i);
    }
    for (std::uint32_t i = form_.given; i < form_.plain_planes; ++i) {
      const auto at = home_.find(last_[i] >> 1);
      const bool kept = at != home_.end() && at->second == i;
      if (!kept && may_be_derived(form_.planes[i].kind) && !derive(i)) keep(i);
    }
    return std::move(out_);
  }

 private:
  void keep(std::uint32_t plane) {
    if (last_[plane] > kOnes) home_.try_emplace(last_[plane] >> 1, plane);
  }

  bool derive(std::uint32_t plane) {
    const PlaneKey key = key_of(form_.planes[plane]);
    if (last_[plane] == kZeros) return out_.roots.try_emplace(key).second;
    const std::size_t before = out_.parts.size();
    visits_ = 0;
    std::optional<Ref> ref = translate(last_[plane]);
    if (ref && ((*ref & 1u) != 0 || out_.parts[*ref >> 1].kept)) ref = make(*ref, *ref);
    if (!ref || new_operations(before) > kMostNewParts || reads_[*ref >> 1] > kMostReads) {
      forget(before);
      return false;
    }
    out_.roots[key] = {*ref >> 1, starts(*ref)};
    return true;
  }
  [[nodiscard]] std::size_t new_operations(std::size_t before) const {
    return static_cast<std::size_t>(std::count_if(out_.parts.begin() + static_cast<std::ptrdiff_t>(before), out_.parts.end(), [](const DerivedPlanes::Part& part) { return !part.kept; }));
  }
  void forget(std::size_t before) {
    std::erase_if(known_, [&](const auto& item) { return item.second >= before; });
    std::erase_if(leaves_, [&](const auto& item) { return item.second >= before; });
    out_.parts.resize(before);
    reads_.resize(before);
  }

  /// The value as an expression, if it can be made of values in planes that are kept.
  std::optional<Ref> translate(Ref ref) {
    if (++visits_ > kMostReads * 2 || ref <= kOnes) return std::nullopt;
    if (const auto at = home_.find(ref >> 1); at != home_.end()) {
      return leaf(at->second) ^ ((last_[at->second] ^ ref) & 1u);
    }
    const FleetStep& s = form_.steps[ref >> 1];
    if (s.kind != StepKind::kAnd && s.kind != StepKind::kOr && s.kind != StepKind::kAndNot) return std::nullopt;
    const bool either = s.kind == StepKind::kOr;
    const std::optional<Ref> a = translate(s.a);
    const std::optional<Ref> b = a ? translate(s.b) : std::nullopt;
    if (!b) return std::nullopt;
    const Ref both = make(*a ^ (either ? 1u : 0u), *b ^ (s.kind == StepKind::kAnd ? 0u : 1u));
    return both ^ (either ? 1u : 0u) ^ (ref & 1u);
  }

  Ref leaf(std::uint32_t plane) {
    const auto [at, fresh] = leaves_.try_emplace(plane, static_cast<std::uint32_t>(out_.parts.size()));
    if (fresh) add({true, form_.planes[plane], kZeros, kZeros}, 1);
    return at->second << 1;
  }
  Ref make(Ref a, Ref b) {
    const auto [at, fresh] = known_.try_emplace({a, b}, static_cast<std::uint32_t>(out_.parts.size()));
    if (fresh) add({false, {}, a, b}, std::min(reads_[a >> 1] + reads_[b >> 1] + 1, kMostReads + 1));
    return at->second << 1;
  }
  void add(const DerivedPlanes::Part& part, std::uint32_t reads) {
    out_.parts.push_back(part);
    reads_.push_back(reads);
  }

  /// The value of the expression for a robot that has not ticked yet.
  [[nodiscard]] bool starts(Ref ref) const {
    const DerivedPlanes::Part& part = out_.parts[ref >> 1];
    const bool value = part.kept ? starts(part.plane) : starts(part.a) && starts(part.b);
    return value != ((ref & 1u) != 0);
  }
  [[nodiscard]] bool starts(const FleetPlane& plane) const {
    if (plane.kind != PlaneKind::kCode) return false;
    const std::vector<float>& values = form_.satellites[plane.of].values;
    const auto at = std::lower_bound(values.begin(), values.end(), p_.cells[p_.facts + plane.of].initial + 0.0f);
    return ((at - values.begin()) >> plane.bit & 1) != 0;
  }

  const FleetForm& form_;
  const program::Program& p_;
  DerivedPlanes out_;
  std::vector<Ref> last_;                           // by plane: what the tick leaves there
  std::map<std::uint32_t, std::uint32_t> home_;     // by step: a kept plane that has its value or the complement
  std::map<std::uint32_t, std::uint32_t> leaves_;   // by plane: its part
  std::map<std::pair<Ref, Ref>, std::uint32_t> known_;
  std::vector<std::uint32_t> reads_{0};             // by part
  std::uint32_t visits_ = 0;
};

}  // namespace

DerivedPlanes derived_planes(const FleetForm& form, const program::Program& program) { return Deriver(form, program).run(); }

}  // namespace kb::tables
